#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Bladewright authors
# SPDX-License-Identifier: MIT
#
# Results that do not fit: files that may not grow beyond every size from nothing to nearly enough, disks of every size, a device that is
# full, folders that are read-only. The earlier result must stay as it was, to the byte, and the status must be 4 with a sentence.
name="full disk"
. "$(dirname "$0")/common.sh"

write_run a result 2>err.txt || fail "the first run"
echo "mine" >result/notes.txt
cp -a result before

same_as_before() { diff -r before result >difference.txt || fail "$1: the earlier result changed: $(head -n 3 difference.txt)"; }

largest=$(find result -type f -printf '%s\n' | sort -n | tail -n 1)
steps=$((20 * rounds_factor))
[ "$steps" -le 400 ] || steps=400
refused=0
for i in $(seq 1 "$steps"); do
  # The limit is in units of 1024 bytes; the largest file does not fit at the last step either.
  blocks=$((largest / 1024 * (i - 1) / steps))
  status=$(ulimit -f "$blocks" && status_of write_run b result)
  [ "$status" = 4 ] || fail "files of at most $blocks kB: status $status instead of 4"
  same_as_before "files of at most $blocks kB"
  refused=$((refused + 1))
done

devices=0
if [ -c /dev/full ]; then
  status=$("$blade" check before >/dev/full 2>err.txt; echo $?) || true
  [ "$status" = 4 ] || fail "standard output that is full: status $status"
  status=$(status_of "$blade" render result --out /dev/full)
  [ "$status" = 4 ] || fail "a picture for a full device: status $status"
  devices=2
fi

# A small file system of our own, from one on which nothing more has room to one on which all has.
disks=0
if unshare -rm true 2>/dev/null; then
  used=$(du -sk before | cut -f 1)
  mkdir disk
  write_command b disk/result
  for i in $(seq 1 "$steps"); do
    size=$((used + 128 + (used + 512) * (i - 1) / steps))
    unshare -rm bash -euc '
      mount -t tmpfs -o size="$1k" tmpfs disk
      cp -a before disk/result
      status=0
      "${@:3}" >out.txt 2>err.txt || status=$?
      if [ "$status" = 4 ]; then
        grep -q "No space left on device; free some space" err.txt
        diff -r before disk/result
      else
        [ "$status" -le 1 ]
        "$2" check disk/result
      fi' _ "$size" "$blade" "${write[@]}" >disk.txt 2>&1 || fail "a disk of $size kB: $(head -n 3 disk.txt)"
    disks=$((disks + 1))
  done
fi

# Root may write everywhere; somebody else may not.
denied=0
someone=()
if [ "$(id -u)" -eq 0 ]; then
  someone=(setpriv --reuid=65534 --regid=65534 --clear-groups)
  chown -R 65534:65534 result
fi
write_command b result
if "${someone[@]}" test -w result; then
  for part in result "result/$(program_of result 2)"; do
    chmod a-w "$part"
    status=$(status_of "${someone[@]}" "${write[@]}")
    chmod u+w "$part"
    [ "$status" = 4 ] || fail "$part is read-only: status $status"
    same_as_before "$part is read-only"
    denied=$((denied + 1))
  done
  # A folder that holds only folders needs not be written to: each file in them is replaced.
  chmod a-w result/programs
  status=$(status_of "${someone[@]}" "${write[@]}")
  chmod u+w result/programs
  [ "$status" -le 1 ] || fail "result/programs is read-only: status $status"
  "$blade" check result >check.txt 2>&1 || fail "result/programs is read-only: $(head -n 3 check.txt)"
  [ -e result/notes.txt ] || fail "result/programs is read-only: a foreign file is gone"
  denied=$((denied + 1))
fi

echo "hostile full disk of $piece: $refused runs with files that may not grow, $disks on a small disk, $devices on full devices, $denied beside read-only folders: each that failed told it with status 4 and left the earlier result whole"
