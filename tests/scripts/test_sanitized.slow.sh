#!/usr/bin/env bash
# The tests of all serial folders with sanitizers: scripts/dev/sanitize says more. Its build takes long.
set -euo pipefail
cd "$(dirname "$0")/../.."
exec scripts/dev/sanitize
