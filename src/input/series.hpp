/// A column of a CSV file as an evenly spaced series, its gaps known.
#pragma once

#include "input/stamps.hpp"
#include "physics/calendar.hpp"

#include <string>
#include <vector>

namespace bemcal::input {

struct Gap {
    int first = 0, n = 0;  ///< steps without a row
    std::size_t row = 0;   ///< the row after it
};

struct RegularSeries {
    physics::TimeAxis axis;      ///< step_s as found; may be longer than an hour
    std::vector<double> values;  ///< [n_steps], NaN where there is no row or no number
    std::vector<Gap> gaps;       ///< absent rows
};

/// What finer rows make of a longer step: an energy is their sum, a register the first of
/// them, all else their mean.
enum class Fold { sum, mean, first };

/// Lays rows on an axis. Where their step changes, the axis has the shortest step that
/// all of them divide. Throws UserError (data) where a stamp is off the grid of the
/// others.
RegularSeries lay(const Csv& csv, const Stamps& stamps, const std::vector<double>& values,
                  Fold fold = Fold::sum);

/// Steps of `step_s` from whole ones on; one that is cut or has a gap is missing. The
/// series' own step must divide it.
RegularSeries coarsened(const RegularSeries& fine, int step_s, Fold fold);

/// A series of hours or finer whose steps begin beside those of the day: what it shows is
/// shared out between the steps that its own lie in; the cut ones at its ends are left
/// out. Any other stays.
RegularSeries on_whole_steps(RegularSeries series);

/// Puts the next file's readings behind those before it; steps between them are missing.
/// Throws UserError (data) naming `file` where its steps are of another length or grid,
/// or it begins before the end of what is there.
/// \param row  that a gap between the two stands before
void append(RegularSeries& series, const RegularSeries& next, const std::string& file,
            std::size_t row = 0);

/// Throws UserError (data) for the first gap; says how to accept it.
void refuse_gaps(const Csv& csv, const RegularSeries& series);

/// "3 h from 2013-04-02 03:00:00"
std::string words_of(const Gap& gap, const physics::TimeAxis& axis);

/// Fills runs of NaN up to `longest` steps between two numbers by a straight line.
/// \return the number of steps filled
int fill_gaps(std::vector<double>& values, int longest);

}  // namespace bemcal::input
