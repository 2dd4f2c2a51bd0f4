/// Works on one building of a stock: reads it, runs all rounds of its study, takes
/// values, errors and findings from its datasets. A night starts from the last one's.
/// Follows from the names of the study's datasets.
/// Drift is judged by `find_drift`. Which are due is decided by the stock's stage.
#include "stock/calibration.hpp"

#include "base/error.hpp"
#include "calibration/screening.hpp"
#include "input/input_files.hpp"
#include "job/kind.hpp"
#include "job/stages.hpp"
#include "loop/options.hpp"

#include <algorithm>
#include <any>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::stock {

namespace {

using study::Case;
using study::Dataset;
using study::ItemAnswer;
using study::Stage;

constexpr int sketch_days = 180;

/// All rounds of a stage. A failed item keeps its reason.
std::vector<ItemAnswer> answers_of(Stage& stage) {
    std::vector<ItemAnswer> answers;
    for (int first = 0, count = stage.n_items();;) {
        for (int item = first; item < first + count; ++item) {
            answers.emplace_back();
            try {
                answers.back() = stage.run(item);
            } catch (const std::exception& error) {
                answers.back().error = error.what();
            }
        }
        const auto round = stage.next_round(answers);
        if (!round) return answers;
        first += count;
        count = round->n_items;
        stage.begin_round(first, *round);
    }
}

/// Datasets of one group, by the rest of their path.
class Group {
  public:
    Group(const std::vector<Dataset>& datasets, std::string path)
        : datasets_(datasets), path_(std::move(path)) {}

    const Dataset& operator[](const std::string& leaf) const {
        static const Dataset none;
        for (const Dataset& dataset : datasets_)
            if (dataset.path.size() == path_.size() + 1 + leaf.size() &&
                dataset.path.starts_with(path_) && dataset.path.ends_with("/" + leaf))
                return dataset;
        return none;
    }
    bool has(const std::string& leaf) const { return !(*this)[leaf].path.empty(); }

  private:
    const std::vector<Dataset>& datasets_;
    std::string path_;
};

std::size_t index_of(const std::vector<std::string>& names, const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

/// Sum and number of the readings of a period.
StockRecord::Fit fit_with_readings(const Case& building, std::size_t period,
                                   std::size_t meter) {
    StockRecord::Fit fit;
    fit.meter = building.meters[meter].name;
    fit.unit = physics::unit_of(building.meters[meter].quantity);
    fit.period = building.periods[period].name;
    fit.before = fit.cv_rmse = fit.nmbe = std::numeric_limits<double>::quiet_NaN();
    const study::Meter& m = building.meters[meter];
    for (int k = 0; k < m.axis.n_steps; ++k) {
        const auto begin = m.axis.begin_of(k);
        const double value = m.values[static_cast<std::size_t>(k)];
        if (begin < building.periods[period].from ||
            begin >= building.periods[period].to || std::isnan(value))
            continue;
        fit.n += 1;
        fit.measured += value;
    }
    return fit;
}

/// Point 0 is the start; values of the best points show how far the readings tell.
void summarise_screening(const std::vector<Dataset>& datasets, const std::string& stage,
                         const Case& building, StockRecord& record) {
    const Group group(datasets, stage);
    if (!group.has("best_parameters"))
        throw std::runtime_error("no point could be simulated: " +
                                 (group.has("failed_reason")
                                      ? group["failed_reason"].texts.at(0)
                                      : std::string("without a reason")));
    const std::size_t n_parameters = building.parameters.size();
    const std::size_t n_meters = building.meters.size();
    const auto& best = group["best_parameters"].values;
    for (std::size_t p = 0; p < n_parameters; ++p) {
        StockRecord::Value& value = record.values[p];
        value.value = value.low = value.high = best[p];
        for (std::size_t k = p; k < best.size(); k += n_parameters) {
            value.low = std::min(value.low, best[k]);
            value.high = std::max(value.high, best[k]);
        }
    }
    for (std::size_t p = 0; p < building.periods.size(); ++p)
        for (std::size_t m = 0; m < n_meters; ++m) {
            const std::size_t at = p * n_meters + m;
            record.fits.push_back(fit_with_readings(building, p, m));
            record.fits.back().before = group["cv_rmse"].values.at(at);
            record.fits.back().cv_rmse = group["best_cv_rmse"].values.at(at);
            record.fits.back().nmbe = group["best_nmbe"].values.at(at);
        }
}

void summarise_posterior(const std::vector<Dataset>& datasets, const std::string& stage,
                         const Case& building, StockRecord& record) {
    const Group group(datasets, stage);
    const auto& unknown = group["unknown"].texts;
    for (StockRecord::Value& value : record.values) {
        const std::size_t at = index_of(unknown, value.name);
        if (at == unknown.size()) continue;
        value.value = group["posterior_mean"].values.at(at);
        value.low = group["posterior_q05"].values.at(at);
        value.high = group["posterior_q95"].values.at(at);
    }
    for (std::size_t p = 0; p < building.periods.size(); ++p)
        for (std::size_t m = 0; m < building.meters.size(); ++m) {
            record.fits.push_back(fit_with_readings(building, p, m));
            StockRecord::Fit& fit = record.fits.back();
            for (const char* part : {"training", "all"}) {
                const Group inner(datasets, fmt::format("{}/{}/{}/{}", stage, fit.period,
                                                        fit.meter, part));
                if (!inner.has("validation_fit")) continue;
                const auto& metric = inner["metric"].texts;
                const auto& values = inner["validation_fit"];
                const std::size_t n_metrics = values.shape.at(2);
                const std::size_t of_after = values.shape.at(1) * n_metrics;
                const std::size_t cv = index_of(metric, "cv_rmse");
                const std::size_t bias = index_of(metric, "nmbe");
                if (cv >= n_metrics || bias >= n_metrics) continue;
                fit.before = values.values.at(cv);
                fit.cv_rmse = values.values.at(of_after + cv);
                fit.nmbe = values.values.at(of_after + bias);
                break;
            }
        }
    if (group.has("convergence") && group["convergence"].texts.at(0) != "converged")
        record.findings.push_back(
            {"posterior", group["convergence"].texts.at(0), "its values are doubtful"});
}

void summarise_loop(const std::vector<Dataset>& datasets, const std::string& stage,
                    const Case& building, StockRecord& record) {
    const Group group(datasets, stage);
    const auto& names = group["parameter"].texts;
    const std::size_t n = names.size();
    for (StockRecord::Value& value : record.values) {
        const std::size_t at = index_of(names, value.name);
        if (at == n) continue;
        value.value = group["parameter_value"].values.at(2 * n + at);
        const double sd = group["parameter_sd"].values.at(2 * n + at);
        value.low = value.value - 1.645 * sd;
        value.high = value.value + 1.645 * sd;
    }
    const auto& channels = group["channel"].texts;
    const Dataset& fit = group["fit"];  // [model, period, resolution, channel, metric]
    const std::size_t n_periods = fit.shape.at(1), n_channels = fit.shape.at(3);
    const auto number = [&](std::size_t model, std::size_t p, std::size_t c,
                            std::size_t metric) {
        return fit.values.at((((model * n_periods + p) * 2) * n_channels + c) * 4 +
                             metric);
    };
    for (std::size_t p = 0; p < n_periods; ++p)
        for (std::size_t m = 0; m < building.meters.size(); ++m) {
            const std::size_t c = index_of(channels, building.meters[m].name);
            if (c == n_channels) continue;
            record.fits.push_back(fit_with_readings(building, p, m));
            record.fits.back().before = number(0, p, c, 1);
            record.fits.back().cv_rmse = number(2, p, c, 1);
            record.fits.back().nmbe = number(2, p, c, 2);
        }
    for (std::size_t k = 0; k < group["effect"].texts.size(); ++k)
        record.findings.push_back(
            {"loop",
             fmt::format("found: {}, {:.3g} {}", group["effect"].texts[k],
                         group["effect_coefficient"].values.at(k),
                         group["effect_unit"].texts.at(k)),
             group["effect_adequate"].values.at(k) != 0 ? "accepted"
                                                        : "accepted, not adequate"});
}

/// Daily sums of the first meter of an energy, over the last days with readings.
void sketch(const Case& building, StockRecord& record) {
    for (const study::Meter& meter : building.meters) {
        const bool daily = meter.axis.step_s <= 3600 && 86400 % meter.axis.step_s == 0;
        if (!daily || physics::is_temperature(meter.quantity)) continue;
        const int per_day = 86400 / meter.axis.step_s;
        const auto last = std::chrono::floor<std::chrono::days>(
            std::min(meter.axis.end(), building.periods.back().to));
        const auto first = last - std::chrono::days(sketch_days);
        record.daily_start = static_cast<double>(
            std::chrono::floor<std::chrono::days>(first.time_since_epoch()).count());
        for (auto day = first; day < last; day += std::chrono::days(1)) {
            double sum = 0;
            for (int k = 0; k < per_day; ++k) {
                const int step = meter.axis.step_of(
                    physics::Seconds(day) + std::chrono::seconds(k * meter.axis.step_s));
                sum += step < 0 || step >= meter.axis.n_steps
                           ? std::numeric_limits<double>::quiet_NaN()
                           : meter.values[static_cast<std::size_t>(step)];
            }
            record.daily.push_back(static_cast<float>(sum));
        }
        return;
    }
}

void add_values(const Case& building, StockRecord& record) {
    for (const physics::Parameter& parameter : building.parameters)
        record.values.push_back({parameter.name, parameter.unit, parameter.least,
                                 parameter.most, parameter.nominal, parameter.least,
                                 parameter.most, 0});
}

/// Yesterday's values of parameters, as far as they still mean something.
std::map<std::string, double> values_in(const StockRecord& before, const Case& building) {
    std::map<std::string, double> values;
    for (const physics::Parameter& parameter : building.parameters)
        for (const StockRecord::Value& value : before.values)
            if (value.name == parameter.name && value.unit == parameter.unit &&
                std::isfinite(value.value))
                values[parameter.name] =
                    std::clamp(value.value, std::min(parameter.least, parameter.most),
                               parameter.most);
    return values;
}

void start_from(const std::map<std::string, double>& values, job::Job& job) {
    for (physics::Parameter& parameter : job.buildings[0].parameters)
        if (const auto found = values.find(parameter.name); found != values.end())
            parameter.nominal = found->second;
    if (auto* loop = std::any_cast<loop::LoopOptions>(&job.studies[0].options))
        loop->start = values;
}

void add_results(const job::Job& job, Calibrated& result) {
    for (const auto& stage : job::make_plan(job)) {
        const auto answers = answers_of(*stage);
        for (const ItemAnswer& answer : answers)
            if (!answer.error.empty()) throw std::runtime_error(answer.error);
        if (stage->n_simulations() > 0)
            result.record.simulations += static_cast<double>(stage->n_simulations());
        for (Dataset& dataset : stage->conclude(answers))
            result.datasets.push_back(std::move(dataset));
    }
}

double best_score(const job::Job& job, const Calibrated& result) {
    const Group group(result.datasets, job.buildings[0].name + "/" + job.studies[0].name);
    return group.has("best_score") ? group["best_score"].values.at(0)
                                   : std::numeric_limits<double>::infinity();
}

/// Ranges that end a quarter of their width from where the night starts, at most.
void narrow(Case& building) {
    for (physics::Parameter& parameter : building.parameters) {
        const double reach = 0.25 * (parameter.most - parameter.least);
        parameter.least = std::max(parameter.least, parameter.nominal - reach);
        parameter.most = std::min(parameter.most, parameter.nominal + reach);
    }
}

/// A screening that goes on from the night before: half of its points anywhere, half near
/// where it starts; the better half stands.
void screen_again(job::Job& job, Calibrated& result) {
    std::size_t& n_points = job.studies[0].as<calibration::ScreeningOptions>().n_points;
    n_points = std::max<std::size_t>(n_points / 2, 1);
    job::Job near = job;
    narrow(near.buildings[0]);
    Calibrated other;
    add_results(job, result);
    add_results(near, other);
    result.record.simulations += other.record.simulations;
    if (best_score(near, other) < best_score(job, result))
        result.datasets = std::move(other.datasets);
}

/// What a stock does with a kind of study, beside what the kind does itself.
struct StockKind {
    const char* word;
    /// Values, errors and findings of a building from its datasets.
    void (*summarise)(const std::vector<Dataset>& datasets, const std::string& stage,
                      const Case& building, StockRecord& record);
    /// In place of the study, where there was a night before; nullptr = the study.
    void (*do_again)(job::Job& job, Calibrated& result);
    /// Simulations of a first calibration, about.
    double (*simulations)(const job::StudySpec& study);
};
constexpr StockKind stock_kinds[] = {
    {"screening", summarise_screening, screen_again,
     [](const job::StudySpec& study) {
         return static_cast<double>(study.as<calibration::ScreeningOptions>().n_points);
     }},
    {"posterior", summarise_posterior, nullptr,
     [](const job::StudySpec&) { return 500000.0; }},
    {"loop", summarise_loop, nullptr, [](const job::StudySpec&) { return 20000.0; }},
};

const StockKind& stock_kind_of(const job::StudySpec& study) {
    for (const StockKind& kind : stock_kinds)
        if (std::string_view(kind.word) == study.kind->word) return kind;
    throw std::logic_error(
        fmt::format("no stock has studies of kind {}", study.kind->word));
}

/// The best points are asked for, and looked at closely where whole results are kept.
void prepare(job::StudySpec& study, const job::StockOptions& stock) {
    auto* screening = std::any_cast<calibration::ScreeningOptions>(&study.options);
    if (screening == nullptr) return;
    screening->keep_points = true;
    screening->close_look = stock.keep_results;
}

void summarise(const job::Job& job, Calibrated& result) {
    const Case& building = job.buildings[0];
    add_values(building, result.record);
    stock_kind_of(job.studies[0])
        .summarise(result.datasets, stage_name(job.studies[0], building), building,
                   result.record);
}

}  // namespace

double usual_simulations(const job::StudySpec& study) {
    return stock_kind_of(study).simulations(study);
}

Calibrated calibrate(const job::Job& stock_job, const job::StockLine& line,
                     const StockRecord* before, std::vector<input::InputFile>& log) {
    input::InputFiles files;
    job::Job job;
    try {
        job = job::read_stock_building(stock_job, line, files);
    } catch (...) {
        log = files.log();
        throw;
    }
    log = files.log();
    const Case& building = job.buildings.at(0);
    if (before != nullptr) start_from(values_in(*before, building), job);
    prepare(job.studies[0], stock_job.stock->options);
    Calibrated result;
    result.record.findings = building.decisions;
    const auto do_again = stock_kind_of(job.studies[0]).do_again;
    if (before != nullptr && do_again != nullptr)
        do_again(job, result);
    else
        add_results(job, result);
    summarise(job, result);
    sketch(building, result.record);
    return result;
}

}  // namespace bemcal::stock
