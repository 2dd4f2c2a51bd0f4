/// A building over a period, held against its meters: the log likelihood of its
/// parameters and of each meter's residual parameters, with derivatives; and what it
/// predicts.
#pragma once

#include "posterior/meter_response.hpp"
#include "stats/residual_model.hpp"
#include "study/case.hpp"
#include "study/reading_noise.hpp"
#include "study/space.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bemcal::posterior {

/// A meter with what is believed of its residuals.
struct MeterModel {
    std::size_t meter = 0;  ///< of the case
    std::string name, unit;
    double scale = 1;                      ///< of the constant part of its noise [unit]
    std::vector<physics::Seconds> begins;  ///< of its readings
    std::vector<double> measured;          ///< all of the period's
    stats::ResidualModel residuals;        ///< of those that train
    std::vector<study::Coordinate> unknowns;  ///< of its residuals
};

/// How a case is held against its meters.
struct MeterChoice {
    std::vector<std::string> names;  ///< empty = all with a reading in the period
    stats::ResidualOptions residuals;
    /// Training readings of a meter, by its index in the case; empty = all readings.
    std::vector<std::vector<bool>> trains;
    /// Of the constant part of the noise [meter's unit], for each meter that is chosen;
    /// empty = the mean size of its readings.
    std::vector<double> scales;
};

class BuildingModel {
  public:
    /// A copy of the case is kept. A meter without readings stays where it is named: it
    /// is predicted. Throws std::invalid_argument for a name that is not a meter's.
    BuildingModel(const study::Case& building, const study::Period& period,
                  const MeterChoice& choice,
                  std::shared_ptr<const ResponseSource> source = own_model());
    /// The same over another period.
    BuildingModel over(const study::Period& period, const MeterChoice& choice) const {
        return {building_, period, choice, source_};
    }

    BuildingModel(const BuildingModel&) = delete;
    BuildingModel& operator=(const BuildingModel&) = delete;

    const study::Case& building() const { return building_; }
    const std::vector<MeterModel>& meters() const { return meters_; }
    std::size_t n_parameters() const { return building_.parameters.size(); }
    /// Where a meter's begin among those of all meters, one after the other.
    std::size_t first_residual_parameter(std::size_t meter) const;
    std::size_t n_residual_parameters() const {
        return first_residual_parameter(meters_.size());
    }
    int lanes() const { return response_->lanes(); }

    /// Of a thread.
    struct Work {
        std::unique_ptr<MeterResponse::Run> run;
        stats::ResidualModel::Work residuals;
        std::vector<double> parameters, values, by_parameter;
    };
    Work make_work() const;

    /// Rows of parameters and of residual parameters, meter after meter.
    struct Points {
        Matrix parameters;  ///< [n x parameters]
        Matrix residuals;   ///< [n x residual parameters]
    };
    /// Of the same shapes; value -inf, and derivatives 0, where a point is impossible.
    struct Likelihood {
        std::vector<double> value;  ///< [n]
        Matrix by_parameter, by_residual;
    };
    void evaluate(const Points& points, bool derivatives, Likelihood& out,
                  Work& work) const;

    /// [n x readings] of each meter; NaN rows where a point is impossible.
    std::vector<Matrix> predict(const Matrix& parameters) const;

  private:
    void evaluate_group(const Points& points, std::size_t first, bool derivatives,
                        Likelihood& out, Work& work) const;
    void add_meter(std::size_t meter, const Points& points, std::size_t first,
                   bool derivatives, Likelihood& out, Work& work) const;

    study::Case building_;
    std::shared_ptr<const ResponseSource> source_;
    std::vector<MeterModel> meters_;
    std::unique_ptr<const MeterResponse> response_;
};

/// What is believed of a meter's residuals before the data.
std::vector<study::Coordinate> residual_unknowns(const study::Meter& meter,
                                                 const stats::ResidualOptions& options);

}  // namespace bemcal::posterior
