/// What the fuzzers and the mutation test throw bytes at: each reader of text, where the
/// only way out besides an answer is a UserError. Anything else is a finding.
#pragma once

#include "base/error.hpp"
#include "input/checks.hpp"
#include "input/csv_numbers.hpp"
#include "input/epw.hpp"
#include "input/input_files.hpp"
#include "input/series.hpp"
#include "input/stamps.hpp"
#include "job/small_office.hpp"

#include <string>

namespace bemcal::job {

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
                input::check_series(series, physics::Quantity::electricity, {});
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
        input::parse_epw(text, "fuzz.epw");
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
