/// Looks at a column before it is read as a meter: first and last day, hours, total, and
/// a step that readings are whole multiples of.
/// Follows from rounded pulses: the step is sought by least squares around the usual
/// distance of frequent values, and taken where it is no round number.
/// Leaves out gaps and clocks, and steps below 20 of the finest ones.
#include "input/stock_readings.hpp"

#include "physics/calendar.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace bemcal::input {

namespace {

constexpr double least_multiples = 0.9, half_width = 0.08;

/// 1, 2, 2.5 or 5 times a power of ten, within a hundredth.
bool is_round(double value) {
    const double scaled = value / std::pow(10, std::floor(std::log10(value)));
    return std::ranges::any_of(std::initializer_list<double>{1, 2, 2.5, 5, 10},
                               [&](double r) { return std::abs(scaled / r - 1) < 0.01; });
}

/// Readings in finest steps.
std::map<long long, int> counts_of(const std::vector<double>& values, double finest) {
    std::map<long long, int> counts;
    for (const double value : values)
        if (value > 0) ++counts[std::llround(value / finest)];
    return counts;
}

/// The power of ten that all readings are multiples of, 0.001 at least.
double finest_step(const std::vector<double>& values) {
    const auto are_multiples = [&](double step) {
        return std::ranges::all_of(values, [&](double value) {
            return std::isnan(value) ||
                   std::abs(value / step - std::round(value / step)) < 1e-6;
        });
    };
    for (const double step : {10.0, 1.0, 0.1, 0.01})
        if (are_multiples(step)) return step;
    return 0.001;
}

struct Multiples {
    double share = 0;     ///< of the readings, near a multiple
    double distance = 0;  ///< of all readings from the next one, squared mean, of q
};

/// In finest steps. Of any readings a share of 2 (half_width q + 1) / q is near.
Multiples multiples_of(const std::map<long long, int>& counts, double q) {
    Multiples found;
    double all = 0;
    for (const auto& [value, n] : counts) {
        const auto reading = static_cast<double>(value);
        const double off = std::abs(reading - q * std::round(reading / q));
        all += n;
        found.distance += n * off * off / (q * q);
        if (off <= 1 + half_width * q) found.share += n;
    }
    return {found.share / all, found.distance / all};
}

/// The middle distance between values that are often read, at least 5 finest steps.
double usual_distance(const std::map<long long, int>& counts, std::size_t n_readings) {
    std::vector<double> distances;
    long long before = 0;
    for (const auto& [value, n] : counts) {
        if (1000 * static_cast<std::size_t>(n) < n_readings) continue;
        if (value - before >= 5) distances.push_back(static_cast<double>(value - before));
        before = value;
    }
    if (distances.size() < 8) return 0;
    std::ranges::nth_element(
        distances, distances.begin() + static_cast<std::ptrdiff_t>(distances.size()) / 2);
    return distances[distances.size() / 2];
}

std::string day_before(const std::string& day) {
    return physics::format_time(physics::parse_time(day) - std::chrono::days(1))
        .substr(0, 10);
}

}  // namespace

ReadingsLook look_for_quantum(const std::vector<double>& values) {
    ReadingsLook look;
    const double finest = finest_step(values);
    const auto counts = counts_of(values, finest);
    const double start = usual_distance(counts, values.size());
    if (start < 20) return look;
    double least = 1;
    for (double q = start - 1.5; q <= start + 1.5; q += 0.01) {
        const Multiples found = multiples_of(counts, q);
        if (found.distance >= least) continue;
        least = found.distance;
        look.quantum_share = found.share;
        look.quantum = q * finest;
    }
    if (look.quantum_share < least_multiples || is_round(look.quantum))
        return ReadingsLook{};
    return look;
}

ReadingsLook look_at(const Csv& csv, const std::string& column) {
    const std::size_t at = csv.column(column);
    const std::vector<double> values = numbers_in(csv, at);
    ReadingsLook look = look_for_quantum(values);
    std::size_t first = values.size(), last = 0;
    for (std::size_t row = 0; row < values.size(); ++row) {
        if (std::isnan(values[row])) continue;
        first = std::min(first, row);
        last = row;
        look.hours += 1;
        look.total += values[row];
    }
    if (first == values.size()) return look;
    look.first_day = csv.cell(first, 0).substr(0, 10);
    const std::string_view end = csv.cell(last, 0);
    look.last_day = end.substr(0, 10);
    if (end.size() >= 13 && end.substr(11, 2) < "23")
        look.last_day = day_before(look.last_day);
    return look;
}

}  // namespace bemcal::input
