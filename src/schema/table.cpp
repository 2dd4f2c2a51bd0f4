/// Declares the sections of the job's table and its rows of the job, a stock, buildings,
/// scenarios and output. A new option is one row here and one line in the reader of its
/// section.
/// Follows from one table for reading, checks, defaults, messages and `describe job`.
/// Leaves out [simulator] (`simulator_keys`), studies (each kind has rows of its own),
/// numbers of a building (`fields()`), and rules between keys, which the readers check.
#include "base/joined.hpp"
#include "holidays/countries.hpp"
#include "schema/schema.hpp"
#include "schema/words.hpp"

#include <limits>

namespace bemcal::schema {

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

constexpr SectionInfo section_table[] = {
    {"job", "(top of the job file)", "building",
     "The job; one building's sections may stand here, or be shared by all in "
     "`buildings`."},
    {"building", "(top of a building's file)", "",
     "A building; sections that its file leaves out are taken from the job file."},
    {"holidays", "[holidays]", "", "Days off by country, in place of holidays = [...]."},
    {"site", "[site]", "", "Where the building stands, and its clock."},
    {"weather", "[weather]", "source",
     "Hourly weather, from EPW files or from a CSV file."},
    {"weather.columns", "[weather.columns]", "",
     "Columns of a CSV weather file; each a name, or a table as [weather.columns.NAME]."},
    {"column", "[weather.columns.NAME]", "",
     "One column, where its name alone does not say all."},
    {"source", "(any section that reads a CSV file)", "",
     "How the time stamps and cells of a CSV file are to be read."},
    {"schedule", "[[schedule]]", "week",
     "A number for each hour of the week and the year."},
    {"schedule.period", "[[schedule.period]]", "week",
     "Days of the year on which other values hold; the last period with the day wins."},
    {"week", "(a schedule or its period)", "", "Values by day; the more exact key wins."},
    {"series", "[[series]]", "source", "A measured or computed input, from a CSV file."},
    {"construction", "[[construction]]", "", "An opaque construction."},
    {"construction.layer", "[[construction.layer]]", "",
     "A layer of one material; the first is outside."},
    {"glazing", "[[glazing]]", "", "A window type."},
    {"boundary", "[[boundary]]", "",
     "A temperature behind a surface or of supplied air."},
    {"zone", "[[zone]]", "", "A zone: a 5R1C network."},
    {"zone.surface", "[[zone.surface]]", "", "An opaque element of the zone."},
    {"zone.window", "[[zone.window]]", "", "A window of the zone."},
    {"zone.flow", "[[zone.flow]]", "",
     "Infiltration, ventilation: air that enters the zone."},
    {"zone.load", "[[zone.load]]", "",
     "People, lights, equipment, hot water, fans, a base load: anything that draws power "
     "by the clock."},
    {"zone.coupling", "[[zone.coupling]]", "",
     "Heat and air exchanged with another zone."},
    {"zone.radiator", "[zone.radiator]", "",
     "Heating of the zone by a radiator, in place of set-points."},
    {"air_system", "[[air_system]]", "",
     "Air that a fan brings to zones: coils, reheat, economiser, and what cooling dries."},
    {"plant", "[plant]", "", "What turns heat and cold into the meters' energy."},
    {"meter", "[[meter]]", "source", "A measured series that the model is held against."},
    {"meter.scale", "[[meter.scale]]", "",
     "A correction of the readings from a date on."},
    {"effect", "[[effect]]", "",
     "What the building does beyond its description: a row of `bemcal-batch describe "
     "effects`, or hook, driver, form and gate. It holds in every study."},
    {"effect.function", "[[effect.function]]", "",
     "A function of what the effect follows, by its values."},
    {"parameter", "[[parameter]]", "", "An uncertain number of the building."},
    {"link", "[[link]]", "",
     "Numbers of the building that follow from others: a polynomial of them, or the row "
     "of a table; links are followed in the order of the file."},
    {"link.term", "[[link.term]]", "", "A term of a polynomial."},
    {"link.row", "[[link.row]]", "", "A row of a table."},
    {"prior", "prior = {...} (of a [[parameter]])", "",
     "What is believed of the parameter before the data, cut to min and max; for kind = "
     "\"posterior\"."},
    {"periods", "[periods]", "", "The first one is for training, the others for judging.",
     true},
    {"run", "[run]", "", "How a simulation runs."},
    {"study", "[[study]]", "", "Its table is that of its kind.", true},
    {"scenario", "[[scenario]]", "",
     "A retrofit, for a study of kind \"retrofit\"; the same for all buildings."},
    {"scenario.change", "[[scenario.change]]", "",
     "A number of the building, or of a [simulator], that it changes; value, factor, offset "
     "or insulation says how."},
    {"output", "[output]", "", "What is kept."},
    {"stock", "[stock]", "",
     "Many buildings in place of one, a line of a table each; a screening, posterior or "
     "loop is done with every one of them. Sections that a building leaves out are the "
     "job's."},
    {"simulator", "[simulator]", "",
     "A program that is studied in place of a building, or in a loop beside it: it runs "
     "once for each point, in a folder of its own."},
    {"simulator.template", "[[simulator.template]]", "",
     "An input file of the program with @NAME@ where a parameter's value belongs."},
    {"simulator.parameter", "[[simulator.parameter]]", "",
     "A number that is varied: @NAME@ in a template or in the command."},
    {"simulator.output", "[[simulator.output]]", "",
     "A number that the program has written."},
    {"simulator.hourly", "[[simulator.hourly]]", "",
     "Hours of a meter that the program has written, of a building that stands in the "
     "same job as its twin: for all studies of its meters. Effects that were found are handed to the program "
     "as effects.toml and effects.csv in the point's folder; what it cannot take it says "
     "in effects_left_out.txt."},
    {"simulator.effect", "[[simulator.effect]]", "",
     "A place of a template that takes effects, in place of effects.toml: those at one "
     "hook, as hours."},
    {"input", "{value, low, schedule}", "",
     "A number that changes with time: low + (value - low) x schedule, or value x "
     "series."},
};

constexpr Key table[] = {
    // job
    {"job", "seed", Type::integer, "", "0", 0, 9007199254740991,
     "Of all random numbers."},
    {"job", "buildings", Type::texts, "", "", 0, 0,
     "Files with a building each; without them the job file is the building."},
    {"job", "study", Type::tables, "", "", 0, 0, "[[study]]"},
    {"job", "output", Type::table, "", "", 0, 0, "[output]"},
    {"job", "scenario", Type::tables, "", "", 0, 0, "[[scenario]]"},
    {"job", "simulator", Type::table, "", "", 0, 0, "[simulator]"},
    {"job", "stock", Type::table, "", "", 0, 0, "[stock]"},
    // stock
    {"stock", "table", Type::text, "", "", 0, 0,
     "CSV file with a building a line: its name and, as columns, its own file, the "
     "places of the template, or floor_area, floors, weather, gas, electricity, ..."},
    {"stock", "folder", Type::text, "", "", 0, 0,
     "In place of a table: each *.toml in it is a building."},
    {"stock", "template", Type::text, "", "", 0, 0,
     "Description of a building, with @column@ where the table's cell belongs; without "
     "one, and without a column `file`, the columns themselves describe it."},
    {"stock", "recent_days", Type::number, "d", "28", 0, 3660,
     "Of buildings that their columns describe: the last days with readings are kept "
     "from the calibration and show how well it predicts."},
    {"stock", "window_days", Type::number, "d", "365", 1, 36600,
     "Of the same: so many days before these are calibrated on."},
    {"stock", "budget", Type::number, "", "0", 0, 1e15,
     "Simulations of a night, kept by order of priority; 0 = no limit."},
    {"stock", "hours", Type::number, "h", "0", 0, 1000,
     "After so long no further building is begun in this night; 0 = no limit."},
    {"stock", "drift_value", Type::number, "-", "0.2", 0, 1,
     "A parameter drifts if it has moved by more than this share of its range, and out "
     "of its interval of the night before."},
    {"stock", "drift_error", Type::number, "-", "1.5", 0, 1000,
     "The error drifts if the RMSE of the recent days is above that of the calibration, "
     "times this."},
    {"stock", "keep_results", Type::flag, "", "false", 0, 0,
     "Store the whole result of every building, not its lines of the summary only."},
    {"stock", "false_alarms", Type::number, "1/week", "0.001", 0, 0.5,
     "Of a loop: where new days have come, a night first tests whether what was found "
     "still holds, and searches again only where it does not. So often a building in "
     "which nothing changes may raise an alarm in a week, if its model is right; 0: no "
     "test, always a search."},
    // building
    {"building", "name", Type::text, "", "", 0, 0, "Default: the file's name."},
    {"building", "holidays", Type::texts, "", "", 0, 0,
     "Days that schedules take as holidays: \"12-24/01-02\" every year, \"2021-05-03\" "
     "once. Or a section [holidays]."},
    {"building", "site", Type::table, "", "", 0, 0, "[site]"},
    {"building", "weather", Type::table, "", required, 0, 0, "[weather]"},
    {"building", "schedule", Type::tables, "", "", 0, 0, "[[schedule]]"},
    {"building", "series", Type::tables, "", "", 0, 0, "[[series]]"},
    {"building", "construction", Type::tables, "", "", 0, 0, "[[construction]]"},
    {"building", "glazing", Type::tables, "", "", 0, 0, "[[glazing]]"},
    {"building", "boundary", Type::tables, "", "", 0, 0, "[[boundary]]"},
    {"building", "zone", Type::tables, "", required, 0, 0, "[[zone]]"},
    {"building", "air_system", Type::tables, "", "", 0, 0, "[[air_system]]"},
    {"building", "plant", Type::table, "", "", 0, 0, "[plant]"},
    {"building", "meter", Type::tables, "", "", 0, 0, "[[meter]]"},
    {"building", "structure", Type::texts, "", "", 0, 0,
     "Refinements of the standard's zone that it has in every study: \"surfaces\", \"air "
     "and thermostat\", \"second mass\", \"glass by angle\"; `bemcal-batch describe "
     "structure` prints them. Their numbers are parameters with priors."},
    {"building", "effect", Type::tables, "", "", 0, 0, "[[effect]]"},
    {"building", "parameter", Type::tables, "", "", 0, 0, "[[parameter]]"},
    {"building", "link", Type::tables, "", "", 0, 0, "[[link]]"},
    {"building", "periods", Type::table, "", required, 0, 0, "[periods]"},
    {"building", "run", Type::table, "", "", 0, 0, "[run]"},
    // holidays
    {"holidays", "country", Type::choice, joined<holidays::country_codes>.data(), "", 0,
     0, "Its public holidays; `bemcal-batch describe holidays` prints them."},
    {"holidays", "state", Type::text, "", "", 0, 0,
     "A state, province, Land, canton or nation of the country, as \"BY\"."},
    {"holidays", "days", Type::texts, "", "", 0, 0,
     "More days off, as in holidays = [...]."},
    {"holidays", "school", Type::texts, "", "", 0, 0,
     "School holidays, \"2021-08-02/2021-08-20\"; kept with the building, not used by "
     "schedules."},
    // site
    {"site", "latitude", Type::number, "deg", "", -90, 90,
     "North positive; default: the EPW file's."},
    {"site", "longitude", Type::number, "deg", "", -180, 180,
     "East positive; default: the EPW file's."},
    {"site", "utc_offset", Type::number, "h", "", -12, 14,
     "Local standard time minus UTC; default: the EPW file's."},
    {"site", "elevation", Type::number, "m", "", -430, 9000,
     "Default: the EPW file's, else 0."},
    {"site", "albedo", Type::number, "-", "0.2", 0, 1, "Ground reflectance."},
    // weather
    {"weather", "files", Type::texts, "", required, 0, 0,
     "One after the other in time; may be gzipped."},
    {"weather", "format", Type::choice, "epw|csv", "epw", 0, 0, "Of the files."},
    {"weather", "temperature", Type::choice, "hour_mean|as_read", "", 0, 0,
     "hour_mean: mean of the readings at both ends of an hour (default for EPW); "
     "as_read: the value stands for its hour (default for CSV)."},
    {"weather", "year", Type::integer, "", "", 1900, 2100,
     "Of the first EPW file, for typical years whose months are of several."},
    {"weather", "sky", Type::choice, "perez|isotropic|hay_davies", "perez", 0, 0,
     "Light of the sky on planes: Perez 1990, uniform, Hay and Davies 1980."},
    {"weather", "columns", Type::table, "", "", 0, 0, "[weather.columns], CSV only."},
    {"weather", "fill_gaps", Type::integer, "h", "0", 0, 48,
     "Gaps up to this length are filled by a straight line; of EPW those of 3 h always."},
    {"weather.columns", "outdoor_temperature", Type::text, "degC", required, -90, 60,
     "Dry bulb."},
    {"weather.columns", "global_horizontal", Type::text, "W/m2", "", -50, 2000,
     "Irradiance."},
    {"weather.columns", "direct_normal", Type::text, "W/m2", "", -50, 2000,
     "Irradiance."},
    {"weather.columns", "diffuse_horizontal", Type::text, "W/m2", "", -50, 2000,
     "Irradiance."},
    {"weather.columns", "wind_speed", Type::text, "m/s", "", 0, 120, ""},
    {"weather.columns", "relative_humidity", Type::text, "%", "", 0, 120, ""},
    {"weather.columns", "cloud_cover", Type::text, "-", "", 0, 1, "0 to 1."},
    {"weather.columns", "infrared", Type::text, "W/m2", "", 0, 1000,
     "Horizontal, from the sky."},
    {"column", "column", Type::text, "", required, 0, 0,
     "Its name in the file's first line."},
    {"column", "unit", Type::text, "", "", 0, 0,
     "degC, 0.1 degC, 0.01 degC, K, degF; W/m2, kW/m2, and of a row's step Wh/m2, "
     "kWh/m2, J/m2, kJ/m2, MJ/m2, J/cm2, cal/cm2, Btu/ft2; m/s, km/h, knots, mph; %, 0 "
     "to 1, tenths, oktas. Left out: the one that is expected, if that is possible."},
    {"column", "factor", Type::number, "-", "1", -1e9, 1e9,
     "To the unit that is said or expected: value x factor + offset."},
    {"column", "offset", Type::number, "", "0", -1e9, 1e9, ""},
    {"column", "stamp", Type::choice, "start|end", "", 0, 0,
     "Where it differs from the file's."},
    // source
    {"source", "time", Type::texts, "", "", 0, 0,
     "Column of the time stamps; default: the first one. Or those of date and clock, or "
     "of the parts: [\"year\", \"month\", \"day\", \"hour\", \"minute\"]."},
    {"source", "stamp", Type::choice, "start|end", "start", 0, 0,
     "Whether a stamp is the start or the end of its interval. Left out: start, unless "
     "the stamps close whole days (first 01:00, last 00:00) or stand inside their "
     "steps."},
    {"source", "clock", Type::choice, "standard|eu|us", "", 0, 0,
     "eu, us: the stamps follow the wall clock, with that summer time. Left out: "
     "standard, and a clock change in the data is an error."},
    {"source", "utc_offset", Type::number, "h", "", -12, 14,
     "Of the file's clock (0 = UTC) where it is not the site's."},
    {"source", "time_format", Type::text, "", "", 0, 0,
     "As of strptime, \"%d/%m/%Y %H:%M\", with %z for an offset and %s for seconds since "
     "1970; default: 2021-03-05 14:00[:00][Z or +01:00]."},
    {"source", "decimal", Type::choice, ".|,", ".", 0, 0, "Decimal mark."},
    {"source", "thousands", Type::choice, ",|.|'| |none", "", 0, 0,
     "Mark between groups of three digits (a blank stands for blanks of all kinds). Left "
     "out: a number that may have one is an error that asks."},
    {"source", "missing", Type::words, "", "", 0, 0,
     "Cells that stand for no reading, [\"Bad\", -999]; empty ones, NA, NaN, null, none, "
     "-, missing and errors of spreadsheets do so in any case."},
    {"source", "header_line", Type::integer, "", "", 1, 1000000,
     "Line of the column names, from 1. Left out: the first line that has the names that "
     "are asked for."},
    {"source", "skip", Type::words, "", "", 0, 0,
     "Lines left out: their numbers, from 1, or texts that they begin with, [3, "
     "\"Total\"]. A line of units below the names and lines without a time behind the "
     "last row are left out in any case, and stated."},
    {"source", "gaps", Type::choice, "error|missing", "error", 0, 0,
     "What absent rows are; empty cells are missing readings in any case."},
    // effects
    {"effect", "name", Type::text, "", required, 0, 0,
     "Of a row of the catalogue, whose hook, driver and shape it has; or another, with "
     "hook and driver. A [[parameter]] varies its coefficient by target = "
     "\"effect.NAME\"."},
    {"effect", "coefficient", Type::number, "", required, -1e9, 1e9,
     "In the hook's unit, per unit of a driver that is not 0 or 1."},
    {"effect", "hook", Type::text, "", "", 0, 0,
     "Where it enters: \"infiltration\", \"gains\", \"heating set-point\", ..."},
    {"effect", "driver", Type::text, "", "constant", 0, 0,
     "What it follows: \"wind\", \"hour of the day\", \"outdoor temperature\", ..."},
    {"effect", "form", Type::text, "", "linear", 0, 0,
     "How it follows it: linear; above, below (what is beyond `at`); over, under (1 "
     "there); within (1 from `at` to `until`); lagged (by `at` hours)."},
    {"effect", "at", Type::number, "", "0", -1e6, 1e6, "In the driver's unit."},
    {"effect", "until", Type::number, "", "0", -1e6, 1e6, "In the driver's unit."},
    {"effect", "since", Type::text, "", "", 0, 0,
     "Of an effect that follows the time elapsed: it begins then, \"2021-09-01\"."},
    {"effect", "since_within", Type::integer, "d", "0", 0, 60,
     "A posterior samples the day of `since`, so many days before and after. 0 = it is "
     "known."},
    {"effect", "full_load", Type::number, "kW", "", 1e-6, 1e6,
     "Of an effect that follows the heating or the cooling load: the load that counts as "
     "1, of all zones. The load is that of the nominal building with its other effects."},
    {"effect", "gate", Type::text, "", "always", 0, 0,
     "When it acts: always, occupied, unoccupied, day, night, weekend, weekday, heating "
     "season, cooling season, on days, EU summer time, US summer time."},
    {"effect", "days", Type::texts, "", "", 0, 0,
     "It acts on these days alone: \"12-24/01-02\" every year, \"2021-05-03\" once."},
    {"effect", "weekday", Type::text, "", "", 0, 0,
     "It acts on this day of the week alone: \"monday\"."},
    {"effect", "hours", Type::numbers, "h", "", 0, 24,
     "It acts from the first to the second hour of a day alone: [22, 6]."},
    {"effect", "meter", Type::choice, quantities, "", 0, 0,
     "Of an effect that enters at a meter, as a factor or an addition."},
    {"effect", "facade", Type::text, "", "", 0, 0,
     "Of an effect on one facade: \"south\", \"north-east\", \"roof\"; default: all."},
    {"effect", "function", Type::tables, "", "", 0, 0,
     "[[effect.function]]: in place of a driver, it follows the sum of these."},
    {"effect.function", "driver", Type::text, "", required, 0, 0,
     "\"one\", \"hour of the week\" (also \"from a day on\"), \"outdoor temperature\" (also \"of three days\", \"of a "
     "month\"), \"sun\", \"wind\", \"moisture\", \"hour and outdoor temperature of a "
     "day\", \"time\", and at efficiencies and meters \"heating load\" or \"cooling load\" "
     "in kW."},
    {"effect.function", "at", Type::numbers, "", "", -1e6, 1e6,
     "Where the driver is at each of the values, rising; between them it is straight. Of "
     "hours from a day on: that day, in years from the first day of training. Not of "
     "hours, time and one."},
    {"effect.function", "values", Type::numbers, "", required, -1e9, 1e9,
     "In the hook's unit. Of hours: 24 of working days, of Saturdays, of Sundays and "
     "holidays; of hour and temperature: at each hour of working days, then of other "
     "days, one for each `at`; of time: one a fortnight from the first day of training."},
    {"effect.function", "spread", Type::number, "", "0", 0, 1e6,
     "In the hook's unit: a posterior samples the values, which differ from those given by "
     "about so much, and how much. Their mean over training stays. 0 = they are known."},
    {"effect", "series", Type::text, "", "", 0, 0,
     "Of driver = \"column\": the [[series]] that it follows."},
    // schedules
    {"schedule", "name", Type::text, "", required, 0, 0, ""},
    {"schedule", "holidays", Type::texts, "", "", 0, 0,
     "Default: the building's holidays."},
    {"schedule", "summer_time", Type::choice, "none|eu|us", "none", 0, 0,
     "eu, us: its hours follow the wall clock."},
    {"schedule", "hours", Type::choice, "given|learn", "given", 0, 0,
     "learn: nobody wrote its hours down. It holds no values by day; a study of kind "
     "\"loop\" learns when it is 1, and others take the usual hours of its use."},
    {"schedule", "use", Type::choice, "office|home|school|shop", "office", 0, 0,
     "With hours = \"learn\": the use whose usual hours the search starts from."},
    {"schedule", "register", Type::text, "", "", 0, 0,
     "CSV file with a date in its first column and a number for that day: the hours' "
     "values are multiplied by it, and by 0 on days that it leaves out."},
    {"schedule", "register_column", Type::text, "", "persons", 0, 0,
     "Of the day's number."},
    {"schedule", "period", Type::tables, "", "", 0, 0, "[[schedule.period]]"},
    {"schedule.period", "dates", Type::text, "", required, 0, 0,
     "\"06-10/09-10\" every year, \"2021-07-01/2021-08-31\" once."},
    {"week", "every_day", Type::day, "", "", -1e6, 1e6, ""},
    {"week", "weekdays", Type::day, "", "", -1e6, 1e6, "Monday to Friday."},
    {"week", "weekend", Type::day, "", "", -1e6, 1e6, "Saturday and Sunday."},
    {"week", "monday", Type::day, "", "", -1e6, 1e6, ""},
    {"week", "tuesday", Type::day, "", "", -1e6, 1e6, ""},
    {"week", "wednesday", Type::day, "", "", -1e6, 1e6, ""},
    {"week", "thursday", Type::day, "", "", -1e6, 1e6, ""},
    {"week", "friday", Type::day, "", "", -1e6, 1e6, ""},
    {"week", "saturday", Type::day, "", "", -1e6, 1e6, ""},
    {"week", "sunday", Type::day, "", "", -1e6, 1e6, ""},
    {"schedule", "holiday", Type::day, "", "", -1e6, 1e6, "Default: the Sunday."},
    {"series", "name", Type::text, "", required, 0, 0, ""},
    {"series", "file", Type::text, "", required, 0, 0, "CSV, may be gzipped."},
    {"series", "column", Type::text, "", required, 0, 0, ""},
    {"series", "unit", Type::text, "", "", 0, 0,
     "Of its values, for reports of effects that follow it: \"mm/h\"."},
    {"series", "factor", Type::number, "-", "1", -1e9, 1e9, "value x factor + offset."},
    {"series", "offset", Type::number, "", "0", -1e9, 1e9, ""},
    {"series", "fill_gaps", Type::integer, "h", "0", 0, 48,
     "Gaps up to this length are filled by a straight line."},
    // input
    {"input", "value", Type::number, "", "", -1e9, inf,
     "Where the schedule is 1; of a series, the factor on it (default 1)."},
    {"input", "low", Type::number, "", "0", -1e9, inf, "Where the schedule is 0."},
    {"input", "schedule", Type::text, "", "", 0, 0, "Name of a [[schedule]]."},
    {"input", "series", Type::text, "", "", 0, 0, "Name of a [[series]]."},
    // building parts; their numbers are in physics/parameters
    {"construction", "name", Type::text, "", required, 0, 0, ""},
    {"construction", "layer", Type::tables, "", "", 0, 0,
     "[[construction.layer]], in place of u_value"},
    {"construction.layer", "name", Type::text, "", "", 0, 0,
     "Default: layer_1, layer_2, ..."},
    {"glazing", "name", Type::text, "", required, 0, 0, ""},
    {"glazing", "angle_modifier", Type::numbers, "", "", -1e3, 1e3,
     "Polynomial in the angle of incidence [rad] of the beam, constant first."},
    {"boundary", "name", Type::text, "", required, 0, 0, ""},
    {"zone", "name", Type::text, "", required, 0, 0, ""},
    {"zone", "class", Type::choice, "very light|light|medium|heavy|very heavy|layers",
     "medium", 0, 0,
     "ISO 13790 Table 12: sets heat_capacity and mass_area_ratio where they are left "
     "out; layers: they follow from the layers of the zone's surfaces."},
    {"zone", "surface", Type::tables, "", "", 0, 0, "[[zone.surface]]"},
    {"zone", "window", Type::tables, "", "", 0, 0, "[[zone.window]]"},
    {"zone", "flow", Type::tables, "", "", 0, 0, "[[zone.flow]]"},
    {"zone", "load", Type::tables, "", "", 0, 0, "[[zone.load]]"},
    {"zone", "coupling", Type::tables, "", "", 0, 0, "[[zone.coupling]]"},
    {"zone", "radiator", Type::table, "", "", 0, 0, "[zone.radiator]"},
    {"zone.radiator", "elements", Type::integer, "", "3", 1, 50,
     "In the direction of the water, each at one temperature."},
    {"air_system", "name", Type::text, "", required, 0, 0, ""},
    {"air_system", "zones", Type::texts, "", "", 0, 0,
     "Names of the [[zone]]s that it serves; default: all."},
    {"air_system", "flow", Type::text, "", "", 0, 0,
     "Name of the [[zone.flow]] that it brings as its outdoor air, or, from a boundary, as "
     "its least supply air; default: none, air circulates."},
    {"air_system", "volume", Type::choice, "constant|variable", "variable", 0, 0,
     "variable: the flow follows the load and terminals reheat; constant: the temperature "
     "follows it."},
    {"air_system", "economiser_by", Type::choice, "dry_bulb|differential|enthalpy",
     "differential", 0, 0,
     "What lets it open: outdoors below economiser_limit by temperature or enthalpy, or "
     "below the room."},
    {"zone.surface", "name", Type::text, "", "", 0, 0,
     "Default: surface_1, surface_2, ..."},
    {"zone.surface", "construction", Type::text, "", required, 0, 0,
     "Name of a [[construction]]."},
    {"zone.surface", "boundary", Type::text, "", "outdoors", 0, 0,
     "What lies behind it: outdoors or the name of a [[boundary]]."},
    {"zone.surface", "azimuth", Type::number, "deg", "", -360, 360,
     "Of the outward normal, clockwise from north; needed where the sun shines on it."},
    {"zone.surface", "tilt", Type::number, "deg", "90", 0, 180,
     "0 = facing up (a roof), 90 = a wall."},
    {"zone.surface", "in_sun", Type::flag, "", "", 0, 0,
     "Sun and sky act on it; default: true outdoors."},
    {"zone.window", "name", Type::text, "", "", 0, 0, "Default: window_1, window_2, ..."},
    {"zone.window", "glazing", Type::text, "", required, 0, 0, "Name of a [[glazing]]."},
    {"zone.window", "azimuth", Type::number, "deg", "", -360, 360,
     "Of the outward normal, clockwise from north; needed unless tilt is 0."},
    {"zone.window", "tilt", Type::number, "deg", "90", 0, 180, "0 = facing up."},
    {"zone.flow", "name", Type::text, "", required, 0, 0,
     "infiltration, ventilation, ..."},
    {"zone.flow", "supply", Type::text, "", "outdoors", 0, 0,
     "Where the air comes from: outdoors or the name of a [[boundary]]."},
    {"zone.load", "name", Type::text, "", required, 0, 0, "people, lights, ..."},
    {"zone.load", "carrier", Type::choice, carriers, "none", 0, 0,
     "The meter that sees it."},
    {"zone.coupling", "zone", Type::text, "", required, 0, 0, "Name of the other zone."},
    {"plant", "heating_carrier", Type::choice, carriers, "gas", 0, 0,
     "The meter that heating is on."},
    {"plant", "cooling_carrier", Type::choice, carriers, "electricity", 0, 0,
     "The meter that cooling is on."},
    // meters
    {"meter", "name", Type::text, "", required, 0, 0, ""},
    {"meter", "quantity", Type::choice, quantities, required, 0, 0,
     "What of the model it is held against."},
    {"meter", "interval", Type::choice, "step|hourly|daily|monthly|annual", "hourly", 0,
     0,
     "Of a reading; finer readings are summed (temperatures averaged). monthly: bills "
     "between any read dates, too."},
    {"meter", "file", Type::texts, "", "", 0, 0,
     "CSV, may be gzipped; several, [\"2021.csv\", \"2022.csv\"], follow one another in "
     "time. Left out: it has no readings and is predicted only."},
    {"meter", "column", Type::text, "", "", 0, 0, "Needed with a file."},
    {"meter", "from", Type::text, "", "", 0, 0,
     "In place of time: column of the begins of rows, such as the dates of a bill."},
    {"meter", "to", Type::text, "", "", 0, 0,
     "Column of their ends: the next bill's begin, or the last day before it."},
    {"meter", "estimated", Type::text, "", "", 0, 0,
     "Of months and bills: column that says which reads are estimated (1, true, E); each "
     "is merged with the next that was read."},
    {"meter", "unit", Type::text, "", required, 0, 0,
     "kWh, Wh, MWh, MJ, GJ, J, kW, W, m3 (of gas), ft3, 100 ft3, CCF, kBtu, therm; degC, K, "
     "degF."},
    {"meter", "factor", Type::number, "-", "1", 1e-9, 1e9,
     "On the readings, with the unit's."},
    {"meter", "tariff", Type::number, "1/kWh", "", -100, 100,
     "What a kWh costs, in any currency: a loop says what the effects that it finds cost."},
    {"meter", "co2", Type::number, "kg/kWh", "", 0, 100, "What a kWh emits, likewise."},
    {"meter", "mask", Type::texts, "", "", 0, 0,
     "Times left out: \"2013-04-02/2013-04-05\" (whole days) or "
     "\"2013-04-02 03:00/2013-04-02 09:00\"."},
    {"meter", "zeros", Type::choice, "check|keep|missing", "check", 0, 0,
     "Zeros. check: missing where the meter is well above 0 at the same hours of the "
     "days around; keep: none is; missing: every run longer than zero_run is."},
    {"meter", "zero_run", Type::integer, "h", "24", 1, 10000, "Longer runs are stated."},
    {"meter", "constant", Type::choice, "check|keep|missing", "check", 0, 0,
     "The same value (not 0) again and again. check: missing where it stays longer than "
     "chance allows; keep: never; missing: every run longer than constant_run is."},
    {"meter", "constant_run", Type::integer, "h", "24", 2, 10000,
     "Longer runs are stated."},
    {"meter", "steps", Type::choice, "check|keep", "check", 0, 0,
     "Steps by the ratio of two units. check: corrected where they are certain; keep: "
     "stated only."},
    {"meter", "codes", Type::choice, "check|keep", "check", 0, 0,
     "Numbers that stand for no reading (-9999, 65535) and lie far from all others. "
     "check: missing; keep: none is. Name others in missing."},
    {"meter", "spikes", Type::choice, "check|keep", "check", 0, 0,
     "One or two readings far above all others. check: missing; keep: none is."},
    {"meter", "negative", Type::choice, "check|keep|missing", "check", 0, 0,
     "Energies below 0. check: a few are missing, tiny ones 0, many are asked about; "
     "keep: a meter that feeds in; missing: all are."},
    {"meter", "register", Type::choice, "check|keep|difference", "check", 0, 0,
     "Readings that count on. check: asked about; keep: each is a use; difference: the "
     "use is from one to the next."},
    {"meter", "scale", Type::tables, "", "", 0, 0, "[[meter.scale]]"},
    {"meter.scale", "from", Type::date, "", required, 0, 0, "First day or time."},
    {"meter.scale", "to", Type::date, "", "", 0, 0, "Last day; default: the end."},
    {"meter.scale", "factor", Type::number, "-", required, 1e-9, 1e9, "On the readings."},
    // parameters
    {"parameter", "name", Type::text, "", required, 0, 0, ""},
    {"parameter", "target", Type::texts, "", required, 0, 0,
     "What it sets: \"construction.wall.u_value\", "
     "\"zone.*.flow.infiltration.air_change\", "
     "\"zone.office.heating_set_point.low\"; several are set together."},
    {"parameter", "min", Type::number, "", "", -1e9, 1e9, "Needed without values."},
    {"parameter", "max", Type::number, "", "", -1e9, 1e9, "Needed without values."},
    {"parameter", "values", Type::numbers, "", "", -1e9, 1e9,
     "In place of min and max: it takes one of these; a posterior holds them all alike, "
     "other studies take the range."},
    {"parameter", "value", Type::number, "", "", -1e9, 1e9,
     "The building has it where a study does not vary the parameter, in place of what is "
     "described; `bemcal-batch adopt` writes it."},
    {"parameter", "prior", Type::table, "", "", 0, 0,
     "{kind = \"normal\", mean = 0.4, sd = 0.1}; default: uniform from min to max."},
    {"parameter", "mode", Type::choice, "replace|factor|offset", "replace", 0, 0,
     "It replaces the number, multiplies it, or is added to it."},
    {"link", "target", Type::texts, "", required, 0, 0,
     "What it sets, as of a [[parameter]]; no parameter may set it."},
    {"link", "of", Type::texts, "", required, 0, 0,
     "What it follows: the path of one number, or several."},
    {"link", "term", Type::tables, "", "", 0, 0,
     "[[link.term]]: the targets are the sum of the terms."},
    {"link", "row", Type::tables, "", "", 0, 0,
     "[[link.row]]: the targets are those of the row whose key is nearest."},
    {"link.term", "factor", Type::number, "", required, -1e9, 1e9, ""},
    {"link.term", "exponents", Type::numbers, "", "", 0, 20,
     "Whole, one for each of `of`: factor x1^e1 x2^e2 ...; default: the factor alone."},
    {"link.row", "key", Type::number, "", required, -1e9, 1e9, "Of the number in `of`."},
    {"link.row", "values", Type::numbers, "", required, -1e9, 1e9,
     "One for each path in `target`."},
    {"prior", "kind", Type::choice, "fixed|uniform|normal|lognormal|beta|gamma", required,
     0, 0, "Of the distribution."},
    {"prior", "value", Type::number, "", "", -1e9, 1e9, "fixed: it stays there."},
    {"prior", "mean", Type::number, "", "", -1e9, 1e9, "normal."},
    {"prior", "sd", Type::number, "", "", 0, 1e9, "normal: standard deviation."},
    {"prior", "median", Type::number, "", "", 0, 1e9, "lognormal."},
    {"prior", "sd_log", Type::number, "", "", 0, 1e3,
     "lognormal: standard deviation of the logarithm."},
    {"prior", "alpha", Type::number, "", "", 0, 1e9,
     "beta: first exponent; a beta is of (x - min) / (max - min)."},
    {"prior", "beta", Type::number, "", "", 0, 1e9, "beta: second exponent."},
    {"prior", "shape", Type::number, "", "", 0, 1e9, "gamma."},
    {"prior", "rate", Type::number, "", "", 0, 1e9, "gamma: inverse of the scale."},
    {"prior", "normalised", Type::flag, "", "false", 0, 0,
     "normal, lognormal, gamma: true where the numbers are of (x - min) / (max - min)."},
    // periods, run
    {"periods", "training", Type::texts, "", required, 0, 0,
     "[first day, last day], both included."},
    {"periods", "held_out", Type::texts, "", "", 0, 0,
     "[first day, last day]; any other name may be used for further periods."},
    {"run", "step", Type::integer, "s", "3600", 60, 3600, "Divides 3600."},
    {"run", "warm_up_days", Type::number, "d", "42", 0, 366,
     "Simulated before a period, to forget the start."},
    // scenarios
    {"scenario", "name", Type::text, "", required, 0, 0, ""},
    {"scenario", "change", Type::tables, "", "", 0, 0,
     "[[scenario.change]]; none: the building stays as it is."},
    {"scenario", "heating_carrier", Type::choice, carriers, "", 0, 0,
     "Another plant: the meter that heating is on afterwards."},
    {"scenario.change", "target", Type::texts, "", required, 0, 0,
     "As of a [[parameter]]: \"construction.wall.u_value\", "
     "\"glazing.*.solar_transmittance\", \"zone.*.flow.infiltration.air_change\", "
     "\"zone.*.flow.ventilation.heat_recovery\", \"plant.heating_efficiency\", "
     "\"zone.*.heating_set_point\". Of a [simulator] the name of a "
     "[[simulator.parameter]], or \"effect.NAME\" that a loop around it found."},
    {"scenario.change", "value", Type::number, "", "", -1e9, 1e9,
     "It becomes this; 0 strikes an effect that a loop found."},
    {"scenario.change", "factor", Type::number, "-", "", 0, 1e6,
     "What is there is multiplied by it."},
    {"scenario.change", "offset", Type::number, "", "", -1e9, 1e9,
     "Is added to what is there."},
    {"scenario.change", "insulation", Type::number, "m", "", 0, 5,
     "Of a u_value: thickness of a layer that is added."},
    {"scenario.change", "conductivity", Type::number, "W/(m K)", "", 0.001, 10,
     "Of that layer."},
    // output
    {"output", "file", Type::text, "", "", 0, 0,
     "Result file, from the working folder; default: the job's name with .h5."},
    {"output", "hourly", Type::texts, "", "", 0, 0,
     "Quantities of nominal and best to be stored by hour."},
    {"output", "max_failed_share", Type::number, "-", "0.05", 0, 1,
     "A larger share of failed points fails the batch."},
};

}  // namespace

std::span<const SectionInfo> declared_sections() {
    return section_table;
}

std::span<const Key> declared_keys() {
    return table;
}

}  // namespace bemcal::schema
