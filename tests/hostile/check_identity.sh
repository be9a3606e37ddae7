#!/usr/bin/env bash
# A scan and its catalogue must not be confused with others, and must agree on every object.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

largest() { # number of the largest region of scan/ without an object
  (cd "$work" && "$program" session regions scan --json 2>/dev/null) |
    python3 -c 'import json, sys
print(max((r for r in json.load(sys.stdin) if r["object"] is None), key=lambda r: r["voxels"])["id"])'
}
list() { (cd "$work" && "$program" objects list --database "$1" --json 2>/dev/null); }
command -v python3 >/dev/null || { echo "NOT RUN: needs python3"; exit 0; }

succeeds "a scan" "$program" scan demo --frames 20 --out scan
succeeds "a scan of something else" "$program" scan demo:room:3 --frames 20 --out other
region=$(largest)
succeeds "naming" "$program" session name scan --region "$region" --name mug
prints "the name is in the list" '"mug"' "$program" session regions scan --json

succeeds "renaming in the catalogue" "$program" objects rename mug "red mug" --database scan/catalogue.sqlite
succeeds "a data set" "$program" export scan --format masks --out renamed
holds "it has the new name" grep -q '"red mug"' "$work/renamed/labels.json"

mkdir "$work/own" && mv "$work"/scan/catalogue.sqlite* "$work/own/"
prints "without the catalogue" "what the session kept" "$program" export scan --format masks --out alone
cp "$work"/other/catalogue.sqlite* "$work/scan/"
list other/catalogue.sqlite >"$work/before.json"
prints "undo beside a foreign catalogue" "is another one than" "$program" session undo scan
list scan/catalogue.sqlite >"$work/after.json"
holds "the foreign catalogue is as before" cmp -s "$work/before.json" "$work/after.json"
succeeds "redo beside it" "$program" session redo scan

rm -f "$work"/scan/catalogue.sqlite* && mv "$work"/own/catalogue.sqlite* "$work/scan/"
succeeds "with its own catalogue again" "$program" session regions scan
succeeds "deleting in the catalogue" "$program" objects delete "red mug" --database scan/catalogue.sqlite
succeeds "another data set" "$program" export scan --format masks --out deleted
holds "it has no deleted object" sh -c '! grep -q mug deleted/labels.json'

finish
