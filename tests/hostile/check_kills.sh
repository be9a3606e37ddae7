#!/usr/bin/env bash
# Kills the program at random moments of a scan, a resumed scan, an export and an edit: check_kills.sh [KILLS] [SEED]
# After each kill the earlier or the new scan opens, and no foreign file is lost.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
kills=${1:-60}
RANDOM=${2:-$(date +%s)}
echo "$kills kills"

succeeds "a scan" "$program" scan demo --frames 8 --out first
succeeds "a recording" "$program" record demo --frames 30 --out rec
mkdir "$work/data" && echo mine >"$work/data/photo"

# Runs a command and kills it after a number of milliseconds.
killed_after() {
  local ms=$1
  shift
  (cd "$work" && exec "$@" >"$work.output" 2>&1) &
  local child=$!
  sleep "$((ms / 1000)).$(printf %03d $((ms % 1000)))"
  kill -9 "$child" 2>/dev/null
  wait "$child" 2>/dev/null
}

opens() {
  local name=$1 scan=$2
  run "$program" session show "$scan"
  if [ "$code" -ne 0 ]; then note_fail "$name" "the scan does not open"; return; fi
  run "$program" objects list --database "$scan/catalogue.sqlite"
  if [ "$code" -ne 0 ]; then note_fail "$name" "the catalogue does not open"; return; fi
  note_pass
}

for ((i = 0; i < kills; ++i)); do
  rm -rf "$work/scan" && cp -r "$work/first" "$work/scan"
  after=$((RANDOM % 4000))
  case $((i % 5)) in
    0) killed_after "$after" "$program" scan rec --out scan ;;
    1) killed_after "$after" "$program" scan rec --resume scan ;;
    2) killed_after $((after / 4)) "$program" export scan --format coco --out data/coco$i ;;
    3) killed_after $((after / 20)) "$program" session undo scan ;;
    4) killed_after $((after / 20)) "$program" objects delete --database scan/catalogue.sqlite 1 ;;
  esac
  opens "kill $i after $after ms" scan
  holds "somebody's file after kill $i" grep -q mine data/photo
  # The remains of a killed export must not look like a complete data set.
  [ -e "$work/data/coco$i" ] && holds "export $i is whole" sh -c "! ls data/coco$i/.scantrove-unfinished"
done
finish
