/// Chooses the widest kernel that this processor can run; BEMCAL_KERNEL overrides.
/// Source: the feature levels x86-64-v3 and v4, asked of the compiler's cpu_supports. It
/// does not measure which kernel is faster, and refuses processors without FMA. Those
/// that are not x86-64 have the scalar kernel alone.
#include "kernel/batch.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace bemcal::kernel {

namespace {

constexpr InstructionSet widest_first[] = {InstructionSet::v4, InstructionSet::v3,
                                           InstructionSet::scalar};

InstructionSet wanted(const std::string& name) {
    for (InstructionSet set : widest_first)
        if (name == name_of(set)) {
            if (is_supported(set)) return set;
            throw std::invalid_argument(
                fmt::format("BEMCAL_KERNEL = {}: this processor cannot run it; leave "
                            "BEMCAL_KERNEL unset",
                            name));
        }
    throw std::invalid_argument(
        fmt::format("BEMCAL_KERNEL = {}: expected scalar, v3 or v4", name));
}

}  // namespace

const char* name_of(InstructionSet set) {
    constexpr const char* names[] = {"scalar", "v3", "v4"};
    return names[static_cast<std::size_t>(set)];
}

#if defined(__x86_64__)
bool is_supported(InstructionSet set) {
    const bool fma = __builtin_cpu_supports("fma") != 0;
    const bool avx2 = fma && __builtin_cpu_supports("avx2") != 0;
    switch (set) {
        case InstructionSet::scalar:
            return fma;
        case InstructionSet::v3:
            return avx2 && __builtin_cpu_supports("bmi") != 0 &&
                   __builtin_cpu_supports("bmi2") != 0;
        case InstructionSet::v4:
            return avx2 && __builtin_cpu_supports("avx512f") != 0 &&
                   __builtin_cpu_supports("avx512dq") != 0 &&
                   __builtin_cpu_supports("avx512bw") != 0 &&
                   __builtin_cpu_supports("avx512cd") != 0 &&
                   __builtin_cpu_supports("avx512vl") != 0;
    }
    return false;
}
#else
bool is_supported(InstructionSet set) {
    return set == InstructionSet::scalar;
}
#endif

InstructionSet choose_instruction_set() {
    if (const char* name = std::getenv("BEMCAL_KERNEL")) return wanted(name);
    for (InstructionSet set : widest_first)
        if (is_supported(set)) return set;
    throw std::invalid_argument(
        "this processor has no fused multiply-add (FMA, since 2013)");
}

}  // namespace bemcal::kernel
