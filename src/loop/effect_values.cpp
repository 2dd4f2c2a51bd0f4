/// Simulates the last model with and without each effect, at its calibrated values and at
/// draws about them.
/// Source: Gaussian approximation of the posterior (Gelman and others 2013, Bayesian Data
/// Analysis, 4.1), its correlations from the normal equations, its deviations as printed.
/// Two effects that act together share what they bring: each is taken out alone; but
/// schedules whose hours changed alike are one, told with the first of them. Hours have
/// no coefficient that could be off: what another model would say is added to their
/// interval. What began on a date is taken as if it had been there all the time.
#include "loop/effect_values.hpp"

#include "base/error.hpp"
#include "loop/decisions.hpp"
#include "loop/intervals.hpp"
#include "stats/distributions.hpp"
#include "stats/normal_draws.hpp"
#include "study/account_name.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace bemcal::loop {
namespace {

/// The calibrated values first, then draws; functions stay as they are. [points x
/// unknowns]
Matrix points_about(const LoopData& data, const Standing& last,
                    const std::vector<double>& deviations, double misfit) {
    const auto& unknowns = last.built.unknowns;
    Matrix points = stats::normal_draws(correlations_of(data, last, misfit),
                                        decisions::draws_of_worth, data.options.seed);
    for (std::size_t r = 0; r < points.rows; ++r)
        for (std::size_t k = 0; k < unknowns.size(); ++k) {
            const double from = unknowns[k].value(last.fit.at.x[k]);
            const double step = r == 0 ? 0 : deviations[k] * points(r, k);
            points(r, k) = std::clamp(from + step, unknowns[k].least, unknowns[k].most);
        }
    return points;
}

using Effects = std::vector<effects::Effect>;

/// Effects that are taken out with this one, itself among them, in their order.
std::vector<std::size_t> taken_with(const Effects& all, std::size_t effect) {
    std::vector<std::size_t> together;
    for (std::size_t k = 0; k < all.size(); ++k)
        if (k == effect || effects::changed_alike(all[k], all[effect]))
            together.push_back(k);
    return together;
}

Effects without(Effects all, const std::vector<std::size_t>& some) {
    for (auto k = some.rbegin(); k != some.rend(); ++k)
        all.erase(all.begin() + static_cast<std::ptrdiff_t>(*k));
    return all;
}

/// Without the columns of some effects.
Matrix without(const Matrix& points, const std::vector<std::size_t>& some,
               std::size_t first_effect) {
    Matrix fewer(points.rows, points.cols - some.size());
    std::size_t to = 0;
    for (std::size_t k = 0; k < points.cols; ++k) {
        if (k >= first_effect && std::ranges::count(some, k - first_effect) > 0) continue;
        for (std::size_t r = 0; r < points.rows; ++r) fewer(r, to) = points(r, k);
        ++to;
    }
    return fewer;
}

/// [points x accounts]
Matrix totals_of(const LoopData& data, const study::FitModel& model, const Matrix& points,
                 const std::vector<Account>& accounts) {
    const Matrix predicted = model.predict(points);
    Matrix totals(points.rows, accounts.size());
    for (std::size_t r = 0; r < points.rows; ++r)
        for (std::size_t c = 0; c < data.targets.n_channels(); ++c) {
            const auto readings = data.targets.of(c, predicted.row(r));
            const double sum = std::accumulate(readings.begin(), readings.end(), 0.0);
            for (std::size_t a = 0; a < accounts.size(); ++a)
                totals(r, a) += accounts[a].per_reading[c] * sum;
        }
    return totals;
}

Account account(const LoopData& data, std::string of, const char* unit) {
    return {std::move(of), unit, std::vector<double>(data.targets.n_channels(), 0.0)};
}

/// What a kWh costs, or emits, over all meters of energy. Where some do not say it, its
/// name says of which it is. Nothing where none does, or all are 0.
std::optional<Account> weighed(const LoopData& data, const char* what, const char* unit,
                               double study::Meter::* per_kwh, double years) {
    Account sum = account(data, what, unit);
    std::vector<std::string> of;
    bool is_of_all = true;
    for (std::size_t c = 0; c < data.meters.size(); ++c) {
        const study::Meter& meter = data.building.meters[data.meters[c]];
        if (physics::is_temperature(meter.quantity)) continue;
        is_of_all = is_of_all && !std::isnan(meter.*per_kwh);
        if (std::isnan(meter.*per_kwh)) continue;
        of.push_back(meter.name);
        sum.per_reading[c] = meter.*per_kwh * years;
    }
    const auto is_used = [](double factor) { return factor != 0; };
    if (std::ranges::none_of(sum.per_reading, is_used)) return std::nullopt;
    sum.of = study::account_name(what, of, is_of_all);
    return sum;
}

/// A draw that cannot be simulated has no say.
/// \param of_model  standard deviation of what another model would say [share]
Worth worth_in(const Matrix& with, const Matrix& less, std::size_t account,
               double of_model) {
    const double mean = with(0, account) - less(0, account);
    double squares = 0, n = 0;
    for (std::size_t r = 1; r < with.rows; ++r) {
        const double difference = with(r, account) - less(r, account);
        if (std::isnan(difference)) continue;
        squares += (difference - mean) * (difference - mean);
        n += 1;
    }
    const double sd = std::hypot(std::sqrt(squares / n), of_model * mean),
                 half = n > 0 ? stats::z_90_two_sided * sd : nan;
    return {mean, mean - half, mean + half};
}

/// From the first hour on what begins on a date; else nothing.
std::optional<effects::Effect> of_all_time(effects::Effect effect) {
    if (effect.driver != effects::Driver::elapsed ||
        effect.shape.form != effects::Form::over || effect.shape.at <= 0)
        return std::nullopt;
    effect.shape.at = -1;  // a year before the first hour
    return effect;
}

}  // namespace

std::optional<double> per_year(double days) {
    constexpr double days_of_year = 365.25;
    if (days < decisions::days_of_all_seasons) return std::nullopt;
    return days_of_year / days;
}

std::vector<Account> accounts_of(const LoopData& data) {
    const auto of_year = per_year(study::hours_of(data.training()) / 24);
    const double years = of_year.value_or(1);
    const bool is_year = of_year.has_value();
    std::vector<Account> accounts;
    for (std::size_t c = 0; c < data.meters.size(); ++c) {
        const study::Meter& meter = data.building.meters[data.meters[c]];
        if (physics::is_temperature(meter.quantity)) continue;
        accounts.push_back(account(data, meter.name, is_year ? "kWh/a" : "kWh"));
        accounts.back().per_reading[c] = years;
    }
    if (auto cost = weighed(data, "cost", is_year ? "currency/a" : "currency",
                            &study::Meter::tariff, years))
        accounts.push_back(*cost);
    if (auto co2 =
            weighed(data, "CO2", is_year ? "kg/a" : "kg", &study::Meter::co2, years))
        accounts.push_back(*co2);
    return accounts;
}

std::vector<std::vector<Worth>> worth_of_effects(const LoopData& data, const Place& place,
                                                 const Standing& last,
                                                 const std::vector<double>& deviations,
                                                 double misfit,
                                                 const std::vector<Account>& accounts) {
    const std::size_t n_found = last.model.effects.size();
    std::vector<std::vector<Worth>> all(n_found, std::vector<Worth>(accounts.size()));
    if (n_found == 0) return all;
    const Matrix points = points_about(data, last, deviations, misfit);
    const Matrix as_it_is = totals_of(data, *last.built.fit_model, points, accounts);
    for (std::size_t k = 0; k < n_found; ++k) {
        const std::vector<std::size_t> together = taken_with(last.model.effects, k);
        if (together[0] != k) continue;  // told with the first of them
        const double of_model =
            last.model.effects[k].other_hours ? decisions::error_of_model : 0;
        try {
            const BuiltModel model = build(place, without(last.model.effects, together));
            const Matrix less =
                totals_of(data, *model.fit_model,
                          without(points, together, last.built.first_effect()), accounts);
            Matrix with = as_it_is;
            if (const auto whole = of_all_time(last.model.effects[k])) {
                auto effects = last.model.effects;
                effects[k] = *whole;
                with =
                    totals_of(data, *build(place, effects).fit_model, points, accounts);
            }
            for (std::size_t a = 0; a < accounts.size(); ++a)
                all[k][a] = worth_in(with, less, a, of_model);
        } catch (const CannotSimulate&) {
            // Without it the building is none: nothing is said of its worth.
            std::ranges::fill(all[k], Worth{});
        }
    }
    return all;
}

}  // namespace bemcal::loop
