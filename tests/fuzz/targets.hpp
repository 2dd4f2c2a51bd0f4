/// What the fuzzers and the mutation test throw bytes at: each reader of text, where the
/// only way out besides an answer is a UserError. Anything else is a finding.
#pragma once

#include "base/error.hpp"
#include "job/csv.hpp"
#include "job/data_checks.hpp"
#include "job/epw.hpp"
#include "job/input_files.hpp"
#include "job/series.hpp"
#include "job/small_office.hpp"
#include "job/stamps.hpp"

#include <string>

namespace bemcal::job {

inline void try_job(const std::string& text) {
    static const std::string weather = small_weather(), readings = small_readings();
    InputFiles files([&](const std::filesystem::path& path) -> std::string {
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

inline void try_csv(const std::string& text) {
    for (const Clock clock : {Clock::unstated, Clock::eu}) {
        try {
            const Csv csv = parse_csv(text, "fuzz.csv");
            StampRules rules;
            rules.clock = clock;
            rules.at_end = clock == Clock::eu;
            const Stamps stamps = stamps_in(csv, 0, rules);
            for (std::size_t column = 1; column < csv.columns.size(); ++column) {
                RegularSeries series = lay(csv, stamps, numbers_in(csv, column));
                check_series(series, physics::Quantity::electricity, {});
                fill_gaps(series.values, 3);
            }
        } catch (const UserError&) {
        }
    }
}

inline void try_epw(const std::string& text) {
    try {
        parse_epw(text, "fuzz.epw");
    } catch (const UserError&) {
    }
}

inline void try_gzip(const std::string& bytes) {
    try {
        unpack_gzip(bytes, "fuzz.gz");
    } catch (const UserError&) {
    }
}

}  // namespace bemcal::job
