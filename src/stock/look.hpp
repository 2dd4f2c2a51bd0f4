/// What the days of a building show of a model that was adopted: residuals by quarters of
/// a day, and the patterns along which they may have changed.
#pragma once

#include "job/stock.hpp"
#include "stats/step_test.hpp"
#include "stock/patterns.hpp"
#include "stock/record.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bemcal::stock {

class Look {
  public:
    /// Reads the building with what the record's loop found, and once more without each
    /// of the effects. Throws as a calibration does.
    Look(const job::Job& stock_job, const job::StockLine& line, const StockRecord& record,
         std::vector<input::InputFile>& log);

    const study::Case& building() const { return building_; }
    const DaySums& sums() const { return sums_; }
    std::size_t n_known() const { return n_known_; }
    /// Whether anything is read and foretold in days that were not known.
    bool sees_new_days() const;
    double n_simulations() const { return n_simulations_; }

    /// A step of what the changes leave, with the pattern's name and unit.
    struct Found {
        stats::Step step;
        std::string of, unit;
        bool is_of_effect = false;
        double day = 0;  ///< [d since 1970]
    };
    /// The step to be told next, if any: of an effect that explains nearly as much as
    /// any pattern does, else of the pattern that does most.
    /// \param told  those of the changes that earlier nights have told
    std::optional<Found> next_step(const std::vector<StockRecord::Change>& changes,
                                   const std::vector<StockRecord::Change>& told,
                                   double false_alarms) const;

    /// Sum of squares of what the changes leave from a day on, in usual spreads.
    double misfit_from(double day, const std::vector<StockRecord::Change>& changes) const;
    /// The same of another model of the same days.
    double misfit_from(double day, const DaySums& other) const;

  private:
    bool has_name(const StockRecord::Change& change) const;
    /// Of what changes without a name leave, as stats::StepOptions has it.
    std::vector<double> wander_behind(
        const std::vector<StockRecord::Change>& changes) const;
    Matrix residuals(const std::vector<StockRecord::Change>& changes) const;
    double misfit_from(double day, const Matrix& residuals) const;

    study::Case building_;
    DaySums sums_;
    std::size_t n_known_ = 0, n_effects_ = 0;
    std::vector<Pattern> patterns_;  ///< effects first
    Matrix spread_;
    double n_simulations_ = 0;
};

/// The building with what the record's loop found, its parameters at the record's values,
/// in the days that were known to it and those since.
study::Case adopted_building(const job::Job& stock_job, const job::StockLine& line,
                             const StockRecord& record, const study::Period& known,
                             std::vector<input::InputFile>& log,
                             const StockRecord::Effect* without = nullptr);

/// Of the record's loop.
study::Period known_of(const StockRecord& record);

double day_of(physics::Seconds time);  ///< [d since 1970]

}  // namespace bemcal::stock
