#include "base/nan.hpp"
#include "posterior/chain_draws.hpp"
#include "posterior/chain_stage.hpp"
#include "posterior/emulated_meters.hpp"
#include "posterior/posterior.hpp"
#include "posterior/posterior_cases.hpp"
#include "posterior/simulator_posterior.hpp"
#include "sampling/normal.hpp"
#include "stats/sobol_sequence.hpp"
#include "study/find.hpp"
#include "study/room_program.hpp"
#include "study/simulated_hours.hpp"
#include "study/simulator_run.hpp"
#include "support/stage_answers.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::posterior {
namespace {

using study::Case;
using test::Room;

const std::vector<double> truth{1.2, 20.5, 0.5};

/// A fortnight, and a week that is held out, with hourly heat of the room. \param phi  of
/// the errors: how much of one is left in the next \param noise  their sd [kWh]
Case measured(double phi = 0, double noise = 0.15) {
    Case made = test::small_case();
    made.periods = {{"training", test::day(0), test::day(14)},
                    {"held_out", test::day(14), test::day(21)}};
    std::vector<double> heat = Room(made).heat(truth);
    Stream random(7, 0, 0);
    double error = 0;
    for (double& value : heat)
        value += error = phi * error + noise * sampling::standard_normal(random);
    const study::Period all{"all", test::day(0), test::day(21)};
    made.meters = {{"heating", physics::Quantity::heating, physics::Interval::hourly,
                    study::axis_of(made, all), heat}};
    return made;
}

PosteriorOptions options() {
    PosteriorOptions options = test::quick_options();
    options.chains.draws_per_round = 500;
    options.chains.most_draws = 3000;
    options.chains.target_ess = 2000;
    options.chains.target_rhat = 1.01;
    options.simulator_runs = 40;
    return options;
}

struct Moments {
    double mean = 0, sd = 0;
};

struct Fitted {
    study::Conclusion conclusion;
    std::string shortfall;
    Moments of(std::size_t unknown) const {
        return {numbers("posterior_mean").at(unknown),
                numbers("posterior_sd").at(unknown)};
    }
    const std::vector<double>& numbers(const char* leaf) const {
        return test::find(conclusion.datasets, leaf).values;
    }
    const std::vector<std::string>& texts(const char* leaf) const {
        return test::find(conclusion.datasets, leaf).texts;
    }
};

Fitted fitted(const Case& building, const PosteriorOptions& options, int fails_each = 0) {
    const auto stage = make_simulator_posterior(
        "around", building, std::make_shared<Room>(building, fails_each), options);
    const auto answers = test::answers_of(*stage);
    return {stage->conclude(answers), stage->shortfall(answers)};
}

/// Means within a tenth of a standard deviation, standard deviations within a tenth.
void expect_same(const Moments& made, const Moments& reference, const std::string& of) {
    EXPECT_NEAR(made.mean, reference.mean, 0.1 * reference.sd) << of;
    EXPECT_NEAR(made.sd, reference.sd, 0.1 * reference.sd) << of;
    std::printf("measured: %s: mean %+.3f sd off, sd %+.1f %%\n", of.c_str(),
                (made.mean - reference.mean) / reference.sd,
                100 * (made.sd / reference.sd - 1));
}

/// Points about a mean, within the range.
std::vector<double> axis_about(const Moments& moments, double least, double most) {
    constexpr int n = 31;
    const double from = std::max(least, moments.mean - 5 * moments.sd),
                 to = std::min(most, moments.mean + 5 * moments.sd);
    std::vector<double> points;
    for (int k = 0; k < n; ++k) points.push_back(from + (to - from) * (k + 0.5) / n);
    return points;
}

/// Log posterior of the room itself with white noise of a share of the mean reading.
class Exact {
  public:
    explicit Exact(const Case& building)
        : room_(building),
          measured_(study::readings_of(building, building.periods[0])[0].values) {
        for (const double value : measured_)
            scale_ += std::abs(value) / static_cast<double>(measured_.size());
    }
    double square(std::span<const double> point) const {
        const auto heat = room_.heat(point);
        double sum = 0;
        for (std::size_t k = 0; k < measured_.size(); ++k)
            sum += (heat[k] - measured_[k]) * (heat[k] - measured_[k]);
        return sum / (scale_ * scale_);
    }
    /// Lognormal prior: median 0.1, 1.
    double log_density(double square, double noise) const {
        const double log_noise = std::log(noise), away = log_noise - std::log(0.1);
        return -square / (2 * noise * noise) -
               static_cast<double>(measured_.size()) * log_noise - away * away / 2 -
               log_noise;
    }

  private:
    Room room_;
    std::vector<double> measured_;
    double scale_ = 0;
};

/// By a grid over parameters and noise. [4]
std::vector<Moments> by_quadrature(const Case& building, const Fitted& about) {
    const Exact exact(building);
    const Room room(building);
    std::vector<std::vector<double>> axes;
    for (std::size_t k = 0; k < 3; ++k)
        axes.push_back(axis_about(about.of(k), room.parameters()[k].least,
                                  room.parameters()[k].most));
    axes.push_back(axis_about(about.of(3), 0.01, 10));
    const double peak = exact.log_density(
        exact.square(std::vector{about.of(0).mean, about.of(1).mean, about.of(2).mean}),
        about.of(3).mean);
    double total = 0;
    std::vector<double> sums(4), squares(4);
    for (const double u : axes[0])
        for (const double set_point : axes[1])
            for (const double sun : axes[2]) {
                const double square = exact.square(std::vector{u, set_point, sun});
                for (const double noise : axes[3]) {
                    const double weight =
                        std::exp(exact.log_density(square, noise) - peak);
                    const double at[] = {u, set_point, sun, noise};
                    total += weight;
                    for (std::size_t k = 0; k < 4; ++k) {
                        sums[k] += weight * at[k];
                        squares[k] += weight * at[k] * at[k];
                    }
                }
            }
    std::vector<Moments> moments;
    for (std::size_t k = 0; k < 4; ++k) {
        const double mean = sums[k] / total;
        moments.push_back({mean, std::sqrt(squares[k] / total - mean * mean)});
    }
    return moments;
}

TEST(SimulatorPosterior, IsThatOfTheProgramByQuadrature) {
    const Case building = measured();
    PosteriorOptions white = options();
    white.residuals.autocorrelated = white.residuals.proportional = false;
    const Fitted made = fitted(building, white);
    EXPECT_EQ(made.shortfall, "");
    ASSERT_EQ(made.texts("unknown"),
              (std::vector<std::string>{"u", "set_point", "sun", "heating_constant",
                                        "log_density"}));
    const auto reference = by_quadrature(building, made);
    for (std::size_t k = 0; k < 4; ++k)
        expect_same(made.of(k), reference[k], made.texts("unknown")[k]);
    // All runs are told, and a part of the second period's readings is foretold.
    EXPECT_EQ(std::ranges::count(made.texts("simulator_run"), "design"), 25);
    EXPECT_EQ(std::ranges::count(made.texts("simulator_run"), "posterior"), 15);
    EXPECT_LT(made.numbers("simulator_emulator_error").at(0), 2);
    EXPECT_EQ(made.numbers("held_out/heating/predicted_q95").size(), 7U * 24);
}

/// The room itself, for every draw.
class RoomItself : public ResponseSource {
  public:
    explicit RoomItself(const Case& building) : room_(building) {}
    std::unique_ptr<MeterResponse> response(const Case& building,
                                            const study::Period& period,
                                            std::span<const std::size_t>) const override {
        return std::make_unique<Response>(room_, building, period);
    }

  private:
    struct RoomRun : MeterResponse::Run {
        std::vector<double> readings;
    };
    class Response : public MeterResponse {
      public:
        Response(const Room& room, const Case& building, const study::Period& period)
            : room_(room), building_(building), period_(period) {}
        int lanes() const override { return 1; }
        std::unique_ptr<MeterResponse::Run> make_run() const override {
            return std::make_unique<RoomRun>();
        }
        std::vector<std::string> predict(const Matrix& points, std::size_t first,
                                         std::size_t,
                                         MeterResponse::Run& run) const override {
            static_cast<RoomRun&>(run).readings = study::readings_of_hours(
                building_, period_,
                {physics::Quantity::heating, physics::Interval::hourly},
                room_.heat(points.row(first)));
            return {""};
        }
        const double* readings(const MeterResponse::Run& run,
                               std::size_t) const override {
            return static_cast<const RoomRun&>(run).readings.data();
        }
        double* sensitivities(MeterResponse::Run&, std::size_t) const override {
            return nullptr;
        }
        void pull_back(MeterResponse::Run&, Matrix&) const override {}

      private:
        const Room& room_;
        const Case& building_;
        study::Period period_;
    };
    Room room_;
};

/// Of errors that remember the one before.
TEST(SimulatorPosterior, IsThatOfTheProgramForEveryDraw) {
    const Case building = measured(0.6);
    PosteriorOptions autocorrelated = options();
    autocorrelated.residuals.proportional = false;
    const Fitted made = fitted(building, autocorrelated);
    EXPECT_EQ(made.shortfall, "");
    PosteriorOptions walk = autocorrelated;
    walk.meters = {"heating"};
    walk.chains.n_chains = walk.chains.chains_per_item = 8;
    walk.chains.sampler.method = sampling::Method::random_walk;
    walk.chains.sampler.n_warm_up = 2000;
    walk.chains.sampler.thin = 20;
    walk.chains.target_ess = 2000;
    const auto stage = make_chain_stage(
        "around",
        make_posterior_through(std::make_shared<RoomItself>(building),
                               with_parameters(building, Room(building).parameters(), 0),
                               walk),
        walk.chains);
    const auto answers = test::answers_of(*stage);
    const Fitted reference{stage->conclude(answers), stage->shortfall(answers)};
    EXPECT_EQ(reference.shortfall, "");
    ASSERT_EQ(made.texts("unknown"), reference.texts("unknown"));
    for (std::size_t k = 0; k < 5; ++k)
        expect_same(made.of(k), reference.of(k), made.texts("unknown")[k]);
}

/// Chains on an emulator of few runs of the design; with its own error or as if it had
/// none.
Fitted by_few_runs(const Case& building, bool has_errors) {
    constexpr std::size_t n_runs = 5;
    const Room room(building);
    const SeriesLayout layout(building, {0});
    const Matrix points = stats::scrambled_sobol_points(0, n_runs, 3, 4);
    Matrix all;
    for (std::size_t r = 0; r < n_runs; ++r) {
        const auto heat = room.heat(study::values_at(points.row(r), room.parameters()));
        const auto series = layout.series(building, {heat});
        all.cols = series.size();
        all.values.insert(all.values.end(), series.begin(), series.end());
        ++all.rows;
    }
    const auto emulator = std::make_shared<const emulator::SeriesEmulator>(
        points, all, layout.weights(building));
    std::vector<double> variance(emulator->n_components());
    if (has_errors)
        variance = mean_variance(*emulator, stats::scrambled_sobol_points(0, 64, 3, 4));
    PosteriorOptions white = options();
    white.meters = {"heating"};
    white.residuals.autocorrelated = white.residuals.proportional = false;
    white.chains.target_ess = 400;
    const auto stage = make_chain_stage(
        "around",
        make_posterior_through(
            emulated_meters(layout, emulator, variance),
            with_parameters(building, room.parameters(), emulator->n_components()),
            white),
        white.chains);
    const auto answers = test::answers_of(*stage);
    return {stage->conclude(answers), stage->shortfall(answers)};
}

/// Standard deviations by which the farthest parameter lies from the truth.
double farthest(const Fitted& fitted) {
    double most = 0;
    for (std::size_t k = 0; k < 3; ++k)
        most = std::max(most, std::abs(fitted.of(k).mean - truth[k]) / fitted.of(k).sd);
    return most;
}

TEST(SimulatorPosterior, IsWiderWhereTheEmulatorIsWrong) {
    const Case building = measured(0, 0.03);
    const double knowing = farthest(by_few_runs(building, true)),
                 pretending = farthest(by_few_runs(building, false));
    std::printf("measured: 5 runs: the truth is %.1f sd away, without the error %.1f\n",
                knowing, pretending);
    EXPECT_LT(knowing, 4);
    EXPECT_GT(pretending, 8);
}

TEST(SimulatorPosterior, RunsThatFailAreToldAndLeftOut) {
    const Case building = measured();
    const Fitted made = fitted(building, options(), 7);
    const auto& failures = made.texts("simulator_run_failure");
    EXPECT_GT(std::ranges::count(failures, "it was told to fail"), 1);
    EXPECT_EQ(made.shortfall, "");
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(made.of(k).mean, truth[k], 4 * made.of(k).sd);
    const Fitted none = fitted(building, options(), 1);
    EXPECT_EQ(none.shortfall, "too few runs of the simulator succeeded for a posterior");
    EXPECT_EQ(none.texts("simulator_run_failure").size(), 25U);
}

TEST(SimulatorPosterior, ParametersLeftOutStayNominal) {
    const Case building = measured();
    PosteriorOptions two = options();
    two.parameters = {"u", "sun"};
    const Fitted made = fitted(building, two);
    EXPECT_EQ(made.texts("simulator_parameter"), two.parameters);
    EXPECT_EQ(made.texts("unknown")[1], "sun");
}

TEST(SimulatorPosterior, RefusesWhatItCannotLearnFrom) {
    Case building = measured();
    const auto room = std::make_shared<Room>(building);
    PosteriorOptions few = options();
    few.simulator_runs = 10;
    EXPECT_THROW(make_simulator_posterior("around", building, room, few),
                 std::invalid_argument);
    PosteriorOptions other = options();
    other.meters = {"gas"};
    EXPECT_THROW(make_simulator_posterior("around", building, room, other),
                 std::invalid_argument);
    std::ranges::fill(building.meters[0].values, nan);
    EXPECT_THROW(make_simulator_posterior("around", building, room, options()),
                 std::invalid_argument);
}

}  // namespace
}  // namespace bemcal::posterior
