#!/usr/bin/env bash
# The environment of the program: unwritable or damaged caches, signals, limits, odd arguments.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
export XDG_CACHE_HOME=$work/cache TMPDIR=$work/tmp
mkdir "$TMPDIR"
two_frames=(scan demo --frames 2 --overwrite)

# Compiled kernels: without a cache folder, and damaged ones.
prints "HOME that cannot be written" "compiled anew" env -u XDG_CACHE_HOME HOME=/proc "$program" devices
prints "HOME that cannot be written leaves the processor" "[0]" env -u XDG_CACHE_HOME HOME=/proc "$program" devices
prints "a cache folder that cannot be written" "compiled anew" env XDG_CACHE_HOME=/proc "$program" devices
prints "an empty POCL_CACHE_DIR" "[0]" env POCL_CACHE_DIR= "$program" devices
prints "a device that PoCL lacks" "POCL_DEVICES" env POCL_DEVICES=nonsense "$program" devices
succeeds "a scan" "$program" "${two_frames[@]}" --out kernels
kernels=$XDG_CACHE_HOME/scantrove/kernels
holds "compiled kernels are kept" test -d "$kernels"
cp -r "$kernels" "$work/given"
find "$kernels" -name '*.so' -exec truncate -s 0 {} +
prints "empty kernels" "damaged" "$program" "${two_frames[@]}" --out kernels
find "$kernels" -name '*.bc' -exec dd if=/dev/zero of={} bs=1 seek=5000 count=3000 conv=notrunc status=none \;
prints "kernels with zeros" "damaged" "$program" "${two_frames[@]}" --out kernels
find "$work/given" -name '*.bc' -exec sh -c 'echo garbage >"$1"' - {} \;
prints "garbage in a folder of others" "Remove that folder" \
  env POCL_CACHE_DIR="$work/given" "$program" "${two_frames[@]}" --out kernels
holds "files of others stay" sh -c 'grep -rqx garbage given'
holds "nothing is left in TMPDIR" sh -c '! ls tmp | grep -q kernels'

# A signal ends each command within 5 seconds, with its results so far.
#   stops NAME PATTERN COMMAND...   sends SIGTERM once the output has PATTERN
stops() {
  local name=$1 pattern=$2 child begun took_ms watchdog
  shift 2
  : >"$work.output"
  (cd "$work" && exec "$@") >"$work.output" 2>&1 </dev/null &
  child=$!
  for _ in $(seq 1200); do
    grep -q -- "$pattern" "$work.output" && break
    kill -0 "$child" 2>/dev/null || break
    sleep 0.1
  done
  begun=$(date +%s%N)
  kill -TERM "$child" 2>/dev/null
  (sleep 30 && kill -KILL "$child") 2>/dev/null &
  watchdog=$!
  wait "$child" 2>/dev/null
  code=$?
  took_ms=$((($(date +%s%N) - begun) / 1000000))
  kill "$watchdog" 2>/dev/null
  echo "  $name: ended $took_ms ms after the signal, code $code"
  if [ "$took_ms" -gt 5000 ]; then note_fail "$name" "it took $took_ms ms"; else note_pass; fi
}
scan_on=(scan demo --overwrite)
stops "a scan before its first frame" "." env POCL_CACHE_DIR="$work/cold" "$program" "${scan_on[@]}" --out stopped
stops "a scan after some frames" "frames (" "$program" "${scan_on[@]}" --out stopped
holds "its results are written" test -s stopped/cloud.ply
prints "its session opens" '"tracked"' "$program" session show stopped --json
stops "a bench" "frames" "$program" bench demo
stops "an export" "%" "$program" export stopped --format coco --out stopped-coco
stops "a recording" "frames" "$program" record demo --out stopped-recording
python=$(command -v python3) && {
  succeeds "a catalogue for a locked one" "$program" "${two_frames[@]}" --out locked
  "$python" - "$work/locked/catalogue.sqlite" <<'EOF' &
import sqlite3, sys, time
catalogue = sqlite3.connect(sys.argv[1], isolation_level=None)
catalogue.execute("BEGIN IMMEDIATE")
time.sleep(60)
EOF
  lock=$!
  stops "a scan with a locked catalogue" "frames (" "$program" "${scan_on[@]}" --out unlocked --database locked/catalogue.sqlite
  kill "$lock" 2>/dev/null
}
refuses "PoCL's device for debugging" "stops for ever" env POCL_DEVICES=basic "$program" "${two_frames[@]}" --out basic

# Arguments from unset variables or mistakes.
refuses "an empty --intrinsics" "--intrinsics: is empty" "$program" scan demo --out odd --intrinsics ''
refuses "an empty --database" "--database: is empty" "$program" scan demo --out odd --database ''
refuses "an empty --out" "--out: is empty" "$program" export kernels --format ply --out ''
refuses "a catalogue in memory" "no file" "$program" scan demo --frames 1 --out odd --database :memory:
refuses "an --out that is not UTF-8" "not UTF-8" "$program" scan demo --out $'odd\xff'
ln -s nowhere "$work/link"
refuses "an --out that is a dangling link" "nowhere" "$program" scan demo --frames 1 --out link
refuses "an export to a dangling link" "nowhere" "$program" export kernels --format ply --out link
refuses "a scan as the source of a scan" "is a scan, not a recording" "$program" scan kernels --out odd
cp -r "$work/kernels" "$work/nomap" && rm -rf "$work/nomap/map"
refuses "going on without a map" "has no map" "$program" scan demo --frames 2 --resume nomap
refuses "a limit to the size of files" "" bash -c "ulimit -f 1000; exec \"$program\" scan demo --frames 3 --out limited"
printf 'not a database' >"$work/nomap/session.sqlite"
run "$program" session show nomap
cp "$work.output" "$work/printed"
holds "a damaged scan is no catalogue" sh -c 'test -s printed && ! grep -qi catalogue printed'

# Folder names with control sequences of a terminal.
mkdir "$work/names"
cp -r "$work/kernels" "$work/names/$(printf 'a\033[31mb\nc')"
run "$program" session list names
cp "$work.output" "$work/printed"
holds "names are printed without control characters" sh -c 'grep -q 31mb printed && ! grep -q "$(printf "\033")" printed'

finish
