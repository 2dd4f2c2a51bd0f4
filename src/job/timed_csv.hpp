/// A CSV file as a section of the job says it is to be read: [weather], [[series]],
/// [[meter]].
#pragma once

#include "input/input_files.hpp"
#include "input/series.hpp"
#include "physics/weather.hpp"
#include "schema/section.hpp"

#include <string>

namespace bemcal::job {

/// The clock, stamp and format of the section (schema: "source").
input::StampRules stamp_rules(const schema::Section& section, const physics::Site& site);

struct TimedCsv {
    const input::Csv* csv = nullptr;
    input::Stamps stamps;
    input::StampRules rules;
    char decimal = '.';
    bool gaps_are_missing = false;
};

/// Opens the file that stands at `key` and reads its stamps. Throws UserError as csv.hpp
/// and stamps.hpp say.
TimedCsv open_csv(const schema::Section& section, const char* key,
                  const std::string& file, input::InputFiles& files,
                  const physics::Site& site, int fallback_step_s = 3600);

/// A column as an even series; absent rows are an error unless the section takes them.
input::RegularSeries series_of(const TimedCsv& source, const std::string& column);

/// Means of the hours of a finer series; an hour with a missing value is missing. Throws
/// UserError (data) where the series is coarser than an hour or hours do not begin on the
/// hour.
input::RegularSeries hourly_means(const input::RegularSeries& series,
                                  const std::string& file);

}  // namespace bemcal::job
