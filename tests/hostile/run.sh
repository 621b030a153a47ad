#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Bladewright authors
# SPDX-License-Identifier: MIT
#
# The hostile runs of a build, one line each: what was tried, how often, and what came of it (docs/reliability.md).
#   tests/hostile/run.sh [small|large] [REGEX]   small is what ctest runs; large has a hundred times the rounds; REGEX chooses by name
# BW_BUILD names the build folder (build/dev); BW_HOSTILE, if set, is the factor on the rounds itself.
set -euo pipefail
cd "$(dirname "$0")/../.."

case "${1:-small}" in
  small) factor=1 ;;
  large) factor=100 ;;
  *) echo "usage: $0 [small|large] [REGEX]" >&2; exit 2 ;;
esac
export BW_HOSTILE="${BW_HOSTILE:-$factor}"
build="${BW_BUILD:-build/dev}"
log="$build/hostile.log"
status=0
ctest --test-dir "$build" -L hostile -R "${2:-.}" --verbose >"$log" 2>&1 || status=$?
sed -n 's/^[0-9]*: \(hostile .*\)$/\1/p' "$log"
if [ "$status" -ne 0 ]; then
  echo "a hostile run failed; see $log" >&2
fi
exit "$status"
