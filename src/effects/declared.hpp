/// Effects that a building has by its description, as it has walls: each is there in
/// every period, with a coefficient that parameters may write to.
#pragma once

#include "effects/driver_functions.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace bemcal::effects {

struct DeclaredEffects {
    std::vector<Effect> effects;
    std::vector<double> coefficients;  ///< [effects]
    physics::Building building;        ///< before them
    /// Rows of Drive::profiles: theirs, which stay empty (0) in a drive that is made
    /// without write_profiles.
    std::size_t first_row = 0, n_rows = 0;
    physics::Seconds from{};  ///< where `elapsed` is 0: the first step of training
    struct Column {
        std::string name;
        std::size_t row;  ///< of Drive::profiles
    };
    std::vector<Column> columns{};  ///< that they may follow
    /// Functions that an effect follows: their sum is the column of its name.
    struct Functions {
        Hook hook;
        std::string column;
        std::vector<DriverFunction> functions;
        bool is_part = false;  ///< of another one: a deviation that is sampled

        bool are_sampled() const {
            return std::ranges::any_of(functions, &DriverFunction::is_sampled);
        }
        bool follow_loads() const;
    };
    std::vector<Functions> functions{};
    /// A step whose day a posterior samples, so many days before and after the declared.
    struct Day {
        std::size_t effect;
        int within;  ///< [d]
    };
    std::vector<Day> days{};
    WallClock clock{};  ///< of their hours

    bool follow_loads() const;
};

/// The building with them: Building::effects has a row for each. Throws CannotSimulate
/// where one cannot enter.
/// \param drive    of a period; its rows from first_row on have no say
/// \param n_rows   set to the number of rows that they take, the same in every period
physics::Building building_with(const DeclaredEffects& declared,
                                const physics::Drive& drive,
                                const physics::Weather& weather, std::size_t& n_rows);

/// A row of Drive::profiles that is 0 until an effect's profile is written there.
physics::Profile empty_row(const physics::Weather& weather);

/// Writes what they follow into their rows of a period's drive. Throws CannotSimulate
/// where this period lacks what one follows, or where it enters other inputs than before.
/// \param building  with them; simulated where one follows its loads
void write_profiles(const DeclaredEffects& declared, const physics::Building& building,
                    const physics::Weather& weather, physics::Drive& drive);
/// The same with loads that are known.
void write_profiles(const DeclaredEffects& declared, const ModelSeries& loads,
                    const physics::Weather& weather, physics::Drive& drive);

/// Gives a period the columns of functions. Throws CannotSimulate where it lacks what one
/// follows.
void add_columns(const std::vector<DeclaredEffects::Functions>& functions,
                 Surroundings& around);

/// What they follow in a period, with loads of 0.
Surroundings surroundings_of(const DeclaredEffects& declared, const physics::Drive& drive,
                             const physics::Weather& weather);
/// The same with these loads.
Surroundings surroundings_of(const DeclaredEffects& declared, const ModelSeries& loads,
                             const physics::Drive& drive,
                             const physics::Weather& weather);

}  // namespace bemcal::effects
