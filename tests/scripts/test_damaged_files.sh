#!/usr/bin/env bash
# Scripts that read cases and results end with a message, whatever is wrong with them: a few dozen
# damaged ones of a fixed seed. scripts/dev/fuzz goes on where this ends.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
/usr/bin/python3 -c 'import h5py, jinja2, matplotlib' 2>/dev/null || exit 77
for script in case_to_job:60 still_holds:40 stock_report:30 result_report:10 result_report_loop:6; do
  "$root/tests/fuzz/fuzz_scripts.py" --seconds 300 --attempts "${script#*:}" --only "${script%:*}"
done
