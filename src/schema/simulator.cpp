/// Declares the schema's rows of [simulator], another program in place of a building.
/// Follows from paper 3's tool, which runs EnergyPlus once per point.
/// Leaves out rules between keys, which `read_simulator` checks.
#include "schema/schema.hpp"

namespace bemcal::schema {

namespace {

constexpr Key simulator_table[] = {
    {"simulator", "command", Type::texts, "", required, 0, 0,
     "The program and its arguments, run without a shell: [\"energyplus\", \"-w\", "
     "\"site.epw\", \"house.idf\"]. A name with a slash lies beside the job, another one "
     "is found on PATH."},
    {"simulator", "shell", Type::flag, "", "false", 0, 0,
     "The command is one text for /bin/sh."},
    {"simulator", "time_limit", Type::number, "s", "600", 0.01, 1e7,
     "Of one point: then the command is ended, with all that it started."},
    {"simulator", "output_limit", Type::number, "MB", "1000", 0.001, 1e9,
     "Of each file that it writes: the command is ended there."},
    {"simulator", "template", Type::tables, "", "", 0, 0, "[[simulator.template]]"},
    {"simulator", "files", Type::texts, "", "", 0, 0,
     "Other files that it reads: they are linked into the folder of every point."},
    {"simulator", "periods", Type::text, "", "", 0, 0,
     "One of the files, CSV with period,first,last: it is written anew for each run, with "
     "the periods that the run is needed for. If left out, each run is of all periods."},
    {"simulator", "parameter", Type::tables, "", required, 0, 0,
     "[[simulator.parameter]]"},
    {"simulator", "output", Type::tables, "", "", 0, 0,
     "[[simulator.output]]: numbers; all studies but those of hours need them."},
    {"simulator", "hourly", Type::tables, "", "", 0, 0,
     "[[simulator.hourly]]: hours of a building's meters, which a loop, posterior, stages, "
     "screening and retrofit need."},
    {"simulator", "effect", Type::tables, "", "", 0, 0,
     "[[simulator.effect]]: places of templates that take what a loop finds, for a program "
     "that reads no effects.toml."},
    {"simulator", "keep", Type::choice, "failed|all|none", "failed", 0, 0,
     "The folders of which points stay."},
    {"simulator", "folder", Type::text, "", "", 0, 0,
     "They lie in it, from the working folder; default: the job's name with .points."},
    {"simulator.template", "file", Type::text, "", required, 0, 0, "Beside the job."},
    {"simulator.template", "as", Type::text, "", "", 0, 0,
     "What the program knows it as; default: its name without .in or .template at the "
     "end."},
    {"simulator.parameter", "name", Type::text, "", required, 0, 0,
     "Letters, digits and underscores."},
    {"simulator.parameter", "unit", Type::text, "", "-", 0, 0, ""},
    {"simulator.parameter", "min", Type::number, "", required, -1e300, 1e300, ""},
    {"simulator.parameter", "max", Type::number, "", required, -1e300, 1e300, ""},
    {"simulator.parameter", "limits", Type::numbers, "", "", -1e300, 1e300,
     "[least, most] that a [[scenario]] may make of it, around min and max; default: "
     "these."},
    {"simulator.parameter", "nominal", Type::number, "", "", -1e300, 1e300,
     "Where a study leaves it alone; default: the middle of the range."},
    {"simulator.output", "name", Type::text, "", required, 0, 0, ""},
    {"simulator.output", "unit", Type::text, "", "-", 0, 0, ""},
    {"simulator.output", "file", Type::text, "", "", 0, 0,
     "That the program writes, in its folder; default: what it prints."},
    {"simulator.output", "column", Type::text, "", "", 0, 0,
     "Of a CSV file, or one with columns between blanks, by its name in the header; "
     "empty cells are left out."},
    {"simulator.output", "pattern", Type::text, "", "", 0, 0,
     "In place of a column: a regular expression as of grep -E, sought in each line (its "
     "first 4,000 characters); its first group is the number: \"heating: *([0-9.]+) "
     "kWh\"."},
    {"simulator.output", "take", Type::choice, "only|first|last|sum|mean|least|most",
     "only", 0, 0, "Which of the numbers found; only: more than one is a failure."},
    {"simulator.output", "row", Type::integer, "", "", 1, 1e9,
     "In place of take: the number in that place, from 1."},
    {"simulator.output", "rows", Type::integer, "", "0", 0, 1e9,
     "How many numbers there have to be: a run that wrote more or fewer has failed; 0 = any."},
    {"simulator.output", "header", Type::integer, "", "1", 1, 1e6,
     "Line of the file with the names of its columns."},
    {"simulator.output", "skip", Type::integer, "", "0", 0, 1e6,
     "Lines below the header that are left out (units)."},
    {"simulator.output", "factor", Type::number, "-", "1", -1e300, 1e300,
     "value x factor + offset."},
    {"simulator.output", "offset", Type::number, "", "0", -1e300, 1e300, ""},
    {"simulator.effect", "name", Type::text, "", required, 0, 0,
     "In a template @name@ becomes a number for each hour of the periods, a line each; 0 "
     "where there is nothing."},
    {"simulator.effect", "hook", Type::text, "", required, 0, 0,
     "What it changes: \"gains\", \"infiltration\", ... (describe effects)."},
    {"simulator.effect", "facade", Type::text, "", "", 0, 0,
     "Of an effect at one facade alone: \"south facade\"."},
    {"simulator.effect", "meter", Type::text, "", "", 0, 0,
     "Of an effect at a meter: \"gas\"."},
    {"simulator.hourly", "meter", Type::text, "", required, 0, 0,
     "Name of the building's [[meter]] that it stands beside."},
    {"simulator.hourly", "file", Type::text, "", "hours.csv", 0, 0,
     "CSV that the program writes, in its folder: a row for each hour of the periods, one "
     "period after the other as the job has them, in local standard time."},
    {"simulator.hourly", "column", Type::text, "", "", 0, 0,
     "By its name in the header; default: the meter's name."},
    {"simulator.hourly", "header", Type::integer, "", "1", 1, 1e6,
     "Line of the file with the names of its columns."},
    {"simulator.hourly", "skip", Type::integer, "", "0", 0, 1e6,
     "Lines below the header that are left out (units)."},
    {"simulator.hourly", "factor", Type::number, "-", "1", -1e300, 1e300,
     "value x factor + offset is kWh in the hour, or degC."},
    {"simulator.hourly", "offset", Type::number, "", "0", -1e300, 1e300, ""},
};

}  // namespace

std::span<const Key> simulator_keys() {
    return simulator_table;
}

}  // namespace bemcal::schema
