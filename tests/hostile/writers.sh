#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Bladewright authors
# SPDX-License-Identifier: MIT
#
# Two runs of different designs into one folder at once, a random moment apart. At the end the folder is one of them, whole, and whoever
# did not get it was told so with status 4.
name="writers"
. "$(dirname "$0")/common.sh"

rounds=$((6 * rounds_factor))
for run in a b; do write_run $run $run 2>err.txt || fail "run $run"; done

is_run() { diff -r -x report.json "$1" result >/dev/null && cmp -s <(grep '"run"' "$1/report.json") <(grep '"run"' result/report.json); }

told=0 one=0 other=0
for i in $(seq 1 "$rounds"); do
  [ $((i % 3)) -ne 0 ] || rm -rf result
  if [ $((RANDOM % 2)) -eq 0 ]; then order=(a b); else order=(b a); fi
  write_run "${order[0]}" result 2>"${order[0]}.txt" &
  first=$!
  wait_ms=$((RANDOM % 900))
  sleep "0.$(printf '%03d' "$wait_ms")"
  write_run "${order[1]}" result 2>"${order[1]}.txt" &
  second=$!
  declare "status_${order[0]}=0" "status_${order[1]}=0"
  wait "$first" || declare "status_${order[0]}=$?"
  wait "$second" || declare "status_${order[1]}=$?"
  for status in $status_a $status_b; do
    case "$status" in 0 | 4) ;; *) fail "round $i: status $status" ;; esac
  done
  [ "$status_a" = 0 ] || [ "$status_b" = 0 ] || fail "round $i: nobody wrote"
  for run in a b; do
    status="status_$run"
    [ "${!status}" = 0 ] && continue
    told=$((told + 1))
    grep -q "nothing was written to result, because" $run.txt || fail "round $i: status 4 without the reason"
  done
  [ "$(status_of "$blade" check result)" = 0 ] || fail "round $i: the folder is not one run: $(cat out.txt)"
  if is_run a; then
    one=$((one + 1))
    [ "$status_a" = 0 ] || fail "round $i: the run of one that was told to have written nothing"
  elif is_run b; then
    other=$((other + 1))
    [ "$status_b" = 0 ] || fail "round $i: the run of one that was told to have written nothing"
  else
    fail "round $i: neither run"
  fi
  [ -z "$(find result -name '*.part-*' -o -name .bladewright-writer)" ] || fail "round $i: something is left"
done

echo "hostile writers of $piece: $rounds pairs: $one times the one, $other times the other, whole each time; $told writers told that the folder is another's"
