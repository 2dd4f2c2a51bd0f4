#!/usr/bin/env bash
# The readers take random input for a minute: scripts/dev/fuzz says more. Its build takes longer.
set -euo pipefail
cd "$(dirname "$0")/../.."
exec scripts/dev/fuzz 60
