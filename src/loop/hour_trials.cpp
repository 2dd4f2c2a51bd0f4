/// Simulates all runs of hours of a schedule, eight at a time: a plan of the fast
/// simulation has the hours that all of them share, and each lane adds some at the ends.
/// Follows from physics::Change: an hour is a change of the schedule, by 0 or 1.
/// The parameters stay where they are; what they would follow is left to the caller.
#include "loop/hour_trials.hpp"

#include <algorithm>
#include <stdexcept>

namespace bemcal::loop {
namespace {

using physics::DailyRun;
using physics::DayKind;

constexpr int day_end = 24;

/// Hours that are told apart in one simulation: each takes a row that all steps read.
constexpr std::size_t hours_at_once = 4;

/// Runs that begin in the last hours before `from` and end in the first from `until` on.
struct Tile {
    int from, until;  ///< of the run that is in all of them
    int n_before, n_after;
};

/// \param n_before, n_after  how many may be told apart at either end
std::vector<Tile> tiles_of(const RunGrid& grid, int n_before, int n_after) {
    const int apart = grid.apart, last_from = std::min(grid.last_from, day_end - apart);
    std::vector<Tile> tiles;
    for (int first = grid.from; first <= last_from; first += (n_before + 1) * apart) {
        const int before = std::min(n_before, (last_from - first) / apart),
                  from = first + before * apart;
        for (int until = std::max(grid.until, from); until <= grid.last_until;
             until += (n_after + 1) * apart)
            tiles.push_back({from, until, before,
                             std::min(n_after, (grid.last_until - until) / apart)});
    }
    return tiles;
}

/// Simulates tile after tile.
class Trials {
  public:
    Trials(const HourModel& model, const std::vector<kernel::Channel>& channels,
           DayKind kind, const RunGrid& grid, std::span<const double> x)
        : model_(model),
          channels_(channels),
          kind_(kind),
          grid_(grid),
          building_(model.built.placed->building),
          drive_(model.built.placed->drive),
          parameters_(model.built.parameters) {
        for (std::size_t k = 0; k < x.size(); ++k)
            point_.push_back(model.built.unknowns[k].within(x[k]));
        add_hours();
    }

    void run(const SeeRun& see) {
        if (n_hours_ == 0) return;
        const int n_before = n_hours_ > 1 ? 1 : 0;
        const int n_after = static_cast<int>(n_hours_) - n_before;
        for (const Tile& tile : tiles_of(grid_, n_before, n_after)) run(tile, see);
    }

  private:
    /// Rows of hours.
    void add_hours() {
        const auto targets = physics::inputs_that_follow(
            building_, static_cast<int>(model_.schedule.profile()));
        n_hours_ = targets.empty() ? 0 : hours_at_once;
        first_row_ = drive_.profiles.rows;
        Matrix profiles(first_row_ + n_hours_, drive_.profiles.cols);
        std::ranges::copy(drive_.profiles.values, profiles.values.begin());
        drive_.profiles = std::move(profiles);
        for (std::size_t k = 0; k < n_hours_; ++k) add_hour(targets, first_row_ + k);
    }

    void add_hour(const std::vector<physics::Target>& targets, std::size_t row) {
        physics::Parameter hour;
        hour.name = "hour";
        for (physics::Target target : targets) {
            auto& changes = physics::input_at(building_, target)->changes;
            target.slot = physics::Slot::change;
            target.change = static_cast<int>(changes.size());
            changes.push_back({0, static_cast<int>(row), physics::ChangeKind::schedule});
            hour.targets.push_back(target);
        }
        parameters_.push_back(std::move(hour));
    }

    void write_row(std::size_t row, const std::vector<double>& values) {
        std::ranges::copy(values, drive_.profiles.row(row).begin());
    }

    /// The hours before the common run stand first.
    void write_rows(const Tile& tile) {
        physics::WeekHours common = model_.hours;
        common[static_cast<std::size_t>(kind_)] = {tile.from, tile.until};
        write_row(model_.schedule.profile(), model_.schedule.row_of(common));
        std::size_t row = first_row_;
        for (int k = 1; k <= tile.n_before; ++k) write_hours(row++, tile.from, -k);
        for (int k = 0; k < tile.n_after; ++k) write_hours(row++, tile.until, k);
    }

    /// Those between two runs of the grid: the so many-th from an hour on.
    void write_hours(std::size_t row, int hour, int so_many) {
        const int from = hour + so_many * grid_.apart;
        write_row(row, model_.schedule.added_by({from, from + grid_.apart}, kind_));
    }

    std::vector<double> point_of(const Tile& tile, int before, int after) const {
        std::vector<double> point = point_;
        for (int k = 0; k < static_cast<int>(n_hours_); ++k)
            point.push_back(
                k < before || (k >= tile.n_before && k < tile.n_before + after) ? 1 : 0);
        return point;
    }

    void run(const Tile& tile, const SeeRun& see) {
        write_rows(tile);
        std::vector<DailyRun> runs;
        Matrix points(static_cast<std::size_t>((tile.n_before + 1) * (tile.n_after + 1)),
                      parameters_.size());
        for (int before = 0; before <= tile.n_before; ++before)
            for (int after = 0; after <= tile.n_after; ++after) {
                std::ranges::copy(point_of(tile, before, after),
                                  points.row(runs.size()).begin());
                runs.push_back(
                    {tile.from - before * grid_.apart, tile.until + after * grid_.apart});
            }
        const study::FitModel fit_model(building_, parameters_, drive_, channels_);
        const Matrix predicted = fit_model.predict(points);
        for (std::size_t p = 0; p < runs.size(); ++p) {
            if (runs[p].is_off() && is_off_seen_) continue;
            if (runs[p].is_off()) is_off_seen_ = true, runs[p] = {};
            see(runs[p], predicted.row(p));
        }
    }

    const HourModel& model_;
    const std::vector<kernel::Channel>& channels_;
    DayKind kind_;
    RunGrid grid_;
    physics::Building building_;
    physics::Drive drive_;
    std::vector<physics::Parameter> parameters_;
    std::vector<double> point_;
    std::size_t n_hours_ = 0, first_row_ = 0;
    bool is_off_seen_ = false;  ///< many tiles have it
};

}  // namespace

ScheduleHours::ScheduleHours(const LoopData& data, std::size_t profile)
    : profile_(profile) {
    const study::Case& building = data.building;
    const auto row = numbered_row_of(building, profile);
    if (!row) throw std::logic_error("the hours of a schedule that are not numbered");
    numbered_row_ = *row;
    const auto numbers = data.drive->profiles.row(numbered_row_);
    numbers_.reserve(numbers.size());
    for (const double number : numbers) numbers_.push_back(static_cast<int>(number));
    const auto& week = building.profiles[profile].schedule.week;
    if (!physics::hours_of(building.profiles[profile].schedule)) return;  // all alike
    low_ = high_ = week[0][0];
    for (const physics::Day& day : week) {
        low_ = std::min(low_, std::ranges::min(day));
        high_ = std::max(high_, std::ranges::max(day));
    }
}

std::vector<double> ScheduleHours::levels_of(const physics::WeekHours& hours, double low,
                                             double high) const {
    std::vector<double> row;
    row.reserve(numbers_.size());
    for (const int number : numbers_)
        row.push_back(physics::runs_at(hours, number) ? high : low);
    return row;
}

std::vector<double> ScheduleHours::row_of(const physics::WeekHours& hours) const {
    return levels_of(hours, low_, high_);
}

std::vector<double> ScheduleHours::added_by(const physics::DailyRun& run,
                                            physics::DayKind kind) const {
    physics::WeekHours hours{};
    hours[static_cast<std::size_t>(kind)] = run;
    return levels_of(hours, 0, high_ - low_);
}

void try_runs(const HourModel& model, const std::vector<kernel::Channel>& channels,
              physics::DayKind kind, const RunGrid& grid, std::span<const double> x,
              const SeeRun& see) {
    Trials(model, channels, kind, grid, x).run(see);
}

}  // namespace bemcal::loop
