/// BFGS on the inverse Hessian of the negative function, steps halved until they rise.
/// Source: Nocedal and Wright 2006, algorithms 6.1 and 3.1. Left out: bounds, and the
/// second Wolfe condition: a move without curvature is not learned from.
#include "emulator/ascent.hpp"

#include <cmath>
#include <limits>

namespace bemcal::emulator {
namespace {

constexpr int most_moves = 80, most_halved = 25;
/// In any coordinate. Unknowns are logarithms: a step beyond e^2 leaves what is known.
constexpr double first_move = 0.5, longest_move = 2;
/// Of a log likelihood: what is nearer to the maximum than this no data tell apart.
constexpr double enough_rise = 1e-3;
constexpr int moves_of_patience = 3;  ///< that rise less, one after the other
constexpr double armijo = 1e-4;       ///< share of the slope's promise (N. and W. p. 33)
constexpr double least_curvature = 1e-10;  ///< of a move, over its lengths

struct Place {
    Eigen::VectorXd at, gradient;
    double value = -std::numeric_limits<double>::infinity();
};

Place look(const Ascended& function, const Eigen::VectorXd& at) {
    Place place{at, Eigen::VectorXd::Zero(at.size())};
    place.value = function(at, place.gradient);
    if (!std::isfinite(place.value) || !place.gradient.allFinite())
        place.value = -std::numeric_limits<double>::infinity();
    return place;
}

/// The first of the halved steps that rises enough; the place itself, if none does.
Place risen(const Ascended& function, const Place& from, const Eigen::VectorXd& step) {
    const double promise = step.dot(from.gradient);
    double length = 1;
    for (int k = 0; k < most_halved; ++k, length /= 2) {
        Place tried = look(function, from.at + length * step);
        if (tried.value >= from.value + armijo * length * promise) return tried;
    }
    return from;
}

void learn_curvature_of(const Place& from, const Place& to, Eigen::MatrixXd& inverse) {
    const Eigen::VectorXd move = to.at - from.at, fall = from.gradient - to.gradient;
    const double curvature = move.dot(fall);
    if (!(curvature > least_curvature * move.norm() * fall.norm())) return;
    const Eigen::VectorXd turned = inverse * fall;
    const double stretch = (curvature + fall.dot(turned)) / (curvature * curvature);
    inverse += stretch * move * move.transpose() -
               (turned * move.transpose() + move * turned.transpose()) / curvature;
}

Eigen::VectorXd cut(const Eigen::VectorXd& step, double most) {
    const double size = step.lpNorm<Eigen::Infinity>();
    return size > most ? Eigen::VectorXd(step * (most / size)) : step;
}

}  // namespace

Summit ascend(const Ascended& function, const Eigen::VectorXd& start) {
    Place here = look(function, start);
    if (!std::isfinite(here.value)) return {here.at, here.value};
    const Eigen::MatrixXd identity =
        Eigen::MatrixXd::Identity(start.size(), start.size());
    Eigen::MatrixXd inverse = identity;
    bool is_fresh = true;
    for (int k = 0, n_idle = 0; k < most_moves && n_idle < moves_of_patience; ++k) {
        const Eigen::VectorXd step =
            cut(inverse * here.gradient, is_fresh ? first_move : longest_move);
        const Place next = risen(function, here, step);
        const double rise = next.value - here.value;
        n_idle = rise < enough_rise ? n_idle + 1 : 0;
        if (rise > 0)
            learn_curvature_of(here, next, inverse);
        else if (is_fresh)
            break;
        else
            inverse = identity;
        is_fresh = !(rise > 0);
        here = next;
    }
    return {here.at, here.value};
}

}  // namespace bemcal::emulator
