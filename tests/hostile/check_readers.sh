#!/usr/bin/env bash
# Real-world recordings: odd times, names, images and camera files; and exports of their scans.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
command -v python3 >/dev/null || { echo "python3 is needed"; exit 1; }

make() { python3 "$here/make_images.py" "$1" "$work/$2"; }
# Peak memory of a command in MB.
peak_mb() {
  (cd "$work" && python3 -c '
import resource, subprocess, sys
subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=170)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss // 1024)' "$@")
}
first_stamp() { sed -n 2p "$work/$1/trajectory.txt" | cut -d. -f1; }

make equal-times equal-times
peak=$(peak_mb "$program" scan equal-times --frames 1 --out out-equal)
holds "20,000 equal times need less than 1.5 GB, it was $peak MB" test "$peak" -lt 1500

make nanoseconds nanoseconds
prints "times in nanoseconds are said" "are nanoseconds" "$program" scan nanoseconds --out out-nanoseconds
holds "they are written as seconds" test "$(first_stamp out-nanoseconds)" = 1403636579

make marked marked
succeeds "lists with a byte order mark" "$program" scan marked --intrinsics 146,146,80,60 --out out-marked

make long-names long-names
prints "names of 19 digits are times" "are nanoseconds" "$program" scan long-names --out out-long-names
holds "they are written as seconds, too" test "$(first_stamp out-long-names)" = 1581120424
make any-names any-names
prints "equal names of any text" "3 tracked" "$program" scan any-names --out out-any-names

for kind in rgba sixteen-bits; do
  make "$kind" "$kind"
  succeeds "colour of $kind" "$program" scan "$kind" --out "out-$kind"
  for format in coco bop yolo masks; do
    succeeds "$kind as $format" "$program" export "out-$kind" --format "$format" --background --out "$kind-$format"
  done
done
# Bytes 24 and 25 of a PNG are bit depth and color type.
only_rgb() {
  local files image
  files=$(find . -path "./*-*/*" -name '*.png' \( -path '*/images/*' -o -path '*/rgb/*' -o -path '*/color/*' \) \
    -not -path './rgba/*' -not -path './sixteen-bits/*' -not -path './long-names/*' -not -path './any-names/*')
  [ -n "$files" ] || return 1
  for image in $files; do
    [ "$(od -An -tu1 -j24 -N2 "$image" | tr -d ' \n')" = 82 ] || { echo "$image is not 8-bit RGB"; return 1; }
  done
}
holds "exported colour is 8-bit RGB" only_rgb

succeeds "a scan with objects" "$program" scan demo --frames 20 --out out-demo
succeeds "meshes around the origin" "$program" export out-demo --format mesh --centred --out meshes
without_blanks() { test -d meshes/objects && ! find meshes -name "* *" | grep -q .; }
holds "mesh files have no blanks in their names" without_blanks
offsets() { test -f meshes/labels.json && test "$(ls meshes/objects/*.json | wc -l)" = "$(ls meshes/objects/*.ply | wc -l)"; }
holds "each object's offset lies beside it" offsets
refuses "--centred of another format" "mesh" "$program" export out-demo --format ply --centred --out cloud

finish
