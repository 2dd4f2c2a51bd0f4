/// The inner loops of `sums`, once for each instruction set. No header is included where
/// they are compiled: an inline function of it could then end in the program for all
/// processors.
#pragma once

namespace bemcal::stats {

constexpr long parts = 8;      ///< of a sum
constexpr long stretch = 256;  ///< readings that are scaled and summed at once

struct SumsKernel {
    /// sums[r] += rows[r] . v, over n readings
    void (*add_products)(const double* const* rows, long n_rows, const double* v, long n,
                         double* sums);
    /// sums[r n_rows + s] += row r . row s for s <= r, rows of a stretch beside each
    /// other
    void (*add_gram)(const double* rows, long n_rows, double* sums);
};

extern const SumsKernel sums_plain, sums_v3;

}  // namespace bemcal::stats
