/// Writes a building's TOML from a few columns of a table: a box with four equal facades,
/// an office's schedules, and parameters that take up what a box misses.
/// Follows from guesses for what is not said; of gas units the one is taken that makes a
/// year's gas nearest to 160 kWh/m2.
/// Leaves out cooling, neighbours, and other uses than offices', but for their hours.
#include "job/stock_description.hpp"

#include "base/machine.hpp"
#include "description/stock_readings.hpp"
#include "description/timed_csv.hpp"
#include "input/units.hpp"
#include "physics/calendar.hpp"
#include "physics/week_hours.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

/// An office's hours, where the line does not leave them to be learned.
constexpr const char* office_hours_text = R"(
[[schedule]]
name = "day"
summer_time = "eu"
weekdays = [0, 0, 0, 0, 0, 0.5, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0.5, 0, 0, 0, 0, 0]
weekend = 0
[[schedule]]
name = "occupied"
summer_time = "eu"
weekdays = [0, 0, 0, 0, 0, 0, 0, 0.2, 0.6, 1, 1, 1, 1, 1, 1, 1, 1, 0.7, 0.3, 0.1, 0, 0, 0, 0]
weekend = 0.1
)";

/// What the box does not take from the line: ranges.
constexpr const char* common_text = R"(
[[parameter]]
name = "envelope"
target = ["construction.*.u_value", "glazing.window.u_value"]
mode = "factor"
min = 0.4
max = 2.0
[[parameter]]
name = "g_window"
target = "glazing.window.solar_transmittance"
min = 0.1
max = 0.8
[[parameter]]
name = "infiltration"
target = "zone.building.flow.infiltration.air_change"
min = 0.1
max = 2.0
[[parameter]]
name = "ventilation"
target = "zone.building.flow.ventilation.air_change"
min = 0
max = 4
[[parameter]]
name = "set_point"
target = "zone.building.heating_set_point"
mode = "offset"
min = -3
max = 3
[[parameter]]
name = "set_back"
target = "zone.building.heating_set_point.low"
mode = "offset"
min = -5
max = 3
[[parameter]]
name = "heat_capacity"
target = "zone.building.heat_capacity"
min = 80000
max = 600000
)";

struct MeterKind {
    const char* name;  ///< in a stock's line
    physics::Quantity quantity;
};
constexpr MeterKind meter_kinds[] = {{"gas", physics::Quantity::gas},
                                     {"electricity", physics::Quantity::electricity},
                                     {"heat", physics::Quantity::district}};

struct GasUnit {
    const char* unit;
    double kwh;
};
constexpr GasUnit gas_units[] = {{"kWh", 1}, {"m3", 11.22}, {"100 ft3", 31.77}};
constexpr double usual_gas = 160;       ///< [kWh/(m2 a)] of a heated building, about
constexpr double large_building = 2e4;  ///< [m2] that are hardly one building

/// Of the box: what a column's number may be. Wide enough for a hut and for an airport; a
/// decimal comma, a percentage or square feet lie outside of most.
struct BoxNumber {
    const char *column, *unit;
    double least, most;
};
constexpr BoxNumber box_numbers[] = {{"floor_area", " m2", 5, 1e7},
                                     {"floors", "", 1, 200},
                                     {"height", " m of a storey", 1.5, 30},
                                     {"glass_share", " of the walls", 0, 0.95},
                                     {"u_wall", " W/(m2 K)", 0.05, 10},
                                     {"u_roof", " W/(m2 K)", 0.05, 10},
                                     {"u_floor", " W/(m2 K)", 0.05, 10},
                                     {"u_window", " W/(m2 K)", 0.3, 10},
                                     {"efficiency", "", 0.1, 10}};

/// Other columns than those of numbers, keys of meters, of the weather and of holidays.
constexpr const char* other_columns[] = {"name",
                                         "id",
                                         "building",
                                         "floor_area_m2",
                                         "class",
                                         "weather",
                                         "outdoor_temperature",
                                         "global_horizontal",
                                         "direct_normal",
                                         "diffuse_horizontal",
                                         "cloud_cover",
                                         "global_horizontal_stamp",
                                         "direct_normal_stamp",
                                         "diffuse_horizontal_stamp",
                                         "cloud_cover_stamp",
                                         "latitude",
                                         "longitude",
                                         "utc_offset",
                                         "elevation",
                                         "from",
                                         "to",
                                         "hours",
                                         "use",
                                         "interval",
                                         "estimated",
                                         "year"};

/// Keys of a meter, and of the weather, that the line says in other ways or not at all.
constexpr std::string_view own_of_meter[] = {"name", "quantity", "file"};
constexpr std::string_view own_of_weather[] = {"files", "format", "columns",
                                               "temperature", "year"};

class Writer {
  public:
    Writer(const Stock& stock, const StockLine& line, input::InputFiles& files)
        : stock_(stock), line_(line), files_(files) {}

    Description write() {
        floor_area_ = floor_area();
        for (const MeterKind& kind : meter_kinds)
            if (!line_.cell(kind.name).empty()) add_meter(kind);
        if (meters_.empty())
            fail("gas",
                 "there is no meter; expected a file under gas, electricity or heat");
        doubt_single_meter();
        doubt_ends();
        add_place();
        add_holidays();
        add_periods();
        add_envelope();
        add_zone();
        return {text_ + hours_text() + common_text + load_parameters() +
                    gas_parameters() + meters_,
                std::move(decisions_)};
    }

  private:
    [[noreturn]] void fail(const std::string& column, const std::string& message) const {
        throw UserError(ExitCode::data,
                        fmt::format("{}:{}: {}: {}", stock_.table.string(), line_.line,
                                    column, message));
    }

    double number_of(const std::string& column, const std::string& cell) const {
        double value = 0;
        const char* end = cell.data() + cell.size();
        const auto [at, error] = std::from_chars(cell.data(), end, value);
        if (error != std::errc() || at != end || !std::isfinite(value))
            fail(column,
                 fmt::format("\"{}\" is not a number; expected one such as 1200.5, "
                             "without a unit or a mark of thousands",
                             cell.substr(0, 40)));
        return value;
    }

    /// In the range of its kind.
    double number_of(const BoxNumber& kind, const std::string& column,
                     const std::string& cell) const {
        const double value = number_of(column, cell);
        if (value < kind.least || value > kind.most)
            fail(column, fmt::format("{}: expected {:g} to {:g}{}", cell, kind.least,
                                     kind.most, kind.unit));
        return value;
    }

    double number(const char* column, double fallback) const {
        const std::string cell = line_.cell(column);
        if (cell.empty()) return fallback;
        const auto* kind = std::ranges::find(
            box_numbers, std::string_view(column),
            [](const BoxNumber& box) { return std::string_view(box.column); });
        return number_of(*kind, column, cell);
    }

    double floor_area() const {
        for (const char* name : {box_numbers[0].column, "floor_area_m2"})
            if (const std::string cell = line_.cell(name); !cell.empty())
                return number_of(box_numbers[0], name, cell);
        fail(box_numbers[0].column, "is missing");
    }

    std::string word(const std::string& column, const std::string& fallback) const {
        const std::string cell = line_.cell(column);
        if (cell.find_first_of("\"\\\n") != std::string::npos)
            fail(column, "holds a quote or backslash");
        return cell.empty() ? fallback : cell;
    }

    std::filesystem::path path(const std::string& column) const {
        return stock_.table.parent_path() / line_.cell(column);
    }

    void decide(const std::string& series, std::string finding, std::string action) {
        decisions_.push_back({series, std::move(finding), std::move(action)});
    }

    /// A cell as the schema's row wants it written.
    std::string toml_of(const schema::Key& key, const std::string& column) const {
        using schema::Type;
        const std::string cell = word(column, "");
        const bool is_number = key.type == Type::number || key.type == Type::integer;
        if (is_number) number_of(column, cell);
        const bool begins_so =
            cell.find_first_not_of("+-.0123456789") == std::string::npos;
        const bool plain =
            is_number || key.type == Type::flag || (key.type == Type::words && begins_so);
        return fmt::format("{} = {}\n", key.key, plain ? cell : '"' + cell + '"');
    }

    /// Keys of a section that columns of the name PREFIX_KEY say.
    std::string said_keys(const std::string& prefix, const char* section,
                          const std::vector<std::string_view>& own) const {
        std::string text;
        for (const schema::Key& key : schema::job_table().keys_of(section)) {
            const std::string column = prefix + "_" + key.key;
            const bool is_own = std::ranges::find(own, key.key) != own.end();
            if (is_own || key.type == schema::Type::tables) continue;
            if (!line_.cell(column).empty()) text += toml_of(key, column);
        }
        return text;
    }

    /// What the meter's section says of its file, before its unit.
    std::string meter_text(const MeterKind& kind, const std::string& column) const {
        const std::string name = kind.name;
        std::string text = fmt::format(
            "[[meter]]\nname = \"{}\"\nquantity = \"{}\"\nfile = \"{}\"\ncolumn = "
            "\"{}\"\n",
            name, physics::name_of(kind.quantity), word(name, ""), column);
        text += said_keys(name, "meter", {"name", "quantity", "file", "column", "unit"});
        for (const char* key : {"interval", "estimated"})
            if (line_.cell(fmt::format("{}_{}", name, key)).empty() &&
                !line_.cell(key).empty())
                text += fmt::format("{} = \"{}\"\n", key, word(key, ""));
        return text;
    }

    /// The readings as the reader of meters will find them.
    description::ReadingsLook look_at(const std::string& text,
                                      const std::string& column) {
        const std::string file = fmt::format("{}:{}", stock_.table.string(), line_.line);
        const schema::Node tree = schema::parse_document(text, file);
        const schema::Section root(tree, "building", file);
        const schema::Section section = root.tables("meter", "meter").at(0);
        const auto interval = section.choice_as<physics::Interval>("interval");
        const bool counts = section.choice("register") == "difference";
        const description::LookColumns columns{
            {section.text("from"), section.text("to"), section.text("estimated")},
            interval,
            counts};
        factor_ = section.number("factor");
        const bool is_long = interval > physics::Interval::hourly;
        const description::OpenOptions options{is_long ? 31 * physics::day_s : 3600,
                                               false,
                                               column,
                                               is_long,
                                               columns.bills.from,
                                               columns.bills.to,
                                               counts};
        const description::TimedCsv source = description::open_csv(
            section, "file", section.text("file"), files_, physics::Site{}, options);
        const input::Csv& csv = *source.csv;
        return description::look_at(
            {csv, source.stamps, source.rules,
             input::numbers_in(csv, csv.column(column), source.numbers)},
            columns);
    }

    void add_meter(const MeterKind& kind) {
        const std::string name = kind.name;
        const std::string column = word(name + "_column", line_.name);
        const std::string text = meter_text(kind, column);
        const description::ReadingsLook look = look_at(text, column);
        if (look.last_day.empty())
            fail(name,
                 fmt::format("{} has no reading of {}", path(name).string(), column));
        first_day_ = std::max(first_day_, look.first_day);
        last_day_ =
            last_day_.empty() ? look.last_day : std::min(last_day_, look.last_day);
        if (bounds_.empty()) bounds_ = look.bounds;
        last_days_.emplace_back(name, look.last_day);
        std::string unit = word(name + "_unit", "kWh");
        if (unit == "auto") unit = chosen_unit(name, look);
        if (const double used = kwh_of(look, unit); name == "electricity" && used > 0)
            mean_load_ = std::clamp(1000 * used / look.hours / floor_area_, 2.0, 500.0);
        if (look.quantum > 0)
            decide(name,
                   fmt::format("{:.1f} % of its readings are whole multiples of {:.4g}",
                               100 * look.quantum_share, look.quantum),
                   "kept; shared: a share of another meter's pulses, or a conversion");
        has_gas_ = has_gas_ || name == "gas";
        meters_ += fmt::format("{}unit = \"{}\"\n", text, unit);
    }

    /// Of an unknown unit as many; the meter's section refuses it.
    double kwh_of(const description::ReadingsLook& look, const std::string& name) const {
        const input::Unit* unit = input::find_unit(name);
        if (unit == nullptr) return factor_ * look.total;
        const bool is_power = unit->kind == input::UnitKind::power;
        return factor_ * unit->factor * look.total * (is_power ? look.hours_each : 1);
    }

    /// Readings of one meter that stop end the periods of all.
    void doubt_ends() {
        for (const auto& [name, day] : last_days_)
            for (const auto& [other, later] : last_days_) {
                const auto apart = std::chrono::floor<std::chrono::days>(
                    physics::parse_time(later) - physics::parse_time(day));
                if (apart.count() <= most_days_late) continue;
                decide(name,
                       fmt::format("its readings end on {}, {} days before those of {}",
                                   day, apart.count(), other),
                       "the periods end there; without this meter they would go on");
            }
    }

    /// By a year's gas of a square metre; says what the others would make of it.
    std::string chosen_unit(const std::string& name,
                            const description::ReadingsLook& look) {
        const double year = factor_ * look.total / look.hours * 8760 / floor_area_;
        const auto oddity = [&](const GasUnit& unit) {
            return std::abs(std::log(std::max(year * unit.kwh, 1e-9) / usual_gas));
        };
        const GasUnit* best = &gas_units[0];
        std::string all;
        for (const GasUnit& unit : gas_units) {
            if (oddity(unit) < oddity(*best)) best = &unit;
            all += fmt::format("{}{:.3g} as {}", all.empty() ? "" : ", ", year * unit.kwh,
                               unit.unit);
        }
        decide(name, fmt::format("its unit is not said; kWh a year and m2: {}", all),
               fmt::format("unit: taken as {}; {}_unit says it", best->unit, name));
        return best->unit;
    }

    /// A site's meter reads like a building's.
    void doubt_single_meter() {
        const bool others_have = line_.has("electricity");
        if (floor_area_ < large_building || !has_gas_ || !others_have ||
            !line_.cell("electricity").empty())
            return;
        decide("gas",
               fmt::format("{:.0f} m2 and no electricity of its own, which others of the "
                           "stock have",
                           floor_area_),
               "kept; shared: it may be the meter of several buildings");
    }

    void add_place() {
        const std::string file = word("weather", "");
        if (file.empty()) fail("weather", "is missing");
        const std::string temperature = word("outdoor_temperature", "");
        for (const char* key : {"latitude", "longitude", "utc_offset", "elevation"})
            if (const std::string cell = line_.cell(key); !cell.empty())
                site_ += fmt::format("{} = {}\n", key, number_of(key, cell));
        if (!temperature.empty() && line_.cell("utc_offset").empty())
            site_ += "utc_offset = 0\n";
        if (!site_.empty()) text_ += "[site]\n" + site_;
        text_ += "[weather]\n" + weather_files(file);
        std::vector<std::string_view> own(std::begin(own_of_weather),
                                          std::end(own_of_weather));
        if (!temperature.empty()) own.emplace_back("fill_gaps");
        text_ += said_keys("weather", "weather", own);
        if (temperature.empty()) return;
        text_ += "format = \"csv\"\ntemperature = \"hour_mean\"\nfill_gaps = 48\n";
        text_ +=
            fmt::format("[weather.columns]\noutdoor_temperature = \"{}\"\n", temperature);
        for (const char* key :
             {"global_horizontal", "direct_normal", "diffuse_horizontal", "cloud_cover"})
            if (const std::string column = word(key, ""); !column.empty())
                text_ += fmt::format("{} = {{column = \"{}\", stamp = \"{}\"}}\n", key,
                                     column, word(std::string(key) + "_stamp", "start"));
    }

    /// Of plant and use alike.
    std::string hours_text() const {
        const std::string hours = word("hours", ""), use = word("use", "");
        if (hours.empty() && !use.empty())
            fail("use",
                 "has no effect without the column hours = learn; an office's "
                 "hours are taken where it is left out");
        if (hours.empty()) return office_hours_text;
        if (hours != "learn")
            fail("hours", fmt::format("\"{}\" is no way to say hours; expected learn, or "
                                      "nothing for an office's",
                                      hours));
        if (!use.empty() && !physics::usual_hours(use))
            fail("use", fmt::format("\"{}\" is no use that has usual hours; expected "
                                    "office, home, school or shop",
                                    use));
        std::string text;
        for (const char* name : {"day", "occupied"})
            text += fmt::format(
                "[[schedule]]\nname = \"{}\"\nsummer_time = \"eu\"\nhours = "
                "\"learn\"\nuse = \"{}\"\n",
                name, use.empty() ? "office" : use);
        return text;
    }

    void add_holidays() {
        const std::string keys = said_keys("holidays", "holidays", {});
        if (!keys.empty()) text_ += "[holidays]\n" + keys;
    }

    /// A typical year's file stands for every year from `year` to that of the last day.
    std::string weather_files(const std::string& file) const {
        if (line_.cell("year").empty()) return fmt::format("files = [\"{}\"]\n", file);
        const auto year = static_cast<int>(number_of("year", line_.cell("year")));
        const int last = physics::calendar_step(day_in("to", last_day_)).year;
        std::string names;
        for (int k = year; k <= std::clamp(last, year, year + 50); ++k)
            names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", file);
        return fmt::format("files = [{}]\nyear = {}\n", names, year);
    }

    physics::Seconds day_in(const std::string& column,
                            const std::string& fallback) const {
        const std::string cell = line_.cell(column);
        try {
            return physics::parse_time((cell.empty() ? fallback : cell).substr(0, 10));
        } catch (const std::exception& error) {
            rethrow_unless_answer(error);
            fail(column, error.what());
        }
    }

    static std::string day_of(physics::Seconds time) {
        return physics::format_time(time).substr(0, 10);
    }

    /// The last days; of months and bills the last of them, as many as are nearest.
    std::chrono::days recent_days(physics::Seconds from, physics::Seconds last) const {
        using std::chrono::days;
        const days wanted(static_cast<int>(stock_.options.recent_days));
        if (bounds_.empty() || wanted.count() == 0) return wanted;
        days nearest = wanted;
        std::int64_t off = std::numeric_limits<std::int64_t>::max();
        for (const physics::Seconds bound : bounds_) {
            if (bound <= from || bound > last) continue;
            const days kept = std::chrono::floor<days>(last + days(1) - bound);
            const std::int64_t apart = std::abs((kept - wanted).count());
            if (apart < off) off = apart, nearest = kept;
        }
        return nearest;
    }

    /// The begin of the first bill from that day on.
    physics::Seconds bill_from(physics::Seconds day) const {
        for (const physics::Seconds bound : bounds_)
            if (bound >= day) return bound;
        return day;
    }

    /// The last days are kept, and a window before them is calibrated on.
    void add_periods() {
        using std::chrono::days;
        physics::Seconds from = day_in("from", first_day_);
        const physics::Seconds last = day_in("to", last_day_);
        const auto window = days(static_cast<int>(stock_.options.window_days));
        const physics::Seconds end = last - recent_days(from, last);
        from = std::max(from, bill_from(end - window + days(1)));
        const auto recent = last - end;
        if (from >= end)
            fail("to", fmt::format("readings from {} to {} are too few for a calibration",
                                   day_of(from), day_of(last)));
        text_ += fmt::format("[periods]\ntraining = [\"{}\", \"{}\"]\n", day_of(from),
                             day_of(end));
        if (recent.count() > 0)
            text_ += fmt::format("recent = [\"{}\", \"{}\"]\n", day_of(end + days(1)),
                                 day_of(last));
    }

    void add_envelope() {
        constexpr struct {
            const char *name, *column;
            double u;
        } parts[] = {
            {"wall", "u_wall", 1.2}, {"roof", "u_roof", 0.7}, {"floor", "u_floor", 0.4}};
        for (const auto& part : parts)
            text_ += fmt::format("[[construction]]\nname = \"{}\"\nu_value = {}\n",
                                 part.name, number(part.column, part.u));
        text_ += fmt::format(
            "[[glazing]]\nname = \"window\"\nu_value = {}\nsolar_transmittance = 0.6\n",
            number("u_window", 3));
    }

    void add_zone() {
        const double floors = number("floors", std::ceil(floor_area_ / 1500));
        const double height = number("height", 3.4), glass = number("glass_share", 0.3);
        const double floor = floor_area_ / floors;
        const double wall = std::sqrt(floor) * floors * height;  // of one side
        text_ += fmt::format(
            "[[zone]]\nname = \"building\"\nfloor_area = {}\nvolume = {}\nclass = "
            "\"{}\"\n"
            "heating_set_point = {{value = 21, low = 18, schedule = \"day\"}}\n"
            "cooling_set_point = 60\ncooling_capacity = 0\n",
            floor_area_, floor_area_ * height, word("class", "medium"));
        for (const int azimuth : {0, 90, 180, 270}) {
            text_ += fmt::format(
                "[[zone.surface]]\nconstruction = \"wall\"\narea = {}\nazimuth = {}\n",
                wall * (1 - glass), azimuth);
            text_ += fmt::format(
                "[[zone.window]]\nglazing = \"window\"\narea = {}\nazimuth = {}\n",
                wall * glass, azimuth);
        }
        text_ += fmt::format(
            "[[zone.surface]]\nconstruction = \"roof\"\narea = {0}\nazimuth = 0\ntilt = "
            "0\n"
            "[[zone.surface]]\nconstruction = \"floor\"\narea = {0}\nadjustment = 0.5\n"
            "in_sun = false\n"
            "[[zone.flow]]\nname = \"infiltration\"\nair_change = 0.5\n"
            "[[zone.flow]]\nname = \"ventilation\"\nair_change = {{value = 1, schedule = "
            "\"day\"}}\n",
            floor);
        add_loads();
    }

    void add_loads() {
        const char* carrier =
            line_.cell("electricity").empty() ? "" : "carrier = \"electricity\"\n";
        text_ += fmt::format(
            "[[zone.load]]\nname = \"steady\"\ndensity = {1:.4g}\n{0}"
            "[[zone.load]]\nname = \"use\"\n"
            "density = {{value = {2:.4g}, schedule = \"occupied\"}}\n{0}",
            carrier, 0.7 * mean_load_, 0.9 * mean_load_);
        if (has_gas_)
            text_ +=
                "[[zone.load]]\nname = \"hot_water\"\ndensity = 1\nheat_fraction = 0\n"
                "carrier = \"gas\"\n";
        text_ +=
            fmt::format("[plant]\nheating_carrier = \"{}\"\nheating_efficiency = {}\n",
                        has_gas_                     ? "gas"
                        : line_.cell("heat").empty() ? "electricity"
                                                     : "district",
                        number("efficiency", has_gas_ ? 0.85 : 1));
    }

    /// Around what the electricity meter shows on average.
    std::string load_parameters() const {
        return fmt::format(
            "[[parameter]]\nname = \"steady_gains\"\ntarget = "
            "\"zone.building.load.steady.density\"\nmin = 0\nmax = {:.4g}\n"
            "[[parameter]]\nname = \"people_and_devices\"\ntarget = "
            "\"zone.building.load.use.density\"\nmin = 0\nmax = {:.4g}\n",
            1.4 * mean_load_, 3 * mean_load_);
    }

    std::string gas_parameters() const {
        if (!has_gas_) return {};
        return "[[parameter]]\nname = \"efficiency\"\ntarget = "
               "\"plant.heating_efficiency\"\nmin = 0.7\nmax = 0.95\n"
               "[[parameter]]\nname = \"hot_water\"\ntarget = "
               "\"zone.building.load.hot_water.density\"\nmin = 0\nmax = 15\n";
    }

    const Stock& stock_;
    const StockLine& line_;
    input::InputFiles& files_;
    double floor_area_ = 0;
    double mean_load_ = 10;  ///< [W/m2]
    double factor_ = 1;      ///< on the readings of the meter that was looked at
    std::vector<std::pair<std::string, std::string>> last_days_;  ///< of each meter
    bool has_gas_ = false;
    std::string first_day_, last_day_, site_, text_, meters_;
    std::vector<physics::Seconds> bounds_;  ///< of months and bills; else empty
    std::vector<study::DataDecision> decisions_;
};

}  // namespace

std::vector<std::string> read_columns() {
    std::vector<std::string> columns(std::begin(other_columns), std::end(other_columns));
    for (const BoxNumber& kind : box_numbers) columns.emplace_back(kind.column);
    const auto add_keys = [&](const std::string& prefix, const char* section,
                              std::span<const std::string_view> own) {
        for (const schema::Key& key : schema::job_table().keys_of(section))
            if (std::ranges::find(own, key.key) == own.end())
                columns.push_back(prefix + "_" + key.key);
    };
    for (const MeterKind& kind : meter_kinds) {
        columns.emplace_back(kind.name);
        add_keys(kind.name, "meter", own_of_meter);
    }
    add_keys("weather", "weather", own_of_weather);
    add_keys("holidays", "holidays", {});
    return columns;
}

Description describe_line(const Stock& stock, const StockLine& line,
                          input::InputFiles& files) {
    return Writer(stock, line, files).write();
}

}  // namespace bemcal::job
