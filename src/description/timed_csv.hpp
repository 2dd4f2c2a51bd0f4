/// A CSV file as a section of the job says it is to be read: [weather], [[series]],
/// [[meter]].
#pragma once

#include "input/csv_numbers.hpp"
#include "input/input_files.hpp"
#include "input/series.hpp"
#include "physics/weather.hpp"
#include "schema/section.hpp"
#include "study/case.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bemcal::description {

/// The clock, stamp and format of the section (schema: "source").
input::StampRules stamp_rules(const schema::Section& section, const physics::Site& site);

struct TimedCsv {
    std::shared_ptr<const input::Csv> own;  ///< where it is not the file's as it is
    const input::Csv* csv = nullptr;
    input::Stamps stamps;
    input::StampRules rules;  ///< as said, or as found
    input::NumberForm numbers;
    bool gaps_are_missing = false;
};

/// How a file is opened where it is not a weather's or a series'.
struct OpenOptions {
    int fallback_step_s = 3600;  ///< where there is one row only
    bool is_mean = true;         ///< rows are means or instants, not sums
    std::string days_of;         ///< column that may be the first of a day's; "" = none
    bool days_by_clock = false;  ///< only where it is named after a time of day
    std::string from, to;        ///< columns of begins and ends; "" = the key time
    bool is_count = false;       ///< rows are what a register shows
};

/// What can be seen of the files at `key` without the site's clock: that they are there
/// and have the columns, and that the section says how to read them.
void check_files(const schema::Section& section, const char* key,
                 const std::vector<std::string>& columns, input::InputFiles& files);

/// Opens the file that stands at `key` and reads its stamps. Throws UserError as csv.hpp
/// and stamps.hpp say.
TimedCsv open_csv(const schema::Section& section, const char* key,
                  const std::string& file, input::InputFiles& files,
                  const physics::Site& site, const OpenOptions& options = {});

/// What was found in the stamps of a file, as decisions on a series.
void note_stamps(const TimedCsv& source, const std::string& series,
                 std::vector<study::DataDecision>& decisions);

/// "FILE:LINE" of the row that holds the beginning of an interval.
std::string row_at(const TimedCsv& source, physics::Seconds begin);

/// Which of its lines were left out, as decisions on the file.
void state_lines(const TimedCsv& source, std::vector<study::DataDecision>& decisions);

/// A column as an even series; absent rows are an error unless the section takes them.
/// \param fold  of finer rows, where the step changes
input::RegularSeries series_of(const TimedCsv& source, const std::string& column,
                               input::Fold fold = input::Fold::mean);

/// Means of the hours of a finer series; an hour with a missing value is missing. Throws
/// UserError (data) where the series is coarser than an hour or hours do not begin on the
/// hour.
input::RegularSeries hourly_means(const input::RegularSeries& series,
                                  const std::string& file);

}  // namespace bemcal::description
