/// Finds codes, spikes, negative use and registers by how far values stand apart from
/// the others, how often they repeat, and how seldom they fall.
/// Our own rules; the codes are those of loggers, of weather files and of whole numbers
/// that are full. Thresholds were held to the real meters of shared data, where the
/// highest reading is up to 2.6 times the next one and a fifth of all changes are falls.
/// Left out: what neighbours in time would say. Whether to mask is the caller's.
#include "checks/data_values.hpp"

#include "base/nan.hpp"
#include "checks/data_runs.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>

namespace bemcal::checks {

namespace {

/// What loggers, utilities and data bases write for no reading.
constexpr double known_codes[] = {
    -1,        -9,         -99,     -99.9,      -99.99,      -999,       -999.9,
    -999.99,   -9999,      -9999.9, -9999.99,   -99999,      -999999,    -6999,
    -7999,     -8888,      -7777,   -1111,      -32767,      -32768,     -2147483648.,
    99,        99.9,       99.99,   999,        999.9,       999.99,     9999,
    9999.9,    9999.99,    99999,   99999.9,    999999,      999999.9,   9999999,
    99999999., 999999999., 6999,    7999,       8888,        32767,      32768,
    65534,     65535,      65536,   2147483647, 2147483648., 4294967295.};
/// Sensors of temperature: cut off, just switched on, at 0.
constexpr double codes_of_temperature[] = {-127, 85, 0};

constexpr double apart_again = 1.5;   ///< of a known code that is read twice or more
constexpr double apart_once = 3;      ///< of one that is read once
constexpr double apart_unknown = 20;  ///< of any other value: a machine of one power
constexpr double most_unknown = 0.1;  ///< of the readings above 0, with all higher ones
constexpr int least_unknown = 3;      ///< times that such a value is read
constexpr int least_other_readings = 3;   ///< beside codes, to stand apart from
constexpr double least_spread = 5;        ///< [K], of a temperature that hardly moves
constexpr double usual_share = 0.001;     ///< on either side of what a temperature spans
constexpr std::size_t enough = 50;        ///< readings above 0, to know a meter's reach
constexpr double least_spike_quanta = 5;  ///< of the highest other reading
constexpr double most_negative = 0.01;    ///< of all readings
constexpr double most_offset = 0.01;      ///< of what the meter usually reaches
constexpr double usual_reach = 0.99;      ///< quantile of the readings above 0
constexpr int least_rises = 24;
constexpr double most_falls = 0.01;    ///< of all changes; a meter's use: about a half
constexpr double most_restarts = 0.1;  ///< the same, of a register of the day
constexpr double starts_again = 0.1;   ///< of the reading before it
constexpr double nearly_full = 0.9;    ///< of the next power of ten
constexpr int most_overflows = 3;      ///< falls of a register that is full, or so seldom
constexpr double of_largest_rise = 3;  ///< past its full number
constexpr int least_rises_of_bills = 9;  ///< a season rises half a year

/// How far a spike stands above the highest other reading, and how many there may be:
/// the farther, the more of them are no peaks.
constexpr struct {
    double ratio, share;
} spikes_by_ratio[] = {{1000, 0.002}, {30, 0.001}, {3, 0.00025}};
constexpr std::size_t few_spikes = 3;
constexpr int longest_spike = 2;  ///< in a row
constexpr double infinity = std::numeric_limits<double>::infinity();

bool is_known(double value, bool temperature) {
    return std::ranges::find(known_codes, value) != std::end(known_codes) ||
           (temperature && std::ranges::find(codes_of_temperature, value) !=
                               std::end(codes_of_temperature));
}

/// Looks for codes in what values there are, and how often.
class CodeSearch {
  public:
    explicit CodeSearch(const DataSeries& series)
        : temperature_(series.driver == Driver::temperature) {
        for (const double value : series.values)
            if (!std::isnan(value)) ++counts_[value];
        for (const auto& [value, n] : counts_)
            if (!is_known(value, temperature_)) others_[value] = n;
        spread_ = spread();
    }

    std::vector<double> search() {
        std::vector<double> codes;
        if (others_.size() < least_other_readings) return codes;
        for (const auto& [value, n] : counts_)
            if (is_known(value, temperature_) &&
                is_apart(value, n > 1 ? apart_again : apart_once))
                codes.push_back(value);
        if (!temperature_) add_unknown(codes);
        return codes;
    }

  private:
    /// What a temperature spans, nearly always.
    double spread() const {
        std::vector<double> values;
        for (const auto& [value, n] : others_)
            values.insert(values.end(), static_cast<std::size_t>(n), value);
        return std::max(least_spread, quantile_of(values, 1 - usual_share) -
                                          quantile_of(values, usual_share));
    }

    bool is_apart(double value, double ratio) const {
        const double lowest = others_.begin()->first;
        if (value < lowest) {
            const double span = temperature_ ? spread_ : std::max(-lowest, 0.0);
            return lowest - value >= (ratio - 1) * span;
        }
        if (value < 0 && !temperature_) return false;
        const auto above = others_.lower_bound(value);
        if (above == others_.begin()) return false;
        const double next = std::prev(above)->first;
        if (temperature_ && above != others_.end()) return false;
        return value - next >=
               (ratio - 1) * (temperature_ ? spread_ : std::max(next, 0.0));
    }

    /// From the lowest on, as one of them may stand below another.
    void add_unknown(std::vector<double>& codes) {
        double below = 0, n_above = 0;
        for (const auto& [value, n] : others_) n_above += value > 0 ? n : 0;
        for (auto it = others_.begin(); it != others_.end();) {
            const auto [value, n] = *it;
            const bool is_code = value > 0 && n >= least_unknown && below > 0 &&
                                 n_above <= most_unknown * (below + n_above) &&
                                 is_apart(value, apart_unknown);
            if (is_code) codes.push_back(value);
            if (value > 0) n_above -= n;
            if (value > 0 && !is_code) below += n;
            it = is_code ? others_.erase(it) : std::next(it);
        }
    }

    bool temperature_;
    std::map<double, int> counts_, others_;
    double spread_ = 0;
};

std::vector<double> above_zero(std::span<const double> values) {
    std::vector<double> above;
    std::ranges::copy_if(values, std::back_inserter(above),
                         [](double v) { return v > 0; });
    return above;
}

/// From which value on readings are spikes; infinity where none is.
double least_spike(std::vector<double> heights, double quantum) {
    std::ranges::sort(heights);
    const std::size_t n = heights.size();
    if (n < enough) return infinity;
    double least = infinity;
    for (const auto& [ratio, share] : spikes_by_ratio) {
        const auto most = static_cast<std::size_t>(share * static_cast<double>(n));
        for (std::size_t k = n - std::max(most, few_spikes); k < n; ++k) {
            const double rest = heights[k - 1];
            const bool coarse =
                ratio < 10 && rest < least_spike_quanta * quantum * (1 - 1e-9);
            if (!coarse && heights[k] >= ratio * rest)
                least = std::min(least, heights[k]);
        }
    }
    return least;
}

/// Those of at least this height; none where more stand in a row than a spike has.
void add_spikes(std::span<const double> heights, double quantum,
                std::vector<int>& spikes) {
    const double least = least_spike(above_zero(heights), quantum);
    std::vector<int> found;
    int in_a_row = 0;
    for (std::size_t k = 0; k < heights.size(); ++k) {
        in_a_row = heights[k] >= least ? in_a_row + 1 : 0;
        if (in_a_row > longest_spike) return;
        if (in_a_row > 0) found.push_back(static_cast<int>(k));
    }
    spikes.insert(spikes.end(), found.begin(), found.end());
}

/// Heights of a temperature over what it usually keeps above, in steps that spread it.
std::vector<double> heights_over(std::span<const double> values, double from,
                                 double sign) {
    std::vector<double> heights;
    heights.reserve(values.size());
    for (const double value : values) heights.push_back(sign * (value - from));
    return heights;
}

bool starts_anew(double from, double to) {
    return 0 <= to && to <= starts_again * from;
}

bool is_seldom(int n_falls, const Course& course) {
    return n_falls <= most_falls * (course.n_rises + course.n_falls);
}

/// A register that drops for a reading and goes on from where it was.
bool is_dip(std::span<const double> counts, std::size_t k) {
    return k > 0 && k + 1 < counts.size() && counts[k] < counts[k - 1] &&
           counts[k + 1] >= counts[k - 1];
}

/// What a register counts past its full number; 0 where that is more than steps count.
double over_full(double from, double to, double most) {
    const double full = std::pow(10, std::ceil(std::log10(from)));
    const double use = full - from + to;
    return from >= nearly_full * full && use <= most ? use : 0;
}

/// From one count to a lower one. What was used before it started again is known where it
/// has counted since: one that stands at 0 has lost the use of the step.
double over_a_fall(double from, double to, double most) {
    if (!starts_anew(from, to)) return nan;
    const double use = over_full(from, to, most);
    return use > 0 ? use : to > 0 ? to : nan;
}

/// The largest use past a full number; 0 of a register that starts again every day.
double most_over_full(std::span<const double> counts) {
    const Course course = course_of(counts);
    if (course.n_falls > most_overflows && !is_seldom(course.n_falls, course)) return 0;
    double largest = 0;
    for (std::size_t k = 0; k + 1 < counts.size(); ++k)
        if (counts[k + 1] > counts[k])
            largest = std::max(largest, counts[k + 1] - counts[k]);
    return of_largest_rise * largest;
}

}  // namespace

std::vector<Code> codes_in(const DataSeries& series) {
    std::vector<Code> codes;
    for (const double value : CodeSearch(series).search()) {
        Code code{value, {}};
        for (int k = 0; k < series.size(); ++k)
            if (series.at(k) == value) code.at.push_back(k);
        codes.push_back(std::move(code));
    }
    return codes;
}

std::vector<int> spikes_in(const DataSeries& series) {
    std::vector<int> spikes;
    const double quantum = quantum_of(series.values);
    if (series.driver != Driver::temperature) {
        add_spikes(series.values, quantum, spikes);
        return spikes;
    }
    std::vector<double> known;
    for (const double v : series.values)
        if (!std::isnan(v)) known.push_back(v);
    const double low = quantile_of(known, usual_share),
                 high = quantile_of(known, 1 - usual_share);
    const double room = std::max(least_spread - (high - low), 0.0);
    add_spikes(heights_over(series.values, low - room, 1), quantum, spikes);
    add_spikes(heights_over(series.values, high + room, -1), quantum, spikes);
    std::ranges::sort(spikes);
    return spikes;
}

Negatives negatives_in(const DataSeries& series) {
    Negatives found;
    if (series.driver == Driver::temperature) return found;
    std::vector<double> above = above_zero(series.values);
    const double reach = above.empty() ? 0 : quantile_of(std::move(above), usual_reach);
    int n = 0;
    for (int k = 0; k < series.size(); ++k) {
        n += !std::isnan(series.at(k));
        if (!(series.at(k) < 0)) continue;
        (series.at(k) >= -most_offset * reach ? found.offsets : found.others)
            .push_back(k);
    }
    found.are_few = found.others.size() <= 1 ||
                    static_cast<double>(found.others.size()) <= most_negative * n;
    return found;
}

Course course_of(std::span<const double> values) {
    Course course;
    double before = nan;
    for (const double value : values) {
        if (std::isnan(value)) continue;
        course.n_rises += value > before;
        course.n_falls += value < before;
        course.n_restarts += value < before && starts_anew(before, value);
        before = value;
    }
    return course;
}

bool is_register(const Course& course) {
    const double n = course.n_rises + course.n_falls;
    const bool starts_again_only =
        course.n_restarts == course.n_falls && course.n_falls <= most_restarts * n;
    return course.n_rises >= least_rises &&
           (is_seldom(course.n_falls, course) || starts_again_only);
}

bool is_register_of_bills(const Course& course) {
    return course.n_rises >= least_rises_of_bills && course.n_falls == 0;
}

std::vector<double> differences_of(std::span<const double> counts) {
    const double most = most_over_full(counts);
    std::vector<double> differences;
    for (std::size_t k = 0; k + 1 < counts.size(); ++k) {
        const double from = counts[k], to = counts[k + 1];
        const bool dips = is_dip(counts, k) || is_dip(counts, k + 1);
        differences.push_back(dips        ? nan
                              : to < from ? over_a_fall(from, to, most)
                                          : to - from);
    }
    return differences;
}

}  // namespace bemcal::checks
