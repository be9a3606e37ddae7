#!/usr/bin/env bash
# Commands must not delete a user's files: exports beside other folders, scans into folders that are not empty.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

succeeds "a scan" "$program" scan demo --frames 3 --out scan
cp -r "$work/scan" "$work/before"
same() { diff -rq -x catalogue.sqlite* -x session.sqlite* "$work/scan" "$work/before"; }

mkdir "$work/data.part-backup" && echo mine >"$work/data.part-backup/photo"
succeeds "an export" "$program" export scan --format ply --out data
holds "an export keeps a folder named like its own part" test -f "$work/data.part-backup/photo"
holds "an export holds no marker" test ! -e "$work/data/.scantrove-unfinished"

refuses "a mistyped catalogue" "missing" "$program" scan demo --frames 3 --out scan --database missing/a.sqlite
refuses "a mistyped source" "nothing" "$program" scan nothing --out scan

succeeds "a recording" "$program" record demo --frames 3 --out rec
refuses "a depth scale that leaves no depth" "" "$program" scan rec --depth-scale 10000000 --out scan
holds "refused scans leave the earlier one" same
prints "the earlier scan opens" '"tracked": 3' "$program" session show scan --json

echo mine >"$work/scan/keyframes/holiday.jpg"
refuses "pictures of others among the key frames" "holiday.jpg" "$program" scan demo --frames 3 --out scan
succeeds "told to overwrite" "$program" scan demo --frames 3 --out scan --overwrite
holds "pictures of others stay" test -f "$work/scan/keyframes/holiday.jpg"

mkdir "$work/recording" && echo truth >"$work/recording/trajectory.txt"
refuses "the folder of a recording" "trajectory.txt" "$program" scan demo --frames 3 --out recording
holds "a recording's trajectory stays" grep -q truth "$work/recording/trajectory.txt"

finish
