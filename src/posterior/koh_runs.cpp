/// Makes a simulator's runs, then the chains of a Kennedy-O'Hagan calibration, as one
/// stage. A run is a design of the calibrated inputs at a field point.
/// Source: paper 1, eq. 2, on scrambled Sobol points.
/// A design with a failed run is left out, so that the grid stays full. Runs from a file
/// are read by `read_koh`.
#include "posterior/koh_runs.hpp"

#include "base/nan.hpp"
#include "posterior/koh_posterior.hpp"
#include "stats/sobol_sequence.hpp"
#include "study/datasets.hpp"
#include "study/failures.hpp"
#include "study/points.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace bemcal::posterior {
namespace {

std::size_t parameter_number(const study::Simulator& simulator, const std::string& name) {
    const auto& parameters = simulator.parameters();
    const auto found = std::ranges::find(parameters, name, &physics::Parameter::name);
    if (found == parameters.end())
        throw std::invalid_argument(
            fmt::format("\"{}\" is no parameter of the simulator", name));
    return static_cast<std::size_t>(found - parameters.begin());
}

std::vector<std::size_t> parameter_numbers(const study::Simulator& simulator,
                                           const std::vector<std::string>& names) {
    std::vector<std::size_t> numbers;
    numbers.reserve(names.size());
    for (const std::string& name : names)
        numbers.push_back(parameter_number(simulator, name));
    return numbers;
}

std::vector<physics::Parameter> chosen(const std::vector<physics::Parameter>& all,
                                       const std::vector<std::size_t>& numbers) {
    std::vector<physics::Parameter> some;
    some.reserve(numbers.size());
    for (const std::size_t number : numbers) some.push_back(all[number]);
    return some;
}

/// The design, and all of its points at all field points.
class Design {
  public:
    Design(const KohOptions& options, const KohRuns& runs)
        : runs_(runs),
          x_(parameter_numbers(*runs.simulator, options.observations.x_names)),
          t_(parameter_numbers(*runs.simulator, options.observations.t_names)),
          field_(options.observations.measured_x),
          designs_(study::in_ranges(
              stats::scrambled_sobol_points(0, runs.n_designs,
                                            static_cast<int>(t_.size()), runs.seed),
              chosen(runs.simulator->parameters(), t_))) {}

    std::size_t n_field() const { return field_.rows; }
    std::size_t n_runs() const { return designs_.rows * field_.rows; }
    const Matrix& designs() const { return designs_; }
    bool failures_may_pass() const { return runs_.simulator->failures_may_pass(); }

    study::ItemAnswer run(std::size_t number) const {
        Matrix point = study::nominal_row(runs_.simulator->parameters());
        const auto t = designs_.row(number / n_field()),
                   x = field_.row(number % n_field());
        for (std::size_t k = 0; k < x.size(); ++k) point(0, x_[k]) = x[k];
        for (std::size_t k = 0; k < t.size(); ++k) point(0, t_[k]) = t[k];
        Matrix outputs;
        std::vector<std::string> failures;
        runs_.simulator->evaluate(point, outputs, failures);
        study::ItemAnswer answer;
        answer.values = {runs_.factor * outputs(0, runs_.output) + runs_.offset};
        answer.failures = study::failures_of_points(failures, number);
        return answer;
    }

    /// The same calibration with its runs, without designs that have a NaN.
    /// \param outputs  [n_runs]
    KohOptions with_runs(KohOptions options, std::span<const double> outputs) const {
        emulator::Observations& o = options.observations;
        o.simulated_x.cols = field_.cols;
        o.simulated_t.cols = designs_.cols;
        for (std::size_t d = 0; d < designs_.rows; ++d) {
            const auto of_design = outputs.subspan(d * n_field(), n_field());
            if (std::ranges::any_of(of_design, [](double y) { return std::isnan(y); }))
                continue;
            for (std::size_t p = 0; p < n_field(); ++p) {
                o.simulated.push_back(of_design[p]);
                o.simulated_x.add_row(field_.row(p));
                o.simulated_t.add_row(designs_.row(d));
            }
        }
        return options;
    }

  private:
    KohRuns runs_;
    std::vector<std::size_t> x_, t_;  ///< numbers of the simulator's parameters
    Matrix field_;                    ///< [n x p]
    Matrix designs_;                  ///< [designs x q]
};

class KohRunsStage : public study::Stage {
  public:
    KohRunsStage(std::string name, KohOptions options, const KohRuns& runs)
        : name_(std::move(name)), options_(std::move(options)), design_(options_, runs) {}

    std::string name() const override { return name_; }
    int n_items() const override { return static_cast<int>(design_.n_runs()); }
    long long n_simulations() const override {
        return static_cast<long long>(design_.n_runs());
    }
    bool has_rounds() const override { return true; }
    const char* items_are() const override { return chains_ ? "items" : "runs"; }
    study::Activity activity() const override {
        return chains_ ? chains_->activity() : study::Activity{};
    }
    std::size_t answer_bytes() const override { return sizeof(double); }
    study::ItemAnswer run(int item) const override {
        if (item < n_items()) return design_.run(static_cast<std::size_t>(item));
        return chains_->run(item - n_items());
    }
    std::optional<study::Round> next_round(
        const std::vector<study::ItemAnswer>& answers) const override {
        if (chains_) return chains_->next_round(of_chains(answers));
        std::vector<double> outputs = outputs_of(answers);
        if (!problem_with(outputs).empty()) return std::nullopt;
        return study::Round{make_chains(outputs)->n_items(), std::move(outputs)};
    }
    void begin_round(int first_item, const study::Round& round) override {
        if (chains_)
            chains_->begin_round(first_item - n_items(), round);
        else
            chains_ = make_chains(round.needed);
    }
    study::Conclusion conclude(
        const std::vector<study::ItemAnswer>& answers) const override {
        study::Conclusion conclusion;
        if (chains_) conclusion = chains_->conclude(of_chains(answers));
        study::DatasetBuilder more(name_);
        if (!chains_) more.kind(koh_kind);
        add_runs(answers, more);
        std::ranges::move(more.take(), std::back_inserter(conclusion.datasets));
        return conclusion;
    }
    bool failures_may_pass() const override { return design_.failures_may_pass(); }
    std::string shortfall(const std::vector<study::ItemAnswer>& answers) const override {
        if (chains_) return chains_->shortfall(of_chains(answers));
        return problem_with(outputs_of(answers));
    }

  private:
    std::unique_ptr<study::Stage> make_chains(std::span<const double> outputs) const {
        return make_koh_stage(name_, design_.with_runs(options_, outputs));
    }
    std::vector<study::ItemAnswer> of_chains(
        const std::vector<study::ItemAnswer>& answers) const {
        return {answers.begin() + n_items(), answers.end()};
    }
    /// [n_runs]; NaN = failed
    std::vector<double> outputs_of(const std::vector<study::ItemAnswer>& answers) const {
        std::vector<double> outputs(design_.n_runs(), nan);
        for (std::size_t k = 0; k < outputs.size(); ++k)
            if (!answers[k].values.empty()) outputs[k] = answers[k].values[0];
        return outputs;
    }
    /// Why nothing can be learned from the runs; "" where it can.
    std::string problem_with(std::span<const double> outputs) const {
        const KohOptions options = design_.with_runs(options_, outputs);
        const std::size_t n = options.observations.simulated.size() /
                              std::max<std::size_t>(1, design_.n_field());
        if (n < 2)
            return fmt::format(
                "{} of {} designs have all of their runs; at least 2 are "
                "needed",
                n, design_.designs().rows);
        try {
            make_koh_posterior(options);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return {};
    }
    void add_runs(const std::vector<study::ItemAnswer>& answers,
                  study::DatasetBuilder& datasets) const {
        const std::size_t n = design_.designs().rows;
        datasets.texts("calibrated_input", "calibrated_input",
                       options_.observations.t_names);
        datasets.array("design_values", {"design", "calibrated_input"},
                       {n, design_.designs().cols}, design_.designs().values);
        datasets.array("design_run", {"design", "field_point"}, {n, design_.n_field()},
                       outputs_of(answers), options_.output_unit);
        std::vector<study::Failure> failures;
        for (std::size_t k = 0; k < design_.n_runs(); ++k)
            study::append_failures(answers[k], {k, 1}, failures);
        datasets.failures(failures);
    }

    std::string name_;
    KohOptions options_;
    Design design_;
    std::unique_ptr<study::Stage> chains_;  ///< once the runs are there
};

}  // namespace

std::vector<study::Coordinate> simulator_coordinates(
    const study::Simulator& simulator, const std::vector<std::string>& names) {
    std::vector<study::Coordinate> made;
    made.reserve(names.size());
    for (const std::size_t number : parameter_numbers(simulator, names)) {
        const physics::Parameter& parameter = simulator.parameters()[number];
        made.push_back({parameter.name, parameter.unit,
                        stats::uniform_prior(parameter.least, parameter.most)});
    }
    return made;
}

std::unique_ptr<study::Stage> make_koh_stage_with_runs(std::string name,
                                                       KohOptions options,
                                                       const KohRuns& runs) {
    return std::make_unique<KohRunsStage>(std::move(name), std::move(options), runs);
}

}  // namespace bemcal::posterior
