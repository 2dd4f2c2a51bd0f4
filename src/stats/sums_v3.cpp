/// Sums for processors with AVX2. Source: the loops of `sums_kernel.inl`, compiled for
/// x86-64-v3. Leaves out fused multiplications: others would get other bits.
#include "stats/sums_kernel.hpp"

namespace bemcal::stats {

namespace {
constexpr long width = 4;
}

#include "stats/sums_kernel.inl"

const SumsKernel sums_v3{add_products, add_gram};

}  // namespace bemcal::stats
