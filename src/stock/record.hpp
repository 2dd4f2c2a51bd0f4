/// What a night knows of each building of a stock: whether and why it was worked on, its
/// files, errors, values and findings. It is an item's answer, a part of the result, and
/// what the next night starts from.
#pragma once

#include "base/nan.hpp"
#include "job/job.hpp"
#include "study/stage.hpp"
#include "study/summary.hpp"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace bemcal::stock {

/// Of the last days, of a building that was tested in a night.
inline constexpr const char* recent_period = "recent";

/// The first lines of a night's table and of the history of nights.
constexpr const char* table_head =
    "building,status,cause,reason,drift,nights_since,simulations,meter,"
    "cv_rmse_start,cv_rmse_training,cv_rmse_last_period,nmbe_last_period,findings\n";
constexpr const char* history_head =
    "night,building,status,cause,cv_rmse_training,cv_rmse_last_period,"
    "nmbe_last_period,drift,reason\n";
constexpr const char* changes_head = "building,change,effect,searches\n";

/// In StockRecord::Name.
inline constexpr double of_what_did_not_join = -1;

struct StockRecord {
    std::string name;
    std::string status;  ///< calibrated, tested, unchanged, postponed, failed
    std::string
        cause;  ///< why it was due: new, line, job, data: FILE; empty = it was not
    std::string reason;  ///< why it failed
    std::string drift;   ///< what drifts; empty = nothing
    std::string told;    ///< what has changed of its effects; empty = nothing
    std::string line_hash, job_hash;
    std::string data_hash;  ///< of readings and weather from the first day to the last
    double age = 0;         ///< nights since it was calibrated
    double simulations = 0;
    double daily_start = 0;  ///< of `daily` [d since 1970]

    struct File {
        std::string path, hash;  ///< no hash: it could not be read
    };
    std::vector<File> files;

    struct Fit {
        std::string meter, unit, period;
        double measured = 0;  ///< sum of its n readings
        double n = 0;
        double before = 0, cv_rmse = 0, nmbe = 0;  ///< before: CV(RMSE) as it started
        double rmse() const { return n > 0 ? cv_rmse * measured / n : 0; }
    };
    std::vector<Fit> fits;

    struct Value {
        std::string name, unit;
        double least = 0, most = 0, value = 0, low = 0, high = 0;
        double moved = 0;  ///< since the night before, of the range
    };
    std::vector<Value> values;

    /// What of a loop's model is no effect, as sections of a job, and what it follows
    /// from: line but for its end, job.
    std::string adopted, adopted_hash;
    double known_from = 0, known_to = 0;  ///< in which it was found [s since 1970]
    double tested_to = 0;  ///< behind the last day that was tested [d since 1970]
    double searches = 0;   ///< in this night

    /// An effect that it has or had, by the last night.
    struct Effect {
        std::string name, unit;
        std::string state;    ///< new, holds, changed, ended
        std::string section;  ///< of a job; empty: it has no name
        double coefficient = nan, low = nan, high = nan;  ///< as it was found
        double since = nan;  ///< first day of this state, where one is known [d]
        /// What the stock makes of it: its likeliest name and how probable that is, and
        /// the coefficient, where others have it too.
        std::string by_stock{};
        double by_stock_probability = nan, by_stock_coefficient = nan;
    };
    std::vector<Effect> effects;
    /// A name that an effect may have, by the building's own readings.
    struct Name {
        double effect = 0;  ///< place in `effects`; -1: of what did not join
        std::string name;
        double probability = 0;
    };
    std::vector<Name> names;
    /// By its own readings.
    std::vector<study::PlaceEffect> of_the_place;
    /// Of what did not join, as of an effect.
    std::string undecided;
    double undecided_probability = nan;

    /// A step that a night has told: the model goes on with it.
    struct Change {
        std::string of;   ///< name of an effect, or of a pattern without a name
        double day = 0;   ///< its first [d since 1970]
        double size = 0;  ///< of an effect: share of its coefficient; -1 = it has ended
    };
    std::vector<Change> changes;

    std::vector<study::DataDecision> findings;
    /// Daily sums of the first energy meter of the last days, to find meters that are
    /// one.
    std::vector<float> daily;

    bool is_failed() const { return status == "failed"; }
};

/// What is known on, of a building with which nothing is done this night.
StockRecord carried_over(const StockRecord& before);

/// As an item's numbers: how many bytes, then 8 of them in a number.
std::vector<double> pack(const StockRecord& record);
/// \param used  so many numbers were its own
StockRecord unpack_record(std::span<const double> packed, std::size_t& used);

/// Datasets stock/*, from the records in the order of the stock; each is asked for once,
/// so that no two need to be there at a time.
std::vector<study::Dataset> datasets_of(
    std::size_t n_records, const std::function<StockRecord(std::size_t)>& record);
/// And back; empty where they hold no stock.
std::vector<StockRecord> records_in(const std::vector<study::Dataset>& datasets);

}  // namespace bemcal::stock
