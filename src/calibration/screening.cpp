/// Runs a screening as a stage: an item is a run of points of a scrambled Sobol sample.
/// With keep_points an answer holds every row, without it a ranking that does not grow.
/// The score is of the first period only. Points come from `screening_plan`, rows are
/// defined in `ranking`, datasets made in `screening_conclude`.
#include "calibration/screening.hpp"

#include "base/nan.hpp"
#include "calibration/screening_plan.hpp"

#include <algorithm>

namespace bemcal::calibration {
namespace {

class Screening : public study::Stage {
  public:
    Screening(std::string name, const study::Case& building,
              const ScreeningOptions& options, const MakePeriodModel& model)
        : plan_(std::move(name), building, options, model) {}

    std::string name() const override { return plan_.name; }
    int n_items() const override { return static_cast<int>(plan_.n_items()); }
    long long n_simulations() const override {
        return static_cast<long long>(plan_.n_points() * plan_.models.size());
    }
    std::size_t answer_bytes() const override {
        const auto& options = plan_.options;
        const std::size_t n_rows =
            options.keep_points ? options.points_per_item : options.n_best;
        return sizeof(double) * n_rows * plan_.layout.width();
    }
    study::ItemAnswer run(int item) const override;
    study::Conclusion conclude(
        const std::vector<study::ItemAnswer>& answers) const override {
        return conclude_screening(plan_, answers);
    }
    std::vector<double> best_point(
        const std::vector<study::ItemAnswer>& answers) const override {
        return best_point_of(plan_, answers);
    }

  private:
    void evaluate(std::size_t period, const Matrix& points, Matrix& rows,
                  std::vector<std::string>& reasons) const;

    ScreeningPlan plan_;
};

/// Fills the period's part of every row; adds the reasons of points that failed.
void Screening::evaluate(std::size_t period, const Matrix& points, Matrix& rows,
                         std::vector<std::string>& reasons) const {
    const PeriodModel& model = *plan_.models[period];
    const auto& readings = model.readings();
    const auto answers = model.evaluate(points, model.all());
    std::vector<study::MeterFit> fits(readings.size());
    for (std::size_t r = 0; r < answers.size(); ++r) {
        const kernel::PointAnswer& answer = answers[r];
        if (reasons[r].empty()) reasons[r] = answer.failure;
        if (!answer.failure.empty()) continue;
        for (std::size_t m = 0; m < readings.size(); ++m)
            fits[m] =
                study::fit_of(readings[m], answer.errors[m], answer.monthly_errors[m]);
        write_fits(plan_.layout, period, readings, fits, rows.row(r));
    }
}

study::ItemAnswer Screening::run(int item) const {
    const auto index = static_cast<std::size_t>(item);
    const std::size_t first = plan_.first_of(index);
    const Matrix points = plan_.points(first, plan_.size_of(index));
    Matrix rows(points.rows, plan_.layout.width(), nan);
    std::vector<std::string> reasons(points.rows);
    for (std::size_t period = 0; period < plan_.models.size(); ++period)
        evaluate(period, points, rows, reasons);
    study::ItemAnswer answer;
    for (std::size_t r = 0; r < points.rows; ++r) {
        if (reasons[r].empty()) continue;
        answer.failures.push_back({static_cast<long long>(first + r), reasons[r]});
        std::ranges::fill(rows.row(r), nan);
    }
    if (plan_.options.keep_points) {
        answer.values = std::move(rows.values);
        return answer;
    }
    Ranking ranking(plan_.layout, plan_.options.n_best);
    ranking.add_rows(static_cast<long long>(first), rows.values);
    answer.values = ranking.pack();
    return answer;
}

}  // namespace

std::unique_ptr<study::Stage> make_screening(std::string name,
                                             const study::Case& building,
                                             const ScreeningOptions& options,
                                             const MakePeriodModel& model) {
    return std::make_unique<Screening>(std::move(name), building, options, model);
}

}  // namespace bemcal::calibration
