/// Judges stages: errors of several versions over periods taken together, shares within
/// 0.5 and the sensor's accuracy, the errors' distribution, deviations of estimates.
/// Source: paper 2, Table 6 and its validation; deviations by `estimate_spread`.
/// Deviations take ranges as flat priors; curvature and discrete parameters are left out.
#include "calibration/staged_results.hpp"

#include "base/nan.hpp"
#include "stats/estimate_spread.hpp"
#include "study/fit.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace bemcal::calibration {
namespace {

/// One meter over all periods of a comparison, one after the other.
struct Joined {
    std::vector<double> simulated, measured;
};

/// Share of the readings whose error is at most `limit`.
double share_within(const Joined& series, double limit) {
    double n = 0, within = 0;
    for (std::size_t k = 0; k < series.measured.size(); ++k) {
        const double error = std::abs(series.simulated[k] - series.measured[k]);
        if (std::isnan(error)) continue;
        n += 1;
        if (error <= limit) within += 1;
    }
    return n > 0 ? within / n : nan;
}

constexpr double half_unit = 0.5;
constexpr double levels[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1, 1.25, 1.5, 2, 3, 5};

/// Of all versions, row after row.
struct Numbers {
    std::vector<double> fit, within_half, within_accuracy, cumulative;

    void add(const Joined& series, double accuracy) {
        const stats::FitMetrics metrics =
            stats::metrics_of(series.simulated, series.measured);
        for (const study::FitNumber& number : study::fit_numbers)
            fit.push_back(metrics.*number.value);
        within_half.push_back(share_within(series, half_unit));
        within_accuracy.push_back(share_within(series, accuracy));
        for (const double level : levels)
            cumulative.push_back(share_within(series, level));
    }
};

void append(const std::vector<double>& some, std::vector<double>& all) {
    all.insert(all.end(), some.begin(), some.end());
}

void add_names(const study::Case& building, const Comparison& comparison,
               study::DatasetBuilder& datasets) {
    std::vector<std::string> meters, units, versions, metrics;
    for (const std::size_t m : comparison.meters) {
        meters.push_back(building.meters[m].name);
        units.emplace_back(physics::unit_of(building.meters[m].quantity));
    }
    for (const Version& version : comparison.versions) versions.push_back(version.name);
    for (const study::FitNumber& number : study::fit_numbers)
        metrics.emplace_back(number.name);
    const std::string folder = comparison.folder + "/";
    datasets.texts(folder + "meter", "meter", std::move(meters));
    datasets.texts(folder + "meter_unit", "meter", std::move(units));
    datasets.texts(folder + "period", "period", comparison.periods);
    datasets.texts(folder + "version", "version", std::move(versions));
    datasets.texts(folder + "metric", "metric", std::move(metrics));
    datasets.vector(folder + "error_level", "error_level",
                    {std::begin(levels), std::end(levels)});
}

void add_numbers(const Comparison& comparison, Numbers numbers,
                 study::DatasetBuilder& datasets) {
    const std::string folder = comparison.folder + "/";
    const std::size_t n = comparison.versions.size(), m = comparison.meters.size();
    datasets.array(folder + "version_fit", {"version", "meter", "metric"},
                   {n, m, std::size(study::fit_numbers)}, std::move(numbers.fit));
    datasets.array(folder + "share_within_half", {"version", "meter"}, {n, m},
                   std::move(numbers.within_half));
    datasets.array(folder + "share_within_accuracy", {"version", "meter"}, {n, m},
                   std::move(numbers.within_accuracy));
    datasets.array(folder + "error_share", {"version", "meter", "error_level"},
                   {n, m, std::size(levels)}, std::move(numbers.cumulative));
}

/// Whether a parameter of the stage has a derivative.
bool has_range(const StageFound& found, std::size_t k) {
    return found.most[k] > found.least[k];
}

/// The point with one of its parameters moved.
std::vector<double> moved(std::vector<double> point, std::size_t parameter, double by) {
    point[parameter] += by;
    return point;
}

}  // namespace

study::CloseLook StagedJudge::look(const std::string& period,
                                   std::span<const double> point) const {
    return models_.at(period)->look(building_, study::period_of(building_, period), point,
                                    {});
}

void StagedJudge::compare(const Comparison& comparison,
                          study::DatasetBuilder& datasets) const {
    add_names(building_, comparison, datasets);
    const std::size_t n_versions = comparison.versions.size();
    std::vector<std::vector<study::CloseLook>> looks(n_versions);  // [versions][periods]
    for (std::size_t v = 0; v < n_versions; ++v)
        for (const std::string& period : comparison.periods)
            looks[v].push_back(look(period, comparison.versions[v].point));
    Numbers numbers;
    for (std::size_t v = 0; v < n_versions; ++v)
        for (const std::size_t m : comparison.meters) {
            Joined joined;
            for (const study::CloseLook& period : looks[v]) {
                append(period.meters[m].simulated, joined.simulated);
                append(period.meters[m].measured, joined.measured);
            }
            numbers.add(joined, accuracy_);
        }
    add_numbers(comparison, std::move(numbers), datasets);
    for (std::size_t p = 0; p < comparison.periods.size(); ++p)
        for (const std::size_t m : comparison.meters) {
            const std::string folder = comparison.folder + "/periods/" +
                                       comparison.periods[p] + "/" +
                                       building_.meters[m].name + "/";
            std::vector<double> simulated;
            for (std::size_t v = 0; v < n_versions; ++v)
                append(looks[v][p].meters[m].simulated, simulated);
            datasets.times(folder + "time", looks[0][p].meters[m].begins);
            datasets.vector(folder + "measured", "time", looks[0][p].meters[m].measured);
            datasets.array(folder + "simulated", {"version", "time"},
                           {n_versions, looks[0][p].meters[m].begins.size()},
                           std::move(simulated));
        }
}

std::vector<StagedJudge::Varied> StagedJudge::varied_in(
    const StageFound& found, const std::vector<double>& carried) const {
    std::vector<Varied> varied;
    for (std::size_t k = 0; k < found.value.size(); ++k) {
        if (k < building_.priors.size() && !building_.priors[k].values.empty()) continue;
        double range = 0, most = building_.parameters[k].most;
        if (has_range(found, k)) {
            range = found.most[k] - found.least[k];
            most = found.most[k];
        } else if (carried[k] > 0) {
            range = carried[k] / std::sqrt(stats::flat_variance);
        } else {
            continue;
        }
        const double step = 0.01 * range;
        varied.push_back({k, range, found.value[k] + step <= most ? step : -step});
    }
    return varied;
}

std::vector<double> StagedJudge::spread_of(const CalibrationStage& stage,
                                           const StageFound& found,
                                           const std::vector<std::size_t>& meters,
                                           const std::vector<double>& carried) const {
    const std::vector<Varied> varied = varied_in(found, carried);
    std::vector<stats::ResidualSeries> series;
    for (const std::string& period : stage.periods) {
        const study::CloseLook at = look(period, found.value);
        std::vector<study::CloseLook> beside;
        beside.reserve(varied.size());
        for (const Varied& each : varied)
            beside.push_back(look(period, moved(found.value, each.parameter, each.step)));
        for (const std::size_t m : meters) {
            const study::MeterSeries& here = at.meters[m];
            const std::size_t n = here.simulated.size();
            stats::ResidualSeries one{{}, Matrix(varied.size(), n)};
            for (std::size_t i = 0; i < n; ++i)
                one.residuals.push_back(here.measured[i] - here.simulated[i]);
            for (std::size_t k = 0; k < varied.size(); ++k)
                for (std::size_t i = 0; i < n; ++i)
                    one.derivatives(k, i) =
                        (beside[k].meters[m].simulated[i] - here.simulated[i]) *
                        varied[k].range / varied[k].step;
            series.push_back(std::move(one));
        }
    }
    const std::vector<double> shares = stats::estimate_spread(series, varied.size());
    std::vector<double> spread(found.value.size(), nan);
    for (std::size_t k = 0; k < varied.size(); ++k)
        if (has_range(found, varied[k].parameter))
            spread[varied[k].parameter] = shares[k] * varied[k].range;
    return spread;
}

}  // namespace bemcal::calibration
