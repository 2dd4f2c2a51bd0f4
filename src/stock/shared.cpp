/// Finds meters of several buildings that are one, by daily sums: within 10 % of one
/// ratio on 70 % of the days, with steps from day to day that correlate by 0.97.
/// Follows from weather, which moves buildings alike, but not to one ratio and by the
/// same steps; a sketch of every fifteenth day ends nearly all pairs.
/// Looks at each building's first energy meter; sums of several meters are left out.
#include "stock/shared.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace bemcal::stock {

namespace {

constexpr std::size_t least_days = 60;
constexpr double near = 0.1, least_share = 0.7, least_variation = 1.2;
constexpr double least_correlation = 0.97;  ///< of the changes from day to day
constexpr std::string_view shared_with = "shared with ";
constexpr std::string_view kept = "kept; shared: both may show one meter";

double middle_of(std::vector<double> values) {
    auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

/// Days of both that are above 0; sums of a day without a reading are NaN.
struct Pairs {
    std::vector<double> ratios, first, second;
};

Pairs pairs_of(const StockRecord& a, const StockRecord& b) {
    Pairs pairs;
    const auto shift = static_cast<std::ptrdiff_t>(a.daily_start - b.daily_start);
    const auto n_b = static_cast<std::ptrdiff_t>(b.daily.size());
    for (std::size_t k = 0; k < a.daily.size(); ++k) {
        const std::ptrdiff_t other = static_cast<std::ptrdiff_t>(k) + shift;
        if (other < 0 || other >= n_b) continue;
        const double x = a.daily[k], y = b.daily[static_cast<std::size_t>(other)];
        if (!(x > 0 && y > 0)) continue;
        pairs.ratios.push_back(y / x);
        pairs.first.push_back(x);
        pairs.second.push_back(y);
    }
    return pairs;
}

/// Of the changes from one day to the next.
double correlation(const std::vector<double>& x, const std::vector<double>& y) {
    double xx = 0, yy = 0, xy = 0;
    for (std::size_t k = 1; k < x.size(); ++k) {
        const double dx = x[k] - x[k - 1], dy = y[k] - y[k - 1];
        xx += dx * dx;
        yy += dy * dy;
        xy += dx * dy;
    }
    return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : 0;
}

double share_near(const std::vector<double>& ratios, double ratio, double width) {
    const auto n = std::ranges::count_if(
        ratios, [&](double r) { return std::abs(r / ratio - 1) < width; });
    return static_cast<double>(n) / static_cast<double>(ratios.size());
}

/// Every fifteenth day of the calendar, so that pairs of a large stock are told apart
/// without a look at all of their days.
struct Sketch {
    std::ptrdiff_t first = 0;  ///< of days since 1970, divided by 15
    std::vector<double> days;
};

Sketch sketch_of(const StockRecord& record) {
    Sketch sketch;
    const auto start = static_cast<std::ptrdiff_t>(record.daily_start);
    sketch.first = (start + 14) / 15;
    for (auto day = 15 * sketch.first - start;
         day < static_cast<std::ptrdiff_t>(record.daily.size()); day += 15)
        sketch.days.push_back(record.daily[static_cast<std::size_t>(day)]);
    return sketch;
}

/// Nearly all pairs end here.
bool can_be_one(const Sketch& a, const Sketch& b) {
    const std::ptrdiff_t from = std::max(a.first, b.first);
    const std::ptrdiff_t to =
        std::min(a.first + std::ssize(a.days), b.first + std::ssize(b.days));
    double least = 0, most = 0;
    int n = 0, n_off = 0;
    for (std::ptrdiff_t day = from; day < to; ++day) {
        const double ratio = b.days[static_cast<std::size_t>(day - b.first)] /
                             a.days[static_cast<std::size_t>(day - a.first)];
        if (!(ratio > 0) || !std::isfinite(ratio)) continue;
        if (n++ == 0) least = most = ratio;
        if (ratio > (1 + 3 * near) * least || ratio < most / (1 + 3 * near)) {
            if (++n_off > 2) return false;
            continue;
        }
        least = std::min(least, ratio);
        most = std::max(most, ratio);
    }
    return n >= 4;
}

void note(StockRecord& at, const StockRecord& with, double ratio, std::size_t n_days) {
    const std::string meter = at.fits.empty() ? "meter" : at.fits.front().meter;
    at.findings.push_back({meter,
                           fmt::format("{}{}: {:.4g} times its daily sums, over {} days",
                                       shared_with, with.name, ratio, n_days),
                           std::string(kept)});
}

std::string partner_in(const std::string& finding) {
    return finding.substr(shared_with.size(), finding.rfind(": ") - shared_with.size());
}

bool is_of_shared(const study::DataDecision& finding) {
    return finding.action == kept;
}

/// What an earlier night said of pairs that are looked at again.
void forget(StockRecord& record, const std::set<std::string>& unchanged) {
    std::erase_if(record.findings, [&](const study::DataDecision& finding) {
        return finding.action == kept &&
               (!unchanged.contains(record.name) ||
                !unchanged.contains(partner_in(finding.finding)));
    });
}

/// Nothing was done with it this night.
bool is_unchanged(const StockRecord& record) {
    return record.age > 0;
}

}  // namespace

StockRecord shared_part(const StockRecord& record) {
    StockRecord part;
    part.name = record.name;
    part.age = record.age;
    part.daily_start = record.daily_start;
    part.daily = record.daily;
    if (!record.fits.empty()) part.fits.push_back(record.fits.front());
    std::ranges::copy_if(record.findings, std::back_inserter(part.findings),
                         is_of_shared);
    return part;
}

void take_shared(const StockRecord& part, StockRecord& record) {
    std::erase_if(record.findings, is_of_shared);
    record.findings.insert(record.findings.end(), part.findings.begin(),
                           part.findings.end());
}

void find_shared_meters(std::vector<StockRecord>& records) {
    std::set<std::string> unchanged;
    for (const StockRecord& record : records)
        if (is_unchanged(record)) unchanged.insert(record.name);
    for (StockRecord& record : records) forget(record, unchanged);
    std::vector<Sketch> sketches;
    sketches.reserve(records.size());
    for (const StockRecord& record : records) sketches.push_back(sketch_of(record));
    for (std::size_t i = 0; i < records.size(); ++i)
        for (std::size_t j = i + 1; j < records.size(); ++j) {
            StockRecord &a = records[i], &b = records[j];
            if (is_unchanged(a) && is_unchanged(b)) continue;
            if (!can_be_one(sketches[i], sketches[j])) continue;
            const Pairs pairs = pairs_of(a, b);
            if (pairs.ratios.size() < least_days) continue;
            const auto [low, high] = std::ranges::minmax(pairs.first);
            const double ratio = middle_of(pairs.ratios);
            if (high < least_variation * low ||
                share_near(pairs.ratios, ratio, near) < least_share ||
                correlation(pairs.first, pairs.second) < least_correlation)
                continue;
            note(a, b, 1 / ratio, pairs.ratios.size());
            note(b, a, ratio, pairs.ratios.size());
        }
}

}  // namespace bemcal::stock
