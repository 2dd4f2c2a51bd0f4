/// Runs of a simulator at Sobol points; of each output a Gaussian process over the
/// parameters; then a study that asks these.
/// Source: O'Hagan 2006, Reliability Engineering and System Safety 91, for studies on an
/// emulator in place of the code.
/// The emulator's own error is told and goes no further: an index or a best point is that
/// of its means. A run that fails is told and left out. No run is made where a study
/// ends.
#include "study/emulated_study.hpp"

#include "emulator/series_emulator.hpp"
#include "stats/sobol_sequence.hpp"
#include "study/failures.hpp"
#include "study/points.hpp"
#include "study/simulator_run.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace bemcal::study {
namespace {

using emulator::SeriesEmulator;

/// Runs that did not fail.
struct UsedRuns {
    Matrix points;   ///< [runs x parameters] on the scale 0 to 1
    Matrix outputs;  ///< [runs x outputs]
};

Matrix column_of(const Matrix& matrix, std::size_t column) {
    Matrix values(matrix.rows, 1);
    for (std::size_t r = 0; r < matrix.rows; ++r) values(r, 0) = matrix(r, column);
    return values;
}

double deviation_of(const Matrix& column) {
    double sum = 0, squares = 0;
    const auto n = static_cast<double>(column.rows);
    for (const double value : column.values) sum += value;
    for (const double value : column.values)
        squares += (value - sum / n) * (value - sum / n);
    return std::sqrt(squares / n);
}

/// A simulator's outputs as its runs have them.
class EmulatedSimulator : public Simulator {
  public:
    EmulatedSimulator(std::shared_ptr<const Simulator> simulator, const UsedRuns& runs)
        : simulator_(std::move(simulator)) {
        for (std::size_t c = 0; c < runs.outputs.cols; ++c) {
            Matrix column = column_of(runs.outputs, c);
            const double deviation = deviation_of(column);
            first_.push_back(column(0, 0));
            if (deviation > 0)
                emulators_.emplace_back(std::in_place, runs.points, std::move(column),
                                        std::vector<double>{1 / deviation});
            else
                emulators_.emplace_back();
        }
    }

    const std::vector<physics::Parameter>& parameters() const override {
        return simulator_->parameters();
    }
    const std::vector<Output>& outputs() const override { return simulator_->outputs(); }

    void evaluate(const Matrix& points, Matrix& answers,
                  std::vector<std::string>& failures) const override {
        answers = Matrix(points.rows, outputs().size());
        failures.assign(points.rows, {});
        for (std::size_t r = 0; r < points.rows; ++r) {
            const std::vector<double> point = on_scale(points.row(r));
            for (std::size_t c = 0; c < emulators_.size(); ++c) {
                const std::optional<SeriesEmulator>& one = emulators_[c];
                answers(r, c) = one ? one->predict(point)[0] : first_[c];
            }
        }
    }

    /// At runs that were left out, in % of the output's mean size. [outputs]
    std::vector<double> errors() const {
        const emulator::ChannelRange whole[] = {{0, 1}};
        std::vector<double> errors;
        errors.reserve(emulators_.size());
        for (const auto& one : emulators_)
            errors.push_back(one ? one->leave_one_out(whole)[0] : 0);
        return errors;
    }

  private:
    std::vector<double> on_scale(std::span<const double> values) const {
        std::vector<double> point(values.size());
        for (std::size_t k = 0; k < point.size(); ++k) {
            const physics::Parameter& of = parameters()[k];
            point[k] =
                std::clamp((values[k] - of.least) / (of.most - of.least), 0.0, 1.0);
        }
        return point;
    }

    std::shared_ptr<const Simulator> simulator_;
    std::vector<std::optional<SeriesEmulator>> emulators_;  ///< none: always the same
    std::vector<double> first_;                             ///< output of the first run
};

class EmulatedStudy : public Stage {
  public:
    EmulatedStudy(std::string name, std::shared_ptr<const Simulator> simulator,
                  int n_runs, std::uint64_t seed, StudyOf study)
        : name_(std::move(name)),
          simulator_(std::move(simulator)),
          n_runs_(n_runs),
          study_(std::move(study)),
          points_(stats::scrambled_sobol_points(
              0, static_cast<std::size_t>(n_runs),
              static_cast<int>(simulator_->parameters().size()), seed)) {
        if (n_runs < 2 * least_runs())
            throw std::invalid_argument(fmt::format(
                "runs = {} are too few for {} parameters; expected {} or more", n_runs,
                points_.cols, 2 * least_runs()));
        study_(simulator_);  // or it throws: what it names is not there
    }

    std::string name() const override { return name_; }
    int n_items() const override { return n_runs_; }
    long long n_simulations() const override { return n_runs_; }
    const char* counts() const override { return "runs"; }
    bool has_rounds() const override { return true; }
    const char* items_are() const override {
        return inner_ ? inner_->items_are() : "runs";
    }
    std::size_t answer_bytes() const override {
        return sizeof(double) * simulator_->outputs().size();
    }
    bool failures_may_pass() const override { return simulator_->failures_may_pass(); }
    Activity activity() const override {
        return inner_ ? inner_->activity() : Activity{};
    }

    ItemAnswer run(int item) const override {
        if (item >= n_runs_) return inner_->run(item - n_runs_);
        Matrix outputs;
        std::vector<std::string> failures;
        const auto row = static_cast<std::size_t>(item);
        simulator_->evaluate(
            in_ranges(part_of(points_, row, 1), simulator_->parameters()), outputs,
            failures);
        return {outputs.values, failures_of_points(failures, item), {}};
    }

    std::optional<Round> next_round(
        const std::vector<ItemAnswer>& answers) const override {
        if (inner_) return inner_->next_round(of_inner(answers));
        const UsedRuns used = used_of(answers);
        if (!are_enough(used)) return std::nullopt;
        Round round;
        round.n_items = study_(emulated(used))->n_items();
        round.needed.push_back(static_cast<double>(used.points.rows));
        for (const Matrix* matrix : {&used.points, &used.outputs})
            round.needed.insert(round.needed.end(), matrix->values.begin(),
                                matrix->values.end());
        return round;
    }

    void begin_round(int first_item, const Round& round) override {
        if (inner_) return inner_->begin_round(first_item - n_runs_, round);
        const auto n = static_cast<std::size_t>(round.needed[0]);
        UsedRuns used{Matrix(n, points_.cols), Matrix(n, simulator_->outputs().size())};
        auto at = round.needed.begin() + 1;
        for (Matrix* matrix : {&used.points, &used.outputs})
            for (double& value : matrix->values) value = *at++;
        inner_ = study_(emulated(used));
    }

    Conclusion conclude(const std::vector<ItemAnswer>& answers) const override {
        Conclusion conclusion;
        if (inner_) conclusion = inner_->conclude(of_inner(answers));
        DatasetBuilder more(name_);
        add_runs(answers, more);
        std::ranges::move(more.take(), std::back_inserter(conclusion.datasets));
        return conclusion;
    }

    std::string shortfall(const std::vector<ItemAnswer>& answers) const override {
        if (inner_) return inner_->shortfall(of_inner(answers));
        return "too few runs of the simulator succeeded for an emulator";
    }

  private:
    int least_runs() const {
        return static_cast<int>(emulator::least_runs(points_.cols));
    }
    bool are_enough(const UsedRuns& used) const {
        return static_cast<int>(used.points.rows) >= least_runs();
    }
    std::shared_ptr<const EmulatedSimulator> emulated(const UsedRuns& used) const {
        return std::make_shared<const EmulatedSimulator>(simulator_, used);
    }

    static bool has_failed(const ItemAnswer& answer) {
        return !answer.error.empty() || !answer.failures.empty();
    }
    static std::string failure_of(const ItemAnswer& answer) {
        if (!answer.error.empty()) return answer.error;
        return answer.failures.empty() ? "" : answer.failures[0].reason;
    }

    UsedRuns used_of(const std::vector<ItemAnswer>& answers) const {
        UsedRuns used{Matrix(0, points_.cols), Matrix(0, simulator_->outputs().size())};
        for (std::size_t k = 0; k < static_cast<std::size_t>(n_runs_); ++k) {
            if (has_failed(answers[k])) continue;
            const auto point = points_.row(k);
            used.points.values.insert(used.points.values.end(), point.begin(),
                                      point.end());
            used.outputs.values.insert(used.outputs.values.end(),
                                       answers[k].values.begin(),
                                       answers[k].values.end());
            ++used.points.rows;
            ++used.outputs.rows;
        }
        return used;
    }

    std::vector<ItemAnswer> of_inner(const std::vector<ItemAnswer>& answers) const {
        return {answers.begin() + n_runs_, answers.end()};
    }

    void add_runs(const std::vector<ItemAnswer>& answers,
                  DatasetBuilder& datasets) const {
        MadeRuns made{std::vector<std::string>(points_.rows, "design"),
                      {},
                      in_ranges(points_, simulator_->parameters()).values};
        for (std::size_t k = 0; k < points_.rows; ++k)
            made.failures.push_back(failure_of(answers[k]));
        add_made_runs(simulator_->parameters(), std::move(made), datasets);
        add_errors(used_of(answers), datasets);
    }

    void add_errors(const UsedRuns& used, DatasetBuilder& datasets) const {
        if (!are_enough(used)) return;
        std::vector<std::string> names;
        names.reserve(simulator_->outputs().size());
        for (const Output& output : simulator_->outputs()) names.push_back(output.name);
        datasets.texts("simulator_channel", "simulator_channel", std::move(names));
        datasets.vector("simulator_emulator_error", "simulator_channel",
                        emulated(used)->errors());
    }

    std::string name_;
    std::shared_ptr<const Simulator> simulator_;
    int n_runs_;
    StudyOf study_;
    Matrix points_;                 ///< [runs x parameters] on the scale 0 to 1
    std::unique_ptr<Stage> inner_;  ///< once the runs are there
};

}  // namespace

std::unique_ptr<Stage> make_emulated_study(std::string name,
                                           std::shared_ptr<const Simulator> simulator,
                                           int n_runs, std::uint64_t seed,
                                           StudyOf study) {
    return std::make_unique<EmulatedStudy>(std::move(name), std::move(simulator), n_runs,
                                           seed, std::move(study));
}

}  // namespace bemcal::study
