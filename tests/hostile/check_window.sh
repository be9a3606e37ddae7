#!/usr/bin/env bash
# The refinement can be skipped, interrupted and done later without losses.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

scan=("$program" scan demo:tabletop:7 --frames 20)

succeeds "scan without refinement" "${scan[@]}" --skip-refinement --out skipped
holds "the report says that it was skipped" grep -q '"skipped": true' "$work/skipped/report.json"
prints "the session says so, too" "session refine" "$program" session show skipped
prints "it is done later" "refined with" "$program" session refine skipped
holds "the report says that it is done" grep -q '"skipped": false' "$work/skipped/report.json"
prints "once is enough" "refined already" "$program" session refine skipped

# Ctrl+C during the refinement: ends within 5 s with all results, and the rest can be done later.
interrupt_refinement() {
  local signal=$1 out=$2
  (cd "$work" && exec "${scan[@]}" --out "$out") >"$work/$out.log" 2>&1 &
  local pid=$!
  while kill -0 $pid 2>/dev/null && ! grep -qs "Refining objects" "$work/$out.log"; do sleep 0.05; done
  kill "-$signal" $pid
  local since=$SECONDS
  wait $pid
  interrupted=$?
  [ $((SECONDS - since)) -le 5 ] && [ $interrupted -eq 0 ]
}
for signal in INT TERM; do
  holds "SIG$signal skips the rest within 5 s" interrupt_refinement $signal "by$signal"
  for file in report.json cloud.ply trajectory.txt session.sqlite; do
    holds "SIG$signal keeps $file" test -s "$work/by$signal/$file"
  done
  prints "SIG$signal: the rest is done later" "refined with" "$program" session refine "by$signal"
done

# Refinement needs the catalogue of the scan.
succeeds "another scan without refinement" "${scan[@]}" --skip-refinement --out alone
rm -f "$work"/alone/catalogue.sqlite*
refuses "a catalogue that is gone" "catalogue" "$program" session refine alone
holds "no empty one takes its place" test ! -e "$work/alone/catalogue.sqlite"
refuses "no scan at all" "nothing" "$program" session refine nothing
refuses "an empty argument" "" "$program" session refine ""

finish
