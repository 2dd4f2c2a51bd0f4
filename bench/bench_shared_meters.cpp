/// What it costs to find the buildings of a stock of 10,000 that show one meter: each a
/// meter of its own, a quarter of them one, and every ten of them one.
///
/// CPU time of one core and what the findings add to the memory; the reference is each a
/// meter of its own. Lines: name value unit reference ratio.
#include "stock/shared.hpp"

#include <cmath>
#include <ctime>
#include <random>
#include <string>

#include <fmt/format.h>
#include <malloc.h>

namespace bemcal::stock {
namespace {

constexpr std::size_t n_days = 180;

/// Daily gas under one weather, with days of a building's own.
std::vector<float> days_of(std::uint64_t seed, double size) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0, 0.2);
    const double base = 14 + 4 * std::generate_canonical<double, 30>(random);
    std::vector<float> days(n_days);
    for (std::size_t k = 0; k < n_days; ++k) {
        const double day = static_cast<double>(k);
        const double outdoor =
            6 - 7 * std::cos(day / 58) + 3 * std::sin(day * 0.7) * std::cos(day * day);
        days[k] = static_cast<float>(size * (std::max(base - outdoor, 0.0) + 1) *
                                     std::exp(noise(random)));
    }
    return days;
}

/// The first `n_alike` in groups of so many that show one meter.
std::vector<StockRecord> stock_of(std::size_t n, std::size_t n_alike,
                                  std::size_t group_size) {
    std::vector<StockRecord> records(n);
    for (std::size_t k = 0; k < n; ++k) {
        records[k].name = fmt::format("house {}", k);
        const std::size_t meter = k < n_alike ? k / group_size : n + k;
        records[k].daily = days_of(meter, 1 + static_cast<double>(k % 37));
    }
    return records;
}

struct Cost {
    double seconds, megabytes;
    std::size_t n_findings;
};

Cost cost_of(std::vector<StockRecord> records) {
    const std::size_t before = ::mallinfo2().uordblks;
    const std::clock_t start = std::clock();
    find_shared_meters(records);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    std::size_t n_findings = 0;
    for (const StockRecord& record : records) n_findings += record.findings.size();
    return {seconds, static_cast<double>(::mallinfo2().uordblks - before) / 1e6,
            n_findings};
}

void print(const std::string& name, const Cost& cost, const Cost& reference) {
    fmt::print("{}_time {:.2f} s {:.2f} {:.2f}\n", name, cost.seconds, reference.seconds,
               cost.seconds / reference.seconds);
    fmt::print("{}_memory {:.1f} MB - -\n{}_findings {} - - -\n", name, cost.megabytes,
               name, cost.n_findings);
}

}  // namespace
}  // namespace bemcal::stock

int main() {
    using namespace bemcal::stock;
    constexpr std::size_t n = 10000;
    const Cost own = cost_of(stock_of(n, 0, 1));
    print("own_meters", own, own);
    print("one_of_2500", cost_of(stock_of(n, 2500, 2500)), own);
    print("one_of_10", cost_of(stock_of(n, n, 10)), own);
}
