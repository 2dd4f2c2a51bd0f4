/// Linearises every step by differences of the plain step, then scans inputs through the
/// steps: state' = A state + b u, shown = C state + d u.
/// Follows from the chain rule along a trajectory. Kinks (a thermostat that starts to
/// act) are met by the mean slope over the difference; the warm-up moves nothing.
#include "functions/linear_steps.hpp"

#include "base/error.hpp"
#include "physics/cycling.hpp"
#include "physics/stepper.hpp"

namespace bemcal::functions {
namespace {

using physics::Building;
using physics::Drive;
using physics::Quantity;
using physics::Stepper;
using physics::StepResult;

constexpr double moved_by = 0.05;  ///< a state, for its derivative [K; W/m2 of heat]

/// The size of what a state moves by: a temperature's in K, an emitter's power by floor.
std::vector<double> differences_of(const Building& building, const Stepper& stepper) {
    std::vector<double> by(stepper.n_states(), moved_by);
    std::size_t at = 0;
    for (const physics::Zone& zone : building.zones) {
        by[at + 3] = moved_by * zone.floor_area;
        at += 4 + (zone.radiator
                       ? static_cast<std::size_t>(zone.radiator->radiator.n_elements) + 2
                       : 0);
    }
    return by;
}

double shown(const Building& building, const Drive& drive, Quantity quantity, int step,
             std::span<const StepResult> zones) {
    if (physics::is_temperature(quantity)) {
        double sum = 0;
        for (std::size_t z = 0; z < zones.size(); ++z)
            sum += building.zones[z].floor_area * zones[z].theta.theta_air;
        return sum / building.floor_area();
    }
    const physics::MeterForm form = physics::meter_form(building, drive, quantity, step);
    physics::PlantPowers sum;
    for (std::size_t z = 0; z < zones.size(); ++z)
        sum.add(building.plant, building.zones[z].floor_area, zones[z].phi_heating,
                zones[z].phi_cooling, zones[z].phi_fan);
    return (form.per_heating * sum.heating + form.per_cooling * sum.cooling +
            form.per_fan * sum.fan + form.source +
            form.per_lost_heating * sum.lost.heating +
            form.per_lost_cooling * sum.lost.cooling) *
           drive.axis.step_s / 3.6e6;
}

/// A building that is stepped from any state: after the step, and what its meters show.
class Probe {
  public:
    Probe(const Building& building, const Drive& drive,
          std::span<const Quantity> quantities)
        : building_(building),
          drive_(drive),
          quantities_(quantities),
          stepper_(building, drive),
          after(stepper_.n_states()),
          meters(quantities.size()) {}

    /// From the state to `after` and `meters`.
    void step(std::span<const double> from, int step) {
        stepper_.set_state(from);
        const auto zones = stepper_.advance(step);
        stepper_.write_state(after);
        for (std::size_t m = 0; m < meters.size(); ++m)
            meters[m] = shown(building_, drive_, quantities_[m], step, zones);
    }

    const Stepper& stepper() const { return stepper_; }

  private:
    const Building& building_;
    const Drive& drive_;
    std::span<const Quantity> quantities_;
    Stepper stepper_;

  public:
    std::vector<double> after, meters;
};

/// The difference quotients of two probes, written to column `column` of `width`.
void write_difference(const Probe& more, const Probe& less, double by,
                      std::span<double> states, std::span<double> meters,
                      std::size_t column, std::size_t width) {
    for (std::size_t k = 0; k < more.after.size(); ++k)
        states[k * width + column] = (more.after[k] - less.after[k]) / by;
    for (std::size_t m = 0; m < more.meters.size(); ++m)
        meters[m * width + column] = (more.meters[m] - less.meters[m]) / by;
}

void linearise_state(std::span<const double> from, int step,
                     std::span<const double> differences, Probe& more, Probe& less,
                     std::span<double> states, std::span<double> meters) {
    std::vector<double> moved(from.begin(), from.end());
    for (std::size_t k = 0; k < from.size(); ++k) {
        moved[k] = from[k] + differences[k];
        more.step(moved, step);
        moved[k] = from[k] - differences[k];
        less.step(moved, step);
        moved[k] = from[k];
        write_difference(more, less, 2 * differences[k], states, meters, k, from.size());
    }
}

/// to = A state + b u, for each input.
void step(std::span<const double> A, const Matrix& state, std::span<const double> b,
          std::span<const double> u, Matrix& to) {
    for (std::size_t i = 0; i < to.rows; ++i) {
        const auto row = to.row(i);
        for (std::size_t f = 0; f < u.size(); ++f) row[f] = b[i] * u[f];
        for (std::size_t k = 0; k < state.rows; ++k) {
            const double a = A[i * state.rows + k];
            if (a == 0) continue;
            const auto from = state.row(k);
            for (std::size_t f = 0; f < u.size(); ++f) row[f] += a * from[f];
        }
    }
}

}  // namespace

LinearSteps linear_steps(const Building& building, const Drive& drive,
                         std::span<const Quantity> quantities,
                         std::span<const Moved> hooks) {
    Probe base(building, drive, quantities), other(building, drive, quantities);
    const std::vector<double> differences = differences_of(building, base.stepper());
    const auto n = static_cast<std::size_t>(drive.n_steps() - drive.n_warm_up);
    LinearSteps linear{differences.size(), quantities.size(), {}, {}, {}};
    linear.states = Matrix(n, linear.n_states * linear.n_states);
    linear.meters = Matrix(n, linear.n_meters * linear.n_states);
    std::vector<Probe> more, less;
    for (const Moved& hook : hooks) {
        more.emplace_back(*hook.more, *hook.drive, quantities);
        less.emplace_back(*hook.less, *hook.drive, quantities);
        linear.hooks.push_back({Matrix(n, linear.n_states), Matrix(n, linear.n_meters)});
    }
    std::vector<double> state(linear.n_states);
    base.stepper().write_state(state);
    for (int step = 0; step < drive.n_steps(); ++step) {
        if (step >= drive.n_warm_up) {
            const auto at = static_cast<std::size_t>(step - drive.n_warm_up);
            linearise_state(state, step, differences, base, other, linear.states.row(at),
                            linear.meters.row(at));
            for (std::size_t h = 0; h < hooks.size(); ++h) try {
                    more[h].step(state, step);
                    less[h].step(state, step);
                    write_difference(more[h], less[h], 2 * hooks[h].size,
                                     linear.hooks[h].to_state.row(at),
                                     linear.hooks[h].to_meters.row(at), 0, 1);
                } catch (const CannotSimulate&) {
                    continue;
                }
        }
        base.step(state, step);
        state = base.after;
    }
    return linear;
}

Matrix scan(const LinearSteps& steps, std::size_t hook, const Matrix& inputs) {
    const std::size_t n_states = steps.n_states, n = inputs.cols;
    const HookSteps& own = steps.hooks[hook];
    Matrix shown(steps.n_meters * n, steps.n_steps());
    Matrix state(n_states, n), after(n_states, n), meters(steps.n_meters, n);
    for (std::size_t t = 0; t < steps.n_steps(); ++t) {
        const auto u = inputs.row(t);
        step(steps.meters.row(t), state, own.to_meters.row(t), u, meters);
        for (std::size_t k = 0; k < meters.values.size(); ++k)
            shown(k, t) = meters.values[k];
        step(steps.states.row(t), state, own.to_state.row(t), u, after);
        std::swap(state, after);
    }
    return shown;
}

}  // namespace bemcal::functions
