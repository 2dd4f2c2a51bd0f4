/// AVX and FMA on four doubles: Intel's intrinsics, and on other processors SIMDe's
/// functions of the same names.
/// Source: Intel's intrinsics guide; SIMDe. Left out: whether the processor can run them,
/// which kernel/instruction_set tells.
#pragma once

#if defined(__x86_64__)
#include <immintrin.h>
#else
#define SIMDE_ENABLE_NATIVE_ALIASES
#include <simde/x86/fma.h>
#endif
