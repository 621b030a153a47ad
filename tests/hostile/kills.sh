#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Bladewright authors
# SPDX-License-Identifier: MIT
#
# kill -9 of a run that writes over the result of another one, at random moments of the whole run and, every other time, of its
# writing. Afterwards the folder is the one run or the other, byte by byte, or `blade check` says that it is not; the programs of the
# two robots are of one run in any case, and what a person put there stays. The next run makes it whole and clears everything away.
name="kills"
. "$(dirname "$0")/common.sh"

rounds=$((12 * rounds_factor))
for run in a b; do
  write_run $run $run 2>err.txt || fail "run $run"
  robot=$(program_of $run 1)
  echo "mine" >$run/notes.txt
  echo "mine" >"$run/$robot/notes.txt"
done
# How long a run takes, and how much of that the writing.
began=$(date +%s%N)
{ write_run b warm 2>&1 >/dev/null || true; } | while IFS= read -r line; do
  case "$line" in writing*) date +%s%N >writing.txt ;; esac
done
ended=$(date +%s%N)
length=$((ended - began))
writing=$((ended - $(cat writing.txt)))

# True if the programs of the two robots of each cut are of one run.
pairs_agree() {
  local cut
  while IFS= read -r cut; do
    [ "$(grep -h -o 'Run [0-9a-f]\{16\}' "$cut"/T_ROB*/*.mod 2>/dev/null | sort -u | wc -l)" -le 1 ] || return 1
  done < <(find result/programs -type d -name T_ROB1 -printf '%h\n' 2>/dev/null)
}
# The report tells how long the run took, which is never the same.
is_run() { diff -r -x report.json -x '*.part-*' -x .bladewright-writer "$1" result >/dev/null && cmp -s <(grep '"run"' "$1/report.json") <(grep '"run"' result/report.json); }

before=0 after=0 told=0 cleared=0
for i in $(seq 1 "$rounds"); do
  rm -rf result && cp -a a result
  mkfifo messages
  write_command b result
  "${write[@]}" 2>messages &
  writer=$!
  exec 3<messages
  rm messages
  if [ $((i % 2)) -eq 0 ]; then
    while IFS= read -r line <&3; do case "$line" in writing*) break ;; esac; done
    wait_ns=$(((RANDOM * 32768 + RANDOM) % (writing + writing / 4)))
  else
    wait_ns=$(((RANDOM * 32768 + RANDOM) % length))
  fi
  sleep "$(printf '%d.%09d' $((wait_ns / 1000000000)) $((wait_ns % 1000000000)))"
  kill -9 "$writer" 2>/dev/null || true
  wait "$writer" 2>/dev/null || true
  exec 3<&-
  pairs_agree || fail "round $i: the robots' programs are of two runs"
  [ "$(cat result/notes.txt "result/$robot/notes.txt" 2>/dev/null)" = "mine
mine" ] || fail "round $i: what a person put there is gone"
  status=$(status_of "$blade" check result)
  if is_run a; then
    before=$((before + 1))
    [ "$status" = 0 ] || fail "round $i: check complains about the earlier run, which is whole"
  elif is_run b; then
    after=$((after + 1))
    [ "$status" = 0 ] || fail "round $i: check complains about the new run, which is whole"
  else
    told=$((told + 1))
    [ "$status" = 1 ] || fail "round $i: a mixture that check does not tell (status $status)"
  fi
  if [ "$status" = 1 ] || [ -n "$(find result -name '*.part-*' -o -name .bladewright-writer)" ]; then
    write_run b result 2>err.txt || fail "round $i: the next run"
    is_run b || fail "round $i: the next run is not whole"
    [ -z "$(find result -name '*.part-*' -o -name .bladewright-writer)" ] || fail "round $i: something of the dead writer is left"
    cleared=$((cleared + 1))
  fi
done

echo "hostile kills of $piece: $rounds: $before left the earlier run, $after the new one, $told a state that check told; 0 mixed in silence; $cleared cleared away by the next run"
