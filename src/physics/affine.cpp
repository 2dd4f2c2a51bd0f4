/// The step's linear forms, in the order of the kernel's columns.
#include "physics/affine.hpp"

#include "physics/hour.hpp"

namespace bemcal::physics {

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

/// All that the coefficients of one regime follow from.
struct Regime {
    const ZonePlan& plan;
    const Building& building;
    const Zone& zone;
    const Drive& drive;
    const Network& network;
    RadiantSplit split;
    StepMap map;
    Control control;

    double per_sol(const LinearForm& form) const {
        return split.to_st * form[Term::phi_st] + split.to_m * form[Term::phi_m];
    }
    double per_int(const LinearForm& form) const {
        return 0.5 * (form[Term::phi_ia] + per_sol(form));
    }
    /// \param place  0 = outdoors behind elements and as supply, 1 + b = boundary b
    double per_temperature(const LinearForm& form, std::size_t place) const {
        return form[Term::theta_em] * network.em_share[place] +
               form[Term::theta_sup] * network.ve_share[place];
    }
    /// What does not change with time: constant boundaries, and the loss to the sky.
    double fixed(const LinearForm& form) const {
        double sum = -per_sol(form) * network.phi_sky;
        for (std::size_t b = 0; b < building.boundaries.size(); ++b) {
            const Input& theta = building.boundaries[b].temperature;
            sum += per_temperature(form, b + 1) *
                   (theta.profile < 0 ? theta.value : theta.low);
        }
        return sum;
    }
};

/// Of make_step_map's forms the two that the standard hour needs, from C.4 to C.11
/// written out: a twentieth of the work.
StepMap standard_step_map(const Network& n, double dt) {
    const double per_air = 1 / (n.H_tr_is + n.H_ve), k_1 = n.H_tr_is * per_air;
    const double H_1 = k_1 * n.H_ve, H_2 = H_1 + n.H_tr_w;
    const double per_surface = 1 / (n.H_tr_ms + H_2), to_mass = n.H_tr_ms * per_surface;
    const double C = n.C_m / dt, H = 0.5 * (to_mass * H_2 + n.H_tr_em),
                 per_mass = 1 / (C + H);
    const double air_per_theta_m = k_1 * to_mass;
    const auto write = [&](double per_m, double per_st, double per_ia, LinearForm& form) {
        const auto set = [&](Term term, double weight) {
            form.weight[static_cast<std::size_t>(term)] = weight;
        };
        set(Term::theta_em, n.H_tr_em * per_m);
        set(Term::theta_e, n.H_tr_w * per_st);
        set(Term::theta_sup, H_1 * per_st + n.H_ve * per_ia);
        set(Term::phi_m, per_m);
        set(Term::phi_st, per_st);
        set(Term::phi_ia, k_1 * per_st + per_ia);
        set(Term::phi_h, k_1 * per_st + per_ia);
    };
    const double m = per_mass, air_m = 0.5 * air_per_theta_m * m;
    StepMap map;
    write(m, to_mass * m, 0, map.theta_m_after);
    write(air_m, to_mass * air_m + k_1 * per_surface, per_air, map.theta_air);
    map.theta_m_after.weight[0] = (C - H) * m;
    map.theta_air.weight[0] = 0.5 * air_per_theta_m * (1 + (C - H) * m);
    return map;
}

double span_of(const Input& input) {
    return input.value - input.low;
}

bool is_driver(const ZonePlan& plan, const Input& input) {
    for (int profile : plan.load_drivers)
        if (profile == input.profile) return true;
    return false;
}

/// phi_int per value of a profile that is a driver [W].
double per_load_driver(const Regime& regime, int profile) {
    double sum = 0;
    for (const Load& load : regime.zone.loads)
        if (load.density.profile == profile)
            sum += regime.network.A_f * span_of(load.density) * load.heat_fraction;
    return sum;
}

/// phi_int at a step, without the part that drivers bring [W].
double tabled_gain(const Regime& regime, int step) {
    double sum = 0;
    for (const Load& load : regime.zone.loads)
        sum +=
            regime.network.A_f * load.heat_fraction *
            (is_driver(regime.plan, load.density) ? load.density.low
                                                  : regime.drive.at(load.density, step));
    return sum;
}

/// Calls write(weight of a form per value of the driver) for every driver but an imposed
/// power.
template <class Write>
void for_drivers(const Regime& regime, Write write) {
    write([&](const LinearForm& form) {
        return regime.per_temperature(form, 0) + form[Term::theta_e];
    });
    for (int boundary : regime.plan.boundary_drivers) {
        const auto b = static_cast<std::size_t>(boundary);
        const double span = span_of(regime.building.boundaries[b].temperature);
        write([&](const LinearForm& form) {
            return span * regime.per_temperature(form, b + 1);
        });
    }
    for (int profile : regime.plan.load_drivers) {
        const double gain = per_load_driver(regime, profile);
        write([&](const LinearForm& form) { return gain * regime.per_int(form); });
    }
}

void add_apertures(const Regime& regime, Columns& columns) {
    for (int plane : regime.plan.planes)
        columns.add(regime.network.aperture[static_cast<std::size_t>(plane)]);
}

/// What converts the standard hour's power into the change of the mass temperature it
/// causes.
struct StandardScale {
    double kelvin_per_watt;   ///< of the mass after the step
    double asked_per_kelvin;  ///< power, in those units, per kelvin of the air
    explicit StandardScale(const StepMap& map)
        : kelvin_per_watt(map.theta_m_after[Term::phi_h]),
          asked_per_kelvin(kelvin_per_watt / map.theta_air[Term::phi_h]) {}
};

/// In the order of kernel::StandardColumn.
void write_standard_regime(const Regime& regime, Columns columns) {
    const LinearForm &mass = regime.map.theta_m_after, &air = regime.map.theta_air;
    const Control& control = regime.control;
    const StandardScale scale(regime.map);
    columns.add(mass[Term::theta_m]);
    columns.add(scale.asked_per_kelvin * air[Term::theta_m]);
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
    explicit StandardRows(const Regime& regime)
        : asked_(StandardScale(regime.map).asked_per_kelvin),
          mass_(regime.fixed(regime.map.theta_m_after)),
          mass_per_int_(regime.per_int(regime.map.theta_m_after)),
          missing_(regime.control.theta_H_set - regime.fixed(regime.map.theta_air)),
          air_per_int_(regime.per_int(regime.map.theta_air)) {}
    void write(double phi_int, Columns columns) const {
        columns.add(mass_ + mass_per_int_ * phi_int);
        columns.add(asked_ * (missing_ - air_per_int_ * phi_int));
    }

  private:
    double asked_, mass_, mass_per_int_, missing_, air_per_int_;
};

const LinearForm& form_of(const StepMap& map, Term state) {
    switch (state) {
        case Term::theta_m:
            return map.theta_m_after;
        case Term::theta_m2:
            return map.theta_m2_after;
        case Term::phi_emitter:
            return map.phi_emitter_after;
        default:
            return map.theta_air;
    }
}

/// Calls use(form) for the free air temperature and each state after the step.
template <class Use>
void for_forms(const Regime& regime, Use use) {
    use(regime.map.theta_air);
    for (Term state : regime.plan.states) use(form_of(regime.map, state));
}

/// The thermostat as a line in the air temperature (structure.hpp): asked - gain
/// theta_free.
struct Line {
    double asked, gain;
};

Line line_of(double theta_set, double slope, double band, double limit) {
    if (limit <= 0) return {0, 0};
    const double gain = 1 / (slope + band / limit);
    return {theta_set * gain, gain};
}

Line heating_line(const Regime& regime) {
    if (regime.control.imposed) return {0, 0};
    return line_of(regime.control.theta_H_set + 0.5 * regime.network.band,
                   regime.map.theta_air[Term::phi_h], regime.network.band,
                   regime.control.phi_H_max);
}

Line cooling_line(const Regime& regime) {
    if (regime.control.imposed) return {0, 0};
    return line_of(regime.control.theta_C_set - 0.5 * regime.network.band,
                   -regime.map.theta_air[Term::phi_c], regime.network.band,
                   regime.control.phi_C_max);
}

/// In the order of kernel::GeneralColumn.
void write_general_regime(const Regime& regime, Columns columns) {
    const Input& imposed = regime.zone.thermostat.imposed_power;
    columns.add(regime.control.phi_H_max);
    columns.add(regime.control.phi_C_max);
    columns.add(heating_line(regime).gain);
    columns.add(cooling_line(regime).gain);
    columns.add(span_of(imposed) * regime.network.A_f);
    const auto add_term = [&](Term term) {
        for_forms(regime, [&](const LinearForm& form) { columns.add(form[term]); });
    };
    add_term(Term::phi_h);
    add_term(Term::phi_c);
    for (Term state : regime.plan.states) add_term(state);
    for_forms(regime, [&](const LinearForm& form) { columns.add(regime.per_sol(form)); });
    for_drivers(regime, [&](auto weight) {
        for_forms(regime, [&](const LinearForm& form) { columns.add(weight(form)); });
    });
    if (regime.plan.imposed_driver)
        for_forms(regime, [&](const LinearForm&) { columns.add(0); });
    add_apertures(regime, columns);
}

/// Power imposed whatever the driver says [W].
double imposed_base(const Regime& regime) {
    const Input& imposed = regime.zone.thermostat.imposed_power;
    if (!regime.control.imposed) return 0;
    return regime.network.A_f * (imposed.profile < 0 ? imposed.value : imposed.low);
}

void write_general_row(const Regime& regime, double phi_int, Columns columns) {
    for_forms(regime, [&](const LinearForm& form) {
        columns.add(regime.fixed(form) + regime.per_int(form) * phi_int);
    });
    const double imposed = imposed_base(regime);
    columns.add(heating_line(regime).asked + imposed);
    columns.add(-cooling_line(regime).asked - imposed);
}

template <class Write>
void for_rows(const Regime& regime, int index, const LaneTables& tables, Write write) {
    const ZonePlan& plan = regime.plan;
    for (int row : plan.rows_of_regime[static_cast<std::size_t>(index)]) {
        double* at =
            tables.rows + static_cast<long>(row) * plan.row_columns() * tables.lanes;
        const int step = plan.rows.first[static_cast<std::size_t>(row)];
        write(tabled_gain(regime, step), Columns{at, tables.lanes});
    }
}

StepMap map_of(const ZonePlan& plan, const Network& network, double dt) {
    return plan.is_standard() ? standard_step_map(network, dt)
                              : make_step_map(network, dt);
}

void write_regime(const Regime& regime, int index, const LaneTables& tables) {
    const ZonePlan& plan = regime.plan;
    const Columns columns{
        tables.regimes + static_cast<long>(index) * plan.regime_columns() * tables.lanes,
        tables.lanes};
    if (plan.is_standard()) {
        const StandardRows rows(regime);
        write_standard_regime(regime, columns);
        for_rows(regime, index, tables,
                 [&](double phi_int, Columns row) { rows.write(phi_int, row); });
    } else {
        write_general_regime(regime, columns);
        for_rows(regime, index, tables, [&](double phi_int, Columns row) {
            write_general_row(regime, phi_int, row);
        });
    }
}

}  // namespace

void write_coefficients(const ZonePlan& plan, const Building& building,
                        const Drive& drive, Network& network, const LaneTables& tables) {
    const Zone& zone = building.zones[plan.zone];
    for (int index = 0; index < plan.regimes.size(); ++index) {
        const int step = plan.regimes.first[static_cast<std::size_t>(index)];
        make_network(building, zone, drive, step, network);
        write_regime(
            {plan, building, zone, drive, network, radiant_split(network),
             map_of(plan, network, drive.axis.step_s), control_at(zone, drive, step)},
            index, tables);
    }
}

void write_start(const ZonePlan& plan, double theta_start, double* state, int lanes) {
    Columns columns{state, lanes};
    if (plan.is_standard()) columns.add(theta_start);
    for (Term term : plan.states)
        columns.add(term == Term::phi_emitter ? 0 : theta_start);
}

}  // namespace bemcal::physics
