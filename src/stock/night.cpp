/// A night in a building: tests, tells, and searches again only where a change has no
/// name yet. A change that the search does not name stays as a pattern of a meter. It has
/// no known shape, so what it leaves from then on may wander; it is told again only where
/// a step stands out of that.
/// Follows from stats::StepTest, at the false alarms that the stock allows in a week.
/// Left out: changes of readings in days that were known already, which only a search
/// sees.
#include "stock/night.hpp"

#include "base/error.hpp"
#include "base/machine.hpp"
#include "stats/distributions.hpp"
#include "stats/metrics.hpp"
#include "stock/look.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

namespace bemcal::stock {

namespace {

using Effect = StockRecord::Effect;
using Change = StockRecord::Change;

constexpr int most_steps = 4;      ///< told of a building in one night
constexpr double days_a_week = 7;  ///< the rate of false alarms is of a week
/// Of an effect, or of a pattern as it was: what is left below this has ended.
constexpr double nearly_nothing = 0.25;

std::string date(double day) {
    return physics::format_date(
        physics::Seconds(std::chrono::days(static_cast<int>(day))));
}

void tell(StockRecord& record, const std::string& sentence) {
    record.told += (record.told.empty() ? "" : "; ") + sentence;
}

/// How much of it there is by the changes: of an effect a share, of a pattern its size.
double amount_of(const Effect& effect, const std::vector<Change>& changes) {
    double amount = effect.section.empty() ? 0 : 1;
    for (const Change& change : changes)
        if (change.of == effect.name) amount += change.size;
    return amount;
}

Effect& effect_of(StockRecord& record, const Look::Found& found) {
    const auto there = std::ranges::find(record.effects, found.of, &Effect::name);
    if (there != record.effects.end()) return *there;
    return record.effects.emplace_back(Effect{found.of, found.unit, "new", "", 0, 0, 0});
}

/// A pattern's coefficient is what there is of it now.
void set_amount(Effect& effect, double amount, double sd) {
    effect.coefficient = amount;
    effect.low = amount - stats::z_90_two_sided * sd;
    effect.high = amount + stats::z_90_two_sided * sd;
}

/// With its unit, if it has one.
std::string with_unit(double value, const std::string& unit) {
    const bool has_none = unit.empty() || unit == "-";
    return fmt::format("{:.3g}{}{}", value, has_none ? "" : " ", has_none ? "" : unit);
}

std::string amount_in_words(const Effect& effect, double amount) {
    if (!effect.section.empty())
        return with_unit(amount * effect.coefficient, effect.unit);
    if (effect.unit == "1") return fmt::format("{:+.0f} %", 100 * amount);
    return (amount > 0 ? "+" : "") + with_unit(amount, effect.unit);
}

/// Into the record: the change, the effect's state, what is told.
void note(const Look::Found& found, StockRecord& record) {
    Effect& effect = effect_of(record, found);
    const bool is_named = !effect.section.empty();
    const double was = amount_of(effect, record.changes);
    double now = was + found.step.size;
    const double unsure = stats::z_90_two_sided * found.step.sd;
    const double usual = is_named ? 1 : std::abs(was);
    const bool is_new = !is_named && was == 0;
    // A pattern's size wanders: less than it may leave as it ends is no change of it.
    if (!is_named && was != 0 && std::abs(found.step.size) <= nearly_nothing * usual)
        return;
    // What has ended already does not end again: what is left of it is followed.
    if (was != 0 && std::abs(now) <= std::max(unsure, nearly_nothing * usual)) now = 0;
    record.changes.push_back({effect.name, found.day, now - was});
    effect.since = found.day;
    effect.state = now == 0 ? "ended" : is_new ? "new" : "changed";
    const std::string is = amount_in_words(effect, now),
                      before = amount_in_words(effect, was);
    if (now == 0)
        tell(record, fmt::format("ended: {}, on {}", effect.name, date(found.day)));
    else if (is_new)
        tell(record,
             fmt::format("new: {}, {}, since {}", effect.name, is, date(found.day)));
    else
        tell(record, fmt::format("changed: {}, from {} to {}, on {}", effect.name, before,
                                 is, date(found.day)));
    if (!is_named) set_amount(effect, now, found.step.sd);
}

/// Errors of the last days by each meter, beside those of training.
void renew_fits(const Look& look, double recent_days, StockRecord& record) {
    if (record.fits.empty() || recent_days <= 0) return;
    const std::string first = record.fits.front().period;
    std::erase_if(record.fits, [&](const auto& fit) { return fit.period != first; });
    const auto known = record.fits;
    const study::Case& building = look.building();
    const physics::Seconds from =
        building.periods.back().to - std::chrono::days(static_cast<int>(recent_days));
    for (const StockRecord::Fit& fit : known) {
        const auto meter =
            std::ranges::find(building.meters, fit.meter, &study::Meter::name);
        if (meter == building.meters.end()) continue;
        const DaySums::Series& series =
            look.sums().series[static_cast<std::size_t>(meter - building.meters.begin())];
        const auto at = static_cast<std::size_t>(
            std::ranges::lower_bound(series.begins, from) - series.begins.begin());
        const auto errors = stats::metrics_of(std::span(series.predicted).subspan(at),
                                              std::span(series.measured).subspan(at));
        StockRecord::Fit recent = fit;
        recent.period = recent_period;
        recent.n = errors.n;
        recent.measured =
            errors.cv_rmse > 0 ? errors.n * errors.rmse / errors.cv_rmse : 0;
        recent.cv_rmse = errors.cv_rmse;
        recent.nmbe = errors.nmbe;
        recent.before = errors.cv_rmse;  // nothing was calibrated
        record.fits.push_back(recent);
    }
}

/// What yesterday's record says of today, before anything is told.
StockRecord begin_from(const StockRecord& before) {
    StockRecord record = carried_over(before);
    record.age = record.simulations = 0;
    record.reason = record.drift = "";
    std::erase_if(record.findings, [](const study::DataDecision& finding) {
        return finding.series != "loop";
    });
    record.files.clear();
    record.daily.clear();
    return record;
}

bool has_effect(const StockRecord& record, const std::string& name) {
    return std::ranges::find(record.effects, name, &Effect::name) != record.effects.end();
}

bool has_name(const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
}

/// Names of effects that the other has not.
std::vector<std::string> names_beyond(const StockRecord& one, const StockRecord& other) {
    std::vector<std::string> names;
    for (const Effect& effect : one.effects)
        if (!has_effect(other, effect.name)) names.push_back(effect.name);
    return names;
}

class Night {
  public:
    Night(const job::Job& stock_job, const job::StockLine& line,
          const StockRecord& before, std::vector<input::InputFile>& log)
        : job_(stock_job),
          line_(line),
          before_(before),
          look_(stock_job, line, before, log) {}

    /// Whether there are days that were not tested yet, and can be.
    bool has_new_days() const { return n_new() > 0 && look_.sees_new_days(); }

    /// Of a file that has grown by what the building does not use, or was written anew.
    /// \param log  what was read for it
    bool has_same_data(const std::vector<input::InputFile>& log) const {
        return has_same_description(log) &&
               before_.data_hash == hash_of_data(look_.building());
    }

    Calibrated nothing() const {
        StockRecord record = carried_over(before_);
        record.status = "unchanged";
        record.reason = "";
        record.files.clear();
        return {record, {}};
    }

    Calibrated work() {
        StockRecord record = begin_from(before_);
        record.simulations = look_.n_simulations();
        const auto first = told_steps(record);
        record.tested_to = end();
        record.status = "tested";
        const study::Case& building = look_.building();
        record.findings.insert(record.findings.begin(), building.decisions.begin(),
                               building.decisions.end());
        record.data_hash = hash_of_data(building);
        sketch(building, record);
        renew_fits(look_, job_.stock->options.recent_days, record);
        return first ? searched(std::move(record), *first) : Calibrated{record, {}};
    }

  private:
    /// A building's own file says more than readings and weather.
    bool has_same_description(const std::vector<input::InputFile>& log) const {
        return std::ranges::all_of(log, [&](const input::InputFile& file) {
            return std::filesystem::path(file.path).extension() != ".toml" ||
                   std::ranges::find(before_.files, file.hash,
                                     &StockRecord::File::hash) != before_.files.end();
        });
    }

    double end() const { return day_of(look_.building().periods.back().to); }
    double n_new() const {
        return end() - std::max(before_.tested_to, day_of(known_of(before_).to));
    }

    /// The first of those without a name that is new.
    std::optional<Look::Found> told_steps(StockRecord& record) const {
        std::optional<Look::Found> unnamed;
        const double weeks = std::min(1.0, n_new() / days_a_week);
        for (int k = 0; k < most_steps; ++k) {
            const auto found = look_.next_step(record.changes, before_.changes,
                                               weeks * job_.stock->options.false_alarms);
            if (!found) break;
            const bool is_known = has_effect(record, found->of);
            note(*found, record);
            if (!is_known && !unnamed) unnamed = found;
        }
        return unnamed;
    }

    /// The search is asked for a name. What it says stands where it names an effect that
    /// there was not, and explains the days since better.
    Calibrated searched(StockRecord record, const Look::Found& unnamed) {
        const job::Adopted window{"", {}, job_.stock->options.window_days};
        std::vector<input::InputFile> log;
        Calibrated found;
        try {
            found = calibrate(job_, line_, &before_, log, &window);
        } catch (const std::exception& error) {
            rethrow_unless_answer(error);
            record.findings.push_back(
                {"loop", fmt::format("the search failed: {}", error.what()), "kept"});
            return {record, {}};
        }
        record.searches = 1;
        record.simulations += found.record.simulations;
        const auto names = names_beyond(found.record, before_);
        if (names.empty() || !explains(found.record, unnamed.day, record.changes))
            return {record, {}};
        take(record, names, unnamed.day, found.record);
        return found;
    }

    bool explains(const StockRecord& found, double day,
                  const std::vector<Change>& changes) const {
        std::vector<input::InputFile> log;
        const study::Case building =
            adopted_building(job_, line_, found, known_of(before_), log);
        return look_.misfit_from(day, day_sums(building)) <
               look_.misfit_from(day, changes);
    }

    /// The search's record, with what the night has told.
    static void take(const StockRecord& tested, const std::vector<std::string>& names,
                     double day, StockRecord& found) {
        found.status = "calibrated";
        found.adopted_hash = tested.adopted_hash;
        found.simulations = tested.simulations;
        found.tested_to = tested.tested_to;
        found.told = tested.told;
        for (Effect& effect : found.effects) {
            const bool is_new = has_name(names, effect.name);
            effect.state = is_new ? "new" : "holds";
            if (!is_new) continue;
            effect.since = day;
            tell(found, fmt::format("named: {}, {}", effect.name,
                                    with_unit(effect.coefficient, effect.unit)));
        }
    }

    const job::Job& job_;
    const job::StockLine& line_;
    const StockRecord& before_;
    Look look_;
};

/// What a search finds where nothing was tested: against what there was, if anything.
void tell_search(const StockRecord* before, StockRecord& record) {
    const StockRecord nothing;
    const StockRecord& was = before != nullptr ? *before : nothing;
    const auto names = names_beyond(record, was);
    for (Effect& effect : record.effects) {
        if (!has_name(names, effect.name)) {
            effect.state = "holds";
            continue;
        }
        tell(record, fmt::format("new: {}, {}", effect.name,
                                 with_unit(effect.coefficient, effect.unit)));
    }
    for (const std::string& name : names_beyond(was, record))
        tell(record, fmt::format("not found again: {}", name));
}

bool can_test(const job::Stock& stock, const StockRecord* before,
              const std::string& follows) {
    return before != nullptr && !before->is_failed() && stock.options.false_alarms > 0 &&
           before->adopted_hash == follows && before->known_to > before->known_from;
}

}  // namespace

Calibrated work_through(const job::Job& stock_job, const job::StockLine& line,
                        const StockRecord* before, const std::string& follows,
                        std::vector<input::InputFile>& log) {
    if (can_test(*stock_job.stock, before, follows)) {
        Night night(stock_job, line, *before, log);
        if (night.has_new_days()) return night.work();
        if (night.has_same_data(log)) return night.nothing();
    }
    Calibrated result = calibrate(stock_job, line, before, log);
    result.record.status = "calibrated";
    result.record.adopted_hash = follows;
    tell_search(before, result.record);
    return result;
}

}  // namespace bemcal::stock
