/// Points by another program: the numbers of its outputs, or the hours of meters with
/// effects handed to it as files.
/// Plain handling of files, without a source. The run itself is point_runner's, numbers
/// are output_rule's.
#include "external/command_simulator.hpp"

#include "base/nan.hpp"
#include "external/effect_files.hpp"
#include "external/effect_places.hpp"
#include "external/periods_file.hpp"
#include "external/point_runner.hpp"
#include "external/regular_file.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::external {
namespace {

namespace fs = std::filesystem;

class CommandSimulator : public study::Simulator {
  public:
    explicit CommandSimulator(CommandOptions options) : runner_(std::move(options)) {
        for (const OutputRule& rule : runner_.options().outputs)
            outputs_.push_back({rule.name, rule.unit});
    }

    const std::vector<physics::Parameter>& parameters() const override {
        return runner_.options().parameters;
    }
    const std::vector<study::Output>& outputs() const override { return outputs_; }
    bool is_slow() const override { return true; }
    /// A full disk, a licence server, a node that was too slow for the time limit.
    bool failures_may_pass() const override { return true; }

    void evaluate(const Matrix& points, Matrix& answers,
                  std::vector<std::string>& failures) const override {
        answers = Matrix(points.rows, outputs_.size(), nan);
        failures.assign(points.rows, {});
        for (std::size_t r = 0; r < points.rows; ++r)
            failures[r] = runner_.run(points.row(r), {}, [&](const fs::path& folder) {
                return read_outputs(folder, answers.row(r));
            });
    }

  private:
    std::string read_outputs(const fs::path& folder, std::span<double> answers) const {
        WrittenFiles files(folder, runner_.options().output_limit);
        std::vector<double> values;
        values.reserve(outputs_.size());
        for (const OutputRule& rule : runner_.options().outputs) {
            const Reading reading = files.read(rule);
            if (!reading.failure.empty())
                return fmt::format("no {}: {}", rule.name, reading.failure);
            values.push_back(reading.value);
        }
        std::ranges::copy(values, answers.begin());
        return {};
    }

    PointRunner runner_;
    std::vector<study::Output> outputs_;
};

class HourlyCommand : public study::HourlySimulator {
  public:
    explicit HourlyCommand(CommandOptions options) : runner_(std::move(options)) {
        for (const OutputRule& rule : runner_.options().hours)
            meters_.push_back(rule.name);
    }

    const std::vector<physics::Parameter>& parameters() const override {
        return runner_.options().parameters;
    }
    const std::vector<std::string>& meters() const override { return meters_; }

    bool takes_periods() const override {
        return !runner_.options().periods_file.empty();
    }

    study::SimulatedHours hours(std::span<const double> point,
                                std::span<const study::GivenEffect> effects,
                                std::span<const study::Period> periods) const override {
        study::SimulatedHours simulated;
        std::size_t n_hours = 0;
        for (const study::Period& period : periods)
            n_hours += static_cast<std::size_t>(study::hours_of(period));
        Handed handed = handed_of(effects, n_hours, simulated);
        if (takes_periods())
            handed.files.push_back({runner_.options().periods_file.filename().string(),
                                    text_of_periods(periods)});
        simulated.failure = runner_.run(point, handed, [&](const fs::path& folder) {
            return read(folder, n_hours, simulated);
        });
        if (!simulated.failure.empty()) simulated.meters.clear();
        return simulated;
    }

  private:
    /// Effects in places of templates, or as files.
    Handed handed_of(std::span<const study::GivenEffect> effects, std::size_t n_hours,
                     study::SimulatedHours& simulated) const {
        const auto& places = runner_.options().places;
        if (places.empty()) return {files_of(effects)};
        PlacedEffects there = placed(places, effects, n_hours);
        simulated.left_out = std::move(there.left_out);
        return {{}, std::move(there.texts)};
    }

    std::string read(const fs::path& folder, std::size_t n_hours,
                     study::SimulatedHours& simulated) const {
        WrittenFiles files(folder, runner_.options().output_limit);
        for (const OutputRule& rule : runner_.options().hours) {
            Readings found = files.read_all(rule);
            if (!found.failure.empty())
                return fmt::format("no hours of {}: {}", rule.name, found.failure);
            if (found.values.size() != n_hours)
                return fmt::format(
                    "no hours of {}: {}: the column \"{}\" has {} numbers; "
                    "expected {}, one for each hour of the periods",
                    rule.name, rule.file, rule.column, found.values.size(), n_hours);
            simulated.meters.push_back(std::move(found.values));
        }
        for (std::string& line : lines_left_out(folder))
            simulated.left_out.push_back(std::move(line));
        return {};
    }

    PointRunner runner_;
    std::vector<std::string> meters_;
};

}  // namespace

std::shared_ptr<const study::Simulator> make_command_simulator(CommandOptions options) {
    if (!options.periods_file.empty()) options.links.push_back(options.periods_file);
    return std::make_shared<CommandSimulator>(std::move(options));
}

std::shared_ptr<const study::HourlySimulator> make_hourly_simulator(
    CommandOptions options) {
    return std::make_shared<HourlyCommand>(std::move(options));
}

}  // namespace bemcal::external
