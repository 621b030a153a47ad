#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Bladewright authors
# SPDX-License-Identifier: MIT
#
# Builds the fuzzers (preset fuzz) and runs each for some seconds, starting from the corpus in this folder.
# usage: tests/fuzz/run.sh [SECONDS]      default 10
# What the fuzzers learn stays in build/fuzz/corpus; an input that breaks something is kept in build/fuzz/findings.
set -eu

seconds="${1:-10}"
case "$seconds" in
  ''|*[!0-9]*) echo "usage: $0 [SECONDS]" >&2; exit 2 ;;
esac
root="$(CDPATH= cd -- "$(dirname -- "$0")/../.." && pwd)"
cd "$root"

if ! command -v clang++ >/dev/null 2>&1; then
  echo "the fuzzers need clang++ with libFuzzer (packages clang and libclang-rt-dev)" >&2
  exit 2
fi
cmake --preset fuzz >/dev/null
cmake --build build/fuzz --target fuzz_job fuzz_design fuzz_curve fuzz_dxf fuzz_program fuzz_typed

status=0
for name in job design curve dxf program typed; do
  learnt="build/fuzz/corpus/$name"
  findings="build/fuzz/findings/$name"
  mkdir -p "$learnt" "$findings"
  log="build/fuzz/fuzz_$name.log"
  options="-max_total_time=$seconds -timeout=10 -rss_limit_mb=2048 -max_len=16384"
  dict="tests/fuzz/$name.dict"
  [ -f "$dict" ] && options="$options -dict=$dict"
  # shellcheck disable=SC2086
  if "build/fuzz/bin/fuzz_$name" $options -artifact_prefix="$findings/" "$learnt" "tests/fuzz/corpus/$name" >"$log" 2>&1; then
    echo "fuzz_$name: $(grep '^Done' "$log" || echo done)"
  else
    echo "fuzz_$name: FAILED, the input is in $findings; the end of $log:" >&2
    tail -n 40 "$log" >&2
    status=1
  fi
done
exit $status
