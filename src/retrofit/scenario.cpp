/// Applies a retrofit's changes to the numbers of a point: set, multiply, shift, or add a
/// layer to a U-value, 1 / (1 / U + R). Says which number leaves its range.
/// Parts of an effect, which a posterior has sampled, are scaled as it is.
/// Source: ISO 6946, resistances in series.
/// Numbers that links or layers set are refused before, by `read_scenarios`.
#include "retrofit/scenario.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::retrofit {

using physics::Target;

double changed(double number, ChangeBy by, double amount) {
    switch (by) {
        case ChangeBy::value:
            return amount;
        case ChangeBy::factor:
            return number * amount;
        case ChangeBy::offset:
            return number + amount;
        case ChangeBy::resistance:
            return number / (1 + number * amount);
    }
    return number;
}

ScenarioNumbers::ScenarioNumbers(const study::Case& building,
                                 const std::vector<Scenario>& scenarios)
    : building_(building.building), parameters_(building.parameters) {
    for (const physics::Parameter& parameter : parameters_)
        for (const Target& target : parameter.targets) add(target);
    for (const Scenario& scenario : scenarios)
        for (const ScenarioChange& change : scenario.changes)
            for (const Target& target : change.targets) add(target);
    find_parts();
}

void ScenarioNumbers::find_parts() {
    const auto number_of_effect = [&](const physics::Coefficient& effect) {
        return number_of(effect.targets.at(0));
    };
    for (const physics::Coefficient& effect : building_.effects) {
        if (!effect.part_of) continue;
        const Part part{number_of_effect(effect),
                        number_of_effect(building_.effects[*effect.part_of])};
        if (std::max(part.number, part.of) < numbers_.size()) parts_.push_back(part);
    }
}

void ScenarioNumbers::add(const Target& target) {
    if (number_of(target) < numbers_.size()) return;
    physics::Parameter number;
    number.name = physics::info_of(building_, target).name;
    number.targets = {target};
    number.nominal = physics::number_at(building_, target);
    numbers_.push_back(std::move(number));
}

std::size_t ScenarioNumbers::number_of(const Target& target) const {
    const auto found = std::ranges::find_if(numbers_, [&](const auto& number) {
        return physics::is_same_number(number.targets[0], target);
    });
    return static_cast<std::size_t>(found - numbers_.begin());
}

std::vector<double> ScenarioNumbers::before(std::span<const double> point) const {
    physics::Building building = building_;
    physics::apply(building_, parameters_, point, building);
    std::vector<double> values;
    values.reserve(numbers_.size());
    for (const physics::Parameter& number : numbers_)
        values.push_back(physics::number_at(building, number.targets[0]));
    return values;
}

std::vector<double> ScenarioNumbers::after(std::vector<double> numbers,
                                           const Scenario& scenario) const {
    for (const ScenarioChange& change : scenario.changes)
        for (const Target& target : change.targets) {
            const std::size_t k = number_of(target);
            const double before = numbers[k];
            numbers[k] = changed(before, change.by, change.amount);
            for (const Part& part : parts_)
                if (part.of == k && before != 0)
                    numbers[part.number] *= numbers[k] / before;
        }
    return numbers;
}

std::string ScenarioNumbers::complaint(std::span<const double> numbers) const {
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        const physics::NumberInfo number =
            physics::info_of(building_, numbers_[k].targets[0]);
        if (numbers[k] >= number.least && numbers[k] <= number.most) continue;
        return fmt::format("{} would be {:g}; expected {:g} to {:g} {}", number.name,
                           numbers[k], number.least, number.most, number.unit);
    }
    return {};
}

physics::Building with_plant(physics::Building building, const Scenario& scenario) {
    if (scenario.heating_carrier)
        building.plant.heating_carrier = *scenario.heating_carrier;
    return building;
}

}  // namespace bemcal::retrofit
