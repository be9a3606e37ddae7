#!/usr/bin/env bash
# Edits of a session that are interrupted, undone and redone: no orphan in the catalogue, no partial edit, the same
# region numbers in all files.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

# One value of a database of the folder scan.
ask() { sqlite3 "$work/scan/$1.sqlite" "$2"; }
# While the index exists, no row of the table for which the condition holds can be written.
block() { ask "$1" "CREATE INDEX obstacle ON $2 (CASE WHEN $3 THEN json('none') END)"; }
unblock() { ask "$1" "DROP INDEX obstacle"; }
objects() { ask catalogue "SELECT count(*) FROM objects"; }
called() { ask catalogue "SELECT count(*) FROM objects WHERE hidden = 0 AND name = '$1'"; }
is() { [ "$1" = "$2" ] || { echo "$1 is not $2" >>"$work.output"; false; }; }
# The largest region without an object.
free_region() {
  "$program" session regions "$work/scan" --json | python3 -c '
import json, sys
free = [r for r in json.load(sys.stdin) if r["object"] is None]
print(max(free, key=lambda r: r["voxels"])["id"])'
}

succeeds "a scan" "$program" scan demo --frames 12 --set fusion.working_width=160 --label-maps --out scan
cp -r "$work/scan" "$work/whole"
region=$(free_region)
before=$(objects)

for action in session-begin add add-view session-end rename confirm; do
  rm -rf "$work/scan" && cp -r "$work/whole" "$work/scan"
  newest=$(ask catalogue "SELECT max(id) FROM events")
  block catalogue events "action = '$action' AND id > $newest"
  for try in 1 2 3; do
    prints "naming says that the catalogue fails ($action)" "not its catalogue" \
      "$program" session name scan --region "$region" --name cup
  done
  unblock catalogue
  holds "failed tries leave no object ($action)" is "$(objects)" "$before"
  succeeds "the next try ($action)" "$program" session name scan --region "$region" --name cup
  holds "there is one object, and no orphan ($action)" is "$(objects) $(called cup)" "$((before + 1)) 1"
done

succeeds "an undo" "$program" session undo scan --steps 1
refuses "more steps than there are" "Only" "$program" session undo scan --steps 50
holds "nothing was undone" is "$(ask session "SELECT count(*) FROM operations WHERE state = 'done'")" 3

# The program is killed at a random moment, and the region named again.
rm -rf "$work/scan" && cp -r "$work/whole" "$work/scan"
for pause in 0.05 0.15 0.25 0.35 0.45 0.6 0.8 1.0 1.3 1.6; do
  { (cd "$work" && timeout -s KILL "$pause" "$program" session name scan --region "$region" --name cup) & } 2>/dev/null
  wait "$!" 2>/dev/null
done
succeeds "naming after kills" "$program" session name scan --region "$region" --name cup
holds "kills leave one object" is "$(objects) $(called cup)" "$((before + 1)) 1"

rm -rf "$work/scan" && cp -r "$work/whole" "$work/scan"
numbers() {
  python3 - "$program" "$work/scan" <<'PYTHON'
import collections, json, struct, subprocess, sys
program, scan = sys.argv[1:]
regions = json.loads(subprocess.run([program, "session", "regions", scan, "--json"], capture_output=True).stdout)
header, points = open(scan + "/cloud.ply", "rb").read().split(b"end_header\n", 1)
points = list(struct.iter_unpack("<fff3BIB", points))
voxels = collections.Counter(point[6] for point in points if not point[7])
shown = {point[6] for point in points} - {0}
listed = {int(number) for number in json.load(open(scan + "/labels.json"))}
voxels.pop(0, None)
wrong = {r["id"]: r["voxels"] for r in regions if voxels[r["id"]] != r["voxels"]}
print(len(wrong), "of", len(regions), "regions have other numbers in cloud.ply", file=sys.stderr)
sys.exit(bool(wrong) or listed - {0} != shown)
PYTHON
}
holds "files number regions as the session" numbers
holds "the cloud says of when it is" grep -qa "as the scan ended" scan/cloud.ply
succeeds "an edit" "$program" session background scan "$region"
prints "files from before an edit are told" "older than the last edits" "$program" session show scan

finish
