/// What the fuzzers and the mutation test throw bytes at: each reader of text, where the
/// only way out besides an answer is a UserError. Anything else is a finding.
#pragma once

#include "base/error.hpp"
#include "checks/series.hpp"
#include "input/csv_numbers.hpp"
#include "input/epw.hpp"
#include "input/input_files.hpp"
#include "input/series.hpp"
#include "input/stamps.hpp"
#include "job/small_office.hpp"
#include "job/stock.hpp"
#include "support/epw_files.hpp"

#include <string>

namespace bemcal::job {

/// A day of an EPW file.
inline std::string small_epw() {
    std::string text =
        "LOCATION,Town,-,-,-,0,23.1,113.3,8.0,21\nDESIGN CONDITIONS,0\n"
        "TYPICAL/EXTREME PERIODS,0\nGROUND TEMPERATURES,0\nHOLIDAYS/DAYLIGHT "
        "SAVINGS,No,0,0,0\n"
        "COMMENTS 1,-\nCOMMENTS 2,-\nDATA PERIODS,1,1,Data,Sunday,1/1,12/31\n";
    for (int hour = 1; hour <= 24; ++hour)
        text += fmt::format(
            "2021,1,1,{},60,-,10.0,5.0,70,101325,0,0,300,0,0,0,0,0,0,0,180,2.0,5,"
            "5,10,77777,9,999999999,0,0,0,88,0,0,0\n",
            hour);
    return text;
}

/// A stock of two lines.
inline std::string small_table() {
    return "name,meter,floor_area,floors,weather,outdoor_temperature,global_horizontal,"
           "latitude,longitude,utc_offset,electricity,electricity_column\n"
           "one,measured.csv,500,2,weather.csv,T_out_C,DNI,50,8,1,measured.csv,elec_kWh\n"
           "two,measured.csv,90,,weather.csv,T_out_C,DNI,50,8,1,,\n";
}

inline void try_job(const std::string& text) {
    static const std::string weather = small_weather(), readings = small_readings();
    input::InputFiles files([&](const std::filesystem::path& path) -> std::string {
        if (path.filename() == "office.toml") return text;
        if (path.filename() == "weather.csv") return weather;
        if (path.filename() == "measured.csv") return readings;
        throw UserError(ExitCode::no_input, "no such file");
    });
    try {
        read_job("office.toml", files);
    } catch (const UserError&) {
    }
}

/// A stock whose table is the text: its lines by a template, and as boxes of their own.
inline void try_stock(const std::string& text) {
    static const std::string weather = small_weather(), readings = small_readings();
    static const std::string building = small_stock_building();
    for (const char* by : {"template = \"building.toml\"\n", ""}) {
        const std::string job_text = fmt::format(
            "seed = 3\n[stock]\ntable = \"stock.csv\"\n{}[[study]]\nkind = "
            "\"screening\"\nn_points = 16\n",
            by);
        input::InputFiles files([&](const std::filesystem::path& path) -> std::string {
            if (path.filename() == "job.toml") return job_text;
            if (path.filename() == "stock.csv") return text;
            if (path.filename() == "building.toml") return building;
            if (path.filename() == "weather.csv") return weather;
            if (path.filename() == "measured.csv") return readings;
            throw UserError(ExitCode::no_input, "no such file");
        });
        try {
            const Job job = read_job("job.toml", files);
            for (const StockLine& line : job.stock->lines) try {
                    read_stock_building(job, line, files);
                } catch (const UserError&) {
                }
        } catch (const UserError&) {
        }
    }
}

/// Asks for its last column, so that the names may stand in any line.
inline void try_csv_by_name(const std::string& text) {
    for (const char* thousands : {"", ",", " "}) {
        try {
            input::CsvForm form;
            form.names = {input::parse_csv(text, "fuzz.csv").columns.back()};
            const input::Csv csv = input::parse_csv(text, "fuzz.csv", form);
            input::NumberForm numbers;
            numbers.thousands = thousands;
            input::numbers_in(csv, csv.column(form.names[0]), numbers);
        } catch (const UserError&) {
        }
    }
}

inline void try_csv(const std::string& text) {
    try_csv_by_name(text);
    for (const input::Clock clock : {input::Clock::unstated, input::Clock::eu}) {
        try {
            const input::Csv csv = input::parse_csv(text, "fuzz.csv");
            input::StampRules rules;
            rules.clock = clock;
            rules.at_end = clock == input::Clock::eu;
            const input::Stamps stamps = input::stamps_in(csv, 0, rules);
            for (std::size_t column = 1; column < csv.columns.size(); ++column) {
                input::RegularSeries series =
                    input::lay(csv, stamps, input::numbers_in(csv, column));
                checks::check_series(series, physics::Quantity::electricity, {});
                input::fill_gaps(series.values, 3);
            }
        } catch (const UserError&) {
        }
    }
}

/// Bytes of any file of data.
inline void try_data(const std::string& bytes) {
    try {
        input::InputFiles files([&](const std::filesystem::path&) { return bytes; });
        files.data("fuzz");
    } catch (const UserError&) {
    }
}

inline void try_epw(const std::string& text) {
    try {
        test::parse_epw(text, "fuzz.epw");
    } catch (const UserError&) {
    }
}

inline void try_gzip(const std::string& bytes) {
    try {
        input::unpack_gzip(bytes, "fuzz.gz");
    } catch (const UserError&) {
    }
}

}  // namespace bemcal::job
