#!/usr/bin/env bash
# The program built by clang++ gives the same result, bit for bit, as this one: the quickstart, made
# small, with each instruction set of this processor.
set -euo pipefail
. "$(dirname "$0")/small_jobs.sh"
job=$jobs/quickstart/quickstart.toml
drop_posterior
"$root/scripts/build" clang bemcal-batch
hash_by() {  # hash_by PROGRAM KERNEL
  BEMCAL_KERNEL=$2 "$1" run "$job" --no-report -o "$folder/result.h5" --force >"$folder/log" 2>&1 || {
    cat "$folder/log" >&2; fail "failed: $1 with the kernel $2"; }
  hash_of "$folder/result.h5"
}
kernels=(scalar)
if grep -qw avx2 /proc/cpuinfo; then kernels+=(v3); fi
if grep -qw avx512vl /proc/cpuinfo; then kernels+=(v4); fi
for kernel in "${kernels[@]}"; do
  expected=$(hash_by "$BEMCAL_PROGRAM" "$kernel")
  [[ -n $expected ]] || fail "no result hash"
  hash=$(hash_by "$root/build/clang/bemcal-batch" "$kernel")
  [[ $hash == "$expected" ]] || fail "kernel $kernel: hash $hash by clang++, $expected by this compiler"
  echo "$kernel: $hash by both compilers"
done
