/// Whether what a model leaves has taken a step, along which of several patterns.
///
/// Rows are days, columns features of a day, such as a meter's sums over its quarters. A
/// pattern is what a unit of its coefficient would add. A step is a coefficient that
/// differs, over the last days, from what it was in the four weeks before. Behind a step
/// that was told, what the model leaves wanders, and a further one must stand out of
/// that.
#pragma once

#include "base/matrix.hpp"

#include <optional>
#include <vector>

namespace bemcal::stats {

struct StepOptions {
    std::size_t n_known = 0;     ///< first days, that the model has learned from
    double false_alarms = 1e-3;  ///< chance of one in a look, over all patterns together
    /// [days] variance that comes to a pattern's coefficient on a day, where a day says a
    /// square of a spread of it; empty = none.
    std::vector<double> wander{};
};

struct Step {
    std::size_t pattern = 0;
    std::size_t day = 0;      ///< row, the most likely first day of it
    double size = 0, sd = 0;  ///< of the coefficient
    double statistic = 0;     ///< standard deviations from no step
};

/// Days of the last that are looked at for a step: one that begins earlier is not told.
inline constexpr std::size_t step_lengths[] = {7, 14, 21, 28};
inline constexpr std::size_t most_step_days = 28;

/// The spread of residuals, day by day: root mean square of the known days on which the
/// same feature was predicted alike; of a day of which more is predicted than of those,
/// as much more, and all that lies beyond 98 % of the known predictions, or below 2 %.
/// [days x features], above 0.
Matrix spread_of(const Matrix& residuals, const Matrix& predicted, std::size_t n_known);

/// What is known of a day by the steps that were told.
enum class Told { nothing, first_day, behind };

/// StepOptions::wander behind steps whose patterns stand for a change of unknown shape:
/// by how much the residuals' mean square there exceeds that of known days. So much comes
/// with the first day, and again in a season.
/// \param residuals  without the steps: all that the change does
std::vector<double> wander_behind(const Matrix& residuals, const Matrix& spread,
                                  const std::vector<Told>& days);

class StepTest {
  public:
    /// \param residuals  [days x features] measured - predicted; NaN = missing
    /// \param spread     as many, above 0
    StepTest(const Matrix& residuals, const Matrix& spread,
             const std::vector<Matrix>& patterns, const StepOptions& options);

    /// |statistic| that a step needs to be told, by the false alarms.
    double threshold() const { return threshold_; }
    /// Whether it has that, and more than its pattern ever shows over the known days.
    bool is_told(const Step& step) const;
    /// The surest step of each pattern, whether told or not; nothing where the pattern
    /// has no say in the last days, or too few days are known.
    std::optional<Step> surest(std::size_t pattern) const;

  private:
    /// Sums of a pattern over days [0, d): of pattern times residual, as it is and with
    /// days that stand out held in, and of its square.
    struct Sums {
        std::vector<double> whole, product, square;
        double slow = 0;   ///< variance of its coefficient from month to month
        double scale = 1;  ///< of the statistic, as the known days show it
        double most = 0;   ///< |statistic| over the known days
    };
    struct Contrast {
        double size, sd;
    };
    struct Level {
        double mean, variance;
    };
    /// Of the coefficient, by the days from first to end, as they follow each other.
    /// \param unit  of wander
    Level level_at(const Sums& sums, std::size_t first, std::size_t end, double unit,
                   const std::vector<double>& product) const;
    /// Of the coefficient's mean from begin to end against that of begin, by wander.
    double wandered(const Sums& sums, std::size_t begin, std::size_t end,
                    double unit) const;
    /// \param product  of sums
    std::optional<Contrast> contrast(const Sums& sums, std::size_t end, std::size_t n,
                                     const std::vector<double>& product) const;
    void learn_slow(Sums& sums) const;
    void learn_scale(Sums& sums) const;

    std::vector<Sums> sums_;
    std::size_t n_days_ = 0;
    StepOptions options_;
    double threshold_ = 0;
};

}  // namespace bemcal::stats
