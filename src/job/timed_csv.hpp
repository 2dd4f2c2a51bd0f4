/// A CSV file as a section of the job says it is to be read: [weather], [[series]],
/// [[meter]].
#pragma once

#include "job/input_files.hpp"
#include "job/section.hpp"
#include "job/series.hpp"
#include "physics/weather.hpp"

#include <string>

namespace bemcal::job {

/// The clock, stamp and format of the section (schema: "source").
StampRules stamp_rules(const Section& section, const physics::Site& site);

struct TimedCsv {
    const Csv* csv = nullptr;
    Stamps stamps;
    StampRules rules;
    char decimal = '.';
    bool gaps_are_missing = false;
};

/// Opens the file that stands at `key` and reads its stamps. Throws UserError as csv.hpp
/// and stamps.hpp say.
TimedCsv open_csv(const Section& section, const char* key, const std::string& file,
                  InputFiles& files, const physics::Site& site,
                  int fallback_step_s = 3600);

/// A column as an even series; absent rows are an error unless the section takes them.
RegularSeries series_of(const TimedCsv& source, const std::string& column);

/// Means of the hours of a finer series; an hour with a missing value is missing. Throws
/// UserError (data) where the series is coarser than an hour or hours do not begin on the
/// hour.
RegularSeries hourly_means(const RegularSeries& series, const std::string& file);

}  // namespace bemcal::job
