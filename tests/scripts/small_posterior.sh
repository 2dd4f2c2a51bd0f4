# Sourced by tests: the quickstart with two parameters and a short posterior as its only study.
. "$(dirname "${BASH_SOURCE[0]}")/small_jobs.sh"
job=$jobs/quickstart/quickstart.toml
sed -i -E '/^# What the design leaves uncertain/,$d; s/^(training *=).*/\1 ["2021-01-01", "2021-01-31"]/;
  s/^(held_out *=).*/\1 ["2021-02-01", "2021-02-28"]/' "$job"
cat >>"$job" <<'END'
[run]
warm_up_days = 7
[[parameter]]
name = "lights"
target = ["zone.office.load.lights.density"]
min = 7
max = 11
prior = {kind = "normal", mean = 9, sd = 1}
[[parameter]]
name = "equipment"
target = ["zone.office.load.equipment.density"]
min = 8.5
max = 13.5
[[study]]
kind = "posterior"
sampler = "random_walk"
meters = ["electricity"]
discrepancy = false
n_chains = 4
warm_up = 40
draws_per_round = 20
most_draws = 60
target_ess = 1000000
n_predictive = 20
END
