/// The way up to a maximum of a smooth function with its gradient: BFGS with backtracking
/// (Nocedal and Wright 2006, algorithms 6.1 and 3.1).
///
/// For functions of some dozen unknowns that are cheap and stand alone; sampling/climb
/// is for densities that chains share. Included by sources only, for it shows Eigen.
#pragma once

#include <functional>

#include <Eigen/Core>

namespace bemcal::emulator {

/// Writes the gradient, and returns the value; -inf where there is none.
using Ascended =
    std::function<double(const Eigen::VectorXd& at, Eigen::VectorXd& gradient)>;

struct Summit {
    Eigen::VectorXd at;
    double value;  ///< -inf: there was none at the start
};

Summit ascend(const Ascended& function, const Eigen::VectorXd& start);

}  // namespace bemcal::emulator
