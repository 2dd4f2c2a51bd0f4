/// Writes the kernel's coefficients of a zone: what each linear form of the step weighs
/// per state, power, driver and plane, and the constants of each row.
/// Follows from the forms of step_map; the order is that of kernel::StandardColumn and
/// GeneralColumn. The elimination is left to step_map, what a regime is to regime, meters
/// to meters.
#include "kernel/affine.hpp"

#include <algorithm>

namespace bemcal::kernel {

namespace {

/// Consecutive columns of one lane.
struct Columns {
    double* next;
    int lanes;
    void add(double value) {
        *next = value;
        next += lanes;
    }
};

/// Calls write(weight of a form per value of the driver) for every driver but an imposed
/// power.
template <class Write>
void for_drivers(const Regime& regime, Write write) {
    const auto write_met = [&](const Met& met) {
        write([&](const physics::LinearForm& form) { return met.by(form); });
    };
    write_met(regime.per_theta_e());
    for (int profile : regime.plan.temperature_drivers)
        write_met(regime.per_driver(profile));
    for (int profile : regime.plan.load_drivers) {
        const double gain = per_load_driver(regime, profile);
        write(
            [&](const physics::LinearForm& form) { return gain * regime.per_int(form); });
    }
}

void add_apertures(const Regime& regime, Columns& columns) {
    for (int plane : regime.plan.planes)
        columns.add(regime.network.aperture[static_cast<std::size_t>(plane)]);
}

/// In the order of StandardColumn.
void write_standard_regime(const Regime& regime, Columns columns) {
    const physics::LinearForm &mass = regime.map.theta_m_after,
                              &air = regime.map.theta_air;
    const physics::Control& control = regime.control;
    const StandardScale scale(regime.map);
    columns.add(mass[physics::Term::theta_m]);
    columns.add(scale.asked_per_kelvin * air[physics::Term::theta_m]);
    columns.add(scale.kelvin_per_watt * control.phi_H_max);
    columns.add(scale.asked_per_kelvin * (control.theta_C_set - control.theta_H_set));
    columns.add(-scale.kelvin_per_watt * control.phi_C_max);
    columns.add(1 / scale.kelvin_per_watt);
    columns.add(1 / scale.asked_per_kelvin);
    columns.add(control.theta_H_set);
    columns.add(regime.per_sol(mass));
    columns.add(-scale.asked_per_kelvin * regime.per_sol(air));
    for_drivers(regime, [&](auto weight) {
        columns.add(weight(mass));
        columns.add(-scale.asked_per_kelvin * weight(air));
    });
    add_apertures(regime, columns);
}

/// Everything of a row that its steps share.
class StandardRows {
  public:
    StandardRows(const Regime& regime, const Met& without_drivers)
        : asked_(StandardScale(regime.map).asked_per_kelvin),
          mass_(regime.fixed(regime.map.theta_m_after, without_drivers)),
          mass_per_int_(regime.per_int(regime.map.theta_m_after)),
          missing_(regime.control.theta_H_set -
                   regime.fixed(regime.map.theta_air, without_drivers)),
          air_per_int_(regime.per_int(regime.map.theta_air)) {}
    void write(double phi_int, Columns columns) const {
        columns.add(mass_ + mass_per_int_ * phi_int);
        columns.add(asked_ * (missing_ - air_per_int_ * phi_int));
    }

  private:
    double asked_, mass_, mass_per_int_, missing_, air_per_int_;
};

/// Calls use(form) for the free air temperature and each state after the step.
template <class Use>
void for_forms(const Regime& regime, Use use) {
    use(regime.map.theta_air);
    for (physics::Term state : regime.plan.states) use(form_of(regime.map, state));
}

/// Of some rooms, by the plant's limit for all; also of an unlimited one.
double most_of(double share, double limit) {
    return share > 0 ? share * limit : 0;
}

/// Of the hottest room's power, over which some rooms ask for less than they get;
/// without an end where all get what it asks for.
double span_of_rooms(double reach, double together) {
    if (!(reach > 0)) return 0;
    return together < 1 ? 2 * reach / (1 - together) : physics::unlimited;
}

double inverse_of(double span) {
    return span > 0 ? 1 / span : 0;
}

/// In the order of GeneralColumn.
void write_general_regime(const Regime& regime, Columns columns) {
    const physics::Input& imposed = regime.zone.thermostat.imposed_power;
    const double heated = regime.control.heated, cooled = regime.control.cooled;
    columns.add(most_of(heated, regime.control.phi_H_max));
    columns.add(most_of(cooled, regime.control.phi_C_max));
    const double heating = heated * heating_line(regime).gain;
    const double cooling = cooled * cooling_line(regime).gain;
    columns.add(heating);
    columns.add(cooling);
    const double half = 0.5 * regime.control.room_spread;
    const double together = regime.control.together;
    const double span_heating = span_of_rooms(half * heating, 0),
                 span_cooling = span_of_rooms(half * cooling, together);
    columns.add(half * heating);
    columns.add(half * cooling);
    columns.add(span_heating);
    columns.add(span_cooling);
    columns.add(inverse_of(span_heating));
    columns.add(inverse_of(span_cooling));
    columns.add(together);
    columns.add(span_of(imposed) * regime.network.A_f);
    const auto add_term = [&](physics::Term term) {
        for_forms(regime,
                  [&](const physics::LinearForm& form) { columns.add(form[term]); });
    };
    add_term(physics::Term::phi_h);
    add_term(physics::Term::phi_c);
    for (physics::Term state : regime.plan.states) add_term(state);
    for_forms(regime, [&](const physics::LinearForm& form) {
        columns.add(regime.per_sol(form));
    });
    for_drivers(regime, [&](auto weight) {
        for_forms(regime,
                  [&](const physics::LinearForm& form) { columns.add(weight(form)); });
    });
    if (regime.plan.imposed_driver)
        for_forms(regime, [&](const physics::LinearForm&) { columns.add(0); });
    add_apertures(regime, columns);
    if (!regime.plan.vented) return;
    columns.add(regime.zone.venting.opens_above);
    columns.add(1 / regime.zone.venting.band);
    add_term(physics::Term::phi_ia);
}

/// Power imposed whatever the driver says [W].
double imposed_base(const Regime& regime, int step) {
    const physics::Input& imposed = regime.zone.thermostat.imposed_power;
    if (!regime.control.imposed) return 0;
    return regime.network.A_f *
           (regime.plan.imposed_driver ? imposed.low : regime.drive.at(imposed, step));
}

void write_general_row(const Regime& regime, const Met& without_drivers, int step,
                       Columns columns) {
    const double phi_int = tabled_gain(regime, step);
    for_forms(regime, [&](const physics::LinearForm& form) {
        columns.add(regime.fixed(form, without_drivers) + regime.per_int(form) * phi_int);
    });
    const double imposed = imposed_base(regime, step);
    columns.add(regime.control.heated * heating_line(regime).asked + imposed);
    columns.add(-regime.control.cooled * cooling_line(regime).asked - imposed);
    if (regime.plan.vented)
        columns.add(physics::venting_conductance(regime.zone, regime.drive, step));
}

double* regime_at(const ZonePlan& plan, int regime, const LaneTables& tables) {
    return tables.regimes +
           static_cast<long>(regime) * plan.regime_columns() * tables.lanes;
}
double* row_at(const ZonePlan& plan, int row, const LaneTables& tables) {
    return tables.rows + static_cast<long>(row) * plan.row_columns() * tables.lanes;
}

/// Calls write(first step of the row, its columns).
template <class Write>
void for_rows(const Regime& regime, const LaneTables& tables, Write write) {
    const ZonePlan& plan = regime.plan;
    for (int row : plan.rows_of_regime[static_cast<std::size_t>(regime.index)])
        write(plan.rows.first[static_cast<std::size_t>(row)],
              Columns{row_at(plan, row, tables), tables.lanes});
}

void write_regime(const Regime& regime, const LaneTables& tables) {
    const ZonePlan& plan = regime.plan;
    const Columns columns{regime_at(plan, regime.index, tables), tables.lanes};
    const Met without_drivers = regime.without_drivers();
    if (plan.is_standard()) {
        const StandardRows rows(regime, without_drivers);
        write_standard_regime(regime, columns);
        for_rows(regime, tables, [&](int step, Columns row) {
            rows.write(tabled_gain(regime, step), row);
        });
    } else {
        write_general_regime(regime, columns);
        for_rows(regime, tables, [&](int step, Columns row) {
            write_general_row(regime, without_drivers, step, row);
        });
    }
}

}  // namespace

void write_coefficients(const ZonePlan& plan, int regime,
                        const physics::Building& building, const physics::Drive& drive,
                        physics::Network& network, physics::StepMaps& maps,
                        const LaneTables& tables) {
    write_regime(make_regime(plan, regime, building, drive, network, maps), tables);
}

void repeat_coefficients(const ZonePlan& plan, int regime, int first,
                         const LaneTables& tables) {
    const auto repeat = [&](double* columns, int n) {
        for (int k = 0; k < n; ++k, columns += tables.lanes)
            std::fill(columns + first, columns + tables.lanes, columns[first - 1]);
    };
    repeat(regime_at(plan, regime, tables), plan.regime_columns());
    for (const int row : plan.rows_of_regime[static_cast<std::size_t>(regime)])
        repeat(row_at(plan, row, tables), plan.row_columns());
}

void write_start(const ZonePlan& plan, double theta_start, double* state, int lanes) {
    Columns columns{state, lanes};
    if (plan.is_standard()) columns.add(theta_start);
    for (physics::Term term : plan.states)
        columns.add(term == physics::Term::phi_emitter ? 0 : theta_start);
}

}  // namespace bemcal::kernel
