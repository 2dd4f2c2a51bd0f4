/// What is kept of each screened point, and the best of them.
#pragma once

#include "base/matrix.hpp"
#include "study/fit.hpp"

#include <span>
#include <vector>

namespace bemcal::calibration {

/// The row of numbers of one point: its score, its verdicts by Guideline 14 [period x
/// resolution], its metrics [metric x period x meter].
struct RowLayout {
    std::size_t n_periods = 0, n_meters = 0;

    enum Metric : std::size_t {
        cv_rmse,
        nmbe,
        mape,
        monthly_cv_rmse,
        monthly_nmbe,
        monthly_mape,
        n_metrics
    };
    static constexpr std::size_t n_resolutions = 2;
    static const char* metric_name(std::size_t metric);  ///< leaf of its dataset
    std::size_t n_verdicts() const { return n_periods * n_resolutions; }
    std::size_t n_fits() const { return n_periods * n_meters; }
    std::size_t verdicts() const { return 1; }
    std::size_t metric(std::size_t k) const { return 1 + n_verdicts() + k * n_fits(); }
    std::size_t width() const { return metric(n_metrics); }
    /// Of a meter in a period.
    double value(std::span<const double> row, Metric k, std::size_t period,
                 std::size_t meter) const {
        return row[metric(k) + period * n_meters + meter];
    }
};

/// Fills one period's part of a row.
void write_fits(const RowLayout& layout, std::size_t period,
                const std::vector<kernel::Readings>& readings,
                const std::vector<study::MeterFit>& fits, std::span<double> row);

struct Ranked {
    long long point = 0;
    std::vector<double> row;
};

/// The best points seen and the counts of all; merged in any grouping, the result is the
/// same.
class Ranking {
  public:
    Ranking(const RowLayout& layout, std::size_t n_best)
        : layout_(layout), n_best_(n_best) {}

    void add(long long point, std::span<const double> row);
    /// Whole rows, of points `first` and on.
    void add_rows(long long first, std::span<const double> rows);
    void add(const Ranking& other);
    const std::vector<Ranked>& best() const { return best_; }            ///< best first
    const std::vector<double>& n_meeting() const { return n_meeting_; }  ///< [verdicts]

    std::vector<double> pack() const;
    static Ranking unpack(const RowLayout& layout, std::size_t n_best,
                          std::span<const double> packed);

  private:
    void insert(Ranked ranked);

    RowLayout layout_;
    std::size_t n_best_;
    std::vector<Ranked> best_;
    std::vector<double> n_meeting_ = std::vector<double>(layout_.n_verdicts(), 0.0);
};

}  // namespace bemcal::calibration
