/// What to measure next: for each question that the readings leave open, how likely a
/// measurement of some weeks would answer it.
///
/// A measurement is the meters that there are, read on for some weeks, and one reading
/// more beside them. It adds to the tangent's information, with the errors that such
/// readings have.
#pragma once

#include "base/nan.hpp"
#include "loop/baseline.hpp"
#include "loop/found.hpp"

#include <string>
#include <vector>

namespace bemcal::loop {

/// What a measurement would answer; it is stored as it is. What is not known is NaN.
struct Answer {
    std::string question;  ///< "night purge, or windows open in warm weather?", "U_wall"
    std::string kind;      ///< "name" or "parameter"
    std::string measure;   ///< "room temperature by the hour"
    std::string from;      ///< "1 January": when these weeks tell most
    double weeks = nan;
    /// Of a name: the chance that the likelier one is right, today and with it. Of a
    /// parameter: its standard deviation, as a share of its prior's.
    double now = nan, then = nan;
    double is_advised = nan;  ///< 1: the cheapest that is enough, or else the best; none
                              ///< where the best tells hardly more
};

/// \param misfit  errors count so many times, as in `deviations_of`
std::vector<Answer> next_measurements(const LoopData& data, const Place& place,
                                      const Standing& last,
                                      const std::vector<Found>& found, double misfit);

/// Whether today's readings tell a question of that kind, so that it needs no others.
bool is_told(const std::string& kind, double now);

/// Marks one of a question's answers, which stand in the order of their cost: the first
/// that is enough, else the best, if it is worth the work.
void advise(std::vector<Answer>& of_one);

/// The chance that of two models the one that readings speak for is right.
/// \param so_far  evidence for the first, as a fall of -2 log likelihood
/// \param apart   what the readings would bring to the one that is right
double chance_to_tell(double so_far, double apart);

}  // namespace bemcal::loop
