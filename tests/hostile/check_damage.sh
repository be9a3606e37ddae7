#!/usr/bin/env bash
# Sessions that other programs change during a scan and afterwards.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

# Scans until the session has a map, then COMMAND... changes the folder. $code: exit code of the scan.
disturbed() {
  local out=$1
  shift
  rm -rf "${work:?}/$out"
  (cd "$work" && exec timeout --kill-after=5 "$limit_s" "$program" scan demo --frames 60 --out "$out") \
    >"$work.output" 2>&1 </dev/null &
  local scan=$!
  until [ -s "$work/$out/map/000001.bricks" ] || ! kill -0 "$scan" 2>/dev/null; do sleep 0.1; done
  (cd "$work" && "$@") >/dev/null 2>&1
  wait "$scan"
  code=$?
}

# reports NAME TEXT: the disturbed scan ended with exit code 1 and a message with TEXT.
reports() {
  if [ "$code" -eq 1 ] && is_printed "$2"; then note_pass; else note_fail "$1" "exit code $code, or no \"$2\""; fi
}

disturbed gone rm gone/session.sqlite
reports "a removed database" "written anew"
prints "a removed database is written anew" '"tracked": 60' "$program" session show gone --json

disturbed log rm log/session.sqlite-wal
reports "a removed log" "written anew"
prints "the session of a removed log opens" '"tracked": 60' "$program" session show log --json

disturbed map rm -r map/map
reports "a removed map" "written anew"
prints "the session of a removed map opens" '"damages": []' "$program" session show map --json

disturbed folder rm -r folder
reports "a removed folder" "written anew"
prints "the session of a removed folder opens" '"tracked": 60' "$program" session show folder --json

disturbed taken bash -c 'rm taken/session.sqlite; echo mine >taken/session.sqlite'
reports "a replaced database" "session.rescued.sqlite"
holds "somebody's file in its place stays" grep -q mine "$work/taken/session.sqlite"
mv "$work/taken/session.rescued.sqlite" "$work/taken/session.sqlite"
prints "the rescued session opens" '"tracked": 60' "$program" session show taken --json

disturbed from mv from to
reports "a moved folder" "moved to"
prints "the session of a moved folder opens" '"ended": true' "$program" session show to --json

# Files that were replaced are skipped and named.
succeeds "a scan" "$program" scan demo --frames 12 --out scan
copy() { rm -rf "$work/copy" && cp -r "$work/scan" "$work/copy"; }
change() { copy && python3 -c "import sqlite3, sys; b = sqlite3.connect('$work/copy/session.sqlite'); b.execute(sys.argv[1]); b.commit()" "$1"; }
if command -v python3 >/dev/null; then
  change "UPDATE frames SET tx = tx + 0.1 WHERE number = 5"
  prints "a moved pose" "1 frames of the session" "$program" export copy --format tum --out moved
  change "DELETE FROM pages WHERE x = (SELECT min(x) FROM pages)"
  prints "a missing page" "parts of the map of the session" "$program" session show copy
  change "UPDATE facts SET value = 'attic' WHERE name = 'source'"
  prints "a changed source" '"source": "demo"' "$program" session show copy --json
  echo "200 random changes take long: tests/hostile/mutate_sessions.py $program --count 200"
else
  echo "python3 is missing: no rows were changed"
fi
copy
image=$(cd "$work/copy" && ls keyframes/*.depth.png | head -n 1)
other=$(cd "$work/copy" && ls keyframes/*.color.* | head -n 1)
cp "$work/copy/$other" "$work/copy/$image"
run "$program" export copy --format coco --out coco
if is_printed "$(basename "$image")"; then note_pass; else note_fail "another image in a key frame's place" "not named"; fi

# Nothing is written through symbolic links.
copy
echo mine >"$work/diary"
rm "$work/copy/session.lock" && ln -s "$work/diary" "$work/copy/session.lock"
refuses "a link as the lock" "link" "$program" session show copy
rm -r "$work/copy/map" && mkdir "$work/pictures" && ln -s "$work/pictures" "$work/copy/map"
rm "$work/copy/session.lock"
refuses "a link as the map" "link" "$program" scan demo --frames 3 --out copy --overwrite
holds "nothing is written through a link" test ! -e "$work/pictures/000001.bricks"

# No other scan starts in a folder between its check and the first frame.
cp -r "$work/scan" "$work/held"
(cd "$work" && exec "$program" scan demo --frames 400 --out held) >/dev/null 2>&1 </dev/null &
first=$!
until ls -l "/proc/$first/fd" 2>/dev/null | grep -q session.lock || ! kill -0 "$first" 2>/dev/null; do sleep 0.05; done
refuses "a second scan into the folder" "in use" "$program" scan demo --frames 3 --out held
kill "$first" 2>/dev/null
wait "$first" 2>/dev/null

# A user's file with a name like ours is kept.
copy
echo mine >"$work/copy/keyframes/000123.color.png"
succeeds "a scan over an earlier one" "$program" scan demo --frames 3 --out copy
holds "a file that the session does not name stays" grep -q mine "$work/copy/keyframes/000123.color.png"
prints "and the new scan is there" '"tracked": 3' "$program" session show copy --json

finish
