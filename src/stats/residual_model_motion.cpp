/// How the state (a, m, d) moves over a gap, what is new in it, and the way back to phi,
/// share and timescale. Noise of short gaps comes from its series, where it would cancel.
/// Source: Hartikainen and Sarkka 2010 (Matern-3/2), AR(1). Other smoothness than 3/2 is
/// left out.
#include "stats/residual_model_motion.hpp"

#include "stats/residual_model_memory.hpp"

#include <cmath>

namespace bemcal::stats::residual {

namespace {

/// 1 - exp(-x) (1 + x + x^2 / 2), by its series where that would cancel.
Lanes beyond_square(const Lanes& x, const Lanes& decay) {
    Lanes series = all(1);
    for (int n = 20; n > 3; --n) series = 1 + series * x / n;
    const Lanes small = decay * x.cube() / 6 * series;
    return choose(x < 1, small, 1 - decay * (1 + x + 0.5 * x.square()));
}

/// The Matern process over u = sqrt(3) gap / timescale: noise for a variance of 1.
struct Slow {
    Lanes u, decay;  ///< exp(-u)
    Noise noise, noise_slope;

    explicit Slow(const Lanes& at) : u(at), decay((-u).exp()) {
        const Lanes x = 2 * u, square = decay.square();
        const Lanes mm = beyond_square(x, square);
        noise = {all(0), mm, 0.5 * x.square() * square, mm + 2 * x * square};
        noise_slope = {all(0), square * x.square(), square * x * (2 - x),
                       square * (2 - x).square()};
    }
    Lanes along(const Transition& slope) const {
        return decay * (u * (slope.dd - slope.mm) + (1 - u) * (slope.md - slope.dm) -
                        2 * slope.dd);
    }
};

Lanes dot(const Noise& slope, const Noise& noise) {
    return slope.mm * noise.mm + 2 * slope.md * noise.md + slope.dd * noise.dd;
}

Slow slow_over(const ParameterLanes& p, std::size_t gap) {
    return Slow(std::sqrt(3.0) * static_cast<double>(gap) * p[timescale].inverse());
}

}  // namespace

Motion no_motion() {
    const Lanes none = all(0);
    return {{none, none, none, none, none}, {none, none, none, none}};
}

Motion motion_over(const ParameterLanes& p, std::size_t gap) {
    Motion motion = no_motion();
    if (gap == 0) {
        motion.noise = {1 - p[share], p[share], all(0), p[share]};
        return motion;
    }
    const Lanes rho = power_of(p[phi], gap).value;
    const Slow slow = slow_over(p, gap);
    const Lanes step = slow.u * slow.decay;
    motion.transition = {rho, slow.decay + step, step, -step, slow.decay - step};
    motion.noise = {(1 - p[share]) * (1 - rho) * (1 + rho), p[share] * slow.noise.mm,
                    p[share] * slow.noise.md, p[share] * slow.noise.dd};
    return motion;
}

void pull_back_motion(const ParameterLanes& p, std::size_t gap, const Motion& slope,
                      ParameterLanes& derivative) {
    const Noise& by_noise = slope.noise;
    if (gap == 0) {
        derivative[share] += by_noise.mm + by_noise.dd - by_noise.aa;
        return;
    }
    const Power rho = power_of(p[phi], gap);
    const Slow slow = slow_over(p, gap);
    derivative[phi] +=
        rho.slope * (slope.transition.rho - 2 * by_noise.aa * (1 - p[share]) * rho.value);
    derivative[share] +=
        dot(by_noise, slow.noise) - by_noise.aa * (1 - rho.value) * (1 + rho.value);
    const Lanes by_u =
        slow.along(slope.transition) + p[share] * dot(by_noise, slow.noise_slope);
    derivative[timescale] -= by_u * slow.u * p[timescale].inverse();
}

}  // namespace bemcal::stats::residual
