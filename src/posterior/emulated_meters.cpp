/// Scores at a point by their processes, readings by the components, and the way back.
/// Source: Higdon, Gattiker, Williams and Rightley 2008; errors stand non-centred.
/// What the components leave out of the runs is left out here, too.
#include "posterior/emulated_meters.hpp"

#include "base/error.hpp"
#include "emulator/eigen_views.hpp"
#include "posterior/building_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace bemcal::posterior {
namespace {

using emulator::ChannelRange;
using emulator::eigen_index;
using emulator::eigen_view;
using emulator::EigenRows;
using emulator::ScoreProcess;
using emulator::SeriesEmulator;

constexpr int n_lanes = 4;  ///< chains that share the components' way through the cache

/// Components over part of the series. [components x part]
auto components_over(const SeriesEmulator& emulator, std::size_t first,
                     std::size_t size) {
    return eigen_view(emulator.parts().components)
        .middleCols(eigen_index(first), eigen_index(size));
}

struct EmulatedRun : MeterResponse::Run {
    Matrix points;      ///< [lanes x parameters of the building], those predicted last
    std::size_t n = 0;  ///< of them
    std::vector<double> readings, sensitivities;  ///< [n_readings x lanes]
};

class EmulatedResponse : public MeterResponse {
  public:
    /// \param ranges  of the meters, one after the other in the emulator's series
    EmulatedResponse(std::shared_ptr<const SeriesEmulator> emulator,
                     const study::Case& building, std::vector<ChannelRange> ranges,
                     const std::vector<double>& variance)
        : emulator_(std::move(emulator)), ranges_(std::move(ranges)) {
        for (const double of_score : variance) sd_.push_back(std::sqrt(of_score));
        for (std::size_t k = 0; k < emulator_->n_parameters(); ++k) {
            least_.push_back(building.parameters[k].least);
            width_.push_back(building.parameters[k].most - building.parameters[k].least);
        }
    }

    int lanes() const override { return n_lanes; }
    std::unique_ptr<Run> make_run() const override {
        auto run = std::make_unique<EmulatedRun>();
        run->points = Matrix(n_lanes, n_parameters());
        run->readings.resize(n_readings() * n_lanes);
        run->sensitivities.resize(n_readings() * n_lanes);
        return run;
    }

    std::vector<std::string> predict(const Matrix& points, std::size_t first,
                                     std::size_t count, Run& of) const override {
        auto& run = static_cast<EmulatedRun&>(of);
        run.n = count;
        EigenRows scores(n_lanes, eigen_index(n_components()));
        for (std::size_t lane = 0; lane < n_lanes; ++lane) {
            const auto row = points.row(first + std::min(lane, count - 1));
            std::ranges::copy(row, run.points.row(lane).begin());
            const std::vector<double> at_point = scores_at(row);
            scores.row(eigen_index(lane)) = eigen_view(std::span<const double>(at_point));
        }
        const auto mean = eigen_view(std::span<const double>(emulator_->parts().mean))
                              .segment(eigen_index(begin()), eigen_index(n_readings()));
        by_reading(run.readings).noalias() =
            scores * components_over(*emulator_, begin(), n_readings());
        by_reading(run.readings).rowwise() += mean.transpose();
        return std::vector<std::string>(count);
    }
    const double* readings(const Run& run, std::size_t meter) const override {
        return static_cast<const EmulatedRun&>(run).readings.data() + offset_of(meter);
    }
    double* sensitivities(Run& run, std::size_t meter) const override {
        return static_cast<EmulatedRun&>(run).sensitivities.data() + offset_of(meter);
    }
    void pull_back(Run& of, Matrix& gradient) const override {
        auto& run = static_cast<EmulatedRun&>(of);
        const EigenRows by_score =
            by_reading(run.sensitivities) *
            components_over(*emulator_, begin(), n_readings()).transpose();
        for (std::size_t lane = 0; lane < run.n; ++lane) {
            const std::span<const double> slopes(by_score.row(eigen_index(lane)).data(),
                                                 n_components());
            pull_scores_back(slopes, std::as_const(run.points).row(lane),
                             gradient.row(lane));
        }
    }

  private:
    using ByReading = Eigen::Map<
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor>>;

    std::size_t n_components() const { return emulator_->n_components(); }
    std::size_t n_parameters() const {
        return emulator_->n_parameters() + n_components();
    }
    std::size_t begin() const { return ranges_.empty() ? 0 : ranges_.front().first; }
    std::size_t n_readings() const {
        return ranges_.empty() ? 0 : ranges_.back().first + ranges_.back().size - begin();
    }
    std::size_t offset_of(std::size_t meter) const {
        return (ranges_[meter].first - begin()) * n_lanes;
    }
    /// [lanes x readings]
    ByReading by_reading(std::vector<double>& values) const {
        return {values.data(), n_lanes, eigen_index(n_readings())};
    }

    /// [parameters] on the scale 0 to 1, where a prior's end may be rounded beyond it
    std::vector<double> on_scale(std::span<const double> row) const {
        std::vector<double> point(emulator_->n_parameters());
        for (std::size_t k = 0; k < point.size(); ++k)
            point[k] = std::clamp((row[k] - least_[k]) / width_[k], 0.0, 1.0);
        return point;
    }

    std::vector<double> scores_at(std::span<const double> row) const {
        const std::vector<double> point = on_scale(row);
        const auto errors = row.subspan(point.size());
        std::vector<double> scores(n_components());
        for (std::size_t c = 0; c < scores.size(); ++c) {
            const ScoreProcess& process = emulator_->processes()[c];
            scores[c] = process.mean(point) + sd_[c] * errors[c];
        }
        return scores;
    }

    void pull_scores_back(std::span<const double> slopes, std::span<const double> row,
                          std::span<double> gradient) const {
        const std::vector<double> point = on_scale(row);
        std::ranges::fill(gradient, 0);
        for (std::size_t c = 0; c < slopes.size(); ++c) {
            const std::vector<double> of_mean = emulator_->processes()[c].gradient(point);
            for (std::size_t k = 0; k < point.size(); ++k)
                gradient[k] += slopes[c] / width_[k] * of_mean[k];
            gradient[point.size() + c] = slopes[c] * sd_[c];
        }
    }

    std::shared_ptr<const SeriesEmulator> emulator_;
    std::vector<ChannelRange> ranges_;
    std::vector<double> sd_;             ///< [components]
    std::vector<double> least_, width_;  ///< [parameters of the program]
};

class EmulatedMeters : public ResponseSource {
  public:
    EmulatedMeters(SeriesLayout layout, std::shared_ptr<const SeriesEmulator> emulator,
                   std::vector<double> variance)
        : layout_(std::move(layout)),
          emulator_(std::move(emulator)),
          variance_(std::move(variance)) {}

    std::unique_ptr<MeterResponse> response(
        const study::Case& building, const study::Period& period,
        std::span<const std::size_t> meters) const override {
        require(std::ranges::equal(meters, layout_.meters()),
                "meters other than the emulator's");
        return std::make_unique<EmulatedResponse>(
            emulator_, building, layout_.ranges(building, period), variance_);
    }
    std::size_t n_errors() const override { return emulator_->n_components(); }

  private:
    SeriesLayout layout_;
    std::shared_ptr<const SeriesEmulator> emulator_;
    std::vector<double> variance_;
};

}  // namespace

study::Case with_parameters(study::Case building,
                            std::vector<physics::Parameter> parameters,
                            std::size_t n_components) {
    building.priors.clear();
    for (const physics::Parameter& parameter : parameters) {
        study::ParameterPrior& uniform = building.priors.emplace_back();
        uniform.prior.least = parameter.least;
        uniform.prior.most = parameter.most;
    }
    building.parameters = std::move(parameters);
    for (std::size_t c = 0; c < n_components; ++c) {
        physics::Parameter& error = building.parameters.emplace_back();
        error.name = fmt::format("emulator error {}", c + 1);
        error.unit = "-";
        error.nominal = 0;
        building.priors.push_back({stats::normal_prior(0, 1), {}});
    }
    return building;
}

std::vector<double> mean_variance(const SeriesEmulator& emulator, const Matrix& points) {
    std::vector<double> mean(emulator.n_components());
    for (std::size_t c = 0; c < mean.size(); ++c) {
        const ScoreProcess& process = emulator.processes()[c];
        for (std::size_t r = 0; r < points.rows; ++r)
            mean[c] += process.variance(points.row(r)) / static_cast<double>(points.rows);
        mean[c] += process.nugget_variance();
    }
    return mean;
}

std::shared_ptr<const ResponseSource> emulated_meters(
    SeriesLayout layout, std::shared_ptr<const SeriesEmulator> emulator,
    std::vector<double> variance) {
    return std::make_shared<EmulatedMeters>(std::move(layout), std::move(emulator),
                                            std::move(variance));
}

}  // namespace bemcal::posterior
