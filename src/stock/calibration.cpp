/// Works on one building of a stock: reads it, runs all rounds of its study, takes
/// values, errors and findings from its summary. A night starts from the last one's.
/// Follows from `study::Summary`.
/// Drift is judged by `find_drift`. Which are due is decided by the stock's stage.
#include "stock/calibration.hpp"

#include "base/error.hpp"
#include "base/hash.hpp"
#include "base/machine.hpp"
#include "calibration/screening.hpp"
#include "input/input_files.hpp"
#include "job/kind.hpp"
#include "job/model_range.hpp"
#include "job/stages.hpp"
#include "loop/loop.hpp"
#include "loop/options.hpp"

#include <algorithm>
#include <any>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace bemcal::stock {

namespace {

using study::Case;
using study::ItemAnswer;
using study::Stage;

constexpr int sketch_days = 180;
constexpr const char* doubtful = "calibrated all the same: its values are doubtful";

/// All rounds of a stage. A failed item keeps its reason.
std::vector<ItemAnswer> answers_of(Stage& stage) {
    std::vector<ItemAnswer> answers;
    for (int first = 0, count = stage.n_items();;) {
        for (int item = first; item < first + count; ++item) {
            answers.emplace_back();
            try {
                answers.back() = stage.run(item);
            } catch (const std::exception& error) {
                rethrow_unless_answer(error);
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

/// The errors, beside the sum and number of the readings of the period.
StockRecord::Fit fit_with_readings(const Case& building, const study::FoundFit& found) {
    const study::Meter& meter = building.meters[found.meter];
    const study::Period& period = building.periods[found.period];
    StockRecord::Fit fit;
    fit.meter = meter.name;
    fit.unit = physics::unit_of(meter.quantity);
    fit.period = period.name;
    fit.before = found.before;
    fit.cv_rmse = found.cv_rmse;
    fit.nmbe = found.nmbe;
    for (int k = 0; k < meter.axis.n_steps; ++k) {
        const auto begin = meter.axis.begin_of(k);
        const double value = meter.values[static_cast<std::size_t>(k)];
        if (begin < period.from || begin >= period.to || std::isnan(value)) continue;
        fit.n += 1;
        fit.measured += value;
    }
    return fit;
}

/// What was not calibrated stays nominal, anywhere in its range.
void add_values(const Case& building, const study::Summary& summary,
                StockRecord& record) {
    for (const physics::Parameter& parameter : building.parameters) {
        study::FoundValue all{parameter.name, parameter.nominal, parameter.least,
                              parameter.most};
        const study::FoundValue* found = study::find_value(summary, parameter.name);
        const auto& [name, value, low, high] = found != nullptr ? *found : all;
        record.values.push_back(
            {name, parameter.unit, parameter.least, parameter.most, value, low, high, 0});
    }
}

/// Of the one study of the one building.
study::Conclusion run_study(const job::Job& job, double& simulations) {
    const std::unique_ptr<Stage> stage = std::move(job::make_plan(job).at(0));
    const auto answers = answers_of(*stage);
    for (const ItemAnswer& answer : answers)
        if (!answer.error.empty()) throw std::runtime_error(answer.error);
    simulations += static_cast<double>(stage->n_simulations());
    return stage->conclude(answers);
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
study::Conclusion screen_again(job::Job& job, double& simulations) {
    std::size_t& n_points = job.studies[0].as<calibration::ScreeningOptions>().n_points;
    n_points = std::max<std::size_t>(n_points / 2, 1);
    job::Job near = job;
    narrow(near.buildings[0]);
    study::Conclusion anywhere = run_study(job, simulations);
    study::Conclusion nearby = run_study(near, simulations);
    const bool is_better = nearby.summaries.at(0).score < anywhere.summaries.at(0).score;
    return is_better ? std::move(nearby) : std::move(anywhere);
}

/// What a stock does with a kind of study, beside what the kind does itself.
struct StockKind {
    const char* word;
    /// In place of the study, where there was a night before; nullptr = the study.
    study::Conclusion (*do_again)(job::Job& job, double& simulations);
    /// Simulations of a first calibration, about.
    double (*simulations)(const job::StudySpec& study);
};
constexpr StockKind stock_kinds[] = {
    {"screening", screen_again,
     [](const job::StudySpec& study) {
         return static_cast<double>(study.as<calibration::ScreeningOptions>().n_points);
     }},
    {"posterior", nullptr, [](const job::StudySpec&) { return 500000.0; }},
    {"loop", nullptr,
     [](const job::StudySpec&) { return double(loop::usual_simulations); }},
};

const StockKind& stock_kind_of(const job::StudySpec& study) {
    for (const StockKind& kind : stock_kinds)
        if (std::string_view(kind.word) == study.kind->word) return kind;
    throw std::logic_error(
        fmt::format("no stock has studies of kind {}", study.kind->word));
}

/// What a stock asks beside: of a loop what its buildings share, of a screening the best
/// points, looked at closely where whole results are kept.
void prepare(job::StudySpec& study, const job::StockOptions& stock) {
    if (auto* loop = std::any_cast<loop::LoopOptions>(&study.options))
        loop->compares_place = true;
    auto* screening = std::any_cast<calibration::ScreeningOptions>(&study.options);
    if (screening == nullptr) return;
    screening->keep_points = true;
    screening->close_look = stock.keep_results;
}

void summarise(const Case& building, const study::Summary& summary, StockRecord& record) {
    if (!summary.failure.empty()) throw std::runtime_error(summary.failure);
    add_values(building, summary, record);
    for (const study::FoundFit& fit : summary.fits)
        record.fits.push_back(fit_with_readings(building, fit));
    record.findings.insert(record.findings.end(), summary.findings.begin(),
                           summary.findings.end());
    if (!summary.shortfall.empty())
        record.findings.push_back({"fit", summary.shortfall, doubtful});
}

/// \param effect  its place, as of StockRecord::Name
void note_names(const std::vector<study::PossibleName>& names, double effect,
                StockRecord& record) {
    for (const study::PossibleName& one : names)
        record.names.push_back({effect, one.name, one.probability});
}

/// Of a loop, what the next nights test: effects one by one, the rest of the model as a
/// whole.
void adopt(const Case& building, const study::Summary& summary, StockRecord& record) {
    for (const study::FoundPart& part : summary.parts) {
        if (part.effect.empty())
            record.adopted += part.section;
        else {
            note_names(part.names, static_cast<double>(record.effects.size()), record);
            record.effects.push_back({part.effect, part.unit, "new", part.section,
                                      part.coefficient, part.least, part.most});
        }
    }
    note_names(summary.undecided, of_what_did_not_join, record);
    record.of_the_place = summary.of_the_place;
    const study::Period& known = building.periods.front();
    record.known_from = static_cast<double>(known.from.time_since_epoch().count());
    record.known_to = static_cast<double>(known.to.time_since_epoch().count());
    record.searches = 1;
}

/// Meters that the model cannot reach, whatever is calibrated.
void find_unreached(const job::Job& job, StockRecord& record) {
    const Case& building = job.buildings.at(0);
    for (const auto& [range, beyond] : job::fitted_ranges(job, building))
        if (!beyond.empty())
            record.findings.push_back(
                {building.meters[range.meter].name, beyond, doubtful});
}

}  // namespace

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

void start_from(const std::map<std::string, double>& values, Case& building) {
    for (physics::Parameter& parameter : building.parameters)
        if (const auto found = values.find(parameter.name); found != values.end())
            physics::set_nominal(found->second, parameter, building.building);
}

void sketch(const Case& building, StockRecord& record) {
    for (const study::Meter& meter : building.meters) {
        const bool daily =
            meter.axis.step_s <= 3600 && physics::day_s % meter.axis.step_s == 0;
        if (!daily || physics::is_temperature(meter.quantity)) continue;
        const int per_day = physics::day_s / meter.axis.step_s;
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
                           ? nan
                           : meter.values[static_cast<std::size_t>(step)];
            }
            record.daily.push_back(static_cast<float>(sum));
        }
        return;
    }
}

std::string hash_of_data(const Case& building) {
    const physics::Seconds from = building.periods.front().from,
                           to = building.periods.back().to;
    Hasher hasher;
    const auto add = [&](const std::vector<double>& values,
                         const physics::TimeAxis& axis) {
        if (values.empty()) return;
        const int first = std::clamp(axis.step_of(from), 0, axis.n_steps),
                  last = std::clamp(axis.step_of(to), first, axis.n_steps);
        hasher.add(std::span(values).subspan(static_cast<std::size_t>(first),
                                             static_cast<std::size_t>(last - first)));
    };
    for (const study::Meter& meter : building.meters) add(meter.values, meter.axis);
    for (const physics::Profile& profile : building.profiles) {
        if (profile.is_series) add(profile.values, profile.axis);
        if (!profile.schedule.days) continue;
        for (const auto& [day, number] : *profile.schedule.days) {
            const double of_register[] = {
                static_cast<double>(day.time_since_epoch().count()), number};
            hasher.add(of_register);
        }
    }
    const physics::Weather& weather = building.weather;
    for (const auto* values :
         {&weather.theta_e, &weather.direct_normal, &weather.diffuse_horizontal,
          &weather.global_horizontal, &weather.wind_speed, &weather.relative_humidity,
          &weather.cloud_cover, &weather.infrared})
        add(*values, weather.axis);
    for (const physics::Seconds time : {from, to})
        hasher.add(std::string_view(physics::format_time(time)));
    return hasher.hex();
}

double usual_simulations(const job::StudySpec& study) {
    return stock_kind_of(study).simulations(study);
}

job::Job read_building(const job::Job& stock_job, const job::StockLine& line,
                       std::vector<input::InputFile>& log, const job::Adopted* adopted) {
    input::InputFiles files;
    try {
        job::Job job = job::read_stock_building(stock_job, line, files, adopted);
        log = files.log();
        return job;
    } catch (...) {
        log = files.log();
        throw;
    }
}

Calibrated calibrate(const job::Job& stock_job, const job::StockLine& line,
                     const StockRecord* before, std::vector<input::InputFile>& log,
                     const job::Adopted* window) {
    job::Job job = read_building(stock_job, line, log, window);
    const Case& building = job.buildings.at(0);
    if (before != nullptr) {
        const auto values = values_in(*before, building);
        start_from(values, job.buildings[0]);
        if (auto* loop = std::any_cast<loop::LoopOptions>(&job.studies[0].options))
            loop->start = values;
    }
    prepare(job.studies[0], stock_job.stock->options);
    Calibrated result;
    result.record.findings = building.decisions;
    find_unreached(job, result.record);
    const auto do_again = stock_kind_of(job.studies[0]).do_again;
    const bool goes_on = before != nullptr && do_again != nullptr;
    result.conclusion = goes_on ? do_again(job, result.record.simulations)
                                : run_study(job, result.record.simulations);
    summarise(building, result.conclusion.summaries.at(0), result.record);
    const auto* loop = std::any_cast<loop::LoopOptions>(&job.studies[0].options);
    if (loop != nullptr && loop->period.empty())
        adopt(building, result.conclusion.summaries[0], result.record);
    result.record.data_hash = hash_of_data(building);
    sketch(building, result.record);
    return result;
}

}  // namespace bemcal::stock
