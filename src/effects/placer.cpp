/// Keeps a building, profiles and coefficients while effects are put into it.
/// Follows from physics::Change.
/// What a hook does with these steps is left to entering.
#include "effects/placer.hpp"

#include "base/error.hpp"
#include "effects/sites.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::effects {

int Placer::profile_row(std::vector<double> series) {
    const auto found =
        is_declared_ ? rows_.end() : std::find(rows_.begin(), rows_.end(), series);
    const auto row = static_cast<std::size_t>(found - rows_.begin());
    if (found == rows_.end()) rows_.push_back(std::move(series));
    return static_cast<int>(first_row_ + row);
}

void Placer::change(physics::Target target, physics::ChangeKind kind, int row) {
    auto& changes = physics::input_at(building_, target)->changes;
    target.change = static_cast<int>(changes.size());
    changes.push_back({0, row, kind});
    parameters_.back().targets.push_back(target);
}

void Placer::set(physics::Target part, const double& number) {
    parameters_.back().targets.push_back(target_of(building_, part, number));
}

void Placer::set(physics::Target part, const physics::Input& input) {
    physics::Target target = target_of(building_, part, input);
    target.slot = physics::Slot::value;
    parameters_.back().targets.push_back(target);
}

std::string Placer::new_name() const {
    return fmt::format("effect_{}", parameters_.size());
}

bool Placer::has(const std::string& name) const {
    return std::any_of(parameters_.begin(), parameters_.end(),
                       [&](const auto& parameter) { return parameter.name == name; });
}

bool Placer::acts() const {
    const auto is_zero = [](double x) { return x == 0; };
    return acts_always_ || std::any_of(rows_.begin(), rows_.end(), [&](const auto& row) {
               return !std::all_of(row.begin(), row.end(), is_zero);
           });
}

physics::Drive Placer::drive() const {
    physics::Drive drive = *around_.drive;
    write_profiles(drive);
    return drive;
}

void Placer::write_profiles(physics::Drive& drive) const {
    Matrix& profiles = drive.profiles;
    const std::size_t n_own = first_row_;
    profiles.rows = n_own + rows_.size();
    profiles.cols = static_cast<std::size_t>(drive.n_steps());
    profiles.values.resize(profiles.rows * profiles.cols);
    for (std::size_t k = 0; k < rows_.size(); ++k)
        std::ranges::copy(rows_[k], profiles.row(n_own + k).begin());
}

}  // namespace bemcal::effects
