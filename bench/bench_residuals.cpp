/// What the residual model costs a point: a year of hours with and without gaps, value
/// alone and with its derivatives, and how the cost grows with the number of readings.
/// Processor time, the least of several runs. Lines: name value unit reference ratio.
#include "base/random.hpp"
#include "stats/residual_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <time.h>

namespace bemcal::stats {

namespace {

constexpr std::size_t hours = 8760, lanes = 8;

double processor_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

enum class Wanted { value, derivatives };
enum class Gaps { none, two_long, many_short };

/// Hourly readings; each gap is of a day, or of single readings, 1 of 50.
std::vector<double> readings(std::size_t n, Gaps gaps) {
    constexpr double missing = std::numeric_limits<double>::quiet_NaN();
    Stream stream(1, 0, 0);
    std::vector<double> values(n);
    for (std::size_t t = 0; t < n; ++t) {
        values[t] =
            10 + 6 * std::sin(0.2618 * static_cast<double>(t)) + 2 * stream.uniform();
        const bool is_long = t % (n / 2) >= n / 4 && t % (n / 2) < n / 4 + 24;
        const bool is_short = stream.below(50) == 0;
        if ((gaps == Gaps::two_long && is_long) || (gaps == Gaps::many_short && is_short))
            values[t] = missing;
    }
    return values;
}

/// Predictions and parameters [rows x lanes], different in every lane.
struct Case {
    ResidualModel model;
    std::vector<double> predictions, parameters, values, by_prediction, by_parameter;
    ResidualModel::Work work;

    Case(std::size_t n, Gaps gaps, const ResidualOptions& options)
        : model(readings(n, gaps), 10, options), values(lanes), by_prediction(n * lanes) {
        for (std::size_t t = 0; t < n; ++t)
            for (std::size_t l = 0; l < lanes; ++l)
                predictions.push_back(10 + (6 + 0.1 * static_cast<double>(l)) *
                                               std::sin(0.2618 * static_cast<double>(t)));
        for (const auto& name : residual_parameters(options))
            for (std::size_t l = 0; l < lanes; ++l)
                parameters.push_back(of(name) * (1 + 0.01 * static_cast<double>(l)));
        by_parameter.resize(parameters.size());
    }
    static double of(const std::string& name) {
        if (name == "phi") return 0.8;
        if (name == "share") return 0.4;
        return name == "timescale" ? 168 : 0.1;
    }
    void run(Wanted wanted) {
        const bool all = wanted == Wanted::derivatives;
        model.log_likelihood(predictions.data(), parameters.data(), lanes, values.data(),
                             all ? by_prediction.data() : nullptr,
                             all ? by_parameter.data() : nullptr, work);
    }
};

/// [us] of processor time for each lane.
double microseconds(Case& work, Wanted wanted) {
    double least = std::numeric_limits<double>::infinity();
    const std::size_t repeats = 1 + 100'000 / work.model.n_readings();
    for (int run = 0; run < 15; ++run) {
        const double begin = processor_seconds();
        for (std::size_t k = 0; k < repeats; ++k) work.run(wanted);
        least = std::min(
            least, (processor_seconds() - begin) / static_cast<double>(repeats * lanes));
    }
    return 1e6 * least;
}

void print(const std::string& name, double value, const char* unit, double reference) {
    fmt::print("{} {:.4g} {} {:.4g} {:.3g}\n", name, value, unit, reference,
               value / reference);
}

/// Reference: what is aimed at for value and derivatives; for the value, its derivatives.
void print_year(const std::string& name, const ResidualOptions& options, Gaps gaps,
                double aim) {
    Case year(hours, gaps, options);
    const double all = microseconds(year, Wanted::derivatives);
    print("residuals." + name + ".derivatives", all, "us", aim);
    print("residuals." + name + ".value", microseconds(year, Wanted::value), "us", all);
}

/// Reference: the first, of 1,000 readings.
void print_growth(const std::string& name, const ResidualOptions& options) {
    double first = 0;
    for (const std::size_t n : {1'000U, 10'000U, 100'000U}) {
        Case some(n, Gaps::none, options);
        const double each =
            1e3 * microseconds(some, Wanted::derivatives) / static_cast<double>(n);
        if (first == 0) first = each;
        print(fmt::format("residuals.{}.each_of_{}", name, n), each, "ns", first);
    }
}

}  // namespace

}  // namespace bemcal::stats

int main() {
    using namespace bemcal::stats;
    print_year("white", {false, false, true}, Gaps::none, 60);
    print_year("ar1", {true, false, true}, Gaps::none, 60);
    print_year("ar1.two_long_gaps", {true, false, true}, Gaps::two_long, 60);
    print_year("ar1.many_short_gaps", {true, false, true}, Gaps::many_short, 60);
    print_year("slow", {true, true, true}, Gaps::none, 250);
    print_year("slow.two_long_gaps", {true, true, true}, Gaps::two_long, 250);
    print_year("slow.many_short_gaps", {true, true, true}, Gaps::many_short, 250);
    print_year("slow.full_filter", {true, true, false}, Gaps::none, 250);
    print_growth("ar1", {true, false, true});
    print_growth("slow", {true, true, true});
    print_growth("slow.full_filter", {true, true, false});
}
