/// Differences point by point, then quantiles of them over the points.
/// Follows from paper 3: before and after, with uncertainty.
/// A point that failed before or after has no difference. What a change itself costs is
/// left out.
#include "retrofit/savings.hpp"

#include "base/nan.hpp"
#include "stats/quantile.hpp"
#include "study/account_name.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::retrofit {
namespace {

constexpr double quantiles[] = {0.05, 0.5, 0.95};

/// [columns] of the rows that have no NaN.
std::vector<double> quantiles_of(const Matrix& values, double p) {
    std::vector<double> result(values.cols, nan), column;
    for (std::size_t k = 0; k < values.cols; ++k) {
        column.clear();
        for (std::size_t r = 0; r < values.rows; ++r)
            if (!std::isnan(values(r, k))) column.push_back(values(r, k));
        std::ranges::sort(column);
        if (!column.empty()) result[k] = stats::quantile_of_sorted(column, p);
    }
    return result;
}

void append(std::vector<double>& to, const std::vector<double>& values) {
    to.insert(to.end(), values.begin(), values.end());
}

/// The quantiles of all columns, one after the other.
void append_quantiles(std::vector<double>& to, const Matrix& values) {
    for (const double p : quantiles) append(to, quantiles_of(values, p));
}

/// The columns of one variant, of all rows but the first.
Matrix columns_of(const Savings& savings, std::size_t variant) {
    const std::size_t n_outputs = savings.outputs.size();
    Matrix part(savings.rows.rows - 1, n_outputs);
    for (std::size_t r = 0; r < part.rows; ++r)
        for (std::size_t k = 0; k < n_outputs; ++k)
            part(r, k) = savings.rows(r + 1, variant * n_outputs + k);
    return part;
}

/// Before less after; or that over before, 0 where there was nothing to save.
Matrix saving_of(const Matrix& before, const Matrix& after, bool is_share) {
    Matrix saving(before.rows, before.cols);
    for (std::size_t k = 0; k < saving.values.size(); ++k) {
        const double saved = before.values[k] - after.values[k];
        saving.values[k] = !is_share || saved == 0 ? saved : saved / before.values[k];
    }
    return saving;
}

struct Account {
    study::Output output;
    double study::Meter::* per_kwh;
};

/// Of an output: the meters that read it, and whether somebody sells it.
struct Sold {
    std::vector<const study::Meter*> meters{};
    bool is_carrier = false;

    /// As the first that has it says; NaN where none does.
    double price(double study::Meter::* per_kwh) const {
        for (const study::Meter* meter : meters)
            if (!std::isnan(meter->*per_kwh)) return meter->*per_kwh;
        return std::numeric_limits<double>::quiet_NaN();
    }
};

bool is_used(const Savings& savings, std::size_t output) {
    const std::size_t n = savings.outputs.size();
    for (std::size_t at = output; at < savings.rows.values.size(); at += n)
        if (std::abs(savings.rows.values[at]) > 0) return true;
    return false;
}

/// One more output of each variant: the sum over those that have a meter which says it.
/// Where others are sold, too, its name says of which it is.
void add_account(const Account& account, const std::vector<Sold>& sold,
                 Savings& savings) {
    const std::size_t n = savings.outputs.size(), n_variants = savings.rows.cols / n;
    std::vector<double> per_kwh(n, 0.0);
    std::vector<std::string> of;
    bool is_of_all = true;
    for (std::size_t k = 0; k < sold.size(); ++k)
        if (const double price = sold[k].price(account.per_kwh); !std::isnan(price)) {
            per_kwh[k] = price;
            of.push_back(savings.outputs[k].name);
        } else if (sold[k].is_carrier && is_used(savings, k)) {
            is_of_all = false;
        }
    if (of.empty()) return;
    Matrix rows(savings.rows.rows, n_variants * (n + 1));
    for (std::size_t r = 0; r < rows.rows; ++r)
        for (std::size_t v = 0; v < n_variants; ++v) {
            const auto from = savings.rows.row(r).subspan(v * n, n);
            const auto to = rows.row(r).subspan(v * (n + 1), n + 1);
            std::ranges::copy(from, to.begin());
            for (std::size_t k = 0; k < n; ++k)
                if (per_kwh[k] != 0) to[n] += per_kwh[k] * from[k];
        }
    savings.rows = std::move(rows);
    savings.outputs.push_back(
        {study::account_name(account.output.name, of, is_of_all), account.output.unit});
}

void add_names(const Setting& setting, Savings& savings,
               study::DatasetBuilder& datasets) {
    std::vector<std::string> names, units;
    for (const study::Output& output : savings.outputs) {
        names.push_back(output.name);
        units.push_back(output.unit);
    }
    datasets.texts("scenario", "scenario", savings.scenarios);
    datasets.texts("output", "output", std::move(names));
    datasets.texts("output_unit", "output", std::move(units));
    datasets.text("points_of", setting.of);
    datasets.vector("quantile", "quantile", {std::begin(quantiles), std::end(quantiles)});
    datasets.vector("comfort_limit", "limit", {setting.too_cold, setting.too_warm});
    datasets.times("simulated_period", {savings.period.start, savings.period.end()},
                   "end");
    datasets.parameters(savings.parameters);
}

}  // namespace

void add_accounts(const std::vector<study::Meter>& meters,
                  std::string (*output_of)(const study::Meter&), Savings& savings) {
    std::vector<Sold> sold;
    sold.reserve(savings.outputs.size());
    for (const study::Output& output : savings.outputs) {
        Sold one;
        for (const study::Meter& meter : meters)
            if (output_of(meter) == output.name) one.meters.push_back(&meter);
        one.is_carrier =
            one.meters.empty()
                ? std::ranges::find(physics::carrier_names, output.name) !=
                      physics::carrier_names.end()
                : physics::carrier_of(one.meters[0]->quantity) != physics::Carrier::none;
        sold.push_back(std::move(one));
    }
    for (const Account& account : {Account{{"cost", "currency"}, &study::Meter::tariff},
                                   Account{{"CO2", "kg"}, &study::Meter::co2}})
        add_account(account, sold, savings);
}

std::string lost_scenarios(const Savings& savings) {
    std::vector<std::string> lost;
    for (std::size_t k = 0; k < savings.scenarios.size(); ++k) {
        const auto column = savings.rows.column((k + 1) * savings.outputs.size());
        const auto points = std::span(column).subspan(column.size() > 1 ? 1 : 0);
        if (std::ranges::all_of(points, [](double value) { return std::isnan(value); }))
            lost.push_back(
                fmt::format("the scenario \"{}\" could be simulated at no point",
                            savings.scenarios[k]));
    }
    return fmt::format("{}", fmt::join(lost, "; "));
}

void add_savings(const Setting& setting, Savings savings,
                 study::DatasetBuilder& datasets) {
    add_names(setting, savings, datasets);
    const std::size_t n_scenarios = savings.scenarios.size(),
                      n_outputs = savings.outputs.size(), n_q = std::size(quantiles),
                      n = savings.points.rows;
    const Matrix before = columns_of(savings, 0);
    std::vector<double> after, after_q, saving_q, share_q, before_q;
    for (std::size_t s = 1; s <= n_scenarios; ++s) {
        const Matrix of_scenario = columns_of(savings, s);
        append(after, of_scenario.values);
        append_quantiles(after_q, of_scenario);
        append_quantiles(saving_q, saving_of(before, of_scenario, false));
        append_quantiles(share_q, saving_of(before, of_scenario, true));
    }
    append_quantiles(before_q, before);
    const auto described = savings.rows.row(0);
    datasets.array("described", {"variant", "output"}, {1 + n_scenarios, n_outputs},
                   {described.begin(), described.end()});
    datasets.array("before_quantile", {"quantile", "output"}, {n_q, n_outputs},
                   std::move(before_q));
    const std::vector<std::string> dims{"scenario", "quantile", "output"};
    const std::vector<std::size_t> shape{n_scenarios, n_q, n_outputs};
    datasets.array("after_quantile", dims, shape, std::move(after_q));
    datasets.array("saving_quantile", dims, shape, std::move(saving_q));
    datasets.array("saving_share_quantile", dims, shape, std::move(share_q));
    if (n == 0) return;
    datasets.array("points", {"point", "parameter"}, {n, savings.points.cols},
                   std::move(savings.points.values));
    datasets.array("before", {"point", "output"}, {n, n_outputs}, before.values);
    datasets.array("after", {"scenario", "point", "output"}, {n_scenarios, n, n_outputs},
                   std::move(after));
}

}  // namespace bemcal::retrofit
