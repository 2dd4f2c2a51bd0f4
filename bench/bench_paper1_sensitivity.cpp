/// Paper 1's sensitivity analysis of one office hour and its agreement with the printed
/// result: 19 inputs first, then 17 in 12 cases of floor area and last-hour temperature.
/// Lines: name value unit reference ratio, after a table of the indices.
#include "sensitivity/sensitivity.hpp"
#include "sensitivity/simulators.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace {

using namespace bemcal;

constexpr double threshold = 0.05;
/// Those that the paper's section 3.1 finds above 0.05 among the 17, besides theta_prev.
const std::set<std::string> printed{
    "L", "W", "WWR", "DHI", "DNI", "theta_ext", "theta_H_set", "theta_C_set", "HourNum"};

struct Result {
    std::vector<std::string> names;
    std::vector<double> first_order, total_order, half_width;
};

const study::Dataset& find(const std::vector<study::Dataset>& datasets,
                           const std::string& leaf) {
    return *std::ranges::find_if(
        datasets, [&](const auto& dataset) { return dataset.path == "hour/" + leaf; });
}

Result indices_of(std::vector<std::pair<std::string, double>> fixed,
                  const physics::OfficeHourAssumptions& assumptions) {
    sensitivity::SensitivityOptions options;
    options.n_base = 4096;
    options.n_bootstrap = 100;
    const auto stage = sensitivity::make_sensitivity(
        "hour", sensitivity::make_office_hour_simulator(std::move(fixed), assumptions),
        options);
    std::vector<study::ItemAnswer> answers;
    for (int item = 0; item < stage->n_items(); ++item)
        answers.push_back(stage->run(item));
    const auto datasets = stage->conclude(answers).datasets;
    return {find(datasets, "parameter").texts, find(datasets, "first_order").values,
            find(datasets, "total_order").values,
            find(datasets, "total_order_half_width").values};
}

void print_first(const Result& result) {
    fmt::print("19 inputs: S1, ST (+- 95 %)\n");
    for (std::size_t k = 0; k < result.names.size(); ++k)
        fmt::print("  {:<12} {:7.4f} {:7.4f} +- {:.4f}\n", result.names[k],
                   result.first_order[k], result.total_order[k], result.half_width[k]);
}

/// Whether `name` has the largest or the second largest total-order index.
bool is_among_two_largest(const Result& result, const std::string& name) {
    const auto at = static_cast<std::size_t>(std::ranges::find(result.names, name) -
                                             result.names.begin());
    return std::ranges::count_if(result.total_order, [&](double index) {
               return index > result.total_order[at];
           }) < 2;
}

std::vector<Result> twelve_cases(const physics::OfficeHourAssumptions& assumptions) {
    std::vector<Result> cases;
    for (const double theta : {10.0, 20.0, 30.0})
        for (const double area : {10e3, 50e3, 100e3, 150e3})
            cases.push_back(
                indices_of({{"GFA", area}, {"theta_prev", theta}}, assumptions));
    return cases;
}

/// What one input's total-order indices are over the cases.
struct Summary {
    int n_above = 0;
    double mean = 0, largest = 0;
};

Summary summary_of(const std::vector<Result>& cases, std::size_t input) {
    Summary summary;
    for (const Result& result : cases) {
        const double index = result.total_order[input];
        summary.n_above += index > threshold;
        summary.mean += index / static_cast<double>(cases.size());
        summary.largest = std::max(summary.largest, index);
    }
    return summary;
}

void print_cases(const std::vector<Result>& cases) {
    fmt::print(
        "17 inputs: ST in the cases theta_prev 10, 20, 30 degC x GFA 10, 50, 100, 150 "
        "thousand m2; mean; cases above {}; * = printed as sensitive\n",
        threshold);
    for (std::size_t input = 0; input < cases[0].names.size(); ++input) {
        const std::string& name = cases[0].names[input];
        fmt::print("{} {:<12}", printed.contains(name) ? '*' : ' ', name);
        for (const Result& result : cases)
            fmt::print(" {:.3f}", result.total_order[input]);
        const Summary summary = summary_of(cases, input);
        fmt::print("  {:.3f}  {:2d}\n", summary.mean, summary.n_above);
    }
}

void print_agreement(const std::vector<Result>& cases, const std::string& name,
                     auto&& is_sensitive) {
    int n_both = 0, n_more = 0;
    for (std::size_t input = 0; input < cases[0].names.size(); ++input)
        if (is_sensitive(summary_of(cases, input)))
            ++(printed.contains(cases[0].names[input]) ? n_both : n_more);
    fmt::print("paper1_second_agree_{} {} inputs {} {:.3g}\n", name, n_both,
               printed.size(), n_both / static_cast<double>(printed.size()));
    fmt::print("paper1_second_others_{} {} inputs 0 {}\n", name, n_more, n_more);
}

/// What the paper leaves open, varied: how much of the agreement hangs on it.
struct Variant {
    const char* name;
    physics::OfficeHourAssumptions assumptions;
};
constexpr Variant variants[] = {
    {"as_assumed", {}},
    {"no_heat_recovery", {.heat_recovery = 0}},
    {"full_heat_recovery", {.heat_recovery = 1}},
    {"clear_glass_no_frame", {.g_value = 0.85, .frame_fraction = 0}}};

void print_variant(const Variant& variant) {
    const Result first = indices_of({}, variant.assumptions);
    const std::vector<Result> cases = twelve_cases(variant.assumptions);
    fmt::print("\n## {}\n", variant.name);
    print_first(first);
    print_cases(cases);
    const int n_largest =
        is_among_two_largest(first, "GFA") + is_among_two_largest(first, "theta_prev");
    fmt::print("paper1_first_two_largest_{} {} inputs 2 {}\n", variant.name, n_largest,
               n_largest / 2.0);
    const auto name = [&](const char* rule) {
        return fmt::format("{}_{}", variant.name, rule);
    };
    print_agreement(cases, name("in_any_case"),
                    [](const Summary& s) { return s.n_above > 0; });
    print_agreement(cases, name("in_most_cases"),
                    [](const Summary& s) { return s.n_above > 6; });
    print_agreement(cases, name("on_average"),
                    [](const Summary& s) { return s.mean > threshold; });
}

}  // namespace

int main() {
    for (const Variant& variant : variants) print_variant(variant);
}
