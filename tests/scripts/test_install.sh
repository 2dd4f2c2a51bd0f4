#!/usr/bin/env bash
# `cmake --install` puts the program, its jobs and its scripts under any prefix, and what is
# installed works from any folder.
set -euo pipefail
prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
cmake --install "$BEMCAL_BUILD" --prefix "$prefix" >/dev/null
fail() { echo "$*" >&2; exit 1; }

cd /
"$prefix/bin/bemcal-batch" --version | grep -qE '[0-9]+\.[0-9]+\.[0-9]+' || fail "no version printed"
for text in LICENSE CHANGELOG.md CITATION.cff; do
  [[ -s $prefix/share/doc/bemcal/$text ]] || fail "$text was not installed"
done
for file in man/man1/bemcal-batch.1 man/man5/bemcal-job.5 bash-completion/completions/bemcal-batch \
    zsh/site-functions/_bemcal-batch; do
  [[ -s $prefix/share/$file ]] || fail "$file was not installed"
done
[[ -d $prefix/share/bemcal/jobs ]] || fail "no jobs were installed"
for script in build check container dev environment install-packages quickstart test; do
  [[ ! -e $prefix/share/bemcal/scripts/$script ]] || fail "scripts/$script works on a checkout only"
done
env -u BEMCAL_PROGRAM PATH=/usr/bin:/bin PYTHONPATH="$prefix/share/bemcal/scripts/python" /usr/bin/python3 -B -c \
  'import bemcal, sys; sys.exit(bemcal.program.find() != sys.argv[1])' "$prefix/bin/bemcal-batch" ||
  fail "the installed Python package does not find the program beside it"
"$prefix/share/bemcal/scripts/result_report" --help >/dev/null || fail "the installed result_report does not start"
shopt -s nullglob
for job in "$prefix"/share/bemcal/jobs/*/quickstart*.toml "$prefix"/share/bemcal/jobs/quickstart*.toml; do
  "$prefix/bin/bemcal-batch" check "$job" >/dev/null || fail "check of the installed $job failed"
done
