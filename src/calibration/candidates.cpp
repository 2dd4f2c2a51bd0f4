/// Writes the nominal and the best point side by side: metrics and series of every meter
/// in every period, quantities by step, the outdoor temperature.
/// Follows from a close look at both (`PeriodModel::look`).
/// Which point is best is decided before; how sure it is, is not said.
#include "calibration/candidates.hpp"

#include "study/fit.hpp"

#include <iterator>
#include <string>
#include <utility>

namespace bemcal::calibration {
namespace {

/// [2][periods]
using Looks = std::vector<std::vector<study::CloseLook>>;

Looks look_at(const CandidateCase& plan, const Matrix& points) {
    Looks looks(2);
    for (std::size_t c = 0; c < 2; ++c) {
        looks[c].reserve(plan.models.size());
        for (std::size_t p = 0; p < plan.models.size(); ++p)
            looks[c].push_back(plan.models[p]->look(plan.building,
                                                    plan.building.periods[p],
                                                    points.row(c), plan.hourly_outputs));
    }
    return looks;
}

void add_fits(const CandidateCase& plan, const Looks& looks, const std::string& leaf,
              stats::FitMetrics study::MeterFit::* which,
              study::DatasetBuilder& datasets) {
    std::vector<double> values;
    for (const auto& periods : looks)
        for (const study::CloseLook& look : periods)
            for (const study::MeterSeries& series : look.meters)
                for (const study::FitNumber& number : study::fit_numbers)
                    values.push_back(series.fit.*which.*number.value);
    datasets.array(leaf, {"candidate", "period", "meter", "metric"},
                   {2, plan.models.size(), plan.building.meters.size(),
                    std::size(study::fit_numbers)},
                   std::move(values));
}

std::vector<double> joined(std::vector<double> one, const std::vector<double>& other) {
    one.insert(one.end(), other.begin(), other.end());
    return one;
}

void add_meter_series(const CandidateCase& plan, const Looks& looks, std::size_t p,
                      study::DatasetBuilder& datasets) {
    for (std::size_t m = 0; m < plan.building.meters.size(); ++m) {
        const study::MeterSeries &nominal = looks[0][p].meters[m],
                                 &best = looks[1][p].meters[m];
        const std::string folder =
            plan.building.periods[p].name + "/" + plan.building.meters[m].name + "/";
        datasets.times(folder + "time", nominal.begins);
        datasets.vector(folder + "measured", "time", nominal.measured);
        datasets.array(folder + "simulated", {"candidate", "time"},
                       {2, nominal.begins.size()},
                       joined(nominal.simulated, best.simulated));
    }
}

/// Quantities of both candidates by step, and always the outdoor temperature they were
/// simulated with, so that other models can be fitted from the result alone.
void add_hourly(const CandidateCase& plan, const Looks& looks, std::size_t p,
                study::DatasetBuilder& datasets) {
    const physics::Drive& drive = plan.models[p]->drive();
    const std::string folder = plan.building.periods[p].name + "/hourly/";
    std::vector<physics::Seconds> begins;
    for (int step = drive.n_warm_up; step < drive.n_steps(); ++step)
        begins.push_back(drive.axis.begin_of(step));
    const std::size_t n_steps = begins.size();
    datasets.times(folder + "time", begins);
    datasets.vector(folder + "outdoor_temperature", "time",
                    {drive.theta_e.begin() + drive.n_warm_up, drive.theta_e.end()});
    for (std::size_t q = 0; q < plan.hourly_outputs.size(); ++q)
        datasets.array(folder + physics::name_of(plan.hourly_outputs[q]),
                       {"candidate", "time"}, {2, n_steps},
                       joined(looks[0][p].hourly[q], looks[1][p].hourly[q]));
}

}  // namespace

void add_candidate_names(const study::Case& building, study::DatasetBuilder& datasets) {
    std::vector<std::string> meters, units, periods, metrics;
    for (const study::Meter& meter : building.meters) {
        meters.push_back(meter.name);
        units.emplace_back(physics::unit_of(meter.quantity));
    }
    for (const study::Period& period : building.periods) periods.push_back(period.name);
    for (const study::FitNumber& number : study::fit_numbers)
        metrics.emplace_back(number.name);
    datasets.texts("meter", "meter", std::move(meters));
    datasets.texts("meter_unit", "meter", std::move(units));
    datasets.texts("period", "period", std::move(periods));
    datasets.texts("candidate", "candidate", {"nominal", "best"});
    datasets.texts("metric", "metric", std::move(metrics));
}

void add_candidates(const CandidateCase& plan, const Matrix& points,
                    study::DatasetBuilder& datasets) {
    datasets.array("candidate_parameters", {"candidate", "parameter"}, {2, points.cols},
                   points.values);
    const Looks looks = look_at(plan, points);
    add_fits(plan, looks, "fit", &study::MeterFit::own, datasets);
    add_fits(plan, looks, "monthly_fit", &study::MeterFit::monthly, datasets);
    for (std::size_t p = 0; p < plan.models.size(); ++p) {
        add_meter_series(plan, looks, p, datasets);
        add_hourly(plan, looks, p, datasets);
    }
}

}  // namespace bemcal::calibration
