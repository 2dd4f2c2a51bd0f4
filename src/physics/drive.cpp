/// Lays weather, schedules and series on the steps of a run. All is first laid without
/// gaps on the steps that it is taken from (`source`); the drive's steps pick from there,
/// a repeated warm-up some of them twice.
/// Plain bookkeeping without a source. Nothing is filled in: a needed value that is
/// missing is an error. Weather must be hourly; filling it is left to weather.cpp.
#include "physics/drive.hpp"

#include "physics/moist_air.hpp"
#include "physics/season.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::physics {
namespace {

using std::chrono::seconds;

struct Span {
    Seconds from, to;
};

[[noreturn]] void fail(const std::string& message) {
    throw std::invalid_argument(message);
}

std::string describe(Span span) {
    return fmt::format("{} to {}", format_time(span.from), format_time(span.to));
}

bool covers(const TimeAxis& axis, Span span) {
    return axis.start <= span.from && span.to <= axis.end();
}

std::string weather_span(const Weather& weather) {
    return describe({weather.axis.start, weather.axis.end()});
}

void check_period(const Weather& weather, Span period, int step_s, int n_warm_up_hours) {
    if (step_s <= 0 || 3600 % step_s != 0)
        fail(fmt::format("a step of {} s: expected one that divides 3600 s", step_s));
    if (n_warm_up_hours < 0) fail("the warm-up must not be negative");
    if (weather.axis.step_s != 3600) fail("the weather must be hourly");
    if (period.from >= period.to)
        fail(fmt::format("the period {} is empty or reversed", describe(period)));
    if (!covers(weather.axis, period))
        fail(fmt::format("the weather covers {}, but the period is {}",
                         weather_span(weather), describe(period)));
    if ((period.from - weather.axis.start).count() % step_s != 0 ||
        (period.to - period.from).count() % step_s != 0)
        fail(fmt::format("the period {} does not begin and end with a step of {} s",
                         describe(period), step_s));
}

void check_size(const TimeAxis& axis, const std::vector<double>& values,
                const std::string& name) {
    if (values.size() != static_cast<std::size_t>(axis.n_steps))
        fail(fmt::format("{} has {} values for {} steps", name, values.size(),
                         axis.n_steps));
}

void check_sizes(const Weather& weather, const Building& building,
                 const std::vector<Profile>& profiles) {
    check_size(weather.axis, weather.theta_e, "outdoor temperature");
    if (!building.planes.empty()) {
        check_size(weather.axis, weather.direct_normal, "direct irradiance");
        check_size(weather.axis, weather.diffuse_horizontal, "diffuse irradiance");
        check_size(weather.axis, weather.global_horizontal, "global irradiance");
    }
    for (const Profile& profile : profiles)
        if (profile.is_series)
            check_size(profile.axis, profile.values,
                       fmt::format("series '{}'", profile.name));
}

/// Calls `look` with the axis and the values of all that is needed of weather and series.
template <class Look>
void for_each_series(const Weather& weather, const Building& building,
                     const std::vector<Profile>& profiles, Look look) {
    look(weather.axis, weather.theta_e);
    for (const auto* series : {&weather.direct_normal, &weather.diffuse_horizontal,
                               &weather.global_horizontal})
        if (!building.planes.empty()) look(weather.axis, *series);
    for (const Profile& profile : profiles)
        if (profile.is_series) look(profile.axis, profile.values);
}

/// A needed value of a series; says which and when where it is missing.
double needed(const TimeAxis& axis, const std::vector<double>& values, int step,
              const std::string& name) {
    const double value = values[static_cast<std::size_t>(step)];
    if (std::isnan(value))
        fail(fmt::format("{} is missing at {}", name, format_time(axis.begin_of(step))));
    return value;
}

/// Air temperature at an instant: linear between the hours' middles.
double temperature_at(const Weather& weather, Seconds time) {
    const int hour = weather.axis.step_of(time);
    const double here =
        needed(weather.axis, weather.theta_e, hour, "outdoor temperature");
    const double offset =
        static_cast<double>((time - weather.axis.begin_of(hour)).count()) / 3600 - 0.5;
    const int neighbour = offset < 0 ? hour - 1 : hour + 1;
    if (neighbour < 0 || neighbour >= weather.axis.n_steps) return here;
    const double there = weather.theta_e[static_cast<std::size_t>(neighbour)];
    return std::isnan(there) ? here : here + std::abs(offset) * (there - here);
}

std::vector<double> temperatures(const Weather& weather, const TimeAxis& source) {
    std::vector<double> theta_e(static_cast<std::size_t>(source.n_steps));
    for (int k = 0; k < source.n_steps; ++k) {
        const Seconds middle = source.begin_of(k) + seconds(source.step_s / 2);
        theta_e[static_cast<std::size_t>(k)] = temperature_at(weather, middle);
    }
    return theta_e;
}

/// Humidity ratio of outdoor air; an hour's value holds for its steps. A missing one is
/// that of the hour before, or of the first that is there. Empty where none is.
std::vector<double> humidity_ratios(const Weather& weather, const TimeAxis& source) {
    const std::vector<double>& relative = weather.relative_humidity;
    const double pressure = standard_pressure(weather.site.elevation);
    std::vector<double> w(relative.size());
    for (std::size_t k = 0; k < w.size(); ++k)
        w[k] = humidity_ratio(relative[k] / 100 * saturation_pressure(weather.theta_e[k]),
                              pressure);
    const auto is_known = [](double value) { return !std::isnan(value); };
    const auto first = std::ranges::find_if(w, is_known);
    if (first == w.end()) return {};
    std::fill(w.begin(), first, *first);
    for (std::size_t k = 1; k < w.size(); ++k)
        if (!is_known(w[k])) w[k] = w[k - 1];
    std::vector<double> of_steps(static_cast<std::size_t>(source.n_steps));
    for (int k = 0; k < source.n_steps; ++k)
        of_steps[static_cast<std::size_t>(k)] =
            w[static_cast<std::size_t>(weather.axis.step_of(source.begin_of(k)))];
    return of_steps;
}

/// The weather of the hours that `source` touches, with nothing missing.
Weather weather_on(const Weather& weather, const TimeAxis& source) {
    const int first = weather.axis.step_of(source.start);
    const int last = weather.axis.step_of(source.end() - seconds(1));
    Weather part;
    part.site = weather.site;
    part.axis = {weather.axis.begin_of(first), 3600, last - first + 1};
    const auto cut = [&](const std::vector<double>& from, const char* name) {
        std::vector<double> values;
        for (int k = first; k <= last; ++k)
            values.push_back(needed(weather.axis, from, k, name));
        return values;
    };
    part.direct_normal = cut(weather.direct_normal, "direct irradiance");
    part.diffuse_horizontal = cut(weather.diffuse_horizontal, "diffuse irradiance");
    part.global_horizontal = cut(weather.global_horizontal, "global irradiance");
    return part;
}

/// The same as the next one, from the series of the whole weather.
Matrix known_irradiances(const Weather& weather, const std::vector<Plane>& planes,
                         const TimeAxis& source, SkyModel sky, PlaneSource& known) {
    Matrix result(planes.size(), static_cast<std::size_t>(source.n_steps));
    for (std::size_t p = 0; p < planes.size(); ++p) {
        const PlaneSource::Series hourly = known.series(planes[p], sky);
        for (int k = 0; k < source.n_steps; ++k)
            result(p, static_cast<std::size_t>(k)) = (*hourly)[static_cast<std::size_t>(
                weather.axis.step_of(source.begin_of(k)))];
    }
    return result;
}

/// Irradiance of each plane on the source steps; an hour's value holds for its steps.
Matrix irradiances(const Weather& weather, const std::vector<Plane>& planes,
                   const TimeAxis& source, SkyModel sky, PlaneSource* known) {
    Matrix result(planes.size(), static_cast<std::size_t>(source.n_steps));
    if (planes.empty()) return result;
    const Weather part = weather_on(weather, source);
    if (known != nullptr) return known_irradiances(weather, planes, source, sky, *known);
    const std::vector<StepSun> suns = step_suns(part.site, part.axis);
    for (std::size_t p = 0; p < planes.size(); ++p) {
        const std::vector<double> hourly = irradiance_series(part, suns, planes[p], sky);
        for (int k = 0; k < source.n_steps; ++k)
            result(p, static_cast<std::size_t>(k)) =
                hourly[static_cast<std::size_t>(part.axis.step_of(source.begin_of(k)))];
    }
    return result;
}

/// A series on the source steps: held where its steps are longer, their mean where
/// shorter.
std::vector<double> series_on(const Profile& profile, const TimeAxis& source) {
    const Span span{source.start, source.end()};
    if (!covers(profile.axis, span))
        fail(fmt::format("series '{}' covers {}, but {} is needed", profile.name,
                         describe({profile.axis.start, profile.axis.end()}),
                         describe(span)));
    const std::string name = fmt::format("series '{}'", profile.name);
    std::vector<double> values(static_cast<std::size_t>(source.n_steps));
    for (int k = 0; k < source.n_steps; ++k) {
        const int first = profile.axis.step_of(source.begin_of(k));
        const int last = profile.axis.step_of(source.begin_of(k + 1) - seconds(1));
        double sum = 0;
        for (int i = first; i <= last; ++i)
            sum += needed(profile.axis, profile.values, i, name);
        values[static_cast<std::size_t>(k)] = sum / (last - first + 1);
    }
    return values;
}

Matrix profile_values(const std::vector<Profile>& profiles, const TimeAxis& source,
                      double utc_offset_h) {
    Matrix result(profiles.size(), static_cast<std::size_t>(source.n_steps));
    for (std::size_t p = 0; p < profiles.size(); ++p) {
        const std::vector<double> values =
            profiles[p].is_series ? series_on(profiles[p], source)
                                  : values_of(profiles[p].schedule, source, utc_offset_h);
        std::copy(values.begin(), values.end(), result.row(p).begin());
    }
    return result;
}

/// The source step of every step of the drive.
struct Layout {
    TimeAxis source;
    std::vector<std::size_t> pick;
};

/// The warm-up ends with the real steps before the period, as far as they are known.
/// Before these it repeats days of the period, the last of them just before its begin, at
/// the same hours of the day: its first ones; of a year those 52 weeks later, so that the
/// first month does not begin as if it had been there before.
Layout lay_out(Span period, int step_s, int n_warm_up, int n_real) {
    const auto count = static_cast<int>((period.to - period.from).count() / step_s);
    const int per_day = day_s / step_s;
    const int year = 52 * 7 * per_day;
    const int days = std::min((n_warm_up + per_day - 1) / per_day, count / per_day);
    const int repeated = count >= year ? year : days > 0 ? days * per_day : count;
    Layout layout;
    layout.source = {period.from - seconds(static_cast<long long>(n_real) * step_s),
                     step_s, count + n_real};
    for (int k = -n_warm_up; k < count; ++k) {
        const int step = k >= -n_real ? k : (repeated - (-k) % repeated) % repeated;
        layout.pick.push_back(static_cast<std::size_t>(step + n_real));
    }
    return layout;
}

template <class From, class To>
void gather(const From& from, const std::vector<std::size_t>& pick, To&& to) {
    for (std::size_t k = 0; k < pick.size(); ++k) to[k] = from[pick[k]];
}

Matrix gather_rows(const Matrix& from, const std::vector<std::size_t>& pick) {
    Matrix to(from.rows, pick.size());
    for (std::size_t r = 0; r < from.rows; ++r) gather(from.row(r), pick, to.row(r));
    return to;
}

}  // namespace

double Drive::changed(const Input& input, int step) const {
    double profile = input.profile < 0 ? 1 : profile_at(input.profile, step);
    double factor = 1, shift = 0;
    for (const Change& change : input.changes) {
        const double brought = change.amount * profile_at(change.profile, step);
        double& sum = change.kind == ChangeKind::shift    ? shift
                      : change.kind == ChangeKind::factor ? factor
                                                          : profile;
        sum += brought;
    }
    return (input.low + (input.value - input.low) * profile) * factor + shift;
}

int known_hours_before(const Weather& weather, const Building& building,
                       const std::vector<Profile>& profiles, Seconds from, int most) {
    Seconds begin = from - std::chrono::hours(most);
    for_each_series(weather, building, profiles,
                    [&](const TimeAxis& axis, const std::vector<double>& values) {
                        int step =
                            std::min(axis.step_of(from - seconds(1)), axis.n_steps - 1);
                        while (step >= 0 && axis.begin_of(step) >= begin &&
                               !std::isnan(values[static_cast<std::size_t>(step)]))
                            --step;
                        begin = std::max(begin, axis.begin_of(step + 1));
                    });
    return std::max(0, static_cast<int>((from - begin) / std::chrono::hours(1)));
}

Drive make_drive(const Weather& weather, const Building& building,
                 const std::vector<Profile>& profiles, Seconds from, Seconds to,
                 int step_s, int n_warm_up_hours, SkyModel sky, PlaneSource* planes) {
    check_period(weather, {from, to}, step_s, n_warm_up_hours);
    check_sizes(weather, building, profiles);
    const int per_hour = 3600 / step_s, n_warm_up = n_warm_up_hours * per_hour;
    const int n_real =
        per_hour * known_hours_before(weather, building, profiles, from, n_warm_up_hours);
    const Layout layout = lay_out({from, to}, step_s, n_warm_up, n_real);

    Drive drive;
    drive.axis = {from - std::chrono::hours(n_warm_up_hours), step_s,
                  static_cast<int>(layout.pick.size())};
    drive.n_warm_up = n_warm_up;
    drive.theta_e.resize(layout.pick.size());
    gather(temperatures(weather, layout.source), layout.pick, drive.theta_e);
    drive.theta_rm.resize(layout.pick.size());
    gather(running_means(weather, layout.source), layout.pick, drive.theta_rm);
    drive.pressure = standard_pressure(weather.site.elevation);
    if (const auto w = humidity_ratios(weather, layout.source); !w.empty()) {
        drive.w_e.resize(layout.pick.size());
        gather(w, layout.pick, drive.w_e);
    }
    drive.irradiance = gather_rows(
        irradiances(weather, building.planes, layout.source, sky, planes), layout.pick);
    drive.profiles = gather_rows(
        profile_values(profiles, layout.source, weather.site.utc_offset_h), layout.pick);
    return drive;
}

}  // namespace bemcal::physics
