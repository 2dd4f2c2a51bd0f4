/// Sums for any processor. Source: the loops of `sums_kernel.inl`. Leaves out all that
/// newer instruction sets have.
#include "stats/sums_kernel.hpp"

namespace bemcal::stats {

namespace {
constexpr long width = 2;
}

#include "stats/sums_kernel.inl"

const SumsKernel sums_plain{add_products, add_gram};

}  // namespace bemcal::stats
