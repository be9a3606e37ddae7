#!/usr/bin/env bash
# Runs every command of --help on a full disk, in a read-only folder, beside a second program, with empty arguments, and
# with a folder of foreign files. Each must end with an exit code, and with a message when it fails.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

if [ "${HOSTILE_MOUNTS:-}" != yes ]; then
  export HOSTILE_MOUNTS=yes
  unshare -m true 2>/dev/null && exec unshare -m "$BASH" "${BASH_SOURCE[0]}"
  HOSTILE_MOUNTS=no
  echo "No file systems can be mounted here: full disks and read-only folders are not tested."
fi

formats="coco bop yolo masks ply pcd mesh tum scannet"

# Expects exit code 0, or 1 or 2 with a message.
explains() {
  local name=$1
  shift
  run "$@"
  if ! ended_by_itself || [ "$code" -gt 2 ]; then note_fail "$name" "ended with code $code"; return; fi
  if [ "$code" -ne 0 ] && ! grep -qE '[a-z]{3,} .*[a-z]{3,}' "$work.output"; then note_fail "$name" "prints no message"; return; fi
  if grep -qE 'terminate called|std::|Segmentation|Aborted' "$work.output"; then note_fail "$name" "prints internals of the code"; return; fi
  note_pass
}

# As explains, but the exit code must not be 0.
fails() {
  local name=$1
  explains "$@"
  [ "$code" -ne 0 ] || note_fail "$name" "exit code 0"
}

succeeds "a scan" "$program" scan demo --frames 24 --stride 4 --out scan
succeeds "a recording" "$program" record demo --frames 6 --out rec
region=$(cd "$work" && "$program" session regions scan --json 2>/dev/null | grep -oE '"id": *[0-9]+' | head -1 | grep -oE '[0-9]+')
object=$(cd "$work" && "$program" objects list --database scan/catalogue.sqlite --json 2>/dev/null | grep -oE '"id": *[0-9]+' | head -1 | grep -oE '[0-9]+')
object=${object:-1}
checksum() { (cd "$1" && find . -type f -print0 | sort -z | xargs -0 sha256sum); }

# Commands that write: each takes the scan folder and the folder to write into.
writers() {
  local check=$1 what=$2 scan=$3 out=$4
  "$check" "scan, $what" "$program" scan demo --frames 4 --label-maps --out "$out"
  "$check" "record, $what" "$program" record demo --frames 4 --out "$out"
  for format in $formats; do
    "$check" "export $format, $what" "$program" export "$scan" --format "$format" --out "$out"
  done
}

# Commands that change a scan or its catalogue.
editors() {
  local check=$1 what=$2 scan=$3
  "$check" "resume, $what" "$program" scan rec --frames 4 --resume "$scan"
  "$check" "session name, $what" "$program" session name "$scan" --region "$region" --name "red mug"
  "$check" "session background, $what" "$program" session background "$scan" --region "$region"
  "$check" "session undo, $what" "$program" session undo "$scan"
  "$check" "session redo, $what" "$program" session redo "$scan"
  "$check" "objects rename, $what" "$program" objects rename --database "$scan/catalogue.sqlite" "$object" mug
  "$check" "objects confirm, $what" "$program" objects confirm --database "$scan/catalogue.sqlite" "$object"
  "$check" "objects delete, $what" "$program" objects delete --database "$scan/catalogue.sqlite" "$object"
}

# Commands that only read.
readers() {
  local check=$1 what=$2 scan=$3
  for command in show regions history; do
    "$check" "session $command, $what" "$program" session "$command" "$scan"
  done
  "$check" "session suggest, $what" "$program" session suggest "$scan" --masks rec
  "$check" "objects list, $what" "$program" objects list --database "$scan/catalogue.sqlite"
  "$check" "evaluate trajectory, $what" "$program" evaluate trajectory --estimate "$scan/trajectory.txt" --truth rec
  "$check" "evaluate segmentation, $what" "$program" evaluate segmentation --estimate "$scan" --truth rec
  "$check" "evaluate catalogue, $what" "$program" evaluate catalogue --scan "$scan" --truth rec
}

# A folder of foreign files: no command changes any of them.
mkdir -p "$work/theirs/map" "$work/theirs/keyframes" "$work/theirs/labels" "$work/theirs/images"
for file in trajectory.txt labels.json cloud.ply session.txt map/page.bin keyframes/000000.color.png labels/000000.png \
  images/a.png annotations.json dataset.yaml report.json; do
  echo "somebody's $file" >"$work/theirs/$file"
done
checksum "$work/theirs" >"$work.theirs"
writers explains "somebody's folder" scan theirs
readers explains "somebody's folder" theirs
editors fails "somebody's folder" theirs
checksum "$work/theirs" >"$work.now"
holds "somebody's files stay" sh -c "grep -vxFf '$work.now' '$work.theirs' | wc -l | grep -qx 0"

# Empty arguments.
for command in scan bench record export window; do explains "$command ''" "$program" "$command" ""; done
explains "''" env -u DISPLAY QT_QPA_PLATFORM=offscreen timeout -s TERM 10 "$program" ""
for option in --out --database --frames --start --stride --poses --intrinsics --depth-scale --config --set --device \
  --resume --color-registration; do
  fails "scan $option ''" "$program" scan rec --frames 2 "$option" ""
done
for option in --format --out; do fails "export $option ''" "$program" export scan --format ply --out other "$option" ""; done
for command in show regions at name join cut background undo redo history object; do
  fails "session $command ''" "$program" session "$command" ""
done
fails "session name --region ''" "$program" session name scan --region "" --name mug
for command in list show rename confirm merge delete; do
  fails "objects $command --database ''" "$program" objects "$command" --database ""
done
for command in trajectory segmentation catalogue; do
  fails "evaluate $command ''" "$program" evaluate "$command" --estimate "" --scan "" --truth ""
  fails "evaluate $command --truth ''" "$program" evaluate "$command" --truth ""
done
holds "empty arguments leave nothing behind" sh -c 'test "$(ls | sort | tr "\n" " ")" = "rec scan theirs "'

# Unwritable output.
for command in "session show scan" "objects list --database scan/catalogue.sqlite" params devices \
  "evaluate trajectory --estimate scan/trajectory.txt --truth rec"; do
  # shellcheck disable=SC2086
  run sh -c "'$program' $command >/dev/full"
  if ended_by_itself && [ "$code" -eq 1 ]; then note_pass; else note_fail "$command >/dev/full" "exit code $code"; fi
done

if [ "$HOSTILE_MOUNTS" = yes ]; then
  # A full disk: 256 KiB for new files, and a copy of the scan on a disk without a free block.
  mkdir "$work/small" "$work/full" "$work/still"
  mount -t tmpfs -o size=256k tmpfs "$work/small"
  for format in $formats; do
    explains "export $format, full disk" "$program" export scan --format "$format" --out small/data
  done
  fails "scan, full disk" "$program" scan demo --frames 6 --label-maps --out small/scan
  rm -rf "$work/small"/*
  fails "record, full disk" "$program" record demo --frames 6 --out small/rec
  umount "$work/small"
  mount -t tmpfs -o size=$(($(du -sm "$work/scan" | cut -f1) + 2))m tmpfs "$work/full"
  cp -r "$work/scan" "$work/full/scan"
  dd if=/dev/zero of="$work/full/ballast" bs=4k 2>/dev/null
  readers explains "full disk" full/scan
  editors explains "full disk" full/scan
  rm "$work/full/ballast"
  succeeds "a scan that met a full disk opens" "$program" session show full/scan
  succeeds "its catalogue opens" "$program" objects list --database full/scan/catalogue.sqlite
  umount "$work/full"

  # A read-only folder.
  cp -r "$work/scan" "$work/still/scan"
  mount --bind "$work/still" "$work/still" && mount -o remount,bind,ro "$work/still"
  writers fails "read-only folder" scan still/out
  readers explains "read-only folder" still/scan
  editors fails "read-only folder" still/scan
  umount "$work/still"
fi

# A second program: a stopped scan holds its folder, and other commands must refuse it.
(cd "$work" && exec "$program" scan demo:room:1 --frames 100000 --out busy >"$work.busy" 2>&1) &
busy=$!
for _ in $(seq 300); do
  [ -s "$work/busy/session.sqlite" ] && break
  sleep 0.2
done
kill -STOP "$busy"
writers explains "second program" busy busy/inner
fails "scan, second program" "$program" scan demo --frames 4 --out busy
fails "resume, second program" "$program" scan rec --frames 4 --resume busy
readers explains "second program" busy
editors explains "second program" busy
began=$SECONDS
kill -TERM "$busy" && kill -CONT "$busy"
wait "$busy"
holds "the running scan ends within 5 s of SIGTERM" test $((SECONDS - began)) -le 6
succeeds "the scan that others looked at opens" "$program" session show busy

rm -f "$work.theirs" "$work.now" "$work.busy"
finish
