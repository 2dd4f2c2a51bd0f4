/// Says for `check` what a stock will cost: every building is read, broken ones and
/// findings are named (50 lines at most), simulations and time added up.
/// Follows from `cost_of_buildings` of each building; `stock_cost` takes the first
/// readable one for all. Counts every building as due, without the night's budget or the
/// time of reading.
#include "plan/stock_text.hpp"

#include "base/error.hpp"
#include "input/input_files.hpp"
#include "job/stock.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::plan {

namespace {

constexpr int most_shown = 50;

struct Sums {
    int n_broken = 0, n_findings = 0, n_lines_shown = 0;
    double simulations = 0, seconds = 0;
    std::string text;

    void show(const std::string& line) {
        if (++n_lines_shown <= most_shown) text += line;
    }
};

void add_building(const job::Job& job, const job::StockLine& line, Sums& sums) {
    try {
        input::InputFiles files;
        const job::Job one = job::read_stock_building(job, line, files);
        const PlanCost cost = cost_of_buildings(one);
        sums.simulations += cost.simulations;
        sums.seconds += cost.core_seconds;
        for (const study::DataDecision& decision : one.buildings[0].decisions) {
            ++sums.n_findings;
            sums.show(fmt::format("  {}, {}: {}: {}\n", line.name, decision.series,
                                  decision.finding, decision.action));
        }
    } catch (const std::exception& error) {
        ++sums.n_broken;
        sums.show(fmt::format("  {}: BROKEN: {}\n", line.name, error.what()));
    }
}

}  // namespace

std::string stock_plan_text(const job::Job& job, int cores) {
    Sums sums;
    for (const job::StockLine& line : job.stock->lines) add_building(job, line, sums);
    std::string text = fmt::format(
        "{}: a stock of {} buildings, {}; broken: {}, findings in data: {}\n", job.name,
        job.stock->lines.size(), job.studies[0].name, sums.n_broken, sums.n_findings);
    text += sums.text;
    if (sums.n_lines_shown > most_shown)
        text += fmt::format("  and {} more lines\n", sums.n_lines_shown - most_shown);
    const int n = std::max(cores, 1);
    return text + fmt::format(
                      "\nsimulations: {:.0f} if all are due; weathers: {}\n"
                      "time:   about {:.0f} s on {} core{}, by rough costs of a step, "
                      "without the reading\n",
                      sums.simulations, job.stock->weathers->n_read(),
                      std::ceil(sums.seconds / n), n, n > 1 ? "s" : "");
}

PlanCost stock_cost(const job::Job& job) {
    const auto n = static_cast<double>(job.stock->lines.size());
    for (const job::StockLine& line : job.stock->lines) {
        try {
            input::InputFiles files;
            const PlanCost one =
                cost_of_buildings(job::read_stock_building(job, line, files));
            return {n,
                    n * one.simulations,
                    n * 4096,
                    one.data_bytes,
                    n * one.core_seconds,
                    one.working_bytes};
        } catch (const std::exception&) {
            continue;  // another one tells
        }
    }
    throw UserError(ExitCode::data, job.file.string() + ": no building can be read");
}

}  // namespace bemcal::plan
