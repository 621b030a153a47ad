#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Bladewright authors
# SPDX-License-Identifier: MIT
#
# kill -9 of `blade rationalize` over the result of another design, at random moments of the whole run and, every other time, of its
# writing. Afterwards the folder is the one run or the other, byte by byte, or `blade check` says that it is not; the programs of the
# two robots are of one run in any case, and what a person put there stays. The next run makes it whole and clears everything away.
name="kills"
. "$(dirname "$0")/common.sh"

rounds=$((12 * rounds_factor))
"$blade" example panel-600x670 --out panel.step 2>/dev/null
panel_job a.json '"stations": 12, "tolerance": 10'
panel_job b.json '"stations": 14, "tolerance": 10, "lead": 25'
for run in a b; do
  "$blade" rationalize panel.step --job $run.json --out $run 2>/dev/null
  mkdir -p $run/programs/strip-0/T_ROB1
  echo "mine" >$run/notes.txt
  echo "mine" >$run/programs/strip-0/T_ROB1/notes.txt
done
# How long a run takes, and how much of that the writing.
began=$(date +%s%N)
{ "$blade" rationalize panel.step --job b.json --out warm 2>&1 >/dev/null || true; } | while IFS= read -r line; do
  case "$line" in writing*) date +%s%N >writing.txt ;; esac
done
ended=$(date +%s%N)
length=$((ended - began))
writing=$((ended - $(cat writing.txt)))

run_lines() { grep -h -o 'Run [0-9a-f]\{16\}' result/programs/strip-0/T_ROB*/*.mod 2>/dev/null | sort -u | wc -l; }
# The report tells how long the run took, which is never the same.
is_run() { diff -r -x report.json -x '*.part-*' -x .bladewright-writer "$1" result >/dev/null && cmp -s <(grep '"run"' "$1/report.json") <(grep '"run"' result/report.json); }

before=0 after=0 told=0 cleared=0
for i in $(seq 1 "$rounds"); do
  rm -rf result && cp -a a result
  mkfifo messages
  "$blade" rationalize panel.step --job b.json --out result 2>messages &
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
  [ "$(run_lines)" -le 1 ] || fail "round $i: the robots' programs are of two runs"
  [ "$(cat result/notes.txt result/programs/strip-0/T_ROB1/notes.txt 2>/dev/null)" = "mine
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
    "$blade" rationalize panel.step --job b.json --out result 2>err.txt || fail "round $i: the next run"
    is_run b || fail "round $i: the next run is not whole"
    [ -z "$(find result -name '*.part-*' -o -name .bladewright-writer)" ] || fail "round $i: something of the dead writer is left"
    cleared=$((cleared + 1))
  fi
done

echo "hostile kills: $rounds kills: $before left the earlier run, $after the new one, $told a state that check told; 0 mixed in silence; $cleared cleared away by the next run"
