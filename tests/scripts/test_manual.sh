#!/usr/bin/env bash
# The man pages that the program writes have no fault that groff knows of, and hold every command
# and kind of study; bash and zsh complete commands, options, topics and files by what it writes.
set -euo pipefail
program=${BEMCAL_PROGRAM:?}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "$*" >&2; exit 1; }
cd "$folder"

"$program" describe man 1 >bemcal-batch.1
"$program" describe man 5 >bemcal-job.5
if command -v groff >/dev/null; then
  for page in bemcal-batch.1 bemcal-job.5; do
    faults=$(groff -man -ww -Tascii -P-cbou "$page" 2>&1 >"$page.txt")
    [[ -z $faults ]] || fail "groff finds in $page: $faults"
  done
  for word in run check describe status report adopt; do
    grep -q "bemcal-batch $word" bemcal-batch.1.txt || fail "the man page lacks the command $word"
  done
  grep -q "FILE\[:COLUMN" bemcal-batch.1.txt || fail "the man page cuts the type of --meter"
  grep -q "u_value" bemcal-job.5.txt || fail "the man page of a job lacks u_value"
else
  echo "groff is not there: the man pages were not formatted"
fi

# What is mistaken on the command line is told in a line.
told() { [[ $("$program" "${@:2}" 2>&1 | head -n 1) == "$1" ]] || fail "after '${*:2}' it is not said: $1"; }
told 'bemcal-batch: chek: there is no such command or job; did you mean "check"?' chek office.toml
told "--every: 0: expected a number above 0" status office.h5 --watch --every 0
[[ $("$program" status --help) == *"Usage: bemcal-batch status "* ]] || fail "the help's usage is no line to type"

# The words that bash offers for a line; the last one is completed.
"$program" describe completion bash >completion
bash -n completion
complete_line() {
  bash -c 'source ./completion
    COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
    _bemcal_batch
    printf "%s\n" "${COMPREPLY[@]}"' bash "$@"
}
expect() {  # what is offered, then the line
  local words
  words=$(complete_line "${@:2}" | sed '/^$/d' | sort | tr '\n' ' ')
  [[ $words == "$1" ]] || fail "after '${*:2}' bash offers '$words', not '$1'"
}
touch office.toml stock.csv office.h5 notes.txt
mkdir folder
expect "describe " bemcal-batch desc
expect "folder office.toml stock.csv " bemcal-batch check ""
expect "folder office.h5 " bemcal-batch report ""
expect "folder office.h5 office.toml stock.csv " bemcal-batch adopt ""
expect "--nodes " bemcal-batch check --no
expect "posterior " bemcal-batch describe post
expect "office.toml " bemcal-batch off
expect "" bemcal-batch check no

# The same of zsh, which completes the line at a terminal.
if ! command -v zsh >/dev/null; then
  echo "zsh is not there: its completion was not tried"
elif ! zsh -fc 'zmodload zsh/zpty; zpty shell true' 2>/dev/null; then
  echo "zsh finds no pseudo-terminal: its completion was not tried"
else
  "$program" describe completion zsh >_bemcal-batch
  zsh -n _bemcal-batch || fail "zsh does not read its completion"
  expect_zsh() {  # what is offered, then the line
    local words
    words=$(timeout 60 zsh -f "$here/zsh_offers.zsh" "$PWD" "bemcal-batch $2" | sed '/^$/d' | tr '\n' ' ')
    [[ $words == "$1" ]] || fail "after 'bemcal-batch $2' zsh offers '$words', not '$1'"
  }
  expect_zsh "describe " "desc"
  expect_zsh "folder office.toml stock.csv " "check "
  expect_zsh "folder office.h5 " "report "
  expect_zsh "--nodes " "check --no"
  expect_zsh "posterior " "describe post"
  expect_zsh "--weather " "new office.toml --weather 2021.epw --we"
  expect_zsh "office.h5 office.toml " "run --after o"
fi
