/// Finds meters of several buildings that are one, by daily sums: within 10 % of one
/// ratio on 70 % of the days, with steps from day to day that correlate by 0.97.
/// Follows from weather, which moves buildings alike, but not to one ratio and by the
/// same steps; a sketch of every fifteenth day ends nearly all pairs.
/// Looks at each building's first energy meter; sums of several meters are left out. What
/// is like one of a large group counts as of the group.
#include "stock/shared.hpp"

#include "base/alike.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace bemcal::stock {

namespace {

constexpr std::size_t least_days = 60;
constexpr double ratio_width = 0.1;  ///< of days that count as at one ratio [-]
constexpr double least_share = 0.7, least_variation = 1.2;
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

/// Logarithms of every fifteenth day of the calendar, so that pairs of a large stock are
/// told apart without a look at all of their days.
class Sketches {
  public:
    explicit Sketches(const std::vector<StockRecord>& records) {
        rows_.reserve(records.size());
        for (const StockRecord& record : records) add(record);
    }

    /// Nearly all pairs end here: two days may differ by more than the ratio's width.
    bool can_be_one(std::size_t a, std::size_t b) const {
        const Row &x = rows_[a], &y = rows_[b];
        const std::ptrdiff_t from = std::max(x.first, y.first);
        const std::ptrdiff_t to = std::min(x.end, y.end);
        double least = 0, most = 0;
        int n = 0, n_off = 0;
        for (std::ptrdiff_t day = from; day < to; ++day) {
            const double step = log_of(y, day) - log_of(x, day);
            if (std::isnan(step)) continue;
            if (n++ == 0) least = most = step;
            if (step > least + width || step < most - width) {
                if (++n_off > 2) return false;
                continue;
            }
            least = std::min(least, step);
            most = std::max(most, step);
        }
        return n >= 4;
    }

  private:
    /// Days since 1970 divided by 15, and where the first stands among all.
    struct Row {
        std::ptrdiff_t first, end, at;
    };
    static inline const double width = std::log(1 + 3 * ratio_width);

    void add(const StockRecord& record) {
        const auto start = static_cast<std::ptrdiff_t>(record.daily_start);
        Row row{(start + 14) / 15, 0, std::ssize(logs_)};
        for (auto day = 15 * row.first - start; day < std::ssize(record.daily);
             day += 15) {
            const double sum = record.daily[static_cast<std::size_t>(day)];
            logs_.push_back(sum > 0 ? std::log(sum) : std::nan(""));
        }
        row.end = row.first + std::ssize(logs_) - row.at;
        rows_.push_back(row);
    }
    double log_of(const Row& row, std::ptrdiff_t day) const {
        return logs_[static_cast<std::size_t>(row.at + day - row.first)];
    }

    std::vector<Row> rows_;
    std::vector<double> logs_;
};

/// How two meters are one.
struct Share {
    std::size_t first = 0, second = 0;
    double ratio = 0;  ///< second / first
    std::size_t n_days = 0;
};

/// Whether they are, by all of their days.
bool is_shared(const StockRecord& a, const StockRecord& b, Share& share) {
    const Pairs pairs = pairs_of(a, b);
    share.n_days = pairs.ratios.size();
    if (share.n_days < least_days) return false;
    const auto [low, high] = std::ranges::minmax(pairs.first);
    share.ratio = middle_of(pairs.ratios);
    return high >= least_variation * low &&
           share_near(pairs.ratios, share.ratio, ratio_width) >= least_share &&
           correlation(pairs.first, pairs.second) >= least_correlation;
}

/// \param partners  whom it is shared with, in words
/// \param ratio  of its daily sums to those of the first of them
void note(StockRecord& at, const std::string& partners, double ratio,
          std::size_t n_days) {
    const std::string meter = at.fits.empty() ? "meter" : at.fits.front().meter;
    at.findings.push_back({meter,
                           fmt::format("{}{}: {:.4g} times its daily sums, over {} days",
                                       shared_with, partners, ratio, n_days),
                           std::string(kept)});
}

/// Of a large group: "house and 2498 more (annex, barn, mill, ...)".
constexpr std::string_view many = " more (";

std::string partner_in(const std::string& finding) {
    return finding.substr(shared_with.size(), finding.rfind(": ") - shared_with.size());
}

bool is_of_shared(const study::DataDecision& finding) {
    return finding.action == kept;
}

/// Nothing was done with it this night, and it is of no large group, which is looked at
/// anew as a whole.
bool is_unchanged(const StockRecord& record) {
    return record.age > 0 &&
           std::ranges::none_of(record.findings, [](const study::DataDecision& finding) {
               return is_of_shared(finding) &&
                      finding.finding.find(many) != std::string::npos;
           });
}

/// Indices of records by their names.
using Places = std::map<std::string, std::size_t>;

class Search {
  public:
    explicit Search(std::vector<StockRecord>& records)
        : records_(records), sketches_(records), groups_(records.size()) {
        for (std::size_t k = 0; k < records.size(); ++k) {
            is_settled_.push_back(is_unchanged(records[k]));
            if (is_settled_[k]) settled_.emplace(records[k].name, k);
        }
    }

    void run() {
        for (StockRecord& record : records_) keep_of_earlier_nights(record);
        for (std::size_t k = 0; k < records_.size(); ++k)
            groups_.add(k, [&](std::size_t earlier, std::size_t later) {
                return look_at(earlier, later);
            });
        for (const Share& share : shares_)
            if (!groups_.is_large(share.first)) note_pair(share);
        for (const std::vector<std::size_t>& group : groups_.large_groups())
            note_group(group);
    }

  private:
    /// What was said of pairs that are looked at again is forgotten.
    void keep_of_earlier_nights(StockRecord& record) {
        const auto own = settled_.find(record.name);
        std::erase_if(record.findings, [&](const study::DataDecision& finding) {
            if (!is_of_shared(finding)) return false;
            const auto partner = settled_.find(partner_in(finding.finding));
            const bool stays = own != settled_.end() && partner != settled_.end();
            if (stays) groups_.join(own->second, partner->second);
            return !stays;
        });
    }

    bool look_at(std::size_t a, std::size_t b) {
        if (is_settled_[a] && is_settled_[b]) return false;
        Share share{a, b, 0, 0};
        if (!sketches_.can_be_one(a, b) || !is_shared(records_[a], records_[b], share))
            return false;
        shares_.push_back(share);
        return true;
    }

    void note_pair(const Share& share) {
        StockRecord &a = records_[share.first], &b = records_[share.second];
        note(a, b.name, 1 / share.ratio, share.n_days);
        note(b, a.name, share.ratio, share.n_days);
    }

    /// Each member beside the first that it is like.
    void note_group(const std::vector<std::size_t>& group) {
        for (const std::size_t member : group)
            std::erase_if(records_[member].findings, is_of_shared);
        for (const std::size_t member : group)
            if (const auto share = share_in(group, member))
                note(records_[member], partners_of(group, *share), share->ratio,
                     share->n_days);
    }
    std::optional<Share> share_in(const std::vector<std::size_t>& group,
                                  std::size_t member) const {
        for (const std::size_t partner : group) {
            Share share{partner, member, 0, 0};
            if (partner != member &&
                is_shared(records_[partner], records_[member], share))
                return share;
        }
        return std::nullopt;
    }
    std::string partners_of(const std::vector<std::size_t>& group,
                            const Share& share) const {
        constexpr std::size_t most_named = 4;
        std::string others;
        std::size_t n_named = 0;
        for (auto each = group.begin(); n_named < most_named; ++each) {
            if (*each == share.first || *each == share.second) continue;
            others += records_[*each].name + ", ";
            ++n_named;
        }
        return fmt::format("{} and {}{}{}...)", records_[share.first].name,
                           group.size() - 2, many, others);
    }

    std::vector<StockRecord>& records_;
    Sketches sketches_;
    AlikeGroups groups_;
    std::vector<bool> is_settled_;  ///< nothing was done with it, and it is kept
    Places settled_;
    std::vector<Share> shares_;
};

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
    Search(records).run();
}

}  // namespace bemcal::stock
