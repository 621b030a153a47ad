# SPDX-FileCopyrightText: 2026 The Bladewright authors
# SPDX-License-Identifier: MIT
#
# What the hostile scripts share; sourced, with the script's own arguments: the program blade, a folder that is made afresh, and the
# example whose results are written (the panel unless it is given).
set -euo pipefail
blade="$1"
folder="$2"
piece="${3:-panel-600x670}"
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

# Two runs, a and b, that differ: the panel with a blade that rests as it is drawn, so that programs are written, or another value of a
# variable of a design.
panel_job() { echo "{\"blade\": {\"preset\": \"steel-tube-3-2.5\", \"length\": 690}, \"clearance\": 30, \"tolerance\": 10, $1}"; }
case "$piece" in
  panel-600x670)
    made_of=$piece.step
    panel_job '"stations": 12' >a.json
    panel_job '"stations": 14, "lead": 25' >b.json
    ;;
  three-block-wall) made_of=$piece.bladewright changed="wave=50" ;;
  two-crossing-cuts) made_of=$piece.bladewright changed="bow=30" ;;
  *) fail "there are no two runs of $piece" ;;
esac
"$blade" example "$piece" --out "$made_of" 2>/dev/null

# write_command RUN FOLDER: puts the command that writes a run into the array `write`.
write_command() {
  case "$1 $made_of" in
    *.step) write=("$blade" rationalize "$made_of" --job "$1.json" --out "$2") ;;
    a*) write=("$blade" design "$made_of" --out "$2") ;;
    b*) write=("$blade" design "$made_of" --set "$changed" --out "$2") ;;
  esac
}

# write_run RUN FOLDER
write_run() {
  local write
  write_command "$@"
  "${write[@]}"
}

# The folder of the first program of a robot, 1 or 2, in a result.
program_of() { (cd "$1" && find programs -type d -name "T_ROB$2" | LC_ALL=C sort | head -n 1); }
