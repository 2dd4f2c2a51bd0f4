/// What a Kennedy-O'Hagan calibration learns from: measurements at known inputs x, and
/// runs of a simulator at inputs (x, t) (paper 1, eq. 1-2); and both without units.
#pragma once

#include "base/matrix.hpp"

#include <string>
#include <vector>

namespace bemcal::emulator {

/// In physical units.
struct Observations {
    std::vector<double> measured;     ///< [n]
    Matrix measured_x;                ///< [n x p] known inputs
    std::vector<double> simulated;    ///< [m]
    Matrix simulated_x, simulated_t;  ///< [m x p], [m x q] known and calibrated inputs
    std::vector<std::string> x_names, t_names;  ///< [p], [q]; empty = x1 ..., t1 ...
};

/// scaled = (physical - origin) / width.
struct Scale {
    double origin = 0, width = 1;
    double scaled(double physical) const { return (physical - origin) / width; }
    double physical(double scaled) const { return origin + width * scaled; }
};

/// The same without units: outputs less the mean of the simulated outputs over their
/// standard deviation (n - 1); x from 0 to 1 over measurements and runs together; t from
/// 0 to 1 over the runs' design.
struct Standardised {
    Observations data;
    Scale output;
    std::vector<Scale> x, t;  ///< [p], [q]
};

/// Throws std::invalid_argument: shapes that do not fit, a number that is not finite, an
/// input or output of one value only, two runs at one point.
Standardised standardise(const Observations& observations);

/// Rows of known inputs as the scales have them. \param x  [k x p]
Matrix scaled_rows(const Matrix& x, const std::vector<Scale>& scales);

}  // namespace bemcal::emulator
