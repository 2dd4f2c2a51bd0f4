/// Inner products of long rows, of which normal equations are made. Which numbers are
/// added in which order depends on the length alone: not on the machine.
#pragma once

#include <cstddef>

namespace bemcal::stats {

/// Rows of numbers, one after the other: row i begins at values + i x stride.
template <class Number>
struct NumberRows {
    const Number* values;
    std::size_t count, stride;
};

/// Adds the products of rows of a and rows of b, each over n numbers. Sums are of
/// doubles.
/// \param to  [a.count x b.count], row-major
void add_inner_products(const NumberRows<double>& a, const NumberRows<double>& b,
                        std::size_t n, double* to);
void add_inner_products(const NumberRows<float>& a, const NumberRows<float>& b,
                        std::size_t n, double* to);

}  // namespace bemcal::stats
