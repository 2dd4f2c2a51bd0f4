/// Screens candidates on the tangent of the model that stands: up to four amplitudes each
/// are simulated, several candidates' at once; the best secant, gain and coefficient with
/// all else refitted.
/// Source: Chernozhukov, Chetverikov and Kato 2013 (multiplier bootstrap of the largest
/// statistic) for what noise alone shows.
/// Curvature is left out; `search` refits in full.
#include "base/error.hpp"
#include "base/random.hpp"
#include "effects/decisions.hpp"
#include "loop/decisions.hpp"
#include "loop/search.hpp"
#include "stats/distributions.hpp"
#include "stats/least_squares.hpp"
#include "stats/quantile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace bemcal::loop {
namespace {

using decisions::amplitudes;

/// What does not change from candidate to candidate.
struct Tangent {
    Tangent(const LoopData& data, const Standing& standing,
            const std::vector<char>& bound)
        : weights(weights_of(data.targets, standing.noise)),
          equations(stats::normal_equations(standing.fit.at.derivatives,
                                            standing.residuals, weights)),
          borders(standing.fit.at.derivatives, standing.residuals, weights),
          diagonal(study::prior_diagonal(standing.built.unknowns)) {
        for (double& entry : diagonal) entry += 1e-6;
        inverse = stats::inverse(equations.matrix, diagonal, bound);
    }

    std::vector<double> times_inverse(std::span<const double> vector) const {
        std::vector<double> product(vector.size(), 0.0);
        for (std::size_t i = 0; i < product.size(); ++i)
            for (std::size_t j = 0; j < product.size(); ++j)
                product[i] += inverse(i, j) * vector[j];
        return product;
    }

    std::vector<double> weights;
    stats::NormalEquations equations;
    stats::Borders borders;
    std::vector<double> diagonal;
    Matrix inverse;
};

double dot(std::span<const double> a, std::span<const double> b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
    return sum;
}

/// A secant of a candidate: what one unit of its coefficient does to the predictions.
struct Secant {
    double amplitude = 0;    ///< 0 = not simulated
    bool is_judged = false;  ///< may be the best; else for comparison alone
    std::vector<double> per_unit;
    stats::Bordered sums;
    std::vector<double> followed;  ///< by how much the other unknowns follow it
    double U = 0, I = 0;

    double coefficient() const { return I > 0 ? U / I : 0; }
    double own_share() const { return I / sums.with_itself; }
    double gain_at(double c) const { return 2 * c * U - c * c * I; }
};

/// What one unit does. \param secant  has its amplitude; what else it was is lost
void take_secant(const Standing& standing, std::span<const double> predicted,
                 Secant& secant) {
    secant.per_unit.resize(predicted.size());
    for (std::size_t k = 0; k < predicted.size(); ++k)
        secant.per_unit[k] =
            (predicted[k] - standing.fit.at.predicted[k]) / secant.amplitude;
}

/// How far the other unknowns follow them, and what the residuals say of them.
void compare(const Tangent& tangent, const std::vector<Secant*>& secants) {
    std::vector<const double*> rows;
    rows.reserve(secants.size());
    for (const Secant* secant : secants) rows.push_back(secant->per_unit.data());
    auto sums = tangent.borders.of(rows);
    for (std::size_t k = 0; k < secants.size(); ++k) {
        Secant& secant = *secants[k];
        secant.sums = std::move(sums[k]);
        secant.followed = tangent.times_inverse(secant.sums.with_others);
        secant.U = secant.sums.with_residual;
        secant.I =
            secant.sums.with_itself - dot(secant.sums.with_others, secant.followed);
    }
}

/// The largest coefficient that a fit may take.
double furthest(const effects::Effect& effect) {
    return effects::decisions::times_plausible *
           std::max(std::abs(effect.least), std::abs(effect.most));
}

/// The coefficient near the amplitude: a secant holds where it was taken.
double within(double coefficient, double amplitude, double most) {
    if (coefficient * amplitude <= 0) return 0;
    const double most_size =
                     std::min(std::abs(amplitude) * decisions::most_of_secant, most),
                 least_size = std::min(std::abs(amplitude) * decisions::least_of_secant,
                                       most_size);
    return std::copysign(std::clamp(std::abs(coefficient), least_size, most_size),
                         amplitude);
}

/// The part of the signature that the other unknowns cannot follow.
std::vector<double> own_part(const Standing& standing, const Secant& secant) {
    std::vector<double> own = secant.per_unit;
    const Matrix& J = standing.fit.at.derivatives;
    for (std::size_t j = 0; j < J.rows; ++j) {
        const auto row = J.row(j);
        for (std::size_t k = 0; k < own.size(); ++k)
            own[k] -= secant.followed[j] * row[k];
    }
    return own;
}

std::vector<double> scores_by_block(const LoopData& data, const Standing& standing,
                                    const Tangent& tangent, std::span<const double> own) {
    std::vector<double> scores(
        static_cast<std::size_t>(1 + *std::ranges::max_element(data.blocks)), 0.0);
    for (std::size_t k = 0; k < own.size(); ++k)
        scores[static_cast<std::size_t>(data.blocks[k])] +=
            own[k] * tangent.weights[k] * standing.residuals[k];
    return scores;
}

Screened judged(const LoopData& data, const Standing& standing, const Tangent& tangent,
                const effects::Effect& effect, const Secant& secant, Keep keep) {
    Screened screened{effect, 0, 0, secant.I, {}, {}, {}, 0};
    screened.coefficient =
        within(secant.coefficient(), secant.amplitude, furthest(effect));
    screened.gain = secant.gain_at(screened.coefficient);
    if (keep == Keep::gains) return screened;
    std::vector<double> own = own_part(standing, secant);
    screened.by_block = scores_by_block(data, standing, tangent, own);
    if (keep != Keep::scores) {
        screened.bias = secant.followed;
        for (double& bias : screened.bias) bias *= effect.typical;
        screened.signature = std::move(own);
    }
    return screened;
}

bool is_plausible_sign(const effects::Effect& effect, double amplitude) {
    return (amplitude > 0 && effect.most > 0) || (amplitude < 0 && effect.least < 0);
}

/// Secants of a candidate, by amplitude; used again for the next one.
struct Secants {
    std::array<Secant, amplitudes.size()> of;
    std::vector<Secant*> taken;
};

/// Of the share that no other unknown follows: a small one bends less.
constexpr std::size_t small_amplitude = 2;  ///< its place among them

/// Their amplitudes, of those that are wanted; of the others 0.
void set_amplitudes(const effects::Effect& effect, const physics::Parameter& coefficient,
                    Keep keep, Secants& secants) {
    for (std::size_t a = 0; a < amplitudes.size(); ++a) {
        Secant& secant = secants.of[a];
        secant.amplitude = std::clamp(amplitudes[a] * effect.typical, coefficient.least,
                                      coefficient.most);
        secant.is_judged = is_plausible_sign(effect, secant.amplitude) &&
                           (keep != Keep::of_typical || a == 0);
        const bool is_small = keep == Keep::of_typical && a == small_amplitude;
        if (!secant.is_judged && !is_small) secant.amplitude = 0;
    }
}

/// The most points that one candidate asks for.
std::size_t most_points_of(const effects::Effect& effect) {
    const auto n = std::ranges::count_if(
        amplitudes, [&](double each) { return is_plausible_sign(effect, each); });
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(n, 1));
}

/// Points that are simulated at once: a run of the widest kernel.
constexpr std::size_t most_together = 8;

/// Candidates whose points fill the lanes of one run of the fast simulation.
using Group = std::vector<const effects::Effect*>;

std::vector<Group> groups_of(const std::vector<effects::Effect>& candidates) {
    std::vector<Group> groups;
    std::size_t n_points = most_together;
    for (const effects::Effect& effect : candidates) {
        const std::size_t n = most_points_of(effect);
        if (n_points + n > most_together) groups.emplace_back(), n_points = 0;
        groups.back().push_back(&effect);
        n_points += n;
    }
    return groups;
}

/// A candidate of the group acts alone, at its secant's amplitude.
Matrix points_of(const Standing& standing, const std::vector<Secants>& group,
                 std::size_t n_candidates) {
    const auto& unknowns = standing.built.unknowns;
    std::vector<double> at;
    at.reserve(unknowns.size() + n_candidates);
    for (std::size_t k = 0; k < unknowns.size(); ++k)
        at.push_back(unknowns[k].value(standing.fit.at.x[k]));
    at.resize(unknowns.size() + n_candidates, 0.0);
    std::vector<std::vector<double>> points;
    for (std::size_t g = 0; g < n_candidates; ++g)
        for (const Secant* secant : group[g].taken) {
            points.push_back(at);
            points.back()[unknowns.size() + g] = secant->amplitude;
        }
    Matrix matrix(points.size(), at.size());
    for (std::size_t k = 0; k < points.size(); ++k)
        std::ranges::copy(points[k], matrix.row(k).begin());
    return matrix;
}

/// The secants of the amplitudes that are wanted and can be simulated.
/// \return those of all candidates
std::vector<Secant*> take_secants(const Standing& standing, const Group& group, Keep keep,
                                  OneMore& one_more, std::vector<Secants>& secants) {
    const study::FitModel& model = one_more.with(group);
    std::vector<Secant*> all;
    for (std::size_t g = 0; g < group.size(); ++g) {
        set_amplitudes(*group[g], one_more.coefficients()[g], keep, secants[g]);
        secants[g].taken.clear();
        for (Secant& secant : secants[g].of)
            if (secant.amplitude != 0) secants[g].taken.push_back(&secant);
        all.insert(all.end(), secants[g].taken.begin(), secants[g].taken.end());
    }
    model.predict_each(points_of(standing, secants, group.size()),
                       [&](std::size_t k, std::span<const double> predicted) {
                           if (std::isnan(predicted[0]))
                               all[k]->amplitude = 0;
                           else
                               take_secant(standing, predicted, *all[k]);
                       });
    std::erase_if(all, [](const Secant* secant) { return secant->amplitude == 0; });
    for (std::size_t g = 0; g < group.size(); ++g)
        std::erase_if(secants[g].taken,
                      [](const Secant* secant) { return secant->amplitude == 0; });
    return all;
}

/// At the best of the amplitudes; none where no amplitude moves a meter.
std::optional<Screened> screen_one(const LoopData& data, const Standing& standing,
                                   const Tangent& tangent, const effects::Effect& effect,
                                   Keep keep, const Secants& secants) {
    const Secant* best = nullptr;
    double best_gain = -1;
    for (const Secant* secant : secants.taken) {
        if (!secant->is_judged || !(secant->I > 1e-12 * secant->sums.with_itself))
            continue;
        const double gain = secant->gain_at(
            within(secant->coefficient(), secant->amplitude, furthest(effect)));
        if (gain > best_gain) best_gain = gain, best = secant;
    }
    if (best == nullptr) return std::nullopt;
    Screened screened = judged(data, standing, tangent, effect, *best, keep);
    const Secant& small = secants.of[small_amplitude];
    const bool has_small =
        keep == Keep::of_typical && small.amplitude != 0 && small.sums.with_itself > 0;
    screened.visibility = has_small ? small.own_share() : best->own_share();
    return screened;
}

}  // namespace

std::vector<Screened> screen(const LoopData& data, const Place& place,
                             const Standing& standing,
                             const std::vector<effects::Effect>& candidates, Keep keep) {
    std::vector<char> bound = standing.fit.bound;
    if (keep == Keep::of_typical) bound.assign(bound.size(), 0);
    const Tangent tangent(data, standing, bound);
    OneMore one_more(place, standing.model.effects);
    std::vector<Secants> secants(most_together);
    std::vector<Screened> screened;
    screened.reserve(candidates.size());
    const auto can_enter = [&](const Group& group) {
        try {
            compare(tangent, take_secants(standing, group, keep, one_more, secants));
        } catch (const CannotSimulate&) {
            return false;
        }
        for (std::size_t g = 0; g < group.size(); ++g)
            if (auto one =
                    screen_one(data, standing, tangent, *group[g], keep, secants[g]))
                screened.push_back(std::move(*one));
        return true;
    };
    for (const Group& group : groups_of(candidates)) {
        if (can_enter(group) || group.size() == 1) continue;
        // Not all of them together. What cannot enter by itself is no candidate.
        for (const effects::Effect* effect : group) can_enter({effect});
    }
    return screened;
}

double null_gain(const std::vector<Screened>& screened, double alpha,
                 std::uint64_t seed) {
    std::vector<double> largest;
    for (int draw = 0; draw < decisions::null_draws; ++draw) {
        Stream random(seed, 0, static_cast<std::uint64_t>(draw));
        std::vector<double> sign;
        double most = 0;
        for (const Screened& candidate : screened) {
            while (sign.size() < candidate.by_block.size())
                sign.push_back(random.uniform() < 0.5 ? -1 : 1);
            double sum = 0;
            for (std::size_t b = 0; b < candidate.by_block.size(); ++b)
                sum += sign[b] * candidate.by_block[b];
            if (candidate.information > 0)
                most = std::max(most, sum * sum / candidate.information);
        }
        largest.push_back(most);
    }
    std::ranges::sort(largest);
    // A few blocks have few patterns of signs: no less than what normal noise would show.
    const auto n = static_cast<double>(std::max<std::size_t>(screened.size(), 1));
    const double z = stats::normal_quantile(1 - 0.5 * alpha / n);
    return std::max(stats::quantile_of_sorted(largest, 1 - alpha), z * z);
}

}  // namespace bemcal::loop
