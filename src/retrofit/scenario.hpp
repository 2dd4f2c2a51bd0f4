/// What a retrofit changes of a building: numbers, and what heats it.
///
/// A change may depend on the number that it finds (half the air change, insulation on a
/// wall of unknown U-value), so it is made to every point of a calibration by itself.
#pragma once

#include "study/case.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace bemcal::retrofit {

enum class ChangeBy {
    value,      ///< it becomes this
    factor,     ///< times this
    offset,     ///< plus this
    resistance  ///< of a U-value: a layer of so many m2 K/W more, 1 / (1 / U + R)
};

struct ScenarioChange {
    std::vector<physics::Target> targets;
    ChangeBy by = ChangeBy::value;
    double amount = 0;
};

struct Scenario {
    std::string name;
    std::vector<ScenarioChange> changes;              ///< one after the other
    std::optional<physics::Carrier> heating_carrier;  ///< another plant; none: as it is
};

double changed(double number, ChangeBy by, double amount);

/// The numbers of a building that its parameters or some scenarios write to, each once: a
/// point of a calibration, before and after, is a row of them.
class ScenarioNumbers {
  public:
    ScenarioNumbers(const study::Case& building, const std::vector<Scenario>& scenarios);

    /// Each number as a parameter that replaces it.
    const std::vector<physics::Parameter>& numbers() const { return numbers_; }
    /// \param point  of the case's parameters  \return [numbers]
    std::vector<double> before(std::span<const double> point) const;
    std::vector<double> after(std::vector<double> numbers,
                              const Scenario& scenario) const;
    /// What is outside the range that its table of numbers gives, in words; "" = none.
    std::string complaint(std::span<const double> numbers) const;

  private:
    /// Numbers of an effect, and of one that it is a part of.
    struct Part {
        std::size_t number, of;
    };
    void add(const physics::Target& target);
    std::size_t number_of(const physics::Target& target) const;
    void find_parts();

    physics::Building building_;
    std::vector<physics::Parameter> parameters_, numbers_;
    std::vector<Part> parts_;
};

/// The building with another plant, where the scenario has one.
physics::Building with_plant(physics::Building building, const Scenario& scenario);

}  // namespace bemcal::retrofit
