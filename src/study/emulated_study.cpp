/// Runs of a simulator at Sobol points; of each output a Gaussian process over the
/// parameters; then a study that asks these.
/// Source: O'Hagan 2006, Reliability Engineering and System Safety 91, for studies on an
/// emulator in place of the code.
/// The emulator's own error is told and goes no further: an index or a best point is that
/// of its means. Where the study ends at a point, the simulator is run there once. A run
/// that fails is told and left out.
#include "study/emulated_study.hpp"

#include "emulator/series_emulator.hpp"
#include "stats/sobol_sequence.hpp"
#include "study/failures.hpp"
#include "study/packed_matrix.hpp"
#include "study/points.hpp"
#include "study/simulator_run.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace bemcal::study {
namespace {

using emulator::SeriesEmulator;

/// What the items of a round are, as its first number.
enum class Part { study, best_run };

/// Runs that did not fail.
struct UsedRuns {
    Matrix points;   ///< [runs x parameters] on the scale 0 to 1
    Matrix outputs;  ///< [runs x outputs]
};

/// A simulator's outputs as its runs have them.
class EmulatedSimulator : public Simulator {
  public:
    EmulatedSimulator(std::shared_ptr<const Simulator> simulator, const UsedRuns& runs)
        : simulator_(std::move(simulator)) {
        constexpr double weight[] = {1};  // of one number it does not matter
        for (std::size_t c = 0; c < runs.outputs.cols; ++c) {
            Matrix column(runs.outputs.rows, 1);
            column.values = runs.outputs.column(c);
            emulators_.emplace_back(runs.points, std::move(column), weight);
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
            const std::vector<double> point = scaled(points.row(r));
            for (std::size_t c = 0; c < emulators_.size(); ++c)
                answers(r, c) = emulators_[c].predict(point)[0];
        }
    }

    /// At runs that were left out, in % of the output's mean size. [outputs]
    std::vector<double> errors() const {
        const emulator::ChannelRange whole[] = {{0, 1}};
        std::vector<double> errors;
        errors.reserve(emulators_.size());
        for (const SeriesEmulator& one : emulators_)
            errors.push_back(one.leave_one_out(whole)[0]);
        return errors;
    }

  private:
    std::vector<double> scaled(std::span<const double> values) const {
        std::vector<double> point(values.size());
        for (std::size_t k = 0; k < point.size(); ++k)
            point[k] = std::clamp(study::on_scale(values[k], parameters()[k]), 0.0, 1.0);
        return point;
    }

    std::shared_ptr<const Simulator> simulator_;
    std::vector<SeriesEmulator> emulators_;  ///< [outputs]
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
        if (n_runs < least_runs_of_study(points_.cols))
            throw std::invalid_argument(fmt::format(
                "runs = {} are too few for {} parameters; expected {} or more", n_runs,
                points_.cols, least_runs_of_study(points_.cols)));
        // Before there are runs: how many items it has, and whether what it names is
        // there.
        n_inner_items_ = study_(emulated({}))->n_items();
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
        if (item < n_runs_)
            return run_at(in_ranges(part_of(points_, static_cast<std::size_t>(item), 1),
                                    simulator_->parameters()),
                          item);
        return item == best_item_ ? run_at(best_, item) : inner_->run(item - n_runs_);
    }

    std::optional<Round> next_round(
        const std::vector<ItemAnswer>& answers) const override {
        if (best_item_ > 0) return std::nullopt;
        if (inner_) return next_of_study(of_inner(answers));
        const UsedRuns used = used_of(answers);
        if (!are_enough(used)) return std::nullopt;
        Round round;
        round.n_items = n_inner_items_;
        pack(used.points, round.needed);
        pack(used.outputs, round.needed);
        return round;
    }

    void begin_round(int first_item, const Round& round) override {
        if (inner_) return begin_round_of_study(first_item, round);
        std::span<const double> packed = round.needed;
        UsedRuns used;
        used.points = take_matrix(packed);
        used.outputs = take_matrix(packed);
        emulated_ = emulated(used);
        inner_ = study_(emulated_);
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
    ItemAnswer run_at(const Matrix& point, int item) const {
        Matrix outputs;
        std::vector<std::string> failures;
        simulator_->evaluate(point, outputs, failures);
        return {outputs.values, failures_of_points(failures, item), {}};
    }

    /// The study's own, then the run at its best point.
    std::optional<Round> next_of_study(const std::vector<ItemAnswer>& answers) const {
        Part part = Part::study;
        auto round = inner_->next_round(answers);
        if (!round) {
            part = Part::best_run;
            round = Round{1, inner_->best_point(answers)};
            if (round->needed.empty()) return std::nullopt;
        }
        round->needed.insert(round->needed.begin(), static_cast<double>(part));
        return round;
    }
    void begin_round_of_study(int first_item, Round round) {
        const bool is_best_run =
            round.needed.at(0) == static_cast<double>(Part::best_run);
        round.needed.erase(round.needed.begin());
        if (!is_best_run) return inner_->begin_round(first_item - n_runs_, round);
        best_item_ = first_item;
        best_ = Matrix(1, round.needed.size());
        best_.values = std::move(round.needed);
    }

    bool are_enough(const UsedRuns& used) const {
        return used.points.rows >= emulator::least_runs(points_.cols);
    }
    std::shared_ptr<const EmulatedSimulator> emulated(const UsedRuns& used) const {
        return std::make_shared<const EmulatedSimulator>(simulator_, used);
    }

    static std::string failure_of(const ItemAnswer& answer) {
        if (!answer.error.empty()) return answer.error;
        return answer.failures.empty() ? "" : answer.failures[0].reason;
    }

    UsedRuns used_of(const std::vector<ItemAnswer>& answers) const {
        UsedRuns used;
        for (std::size_t k = 0; k < static_cast<std::size_t>(n_runs_); ++k) {
            if (!failure_of(answers[k]).empty()) continue;
            used.points.add_row(points_.row(k));
            used.outputs.add_row(answers[k].values);
        }
        return used;
    }

    std::vector<ItemAnswer> of_inner(const std::vector<ItemAnswer>& answers) const {
        return {answers.begin() + n_runs_,
                best_item_ > 0 ? answers.begin() + best_item_ : answers.end()};
    }

    void add_runs(const std::vector<ItemAnswer>& answers,
                  DatasetBuilder& datasets) const {
        MadeRuns made{std::vector<std::string>(points_.rows, "design"),
                      {},
                      in_ranges(points_, simulator_->parameters()).values};
        for (std::size_t k = 0; k < points_.rows; ++k)
            made.failures.push_back(failure_of(answers[k]));
        const auto best = static_cast<std::size_t>(best_item_);
        if (best > 0 && best < answers.size()) {
            made.of.emplace_back("best point");
            made.failures.push_back(failure_of(answers[best]));
            made.values.insert(made.values.end(), best_.values.begin(),
                               best_.values.end());
            if (made.failures.back().empty()) add_best_run(answers[best], datasets);
        }
        add_made_runs(simulator_->parameters(), std::move(made), datasets);
        if (inner_) add_errors(datasets);
    }

    /// What the simulator says there, beside the emulator.
    void add_best_run(const ItemAnswer& answer, DatasetBuilder& datasets) const {
        std::vector<std::string> names, units;
        for (const Output& output : simulator_->outputs()) {
            names.push_back(output.name);
            units.push_back(output.unit);
        }
        Matrix foretold;
        std::vector<std::string> failures;
        emulated_->evaluate(best_, foretold, failures);
        datasets.texts("best_run_output", "best_run_output", std::move(names));
        datasets.texts("best_run_unit", "best_run_output", std::move(units));
        datasets.vector("best_run_value", "best_run_output", answer.values);
        datasets.vector("best_run_foretold", "best_run_output", foretold.values);
    }

    void add_errors(DatasetBuilder& datasets) const {
        std::vector<std::string> names;
        names.reserve(simulator_->outputs().size());
        for (const Output& output : simulator_->outputs()) names.push_back(output.name);
        datasets.texts("simulator_channel", "simulator_channel", std::move(names));
        datasets.vector("simulator_emulator_error", "simulator_channel",
                        emulated_->errors());
    }

    std::string name_;
    std::shared_ptr<const Simulator> simulator_;
    int n_runs_;
    StudyOf study_;
    Matrix points_;          ///< [runs x parameters] on the scale 0 to 1
    int n_inner_items_ = 0;  ///< of its first round
    /// Once the runs are there.
    std::shared_ptr<const EmulatedSimulator> emulated_;
    std::unique_ptr<Stage> inner_;
    // Once the study has ended at a point.
    int best_item_ = 0;  ///< the run there; 0 = not yet
    Matrix best_;        ///< [1 x parameters] in their units
};

}  // namespace

int least_runs_of_study(std::size_t n_parameters) {
    return static_cast<int>(2 * emulator::least_runs(n_parameters));
}

std::unique_ptr<Stage> make_emulated_study(std::string name,
                                           std::shared_ptr<const Simulator> simulator,
                                           int n_runs, std::uint64_t seed,
                                           StudyOf study) {
    return std::make_unique<EmulatedStudy>(std::move(name), std::move(simulator), n_runs,
                                           seed, std::move(study));
}

}  // namespace bemcal::study
