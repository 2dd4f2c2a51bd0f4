/// A building into which effects are put, one after the other: the few steps that every
/// way of entering is made of.
#pragma once

#include "effects/surroundings.hpp"
#include "physics/parameters.hpp"

#include <string>
#include <vector>

namespace bemcal::effects {

class Placer {
  public:
    /// \param around  must outlive this
    explicit Placer(const Surroundings& around)
        : Placer(around, around.drive->profiles.rows, false) {}
    /// Of declared effects, whose rows are the same ones in every period: from
    /// `first_row` on, one for each profile, whatever it is.
    Placer(const Surroundings& around, std::size_t first_row)
        : Placer(around, first_row, true) {}

    const Surroundings& around() const { return around_; }
    physics::Building& building() { return building_; }

    /// The next effect's coefficient, to which targets are added from here on.
    void begin(physics::Parameter coefficient) {
        parameters_.push_back(std::move(coefficient));
    }
    /// The row of Drive::profiles with this series, appended where it is new.
    int profile_row(std::vector<double> series);
    /// Of the rows that are appended.
    std::size_t first_row() const { return first_row_; }
    /// Whether rows stay that have no say in this period.
    bool keeps_rows() const { return is_declared_; }
    /// Those that were appended.
    const std::vector<std::vector<double>>& rows() const { return rows_; }
    /// Changes an input by a profile.
    void change(physics::Target target, physics::ChangeKind kind, int row);
    /// A number, or an input's value, that is the coefficient itself.
    void set(physics::Target part, const double& number);
    void set(physics::Target part, const physics::Input& input);
    /// What was put has a say without a profile.
    void act_always() { acts_always_ = true; }

    /// For a part that an effect adds.
    std::string new_name() const;
    bool has(const std::string& name) const;

    /// Whether anything that was put has a say at any step.
    bool acts() const;
    /// The surroundings' drive with the profiles appended.
    physics::Drive drive() const;
    /// The same in a copy of that drive, whatever was appended to it before.
    void write_profiles(physics::Drive& drive) const;
    const std::vector<physics::Parameter>& parameters() const { return parameters_; }

  private:
    Placer(const Surroundings& around, std::size_t first_row, bool is_declared)
        : around_(around),
          building_(*around.building),
          first_row_(first_row),
          is_declared_(is_declared) {}

    const Surroundings& around_;
    physics::Building building_;
    std::vector<std::vector<double>> rows_;
    std::vector<physics::Parameter> parameters_;
    std::size_t first_row_;
    bool is_declared_;
    bool acts_always_ = false;
};

}  // namespace bemcal::effects
