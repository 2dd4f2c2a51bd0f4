/// Numbers that decide in the search for missing effects, each with its unit, what it
/// decides, and where it comes from. README.md of loop has them as a table, with the
/// test at each one's edge ('Numbers that decide').
#pragma once

#include <array>
#include <cstddef>

namespace bemcal::loop::decisions {

// Keys of the job, as they are if it says nothing

/// Effects that are accepted; then the search ends. Judgement.
inline constexpr int most_effects = 6;
/// Length of a block of the training period [d]. Judgement.
inline constexpr double block_days = 14;
/// Fall of the unseen error that a candidate must bring, as a mean over meters [%].
/// Judgement.
inline constexpr double least_gain = 2;
/// Rise of it that each meter may show [%]. Judgement.
inline constexpr double most_loss = 1;
/// Chance that noise alone passes the threshold in a round. Statistic: a level of 1 %.
inline constexpr double alpha = 0.01;
/// Runs of another program that is searched. Data: fits of the small office in
/// around_simulator.cpp.
inline constexpr int simulator_runs = 80;

// Readings and their errors

/// Blocks over which errors are counted as one [d]. Judgement: a week repeats.
inline constexpr double days_of_noise = 7;
/// Readings left out where the state before them is not known [h]. Judgement: heavy
/// walls take two days.
inline constexpr int hours_of_state = 48;
/// So many times longer a period is, or none are left out. Judgement.
inline constexpr int least_times_state = 10;
/// Of the largest meter's energy: from here on a meter counts whole. Judgement.
inline constexpr double share_of_largest = 0.1;
/// Weight of the smallest meter. Judgement.
inline constexpr double least_share_of_meter = 0.01;
/// No month counts as met better than that. Statistic: a fifth of the 15 % of ASHRAE
/// Guideline 14.
inline constexpr double least_error_of_month = 0.03;
/// Error of a meter whose readings are all the same, of the largest meter. Judgement.
inline constexpr double error_of_constant = 0.1;
/// The same of a temperature [K]. Judgement.
inline constexpr double error_of_constant_air = 1;
/// Of a meter's error: what is less is met as if exactly. Judgement.
inline constexpr double met_exactly = 1e-3;
/// Error before the first fit, of what readings vary. Judgement: it is found anew.
inline constexpr double first_error = 0.2;
/// Hours that count as one before the first fit [h]. Judgement: a day.
inline constexpr double first_kappa = 24;
/// Fits, each with the errors that the one before left. Judgement.
inline constexpr int noise_rounds = 2;

// Hours that are searched

/// Each hour that is not the usual one of its use [deviance]. Judgement: exp(-1/4) as
/// likely.
inline constexpr double cost_of_hour = 0.5;
/// Rounds over schedules and kinds of days. Judgement.
inline constexpr int most_hour_rounds = 6;
/// Runs of hours that are calibrated after all were followed along tangents. Judgement.
inline constexpr std::size_t most_runs_calibrated = 3;
/// Begins and ends of other hours than declared that are simulated first [h]. Judgement:
/// time; all others beside the best of them follow.
inline constexpr int hours_apart_at_first = 2;
/// What other hours must bring [deviance]. Judgement: rounds go to and fro below it.
inline constexpr double least_change_of_hours = 0.1;
/// Probability from which on hours are told without a doubt. Judgement.
inline constexpr double certain_hours = 0.9;
/// Share of begins and ends before the interval that is told. Statistic: 90 %.
inline constexpr double earliest_of_hours = 0.05;
/// Share up to its end. Statistic: 90 %.
inline constexpr double latest_of_hours = 0.95;

// Structure

/// Fall of the unseen deviance that a refinement must bring [deviance]. Judgement: odds
/// of 20.
inline constexpr double least_evidence_of_refinement = 6;
/// One that last gained less than the best over this is not tried again. Judgement.
inline constexpr double promise_ratio = 2;

// What the data could show

/// An effect of typical size that could be seen [standard errors]. Judgement.
inline constexpr double least_detectability = 5;
/// Correlation from which on parameters imitate an effect. Judgement.
inline constexpr double same_signature = 0.98;

/// An effect of the place is believed no further from none [typical size].
/// Judgement: a parabola through one size reaches no further.
inline constexpr double most_steps_of_place = 3;

// Screening on the tangent

/// Sizes at which a candidate is simulated; the third is the small one that bends less
/// [typical size]. Judgement.
inline constexpr std::array amplitudes = {1.0, -1.0, 0.25, -0.25};
/// A secant holds up to so many amplitudes. Judgement.
inline constexpr double most_of_secant = 2.5;
/// And from this share of one on. Judgement.
inline constexpr double least_of_secant = 0.02;
/// Draws of signs for the threshold. Statistic: four of them are over a level of 1 %.
inline constexpr int null_draws = 400;

// Refitting and judging

/// Candidates refitted in a round. Judgement: time.
inline constexpr std::size_t most_refitted = 36;
/// Of them of one name, or of one hook of the grammar. Judgement.
inline constexpr std::size_t most_of_a_kind = 3;
/// Of them fitted to the end and judged. Judgement: time.
inline constexpr std::size_t most_judged = 14;
/// What a candidate of the grammar pays, and one by which a meter reads otherwise: plants
/// and use do as much more often [deviance]. Statistic: -2 log 0.1, their prior weight.
inline constexpr double price_of_a_tenth = 4.6;
/// A picked day pays 2 log of this; a holiday of a calendar saves log of it. Statistic:
/// the days of a year.
inline constexpr double days_to_pick_from = 365;
/// Blocks of an effect of picked days [d]. Judgement: it acts on few.
inline constexpr double days_of_short_blocks = 2;
/// Of the best one's evidence: from here on dates and hours move before judging.
/// Judgement: time.
inline constexpr double dated_share_of_best = 0.3;
/// And from this evidence on [deviance]. Judgement: time.
inline constexpr double dated_evidence = 100;
/// Names whose dates move. Judgement: time.
inline constexpr std::size_t most_dated_names = 3;
/// Each of two dates or hours that moved pays 2 log of this. Statistic: four weeks'
/// days.
inline constexpr double places_of_date = 28;

// Gates

/// Factor beyond an end of the plausible range. Judgement.
inline constexpr double slack_of_range = 1.5;
/// First and last part of training in which no step may lie [a]. Judgement: the state
/// before, too few days after.
inline constexpr double two_weeks_at_ends = 0.04;
/// Weight from which on a meter counts. Judgement.
inline constexpr double least_share_that_counts = 0.5;
/// Of the best meter's gain: what another may lose, also by functions. Judgement.
inline constexpr double share_in_exchange = 0.15;
/// Of the evidence: what unseen blocks must show of it. Data: 70 right effects had 0.73
/// or more (seeds 401 to 408, EnergyPlus), a third of the wrong ones 0.71 or less.
inline constexpr double share_foretold = 0.72;
/// Of what follows a step: the last part, which the first must foretell. Judgement: as
/// much is left to learn its size from.
inline constexpr double share_behind_step = 0.5;
/// Evidence of what joins beside functions [thresholds]. Data: right effects had 3.8 or
/// more (seed 408, EnergyPlus), wrong ones up to 2.8.
inline constexpr double least_beside_functions = 3;
/// Standard deviation of an electricity meter's level from year to year. Data: 232
/// buildings (bench_level_change.py).
inline constexpr double change_of_electricity = 0.06;
/// The same of other energy meters. Data: 232 buildings (bench_level_change.py).
inline constexpr double change_of_fuel = 0.18;

// Class and doubts

/// Of the threshold: from there on unseen blocks are judged. Judgement.
inline constexpr double rival_share = 0.7;
/// Drawings of blocks for the probability of a name. Statistic: 0.025 at most of
/// standard error.
inline constexpr int bagging_draws = 400;
/// Probability from which on an effect joins. Statistic: more probable than not.
inline constexpr double least_probability_to_join = 0.5;
/// Probability from which on a name is told without a doubt. Judgement.
inline constexpr double told_probability = 0.9;
/// Probability from which on another name is of the class. Judgement: one of twenty.
inline constexpr double least_probability = 0.05;
/// Names of a class. Judgement: room.
inline constexpr std::size_t most_names_of_class = 3;
/// Rivals kept, to take an effect's place later. Judgement: time.
inline constexpr std::size_t most_rivals = 8;
/// What noise's fluctuation exceeds once in a hundred: an alarm of 1. Statistic: the
/// largest of a Brownian bridge.
inline constexpr double critical_fluctuation = 1.628;
/// Of the alarm before: what may be left of a pattern that is over. Judgement: no model
/// is exact.
inline constexpr double largest_alarm_left = 0.5;
/// Readings of 0 that each bin has beforehand, for the share left unexplained.
/// Judgement.
inline constexpr double readings_of_no_pattern = 3;

// Moves of what was accepted

/// What a rival in its place, a split or a new start must bring [deviance]. Judgement:
/// odds of 20.
inline constexpr double least_evidence_of_move = 6;
/// What a moved threshold, date or hour must bring [deviance]. Judgement.
inline constexpr double least_fall_of_shape = 0.5;
/// Moves of one length. Judgement: time.
inline constexpr int most_moves = 5;
/// A date's first move, in days: the last is one day long [d]. Statistic: the first
/// moves in drivers.cpp.
inline constexpr double days_of_first_move = 14;
/// First move of an effect's hours [h]. Judgement.
inline constexpr double hours_of_first_move = 2;
/// A set-point is kept so long [h]. Judgement: what is shorter is the plant's start.
inline constexpr double least_window = 3;
/// Of two coefficients: what parts plant from use. Judgement.
inline constexpr double least_difference_of_halves = 0.2;

// What stays

/// Evidence below which an effect is no longer needed; a split must bring it
/// [thresholds]. Judgement.
inline constexpr double share_of_threshold = 0.5;
/// Times most_effects: rounds at most. Judgement: what is accepted may leave.
inline constexpr int rounds_per_effect = 3;
/// Of a coefficient, or of what hours bring: what the hour's model is off. Data: seeds 71
/// and 81 of bench_loop.py.
inline constexpr double error_of_model = 0.08;
/// The same, to be divided by the root of the share of what an effect does that no other
/// unknown can do. Data: three effects of which that is 0.002 to 0.007 (seed 500, dev_03)
/// were off by 0.16 to 0.78.
inline constexpr double error_beside_others = 0.03;
/// Parts of training left out in turn for an interval. Judgement: months of a year.
inline constexpr double jackknife_parts = 12;
/// Weight from which on a meter must not get worse in the last fit. Judgement.
inline constexpr double least_share_spared = 0.1;
/// Of a coefficient: further, the last fit stops. Judgement.
inline constexpr double most_change_spared = 0.1;
/// Last fits. Judgement: time.
inline constexpr int most_rounds_spared = 8;
/// Growth of a meter's mean square that is left: 0.2 % of the error. Judgement.
inline constexpr double most_growth_spared = 1.004;

// A late clock

/// A shift of schedules as near to whole hours asks for the clock [h]. Judgement.
inline constexpr double about_whole_hours = 0.3;
/// What a clock must explain more than schedules, or than another hour [deviance].
/// Judgement: odds of 150.
inline constexpr double least_fall_of_clock = 10;

// Closed days

/// Days between those that are closed in one simulation [d]. Judgement: a day's
/// response has died.
inline constexpr int days_closed_apart = 3;
/// Weight from which on a meter tells of closed days. Judgement.
inline constexpr double closed_meter_share = 0.5;
/// Of the median day's squares: a day that would show it. Judgement.
inline constexpr double least_share_of_signature = 0.1;
/// Days that show it, or none is told. Judgement.
inline constexpr std::size_t least_days_shown = 20;
/// A day is closed from here [Sundays]. Judgement.
inline constexpr double least_closed_share = 0.5;
/// To here [Sundays]. Judgement.
inline constexpr double most_closed_share = 1.7;
/// From ordinary days' middle [standard deviations]. Judgement: one day in 3 million.
inline constexpr double least_closed_deviation = 5;
/// A run that takes in the weekends at its ends [d]. Judgement.
inline constexpr int least_long_run = 3;
/// How far a closed day of a calendar lies from a Sunday [Sundays]. Judgement: it keeps
/// some use.
inline constexpr double closed_spread = 0.25;
/// A holiday's own day against the one beside it [log]. Judgement: moved in one year of
/// twenty.
inline constexpr double odds_of_own_day = 3;
/// What a state's calendar pays beyond its country's [picks]. Judgement: a house adds a
/// day of its own, so more than one.
inline constexpr double picks_of_state = 1.5;
/// For a calendar [odds]. Judgement: a probability of 90 %.
inline constexpr double least_odds_of_calendar = 9;

// Functions

/// Evidence that a function at a physical hook must bring [log]. Judgement: as many are
/// tried.
inline constexpr double log_odds_of_hook = 5;
/// The same at a meter [log]. Judgement: a tenth as likely.
inline constexpr double log_odds_of_meter = 7.3;
/// More, of other hours from a day on [log]. Statistic: log 365, no more days of a year
/// are looked at.
inline constexpr double log_odds_of_day = 5.9;
/// On either side of such a day [d]. Judgement: a season; what is shorter may be one.
inline constexpr int least_days_of_change = 91;
/// How far parameters move with functions in a round [prior sd]. Judgement: where steps
/// are linear.
inline constexpr double linear_range = 0.2;
/// Every so many-th block is left out together. Judgement.
inline constexpr std::size_t function_folds = 6;
/// Searches, each about the model with the functions so far. Judgement: time.
inline constexpr int function_rounds = 2;
/// Rise of a whole meter's unseen error. Judgement.
inline constexpr double most_rise_by_functions = 0.01;
/// Move of a hook for its slope [typical size]. Judgement: between rounding and what a
/// function brings.
inline constexpr double moved_share = 0.25;

// What is told

/// A parameter beyond is far from its prior, a setting denied [prior sd]. Statistic:
/// one of 370.
inline constexpr double far = 3;
/// Training from which on what effects bring is told per year [d]. Judgement.
inline constexpr double days_of_all_seasons = 300;
/// Draws for what an effect brings. Statistic: a deviation is known within 9 %.
inline constexpr std::size_t draws_of_worth = 64;
/// A parameter that is an open question, and denies no setting [prior sd]. Judgement.
inline constexpr double wide_parameter = 0.5;
/// Lengths of a measurement [weeks]. Judgement.
inline constexpr std::array weeks_tried = {1, 2, 4, 8};
/// Chance to tell a name that is enough. Judgement.
inline constexpr double enough_chance = 0.95;
/// Of a parameter's deviation: enough. Judgement.
inline constexpr double enough_narrower = 0.5;
/// Less is not worth a measurement. Judgement.
inline constexpr double least_fall_of_doubt = 0.1;
/// Of a thermometer that nobody has read yet [K]. Data: school rooms and twin house of
/// bench/README.md.
inline constexpr double error_of_room = 0.5;
/// Of an energy meter that nobody has read yet. Statistic: the hourly limit of ASHRAE
/// Guideline 14.
inline constexpr double error_of_energy = 0.3;
/// Levels of the prediction that have bands of their own. Judgement.
inline constexpr std::size_t band_levels = 8;
/// Fewer in a kind, and it has the bands of all. Judgement.
inline constexpr std::size_t least_residuals = 50;
/// Residuals below and above a band. Statistic: 90 %.
inline constexpr double band_tail = 0.05;
/// Day of the bands begins [h]. Judgement.
inline constexpr int band_day_begins = 7;
/// And ends [h]. Judgement.
inline constexpr int band_day_ends = 19;

// Around another program

/// A round of calibration has one run of so many of the budget. Data: fits of the small
/// office in around_simulator.cpp.
inline constexpr int runs_per_round = 20;
/// Rounds of calibration. Data: fits of the small office in around_simulator.cpp.
inline constexpr int calibrations_around = 6;
/// Rounds after the effects. Judgement.
inline constexpr int refinements_around = 2;
/// Effects that the budget keeps runs for. Judgement: what a search finds.
inline constexpr int effects_expected = 3;
/// Named effects and functions that are tried. Judgement: runs.
inline constexpr int most_effects_around = 6;
/// Runs that try an effect. Judgement: parameters stood in for it.
inline constexpr std::size_t runs_of_trial = 2;
/// Runs that do without it at the end. Judgement.
inline constexpr std::size_t runs_of_doubt = 2;
/// What an effect must bring to stay [deviance]. Statistic: 2 log 1000, once in a
/// thousand candidates.
inline constexpr double least_fall_around = 13.8;
/// Prior mean of a parameter [range]. Judgement: nothing is known but its range.
inline constexpr double centre_of_parameter = 0.5;
/// Its prior's standard deviation [range]. Judgement: nothing is known but its range.
inline constexpr double sd_of_parameter = 1;
/// Most of an effect's scale. Judgement.
inline constexpr double largest_scale = 2;
/// Its prior's mean. Statistic: as found.
inline constexpr double usual_scale = 1;
/// Its prior's standard deviation. Judgement: the twin is another building.
inline constexpr double sd_of_scale = 0.5;

}  // namespace bemcal::loop::decisions
