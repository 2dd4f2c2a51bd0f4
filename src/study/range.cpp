/// Simulates the nominal building, 64 points of a Sobol sequence over the ranges, and for
/// each meter the two corners towards which its total rises and falls over these.
/// Source: Joe and Kuo 2008 for the sequence; the corners are our own.
/// A total that is highest inside of the ranges may be higher than what is found here.
/// Priors are left out: their ranges count.
#include "study/range.hpp"

#include "base/nan.hpp"
#include "stats/sobol_sequence.hpp"
#include "study/bias.hpp"
#include "study/points.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bemcal::study {
namespace {

constexpr std::size_t n_sample = 64;
constexpr std::uint64_t sample_seed = 0x72616e67;  // its own: no study draws from it

struct MeteredTotal {
    std::size_t meter;
    double measured;
};

double total_of(const std::vector<double>& readings) {
    return std::accumulate(
        readings.begin(), readings.end(), 0.0,
        [](double sum, double value) { return std::isnan(value) ? sum : sum + value; });
}

bool is_wanted(const Meter& meter, const std::vector<std::string>& names) {
    return !physics::is_temperature(meter.quantity) &&
           (names.empty() || std::ranges::count(names, meter.name) > 0);
}

/// \param readings  gets those of the meters returned
std::vector<MeteredTotal> metered_totals(const Case& building, const Period& period,
                                         const std::vector<std::string>& names,
                                         std::vector<kernel::Readings>& readings) {
    std::vector<MeteredTotal> totals;
    std::vector<kernel::Readings> all = readings_of(building, period);
    for (std::size_t m = 0; m < all.size(); ++m) {
        const double measured = total_of(all[m].values);
        if (!is_wanted(building.meters[m], names) || !(measured > 0)) continue;
        totals.push_back({m, measured});
        readings.push_back(std::move(all[m]));
    }
    return totals;
}

/// From the unit cube, its ends included; discrete parameters take one of their values.
Matrix points_of(const Case& building, const Matrix& unit) {
    Matrix points = in_ranges(unit, building.parameters);
    for (std::size_t k = 0; k < building.priors.size(); ++k) {
        const std::vector<double>& values = building.priors[k].values;
        const auto n = static_cast<double>(values.size());
        for (std::size_t r = 0; r < points.rows && !values.empty(); ++r)
            points(r, k) =
                values[static_cast<std::size_t>(std::min(unit(r, k) * n, n - 1))];
    }
    return points;
}

/// [points x meters], NaN where a point failed.
Matrix totals_of(const kernel::Batch& batch, const kernel::Request& request,
                 const Matrix& points) {
    Matrix totals(points.rows, request.readings.size(), nan);
    const auto answers = batch.evaluate(points, request);
    for (std::size_t r = 0; r < answers.size(); ++r)
        for (std::size_t m = 0; m < totals.cols && answers[r].failure.empty(); ++m)
            totals(r, m) = answers[r].errors[m].simulated;
    return totals;
}

/// Of those that are not NaN.
double mean_of(const Matrix& totals, std::size_t column) {
    double sum = 0, n = 0;
    for (std::size_t r = 0; r < totals.rows; ++r) {
        if (std::isnan(totals(r, column))) continue;
        sum += totals(r, column);
        n += 1;
    }
    return sum / n;
}

/// Whether a meter's total rises with a parameter, on the whole.
bool rises(const Matrix& unit, std::size_t parameter, const Matrix& totals,
           std::size_t meter) {
    const double mean = mean_of(totals, meter);
    double slope = 0;
    for (std::size_t r = 0; r < unit.rows; ++r)
        if (!std::isnan(totals(r, meter)))
            slope += (unit(r, parameter) - 0.5) * (totals(r, meter) - mean);
    return slope > 0;
}

/// Two rows for each meter: where its total is high, and where it is low.
Matrix corners_of(const Matrix& unit, const Matrix& totals) {
    Matrix corners(2 * totals.cols, unit.cols);
    for (std::size_t m = 0; m < totals.cols; ++m)
        for (std::size_t k = 0; k < unit.cols; ++k) {
            const bool is_high = rises(unit, k, totals, m);
            corners(2 * m, k) = is_high ? 1 : 0;
            corners(2 * m + 1, k) = is_high ? 0 : 1;
        }
    return corners;
}

void append(const Matrix& some, Matrix& all) {
    all.values.insert(all.values.end(), some.values.begin(), some.values.end());
    all.rows += some.rows;
}

/// The nominal building first. [points x meters]
Matrix sampled_totals(const Case& building, const kernel::Batch& batch,
                      const kernel::Request& request) {
    Matrix totals = totals_of(batch, request, nominal_row(building.parameters));
    if (building.parameters.empty()) return totals;
    const Matrix unit = stats::scrambled_sobol_points(
        0, n_sample, static_cast<int>(building.parameters.size()), sample_seed);
    const Matrix sample = totals_of(batch, request, points_of(building, unit));
    append(sample, totals);
    append(totals_of(batch, request, points_of(building, corners_of(unit, sample))),
           totals);
    return totals;
}

/// Takes in what a meter reads at each point. \return false where none could be simulated
bool take_totals(const Matrix& totals, std::size_t column, MeterRange& range) {
    range.nominal = totals(0, column);
    for (std::size_t r = 0; r < totals.rows; ++r) {
        const double total = totals(r, column);
        if (std::isnan(total)) continue;
        range.least = range.n_points > 0 ? std::min(range.least, total) : total;
        range.most = range.n_points > 0 ? std::max(range.most, total) : total;
        range.n_points += 1;
    }
    return range.n_points > 0;
}

void leave_out_small(std::vector<MeterRange>& ranges) {
    double largest = 0;
    for (const MeterRange& range : ranges) largest = std::max(largest, range.most);
    std::erase_if(ranges, [&](const MeterRange& range) {
        return std::max(range.measured, range.most) < next_to_nothing * largest;
    });
}

}  // namespace

std::vector<MeterRange> ranges_of(const Case& building, std::size_t period,
                                  const std::vector<std::string>& meters) {
    kernel::Request request;
    const auto metered =
        metered_totals(building, building.periods.at(period), meters, request.readings);
    if (metered.empty()) return {};
    const physics::Drive drive = drive_of(building, building.periods[period]);
    const kernel::Batch batch(building.building, building.parameters, drive);
    const Matrix totals = sampled_totals(building, batch, request);
    std::vector<MeterRange> ranges;
    for (std::size_t c = 0; c < metered.size(); ++c) {
        MeterRange range{period, metered[c].meter, metered[c].measured};
        if (take_totals(totals, c, range)) ranges.push_back(range);
    }
    leave_out_small(ranges);
    return ranges;
}

}  // namespace bemcal::study
