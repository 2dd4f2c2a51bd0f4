/// Inputs that enter linearly, split into what drivers bring per value and the rest, and
/// the way back through both: drivers are taken out of a copy, which the drive evaluates.
/// Follows from how Input's value is made (building). Inputs with a factor or a change of
/// schedule are not linear; input_profiles tells which profiles may be drivers.
#include "kernel/linear_input.hpp"

#include "adjoint/network_adjoint.hpp"

namespace bemcal::kernel {

namespace {

bool is_driven(const physics::Change& change, const std::vector<int>& drivers) {
    return change.kind == physics::ChangeKind::shift && contains(drivers, change.profile);
}

/// Without the drivers.
physics::Input rest_of(physics::Input input, const std::vector<int>& drivers) {
    if (contains(drivers, input.profile)) input.value = input.low;
    for (physics::Change& change : input.changes)
        if (is_driven(change, drivers)) change.amount = 0;
    return input;
}

}  // namespace

bool is_linear(const physics::Input& input) {
    for (const physics::Change& change : input.changes) {
        if (change.kind != physics::ChangeKind::shift) return false;
    }
    return true;
}

bool follows(const physics::Input& input, int profile) {
    if (input.profile == profile) return true;
    for (const physics::Change& change : input.changes) {
        if (change.profile == profile) return true;
    }
    return false;
}

double along(const physics::Input& input, int profile) {
    double sum = input.profile == profile ? input.value - input.low : 0;
    for (const physics::Change& change : input.changes) {
        if (change.profile == profile) sum += change.amount;
    }
    return sum;
}

void pull_along(const physics::Input& input, int profile, double of_along,
                physics::Input& of_input) {
    if (input.profile == profile) {
        of_input.value += of_along;
        of_input.low -= of_along;
    }
    for (std::size_t k = 0; k < input.changes.size(); ++k)
        if (input.changes[k].profile == profile) of_input.changes[k].amount += of_along;
}

double tabled_changed(const physics::Input& input, const std::vector<int>& drivers,
                      const physics::Drive& drive, int step) {
    return drive.at(rest_of(input, drivers), step);
}

void pull_tabled(const physics::Input& input, const std::vector<int>& drivers,
                 const physics::Drive& drive, int step, double of_value,
                 physics::Input& of_input) {
    const bool is_driver = contains(drivers, input.profile);
    if (!input.is_changed()) {
        if (is_driver)
            of_input.low += of_value;
        else
            adjoint::pull_input(input, drive, step, of_value, of_input);
        return;
    }
    physics::Input of_rest;
    of_rest.changes.resize(input.changes.size());
    adjoint::pull_input(rest_of(input, drivers), drive, step, of_value, of_rest);
    of_input.low += is_driver ? of_rest.low + of_rest.value : of_rest.low;
    if (!is_driver) of_input.value += of_rest.value;
    for (std::size_t k = 0; k < input.changes.size(); ++k)
        if (!is_driven(input.changes[k], drivers))
            of_input.changes[k].amount += of_rest.changes[k].amount;
}

}  // namespace bemcal::kernel
