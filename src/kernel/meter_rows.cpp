/// A meter's form at many steps, in blocks on the stack: one load or efficiency after
/// another, not one step after another.
/// Follows from meter_form, to the bit. What meter_form would reject is left to it, so
/// that the message is its own.
#include "kernel/meter_rows.hpp"

#include <array>
#include <cmath>

namespace bemcal::kernel {

namespace {

constexpr std::size_t most_steps = 64;

/// A number at each step of a block.
using Values = std::array<double, most_steps>;

/// Some steps, and whether all that was evaluated there can be divided by.
class Block {
  public:
    Block(const physics::Drive& drive, std::span<const int> steps)
        : drive_(drive), steps_(steps) {}

    std::size_t size() const { return steps_.size(); }
    bool is_good() const { return good_; }

    void evaluate(const physics::Input& input, Values& values) const {
        if (input.is_changed()) return change(input, values);
        if (input.profile < 0) return fill(values, input.value);
        const double* profile = row(input.profile);
        const double span = input.value - input.low;
        for (std::size_t k = 0; k < size(); ++k)
            values[k] = input.low + span * profile[steps_[k]];
    }
    /// What has to be above 0.
    void evaluate_divisor(const physics::Input& input, Values& values) {
        evaluate(input, values);
        for (std::size_t k = 0; k < size(); ++k) good_ = good_ && values[k] > 0;
    }
    /// What has to be a number >= 0.
    void evaluate_factor(const physics::Input& input, Values& values) {
        evaluate(input, values);
        for (std::size_t k = 0; k < size(); ++k)
            good_ = good_ && values[k] >= 0 && std::isfinite(values[k]);
    }

  private:
    const double* row(int profile) const {
        return drive_.profiles.row(static_cast<std::size_t>(profile)).data();
    }
    void fill(Values& values, double value) const {
        std::fill_n(values.begin(), size(), value);
    }

    /// Drive::at, in its order.
    void change(const physics::Input& input, Values& values) const {
        Values factor, shift;
        fill(values, 1);
        fill(factor, 1);
        fill(shift, 0);
        if (input.profile >= 0)
            for (std::size_t k = 0; k < size(); ++k)
                values[k] = row(input.profile)[steps_[k]];
        for (const physics::Change& change : input.changes) {
            Values& sum = change.kind == physics::ChangeKind::shift    ? shift
                          : change.kind == physics::ChangeKind::factor ? factor
                                                                       : values;
            const double* profile = row(change.profile);
            for (std::size_t k = 0; k < size(); ++k)
                sum[k] += change.amount * profile[steps_[k]];
        }
        const double span = input.value - input.low;
        for (std::size_t k = 0; k < size(); ++k)
            values[k] = (input.low + span * values[k]) * factor[k] + shift[k];
    }

    const physics::Drive& drive_;
    std::span<const int> steps_;
    bool good_ = true;
};

/// true_meter_form's source, share of heating and of cooling at the steps of a block.
struct Forms {
    Values source{}, heating{}, cooling{};
};

void add_loads(const physics::Building& building, physics::Carrier carrier, Block& block,
               Values& source) {
    Values density, efficiency;
    for (const physics::Zone& zone : building.zones)
        for (const physics::Load& load : zone.loads) {
            if (load.carrier != carrier) continue;
            block.evaluate(load.density, density);
            block.evaluate_divisor(load.efficiency, efficiency);
            for (std::size_t k = 0; k < block.size(); ++k)
                source[k] += zone.floor_area * density[k] / efficiency[k];
        }
}

void write_share(const physics::Input& efficiency, Block& block, Values& share) {
    block.evaluate_divisor(efficiency, share);
    for (std::size_t k = 0; k < block.size(); ++k) share[k] = 1 / share[k];
}

Forms forms_of(const physics::Building& building, physics::Quantity quantity,
               Block& block) {
    const physics::Carrier carrier = physics::carrier_of(quantity);
    const physics::Plant& plant = building.plant;
    Forms forms;
    if (plant.heating_carrier == carrier)
        write_share(plant.heating_efficiency, block, forms.heating);
    if (plant.cooling_carrier == carrier)
        write_share(plant.cooling_cop, block, forms.cooling);
    if (carrier == physics::Carrier::electricity)
        for (std::size_t k = 0; k < block.size(); ++k) {
            forms.heating[k] += plant.heating_auxiliary;
            forms.cooling[k] += plant.cooling_auxiliary;
        }
    add_loads(building, carrier, block, forms.source);
    Values factor;
    block.evaluate_factor(building.meter_factor[static_cast<std::size_t>(quantity)],
                          factor);
    for (Values* part : {&forms.heating, &forms.cooling, &forms.source})
        for (std::size_t k = 0; k < block.size(); ++k) (*part)[k] *= factor[k];
    return forms;
}

/// Some of a lane's rows.
struct LaneRows {
    std::size_t first;
    int lane;
    LaneArray& table;
    void write(std::size_t row, const physics::MeterForm& form) const {
        const std::size_t column = 3 * (first + row);
        table.column(column)[lane] = form.source;
        table.column(column + 1)[lane] = form.per_heating;
        table.column(column + 2)[lane] = form.per_cooling;
    }
};

/// Returns whether all could be divided by what it had to.
bool write_block(const physics::Building& building, physics::Quantity quantity,
                 Block block, const LaneRows& to) {
    const Forms forms = forms_of(building, quantity, block);
    for (std::size_t k = 0; k < block.size(); ++k)
        to.write(k, {forms.heating[k], forms.cooling[k], forms.source[k]});
    return block.is_good();
}

}  // namespace

void write_meter_rows(const MeterPlan& plan, const physics::Building& building,
                      const physics::Drive& drive, physics::Quantity quantity, int lane,
                      LaneArray& rows) {
    constexpr std::size_t few_steps = 16;
    const std::span<const int> all = plan.rows.first;
    const bool in_blocks =
        all.size() > few_steps && physics::carrier_of(quantity) != physics::Carrier::none;
    for (std::size_t first = 0; first < all.size(); first += most_steps) {
        const auto steps = all.subspan(first, std::min(most_steps, all.size() - first));
        const LaneRows to{first, lane, rows};
        if (in_blocks && write_block(building, quantity, {drive, steps}, to)) continue;
        for (std::size_t k = 0; k < steps.size(); ++k)
            to.write(k, physics::meter_form(building, drive, quantity, steps[k]));
    }
}

}  // namespace bemcal::kernel
