/// How well the description and the posterior's mean predict every meter, in training, in
/// what was held out of it and in the other periods, with coverage of the intervals.
/// Made from the stored `validation_fit` and `coverage`, which are not computed again.
/// Guideline 14's verdicts are as stored, too.
#include "base/nan.hpp"
#include "report/fit_words.hpp"
#include "report/interval_name.hpp"
#include "report/sections.hpp"
#include "report/text_table.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::report {
namespace {

/// The readings of a meter in a period, or those that were held out.
struct Part {
    Group meter, part;
    std::string place;  ///< "training/gas", "training/gas held_out_weeks"
};

std::string before_last_slash(const std::string& path) {
    return path.substr(0, path.rfind('/'));
}

/// All of a meter's readings are left out where training and held-out ones stand apart.
std::vector<Part> parts_of(const Group& study) {
    std::vector<Part> parts;
    for (const Group& part : study.groups_below("validation_fit")) {
        const std::string path = before_last_slash(part.path());
        if (path.size() <= study.path().size()) continue;  // of no meter
        const std::string name = part.path().substr(path.size() + 1);
        const std::string place = path.substr(study.path().size() + 1);
        const Group meter = study.inner(place);
        if (name != "all")
            parts.push_back({meter, part, fmt::format("{} {}", place, name)});
        else if (!meter.inner("training").has("validation_fit"))
            parts.push_back({meter, part, place});
    }
    return parts;
}

/// A number of a stored array, or NaN.
double at(const std::vector<double>& values, std::size_t k) {
    return k < values.size() ? values[k] : nan;
}

/// Before and after.
struct Pair {
    double before = nan, after = nan;
};

enum Resolution : std::size_t { own, daily, monthly, n_resolutions };

/// A metric by [version x resolution x metric].
Pair metric_of(const Group& part, Resolution resolution, const std::string& name) {
    const auto& names = part.texts("metric");
    const auto& values = part.values("validation_fit");
    const auto column =
        static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    if (column == names.size()) return {};
    const auto number = [&](std::size_t version) {
        return at(values, (version * n_resolutions + resolution) * names.size() + column);
    };
    return {number(0), number(1)};
}

std::string change_of(const Part& of, Resolution resolution, const char* metric) {
    const Pair share = metric_of(of.part, resolution, metric);
    return change(share.before, share.after);
}

/// By the hourly (0) or monthly (1) limits.
std::string verdict_by(const Group& part, std::size_t limits) {
    const auto& met = part.values("guideline_14_met");
    return verdict(at(met, limits) == 1, at(met, 2 + limits) == 1);
}

void add_row(TextTable& table, const Part& of, Resolution resolution,
             const std::string& interval, const std::string& verdict_text) {
    const double n = metric_of(of.part, resolution, "n").after;
    if (!(n > 0)) return;
    table.add({of.place, interval, in_short(n), change_of(of, resolution, "cv_rmse"),
               change_of(of, resolution, "nmbe"), verdict_text});
}

void add_fits(TextTable& table, const Part& of) {
    const std::string interval = interval_name(of.meter.values("time"));
    const bool is_fine = interval == "steps" || interval == "hourly";
    const bool is_coarse =
        interval == "monthly" || interval == "billed" || interval == "annual";
    add_row(table, of, own, interval, verdict_by(of.part, is_coarse ? 1 : 0));
    if (is_fine) add_row(table, of, daily, "daily", "");
    if (!is_coarse) add_row(table, of, monthly, "monthly", verdict_by(of.part, 1));
}

std::string text_of(const TextTable& table) {
    return table.is_empty() ? std::string() : table.text(44);
}

}  // namespace

std::string validation_tables(const Group& study) {
    TextTable fits(
        {"described -> posterior mean", "", "n", "CV(RMSE) %", "NMBE %", "G14"});
    TextTable coverage(
        {"readings within the intervals of", "50 %", "90 %", "months: 50 %", "90 %"});
    for (const Part& part : parts_of(study)) {
        add_fits(fits, part);
        const auto& shares = part.part.values("coverage");
        if (shares.empty()) continue;
        coverage.add({part.place, percent(at(shares, 0)), percent(at(shares, 1)),
                      percent(at(shares, 2)), percent(at(shares, 3))});
    }
    return text_of(fits) + (fits.is_empty() ? "" : guideline_note) + text_of(coverage);
}

}  // namespace bemcal::report
