/// The published standardised data of bc-stan's example, and the densities that Stan has
/// for it.
#pragma once

#include "emulator/density.hpp"
#include "support/csv_table.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::emulator::test {

using bemcal::test::CsvTable;
using bemcal::test::shared_file;

inline bool is_reference_absent() {
    return bemcal::test::is_absent(shared_file("koh/std_field.csv"));
}

/// Columns a ... b of a table.
inline Matrix columns(const CsvTable& table, std::size_t from, std::size_t n) {
    Matrix made(table.n_rows(), n);
    for (std::size_t i = 0; i < table.n_rows(); ++i) {
        const std::vector<double> row = table.numbers(i, from + n);
        std::copy_n(row.begin() + static_cast<std::ptrdiff_t>(from), n,
                    made.row(i).begin());
    }
    return made;
}

/// As the files have it, without standardising again; the output's scale is the
/// published one.
inline Standardised reference_data() {
    const CsvTable field(shared_file("koh/std_field.csv")),
        runs(shared_file("koh/std_comp.csv"));
    Standardised made;
    made.data.measured = columns(field, 0, 1).values;
    made.data.measured_x = columns(field, 1, 3);
    made.data.simulated = columns(runs, 0, 1).values;
    made.data.simulated_x = columns(runs, 1, 3);
    made.data.simulated_t = columns(runs, 4, 3);
    made.data.x_names = {"x1", "x2", "x3"};
    made.data.t_names = {"t1", "t2", "t3"};
    made.output = {2051.24719145833, 542.758553675629};
    made.x.resize(3);
    made.t.resize(3);
    return made;
}

/// Normalisations of the priors, which Stan leaves out: 9 x Beta(1, 0.3), Gamma(10, 10),
/// Gamma(10, 0.3), Gamma(10, 0.03).
inline double prior_constants() {
    return 9 * std::log(0.3) + 10 * (std::log(10.0) + std::log(0.3) + std::log(0.03)) -
           3 * std::lgamma(10.0);
}

}  // namespace bemcal::emulator::test
