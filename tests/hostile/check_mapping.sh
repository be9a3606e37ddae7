#!/usr/bin/env bash
# Scans of unrelated recordings, with a wrong first frame, or far from the origin.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

# The times of a trajectory increase.
rises() { grep -v '#' "$1" | awk 'NR > 1 && $1 <= last { exit 1 } { last = $1 }'; }
files() { [ "$(find "$1" -type f | wc -l)" -eq "$2" ]; }
# Copies the recording `rec` to $1, with cameras moved by $2 metres along x from frame $3 on.
moved() {
  cp -r "$work/rec" "$work/$1"
  for file in "$work/$1"/*.pose.txt; do
    number=${file##*frame-}
    [ "$((10#${number%.pose.txt}))" -lt "$3" ] && continue
    awk -v by="$2" 'NR == 1 { $4 = sprintf("%.6f", $4 + by) } { print }' "$file" >"$work/pose" && mv "$work/pose" "$file"
  done
}
points() { grep -a -m1 'element vertex' "$1" | awk '{ exit !($3 > 1000) }'; }

succeeds "a scan with label images" "$program" scan demo --frames 8 --label-maps --out scan
succeeds "a second recording" "$program" scan demo --frames 6 --label-maps --resume scan
holds "times of both recordings rise" rises scan/trajectory.txt
holds "label images of both are kept" files scan/labels 14
prints "the session knows the second one's numbers" '"index_shift": 8' "$program" session show scan --json

succeeds "a recording" "$program" record demo --frames 4 --out rec
moved far 5600000 0
succeeds "poses 5,600 km from the origin" "$program" scan far --poses given --out far.scan
holds "such a scan has a cloud" points far.scan/cloud.ply
holds "its trajectory is where the recording is" grep -q '^0.000000 5599999\|^0.000000 5.599999\|^0.000000 5.6e' far.scan/trajectory.txt
prints "its frames are all tracked" '4 tracked' "$program" session show far.scan
moved nowhere 1000000000000 0
refuses "poses where no camera is" "where no camera is" "$program" scan nowhere --poses given --out nowhere.scan
moved jump 3000 3
prints "a pose that jumps" "jumps by 3 km" "$program" scan jump --poses given --out jump.scan

succeeds "a longer recording" "$program" record demo --frames 45 --out late
succeeds "a frame of another place" "$program" record demo:room:3 --frames 1 --out other
cp "$work/other/frame-000000.color.png" "$work/other/frame-000000.depth.png" "$work/late/"
prints "a first frame of another place" "begins anew" "$program" scan late --out late.scan
prints "the rest is tracked" '14 tracked' "$program" session show late.scan
holds "the report advises" grep -q 'begins anew' late.scan/report.json

succeeds "a device that tracks itself, in steps of 0.6 m" "$program" scan demo:corridor:device --stride 24 --frames 8 --out walk
prints "all its frames are tracked" '8 tracked' "$program" session show walk
holds "the report counts those by the device alone" grep -q '"by_device"' walk/report.json

finish
