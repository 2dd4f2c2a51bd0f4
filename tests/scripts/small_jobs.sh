# Sourced by tests: the shipped jobs, made small, in a folder of their own.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
jobs=$folder/main/jobs
mkdir -p "$folder/main"
cp -r "$root/jobs" "$jobs"
if [[ -d $root/../shared ]]; then ln -s "$(cd "$root/../shared" && pwd)" "$folder/shared"; fi
find "$jobs" -name '*.toml' -exec sed -i -E 's/^( *n_base *=).*/\1 16/; s/^( *n_points *=).*/\1 64/;
  s/^( *n_designs *=).*/\1 8/; s/^( *n_best *=).*/\1 5/; s/^( *n_bootstrap *=).*/\1 20/; s/^( *points_per_item *=).*/\1 16/;
  s/^( *n_chains *=).*/\1 2/; s/^( *warm_up *=).*/\1 5/; s/^( *(draws_per_round|most_draws) *=).*/\1 4/;
  s/^( *n_predictive *=).*/\1 4/; s/^( *evaluations *=).*/\1 200/; /^ *sampler *=/d; s/^ *kind *= *"posterior"/&\nsampler = "random_walk"/;
  s/^ *kind *= *"loop"/&\nmost_effects = 0\ntry_structures = false/' {} +

. "$root/scripts/environment"
fail() { echo "$*" >&2; exit 1; }
hash_of() { "$BEMCAL_PROGRAM" status "$1" | grep -oE '\b[0-9a-f]{32}\b' | head -n 1; }
# Made small, a posterior misses its target, and the run ends with 1; for tests that are not about it.
drop_posterior() { sed -i '/^# The ten that matter/,$d' "$jobs/quickstart/quickstart.toml"; }
