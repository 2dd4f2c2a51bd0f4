#!/bin/sh
# The kernels for AVX, AVX2 and AVX-512 have no weak symbols, and the check itself finds one elsewhere.
set -eu
root=$(dirname "$0")/../..
if [ "$(uname -m)" != x86_64 ]; then
  echo "only x86-64 has these kernels: skipped"
  exit 77
fi
objects=$BEMCAL_BUILD/CMakeFiles/bemcal_kernel.dir/src/kernel
if nm "$objects/kernel_v3.cpp.o" | grep -q asan; then
  echo "sanitizers add weak symbols of their own: skipped"
  exit 77
fi
"$root/scripts/dev/check_weak_symbols" "$objects/kernel_v3.cpp.o" "$objects/kernel_v4.cpp.o"
emulator=$BEMCAL_BUILD/CMakeFiles/bemcal_emulator.dir/src/emulator
"$root/scripts/dev/check_weak_symbols" "$emulator/correlation.cpp.o" "$emulator/elimination.cpp.o"
! "$root/scripts/dev/check_weak_symbols" "$BEMCAL_BUILD/CMakeFiles/bemcal_job.dir/src/job/grid_kind.cpp.o" >/dev/null
