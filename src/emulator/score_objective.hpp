/// What a measured series says of an emulator's scores: its misfit is a square of them.
///
///     r' C^-1 r / 2 = (rest - 2 pull' z + z' information z) / 2
///
/// with C = 1 + B V B' as series_fit.hpp has it. Included by sources only.
#pragma once

#include "emulator/series_emulator.hpp"

#include <Eigen/Core>

namespace bemcal::emulator {

/// B'B, B'r and r'r of r = weights (measured - mean), B = weights components.
class MeasuredScores {
  public:
    /// \param weights  [n] 0 where nothing is measured
    MeasuredScores(const SeriesEmulator& emulator, std::span<const double> measured,
                   std::span<const double> weights);

    struct Square {
        Eigen::MatrixXd information;  ///< [components x components] B' C^-1 B
        Eigen::VectorXd pull;         ///< [components] B' C^-1 r
        double rest;                  ///< r' C^-1 r
    };
    /// \param variance  V [components]
    Square square(const Eigen::VectorXd& variance) const;

  private:
    Eigen::MatrixXd root_;  ///< R [components x rank], B'B = R R'
    Eigen::VectorXd seen_;  ///< [rank] R^+ B'r
    double rest_;           ///< of r'r, what no score explains
};

}  // namespace bemcal::emulator
