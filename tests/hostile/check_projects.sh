#!/usr/bin/env bash
# Hostile masks, projects, lists of classes, pictures and catalogues: one message, exit code 1 or 2, and no file of the
# user's changes. Needs python3.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

if [ "${HOSTILE_MOUNTS:-}" != yes ]; then
  export HOSTILE_MOUNTS=yes
  unshare -m true 2>/dev/null && exec unshare -m "$BASH" "${BASH_SOURCE[0]}"
  HOSTILE_MOUNTS=no
  echo "No file systems can be mounted here: read-only folders are not tested."
fi

# All files with checksums, and all folders. SQLite's files beside a database, and empty locks, come and go.
tree() {
  (cd "$work" && find . ! -type f -printf '%y %p %l\n' | sort &&
    find . -type f ! -name '*-shm' ! -name '*-wal' ! -name '*.lock' -print0 | sort -z | xargs -0 sha256sum)
}

# As refuses; nothing below $work changes, and the message has no internals of the code.
spares() {
  local name=$1
  tree >"$work.before"
  refuses "$@"
  if grep -qE 'terminate called|std::|json\.exception|nlohmann|SQLITE|Segmentation|Aborted|what\(\)' "$work.output"; then
    note_fail "$name" "prints internals of the code"
  fi
  tree >"$work.after"
  if cmp -s "$work.before" "$work.after"; then note_pass; else
    diff "$work.before" "$work.after" | head -n 5 >"$work.output"
    note_fail "$name" "files changed"
  fi
}

succeeds "a project" "$program" project create project
succeeds "its scan" "$program" project scan project demo --frames 24 --stride 4
scan=$(cd "$work" && ls -d project/scans/* | head -n 1)
region=$(cd "$work" && "$program" session regions "$scan" --json 2>/dev/null | grep -oE '"id": *[0-9]+' | head -1 | grep -oE '[0-9]+')
succeeds "a name" "$program" session name "$scan" --region "$region" --name mug --class cup
cp -r "$work/$scan" "$work/project/scans/second"

# Masks.
frame=$(cd "$work" && "$program" session review "$scan" --list --json 2>/dev/null | grep -oE '"frame": *[0-9]+' | head -1 | grep -oE '[0-9]+')
python3 - "$work" <<'PYTHON'
import struct, sys, zlib
def chunk(kind, content):
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
def write(name, width=640, height=480, value=b"\xff", color_type=0):
    """A rectangle of the value on black."""
    inside = [100 <= i < 200 for i in range(max(width, height))]
    rows = [b"\0" + b"".join(value if inside[x] and inside[y] else bytes(len(value)) for x in range(width)) for y in range(height)]
    bits = 16 if color_type == 0 and len(value) == 2 else 8
    data = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, bits, color_type, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(b"".join(rows))) + chunk(b"IEND", b""))
    open(f"{sys.argv[1]}/{name}", "wb").write(data)
    return data
write("small.png", 320, 240)
write("large.png", 1280, 960)
write("turned.png", 480, 640)
write("deep.png", value=b"\xff\xff")
write("alpha.png", value=b"\xff\xff\xff\xff", color_type=6)
write("color.png", value=b"\xff\0\0", color_type=2)
write("none.png", value=b"\0")
write("faint.png", value=b"\x7f")
whole = write("good.png")
open(f"{sys.argv[1]}/cut.png", "wb").write(whole[: len(whole) // 2])
open(f"{sys.argv[1]}/empty.png", "wb").close()
open(f"{sys.argv[1]}/text.png", "w").write("no image\n")
PYTHON
mkdir "$work/folder.png"
paint() { spares "paint $1" "$2" "$program" session paint "$scan" "$3" --frame "$frame" --region "$region" --set; }
for mask in small large turned deep alpha color none faint cut empty text folder missing; do
  case $mask in none | faint) text=painted ;; *) text=$mask.png ;; esac
  paint "$mask.png" "$text" "$mask.png"
done
spares "paint a frame that is no key frame" "99999" "$program" session paint "$scan" good.png --frame 99999 --region "$region" --set
spares "paint frame -1" "frame" "$program" session paint "$scan" good.png --frame -1 --region "$region" --set
spares "paint a region that is not there" "99999" "$program" session paint "$scan" good.png --frame "$frame" --region 99999 --set
spares "paint region 0" "0" "$program" session paint "$scan" good.png --frame "$frame" --region 0 --set
spares "paint a line" "polygon" "$program" session paint "$scan" --polygon 1,2,3,4 --frame "$frame" --region "$region" --add
spares "paint no numbers" "polygon" "$program" session paint "$scan" --polygon 1,2,x,4,5,6 --frame "$frame" --region "$region" --add
spares "paint infinity" "polygon" "$program" session paint "$scan" --polygon 1,2,inf,4,5,6 --frame "$frame" --region "$region" --add
spares "paint beside the image" "painted" "$program" session paint "$scan" --polygon=-9,-9,-5,-9,-5,-5 --frame "$frame" --region "$region" --add
spares "paint far away" "p" "$program" session paint "$scan" --polygon 1e30,0,2e30,0,2e30,9 --frame "$frame" --region "$region" --add
spares "masks over a file" "good.png" "$program" session masks "$scan" --frame "$frame" --out good.png
spares "masks into a missing folder" "nowhere" "$program" session masks "$scan" --frame "$frame" --out nowhere/masks.png
spares "paint in a folder that is no scan" "project" "$program" session paint project good.png --frame 0 --region 1 --set

# Exports of a project.
mkdir "$work/theirs" && echo mine >"$work/theirs/notes.txt"
export_project() { spares "$1" "$2" "$program" export --project project --format "$3" "${@:4}"; }
for format in coco bop yolo masks voc labelstudio boxes foundationpose ply pcd mesh tum scannet; do
  export_project "export $format into the user's folder" "notes.txt" "$format" --out theirs
done
succeeds "an export" "$program" export --project project --format coco --out data
echo changed >>"$work/data/README.md"
export_project "export over a changed file" "README.md" coco --out data
succeeds "another export" "$program" export --project project --format masks --out masks
export_project "export of another format over it" "masks" coco --out masks
rm "$work/masks/labels.json" && mkdir "$work/masks/labels.json"
export_project "export over a folder in a file's place" "labels.json" masks --out masks
ln -s "$work/theirs" "$work/link"
export_project "export into a link to the user's folder" "notes.txt" coco --out link
export_project "export into a file" "good.png" coco --out good.png
export_project "export into the project" "project" coco --out project
export_project "export into a scan" "$(basename "$scan")" coco --out "$scan"
export_project "export without a folder" "--out" coco
export_project "export below a file" "good.png" coco --out good.png/data
for split in train val test; do
  export_project "a scan that is none for $split" "nobody" coco "--$split" nobody --out other
  export_project "a path as a scan for $split" ".." coco "--$split" ../theirs --out other
done
export_project "a scan twice" "second" coco --train second --val second --out other
export_project "no shares" "split" coco --split train=x --out other
export_project "negative shares" "split" coco --split train=-1,val=2 --out other
export_project "shares of nothing" "split" coco --split train=0,val=0 --out other
export_project "both ways of splitting" "split" coco --split train=1 --train second --out other
export_project "a class that is none" "zebra" coco --class zebra --out other
spares "export of a folder that is no project" "theirs" "$program" export --project theirs --format coco --out other
spares "export of nothing" "nowhere" "$program" export --project nowhere --format coco --out other
if [ "$HOSTILE_MOUNTS" = yes ]; then
  mkdir "$work/still"
  mount -t tmpfs tmpfs "$work/still" && cp -r "$work/project" "$work/still/project" && mkdir "$work/still/empty"
  mount -o remount,ro "$work/still"
  export_project "export into a read-only folder" "still" coco --out still/empty
  export_project "export into a new folder on a read-only disk" "still" coco --out still/new
  spares "scan into a read-only project" "still" "$program" project scan still/project demo --frames 4
  spares "a project in a read-only folder" "still" "$program" project create still/another
  run "$program" project show still/project
  if ended_by_itself && [ "$code" -le 1 ]; then note_pass; else note_fail "show a read-only project" "exit code $code"; fi
  spares "a class in a read-only catalogue" "still" "$program" objects classes add zebra --database still/project/catalogue.sqlite
  spares "a picture into a read-only folder" "still" "$program" render "$scan" --out still/picture.png
  spares "a catalogue into a read-only folder" "still" "$program" objects copy --from project/catalogue.sqlite --to still/copy.sqlite
fi

# Folders that are no projects.
for command in show list; do
  spares "project $command of the user's folder" "theirs" "$program" project "$command" theirs
  spares "project $command of nothing" "nowhere" "$program" project "$command" nowhere
  spares "project $command of a file" "good.png" "$program" project "$command" good.png
done
spares "project scan into the user's folder" "theirs" "$program" project scan theirs demo --frames 4
spares "project create in the user's folder" "theirs" "$program" project create theirs
spares "project create over a project" "project" "$program" project create project
spares "project create below a file" "good.png" "$program" project create good.png/project
spares "a list that is missing" "list.txt" "$program" project scan project --list list.txt
head -c 4096 /dev/urandom >"$work/noise.txt"
spares "a list of noise" "noise.txt" "$program" project scan project --list noise.txt
spares "no jobs" "jobs" "$program" project scan project demo --jobs 0
spares "a task that is none" "task" "$program" project scan project demo --task 3/2
spares "an unknown recording" "nowhere.oni" "$program" project scan project nowhere.oni
broken() {
  rm -rf "$work/broken" && cp -r "$work/project" "$work/broken"
  printf "$2" >"$work/broken/scantrove-project.json"
  for command in show list; do spares "project $command: $1" "broken" "$program" project "$command" broken; done
  spares "project scan: $1" "broken" "$program" project scan broken demo --frames 4
  spares "project export: $1" "broken" "$program" export --project broken --format coco --out other
}
broken "an empty file" ""
broken "no JSON" "{not json"
broken "a list" "[1, 2]"
broken "another object" '{"name": 5}'
broken "a newer version" '{"version": 999999, "name": "p", "scantrove_project": 999999}'
broken "noise" '\001\377\376\000{'
rm -rf "$work/broken"

# Lists of classes.
succeeds "a copy of the catalogue" "$program" objects copy --from project/catalogue.sqlite --to classes.sqlite
import() {
  spares "import $1" "$2" "$program" objects classes import "$3" --database classes.sqlite
}
list() { printf "$2" >"$work/$1"; import "$3" "$1" "$1"; }
list bad.json '{"categories": [' "cut JSON"
list empty.json '' "an empty file"
list number.json '5' "a number"
list none.json '{"images": []}' "JSON without categories"
list types.json '{"categories": [{"id": "x", "name": 7}]}' "wrong types"
list zero.json '{"categories": [{"id": 0, "name": "a"}]}' "id 0"
list huge.json '{"categories": [{"id": 99999999999999999999, "name": "a"}]}' "a huge id"
list ids.json '{"categories": [{"id": 3, "name": "a"}, {"id": 3, "name": "b"}]}' "an id twice"
list names.json '{"categories": [{"id": 3, "name": "a"}, {"id": 4, "name": "a"}]}' "a name twice"
list blank.json '{"categories": [{"id": 3, "name": ""}]}' "an empty name"
list bytes.json '{"categories": [{"id": 3, "name": "\377\376"}]}' "bytes that are no UTF-8"
list quote.csv 'id,name\n1,"open\n' "an open quote"
list columns.csv 'number,title\n1,a\n' "unknown columns"
list twice.csv 'id,name\n1,a\n1,b\n' "an id twice in CSV"
list ragged.csv 'id,name\n1,a,b,c,d\n' "too many fields"
list empty.csv '' "an empty CSV"
printf '%*s' 100000 '' | tr ' ' '[' >"$work/deep.json" && import "deep JSON" deep.json deep.json
python3 - "$work" <<'PYTHON'
import json, sys
for count in (10000, 10001):
    names = [{"id": i + 1000, "name": f"class {i}"} for i in range(count)]
    json.dump({"categories": names}, open(f"{sys.argv[1]}/many{count}.json", "w"))
open(f"{sys.argv[1]}/fat.csv", "w").write("name\n" + "x" * (17 << 20) + "\n")
PYTHON
import "10,001 classes" many10001.json many10001.json
import "17 MiB" fat.csv fat.csv
import "a folder" theirs theirs
import "a missing list" missing.json missing.json
import "a picture" good.png good.png
prints "10,000 classes" "10000" "$program" objects classes import many10000.json --database classes.sqlite
spares "export of classes over a file" "good.png" "$program" objects classes export good.png --database classes.sqlite
spares "a class twice" "cup" "$program" objects classes add cup --database project/catalogue.sqlite
spares "a class with an id that is taken" "1" "$program" objects classes add zebra --id 1 --database project/catalogue.sqlite
spares "classes of a file that is no catalogue" "good.png" "$program" objects classes add zebra --database good.png

# Pictures.
spares "a picture over a file" "good.png" "$program" render "$scan" --out good.png
echo mine >"$work/film.webm"
spares "a video over a file" "film.webm" "$program" render "$scan" --out film.webm
spares "a picture of an unknown kind" "picture.gif" "$program" render "$scan" --out picture.gif
spares "a picture without a kind" "picture" "$program" render "$scan" --out picture
spares "a picture in a missing folder" "nowhere" "$program" render "$scan" --out nowhere/picture.png
spares "a picture in place of a folder" "folder.png" "$program" render "$scan" --out folder.png
spares "a picture of no object" "zebra" "$program" render "$scan" --out picture.png --object zebra
spares "a picture without size" "size" "$program" render "$scan" --out picture.png --size 0x0
spares "a picture that is too large" "size" "$program" render "$scan" --out picture.png --size 1000000x1000000
spares "a picture of no scan" "theirs" "$program" render theirs --out picture.png

# Copies of catalogues.
spares "a catalogue onto itself" "catalogue.sqlite" "$program" objects copy --from project/catalogue.sqlite --to project/catalogue.sqlite
ln -s catalogue.sqlite "$work/project/alias.sqlite"
spares "a catalogue onto itself by a link" "alias.sqlite" "$program" objects copy --from project/catalogue.sqlite --to project/alias.sqlite
rm "$work/project/alias.sqlite"
spares "a catalogue onto another one" "classes.sqlite" "$program" objects copy --from project/catalogue.sqlite --to classes.sqlite
spares "a catalogue onto a picture" "good.png" "$program" objects copy --from project/catalogue.sqlite --to good.png
python3 -c "import sqlite3; b = sqlite3.connect('$work/foreign.sqlite'); b.execute('CREATE TABLE mine (a)'); b.commit()"
spares "a catalogue onto a database of another program" "foreign.sqlite" "$program" objects copy --from project/catalogue.sqlite --to foreign.sqlite
spares "a picture as a catalogue" "good.png" "$program" objects copy --from good.png --to copied.sqlite
spares "a missing catalogue" "missing.sqlite" "$program" objects copy --from missing.sqlite --to copied.sqlite
spares "a catalogue into a missing folder" "nowhere" "$program" objects copy --from project/catalogue.sqlite --to nowhere/copied.sqlite

[ "$HOSTILE_MOUNTS" = yes ] && umount "$work/still"
rm -f "$work.before" "$work.after"
finish
