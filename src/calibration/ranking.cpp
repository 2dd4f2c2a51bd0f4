/// Keeps a row of numbers for each screened point, the best of all, and how many meet
/// Guideline 14. Merged in any grouping the result is the same; ties go by index.
/// Source: ASHRAE Guideline 14 for the verdicts, by `fit`.
/// Failed points are left out. Which rows are stored is decided in `screening`.
#include "calibration/ranking.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::calibration {
namespace {

constexpr const char* metric_names[RowLayout::n_metrics] = {
    "cv_rmse", "nmbe", "mape", "monthly_cv_rmse", "monthly_nmbe", "monthly_mape"};

/// Better score first; of equals the lower index.
bool is_better(const Ranked& one, const Ranked& other) {
    if (one.row[0] != other.row[0]) return one.row[0] < other.row[0];
    return one.point < other.point;
}

}  // namespace

const char* RowLayout::metric_name(std::size_t metric) {
    return metric_names[metric];
}

void write_fits(const RowLayout& layout, std::size_t period,
                const std::vector<kernel::Readings>& readings,
                const std::vector<study::MeterFit>& fits, std::span<double> row) {
    if (period == 0) row[0] = study::score_of(fits);
    for (const auto resolution : {stats::Resolution::hourly, stats::Resolution::monthly})
        row[layout.verdicts() + period * RowLayout::n_resolutions +
            static_cast<std::size_t>(resolution)] =
            study::meet_guideline_14(readings, fits, resolution) ? 1 : 0;
    for (std::size_t m = 0; m < fits.size(); ++m) {
        const auto &own = fits[m].own, &monthly = fits[m].monthly;
        const double values[] = {own.cv_rmse,     own.nmbe,     own.mape,
                                 monthly.cv_rmse, monthly.nmbe, monthly.mape};
        for (std::size_t k = 0; k < RowLayout::n_metrics; ++k)
            row[layout.metric(k) + period * layout.n_meters + m] = values[k];
    }
}

void Ranking::add(long long point, std::span<const double> row) {
    if (std::isnan(row[0])) return;
    for (std::size_t k = 0; k < n_meeting_.size(); ++k)
        n_meeting_[k] += row[layout_.verdicts() + k];
    if (best_.size() < n_best_ || row[0] < best_.back().row[0])
        insert({point, {row.begin(), row.end()}});
}

void Ranking::add_rows(long long first, std::span<const double> rows) {
    for (std::size_t at = 0; at < rows.size(); at += layout_.width())
        add(first++, rows.subspan(at, layout_.width()));
}

void Ranking::add(const Ranking& other) {
    for (std::size_t k = 0; k < n_meeting_.size(); ++k)
        n_meeting_[k] += other.n_meeting_[k];
    for (const Ranked& ranked : other.best_) insert(ranked);
}

void Ranking::insert(Ranked ranked) {
    const auto place = std::ranges::upper_bound(best_, ranked, is_better);
    best_.insert(place, std::move(ranked));
    if (best_.size() > n_best_) best_.pop_back();
}

std::vector<double> Ranking::pack() const {
    std::vector<double> packed = n_meeting_;
    for (const Ranked& ranked : best_) {
        packed.push_back(static_cast<double>(ranked.point));
        packed.insert(packed.end(), ranked.row.begin(), ranked.row.end());
    }
    return packed;
}

Ranking Ranking::unpack(const RowLayout& layout, std::size_t n_best,
                        std::span<const double> packed) {
    Ranking ranking(layout, n_best);
    ranking.n_meeting_.assign(
        packed.begin(),
        packed.begin() + static_cast<std::ptrdiff_t>(layout.n_verdicts()));
    for (std::size_t at = layout.n_verdicts(); at < packed.size();
         at += 1 + layout.width()) {
        const auto row = packed.subspan(at + 1, layout.width());
        ranking.insert({static_cast<long long>(packed[at]), {row.begin(), row.end()}});
    }
    return ranking;
}

}  // namespace bemcal::calibration
