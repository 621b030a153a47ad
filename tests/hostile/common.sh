# SPDX-FileCopyrightText: 2026 The Bladewright authors
# SPDX-License-Identifier: MIT
#
# What the hostile scripts share; sourced, with the script's own arguments: the program blade and a folder that is made afresh.
set -euo pipefail
blade="$1"
folder="$2"
rounds_factor="${BW_HOSTILE:-1}"
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"

# The status of a command, which may fail.
status_of() {
  local status=0
  "$@" >out.txt 2>err.txt || status=$?
  echo "$status"
}

# fail MESSAGE: names what went wrong, with the last messages of the program.
fail() {
  echo "hostile $name: FAILED: $1" >&2
  tail -n 5 err.txt >&2 2>/dev/null || true
  exit 1
}

# panel_job FILE KEYS: a job for the example panel with a blade that rests as it is drawn, so that programs are written.
panel_job() { echo "{\"blade\": {\"preset\": \"steel-tube-3-2.5\", \"length\": 690}, \"clearance\": 30, $2}" >"$1"; }
