# Shared by the scripts in tests/hostile: runs the program on hostile inputs and counts passed checks.
# Checks run in $work, an empty folder that is removed at the end, for at most $limit_s each.
#
#   refuses   NAME TEXT COMMAND...   exit 1 or 2, no signal, and stderr or stdout contains TEXT
#   succeeds  NAME COMMAND...        exit 0
#   prints    NAME TEXT COMMAND...   exit 0, and stderr or stdout contains TEXT
#   survives  NAME COMMAND...        exit 0, 1 or 2 in time: neither a signal nor a hang
#   holds     NAME COMMAND...        a shell condition, e.g. holds "the file is kept" test -f x
set -u
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=${SCANTROVE:-$here/../../build/dev/app/scantrove}
data=${SCANTROVE_DATA:-$here/../../../shared/data}
limit_s=${HOSTILE_LIMIT_S:-180}
work=$(mktemp -d)
passed=0
failed=0

leave() {
  chmod -R u+rwX "$work" 2>/dev/null
  rm -rf "$work"
}
trap leave EXIT

note_pass() { passed=$((passed + 1)); }
note_fail() {
  failed=$((failed + 1))
  echo "FAILED: $1: $2"
  [ -s "$work.output" ] && tail -n 6 "$work.output" | cut -c1-300 | sed 's/^/    /'
}

# Runs a command in $work with a time limit; its exit code is in $code, its output in $work.output.
run() {
  (cd "$work" && timeout --kill-after=5 "$limit_s" "$@") >"$work.output" 2>&1 </dev/null
  code=$?
}

ended_by_itself() { [ "$code" -lt 124 ]; }
is_printed() { grep -qF -- "$1" "$work.output"; }

refuses() {
  local name=$1 text=$2
  shift 2
  run "$@"
  if ! ended_by_itself; then note_fail "$name" "ended with code $code"; return; fi
  if [ "$code" -ne 1 ] && [ "$code" -ne 2 ]; then note_fail "$name" "exit code $code"; return; fi
  if ! is_printed "$text"; then note_fail "$name" "the message lacks \"$text\""; return; fi
  note_pass
}

prints() {
  local name=$1 text=$2
  shift 2
  run "$@"
  if [ "$code" -ne 0 ]; then note_fail "$name" "exit code $code"; return; fi
  if ! is_printed "$text"; then note_fail "$name" "the output lacks \"$text\""; return; fi
  note_pass
}

succeeds() {
  local name=$1
  shift
  run "$@"
  if [ "$code" -ne 0 ]; then note_fail "$name" "exit code $code"; return; fi
  note_pass
}

survives() {
  local name=$1
  shift
  run "$@"
  if ! ended_by_itself || [ "$code" -gt 2 ]; then note_fail "$name" "ended with code $code"; return; fi
  note_pass
}

holds() {
  local name=$1
  shift
  : >"$work.output"
  if (cd "$work" && "$@"); then note_pass; else note_fail "$name" "the condition is false"; fi
}

# Prints the summary of a script. Exit code 0: all checks passed.
finish() {
  rm -f "$work.output"
  echo "$passed passed, $failed failed"
  [ "$failed" -eq 0 ]
}
