/// Takes the adjoints of the kernel's coefficients, in the order in which affine.cpp
/// writes them, and adds each to the forms, gains and set-points that it was made of.
/// Follows from affine.cpp, line by line in reverse (product rule). An unlimited plant
/// has no adjoint. The forms are taken further back by step_map_adjoint and
/// network_adjoint.
#include "kernel/affine_adjoint.hpp"

#include "adjoint/step_map_adjoint.hpp"
#include "kernel/regime_adjoint.hpp"

#include <array>

namespace bemcal::kernel {

namespace {

/// Consecutive columns of one lane.
struct ColumnsBack {
    const double* next;
    int lanes;
    double take() {
        const double value = *next;
        next += lanes;
        return value;
    }
};

void pull_apertures(RegimeBack& back, ColumnsBack& columns) {
    for (int plane : back.regime.plan.planes)
        back.of_network.aperture[static_cast<std::size_t>(plane)] += columns.take();
}

/// Calls pull(first step of the row, phi_int, the row's columns), which returns the
/// adjoint of phi_int.
template <class Pull>
void for_rows(RegimeBack& back, const LaneAdjoints& tables, Pull pull) {
    const ZonePlan& plan = back.regime.plan;
    for (int row : plan.rows_of_regime[static_cast<std::size_t>(back.regime.index)]) {
        const double* at =
            tables.rows + static_cast<long>(row) * plan.row_columns() * tables.lanes;
        const int step = plan.rows.first[static_cast<std::size_t>(row)];
        const double phi_int = tabled_gain(back.regime, step);
        pull_tabled_gain(back, step, pull(step, phi_int, ColumnsBack{at, tables.lanes}));
    }
}

/// The regime of a standard hour: columns that are functions of two forms, mass and air,
/// and of two scales.
class StandardBack {
  public:
    explicit StandardBack(RegimeBack& back)
        : back_(back),
          mass_(back.regime.map.theta_m_after),
          air_(back.regime.map.theta_air),
          of_mass_(back.of_map.theta_m_after),
          of_air_(back.of_map.theta_air),
          scale_(back.regime.map) {}

    /// In the order of StandardColumn.
    void pull_columns(ColumnsBack columns) {
        of_mass_[physics::Term::theta_m] += columns.take();
        const double of_gain = columns.take();
        of_asked_ += of_gain * air_[physics::Term::theta_m];
        of_air_[physics::Term::theta_m] += of_gain * scale_.asked_per_kelvin;
        pull_control(columns);
        columns.take();
        columns.take();
        for_drivers(back_, [&](auto weight, auto pull_weight) {
            pull_weight(mass_, columns.take(), of_mass_);
            pull_weight(air_, asked(weight(air_), columns.take()), of_air_);
        });
        pull_planes(columns);
    }

    void pull_rows(const LaneAdjoints& tables) {
        const Regime& regime = back_.regime;
        const double mass_per_int = regime.per_int(mass_),
                     air_per_int = regime.per_int(air_);
        double of_mass = 0, of_mass_int = 0, of_asked = 0, of_asked_int = 0;
        for_rows(back_, tables, [&](int, double phi_int, ColumnsBack row) {
            const double g_mass = row.take(), g_asked = row.take();
            of_mass += g_mass;
            of_mass_int += g_mass * phi_int;
            of_asked += g_asked;
            of_asked_int += g_asked * phi_int;
            return g_mass * mass_per_int -
                   g_asked * scale_.asked_per_kelvin * air_per_int;
        });
        const Met without_drivers = regime.without_drivers();
        Met of_without;
        back_.fixed(mass_, without_drivers, of_mass, of_mass_, of_without);
        back_.per_int(mass_, of_mass_int, of_mass_);
        back_.fixed(air_, without_drivers,
                    asked(regime.fixed(air_, without_drivers), of_asked), of_air_,
                    of_without);
        back_.without_drivers(of_without);
        back_.per_int(air_, asked(air_per_int, of_asked_int), of_air_);
        of_asked_ += of_asked * regime.control.theta_H_set;
        back_.of_control.theta_H_set += of_asked * scale_.asked_per_kelvin;
    }

    void pull_map(double dt) {
        const double kelvin = scale_.kelvin_per_watt,
                     per_air = air_[physics::Term::phi_h];
        of_mass_[physics::Term::phi_h] += of_kelvin_ + of_asked_ / per_air;
        of_air_[physics::Term::phi_h] -= of_asked_ * kelvin / (per_air * per_air);
        adjoint::pull_standard_step_map(back_.regime.network, dt, back_.of_map,
                                        back_.of_network);
    }

  private:
    /// Of a column -asked_per_kelvin value: returns the value's adjoint.
    double asked(double value, double g) {
        of_asked_ -= g * value;
        return -g * scale_.asked_per_kelvin;
    }

    /// kelvin_per_watt limit; an unlimited one has no adjoint.
    double limit(double value, double g) {
        if (g == 0) return 0;
        of_kelvin_ += g * value;
        return g * scale_.kelvin_per_watt;
    }

    /// ColumnsBack sun_mass, sun_asked and the aperture of each plane, which meet in the
    /// sum over planes of sun_mass aperture irradiance.
    void pull_planes(ColumnsBack& columns) {
        const double sun_mass = back_.regime.per_sol(mass_),
                     sun_air = back_.regime.per_sol(air_),
                     sun_asked = -scale_.asked_per_kelvin * sun_air;
        double of_sun_mass = 0, of_sun_asked = 0;
        for (int plane : back_.regime.plan.planes) {
            const auto p = static_cast<std::size_t>(plane);
            const double aperture = back_.regime.network.aperture[p];
            const double mass = columns.take(), asked_too = columns.take();
            of_sun_mass += aperture * mass;
            of_sun_asked += aperture * asked_too;
            back_.of_network.aperture[p] += sun_mass * mass + sun_asked * asked_too;
        }
        back_.per_sol(mass_, of_sun_mass, of_mass_);
        back_.per_sol(air_, asked(sun_air, of_sun_asked), of_air_);
    }

    void pull_control(ColumnsBack& columns) {
        const physics::Control& control = back_.regime.control;
        physics::Control& of = back_.of_control;
        of.phi_H_max += limit(control.phi_H_max, columns.take());
        const double of_gap = columns.take();
        of_asked_ += of_gap * (control.theta_C_set - control.theta_H_set);
        of.theta_C_set += of_gap * scale_.asked_per_kelvin;
        of.theta_H_set -= of_gap * scale_.asked_per_kelvin;
        of.phi_C_max += limit(control.phi_C_max, -columns.take());
        of_kelvin_ -= columns.take() / (scale_.kelvin_per_watt * scale_.kelvin_per_watt);
        of_asked_ -= columns.take() / (scale_.asked_per_kelvin * scale_.asked_per_kelvin);
        of.theta_H_set += columns.take();
    }

    RegimeBack& back_;
    const physics::LinearForm &mass_, &air_;
    physics::LinearForm &of_mass_, &of_air_;
    StandardScale scale_;
    double of_kelvin_ = 0, of_asked_ = 0;  ///< adjoints of the scales
};

/// Of line_of: the adjoint of a thermostat's line to its set-point, slope, band, limit.
struct LineBack {
    double theta_set = 0, slope = 0, band = 0, limit = 0;
    LineBack(const Line& line, const Line& of_line, double theta, double width,
             double most) {
        if (line.gain == 0) return;
        theta_set = of_line.asked * line.gain;
        slope = -line.gain * line.gain * (of_line.gain + of_line.asked * theta);
        band = slope / most;
        limit = -slope * width / most / most;
    }
};

/// The regime of any other zone: columns for each form.
class GeneralBack {
  public:
    explicit GeneralBack(RegimeBack& back) : back_(back) {}

    /// In the order of GeneralColumn.
    void pull_columns(ColumnsBack columns) {
        const physics::Control& control = back_.regime.control;
        physics::Control& of = back_.of_control;
        pull_most(control.heated, control.phi_H_max, columns.take(), of.heated,
                  of.phi_H_max);
        pull_most(control.cooled, control.phi_C_max, columns.take(), of.cooled,
                  of.phi_C_max);
        of_heating_.gain += columns.take();
        of_cooling_.gain += columns.take();
        pull_reach(control.heated * heating_line(back_.regime).gain, columns.take(),
                   of_heating_);
        pull_reach(control.cooled * cooling_line(back_.regime).gain, columns.take(),
                   of_cooling_);
        for (int in_reach = 0; in_reach < 4; ++in_reach) columns.take();
        of.together += columns.take();
        pull_imposed_span(columns.take());
        pull_term(physics::Term::phi_h, columns);
        pull_term(physics::Term::phi_c, columns);
        for (physics::Term state : back_.regime.plan.states) pull_term(state, columns);
        for_forms([&](const physics::LinearForm& form, physics::LinearForm& of_form) {
            back_.per_sol(form, columns.take(), of_form);
        });
        for_drivers(back_, [&](auto, auto pull_weight) {
            for_forms([&](const physics::LinearForm& form, physics::LinearForm& of_form) {
                pull_weight(form, columns.take(), of_form);
            });
        });
        if (back_.regime.plan.imposed_driver)
            for_forms([&](const physics::LinearForm&, physics::LinearForm&) {
                columns.take();
            });
        pull_apertures(back_, columns);
        if (back_.regime.plan.vented) pull_venting(columns);
    }

    void pull_rows(const LaneAdjoints& tables) {
        FormSums per_int{}, of_fixed{}, of_int{};
        std::size_t n = 0;
        for_forms([&](const physics::LinearForm& form, physics::LinearForm&) {
            per_int[n++] = back_.regime.per_int(form);
        });
        for_rows(back_, tables, [&](int step, double phi_int, ColumnsBack row) {
            double of_phi_int = 0;
            for (std::size_t f = 0; f < n; ++f) {
                const double g = row.take();
                of_phi_int += g * per_int[f];
                of_fixed[f] += g;
                of_int[f] += g * phi_int;
            }
            const double of_heating = row.take(), of_cooling = row.take();
            of_heating_.asked += of_heating;
            of_cooling_.asked -= of_cooling;
            pull_imposed_base(step, of_heating - of_cooling);
            if (back_.regime.plan.vented) pull_opening(step, row.take());
            return of_phi_int;
        });
        std::size_t f = 0;
        const Met without_drivers = back_.regime.without_drivers();
        Met of_without;
        for_forms([&](const physics::LinearForm& form, physics::LinearForm& of_form) {
            back_.fixed(form, without_drivers, of_fixed[f], of_form, of_without);
            back_.per_int(form, of_int[f++], of_form);
        });
        back_.without_drivers(of_without);
    }

    void pull_map(double dt) {
        pull_lines();
        adjoint::pull_step_map(back_.regime.network, dt, back_.of_map, back_.of_network);
    }

  private:
    using FormSums = std::array<double, 5>;  ///< of the air and at most four states

    template <class Use>
    void for_forms(Use use) {
        const physics::StepMap& map = back_.regime.map;
        use(map.theta_air, back_.of_map.theta_air);
        for (physics::Term state : back_.regime.plan.states)
            use(form_of(map, state), form_of(back_.of_map, state));
    }

    void pull_term(physics::Term term, ColumnsBack& columns) {
        for_forms([&](const physics::LinearForm&, physics::LinearForm& of_form) {
            of_form[term] += columns.take();
        });
    }

    /// Of most_of (affine.cpp); an unlimited plant has no adjoint, nor has one that is
    /// off.
    static void pull_most(double share, double limit, double g, double& of_share,
                          double& of_limit) {
        if (g == 0 || share == 0) return;
        of_share += g * limit;
        of_limit += g * share;
    }

    void pull_imposed_span(double g) {
        const physics::Input& power = back_.regime.zone.thermostat.imposed_power;
        pull_span(g * back_.regime.network.A_f,
                  back_.place.of_here().thermostat.imposed_power);
        back_.of_network.A_f += g * span_of(power);
    }

    void pull_imposed_base(int step, double g) {
        const auto& [plan, index, building, zone, drive, network, split, map, control] =
            back_.regime;
        if (!control.imposed) return;
        const physics::Input& power = zone.thermostat.imposed_power;
        physics::Input& of_power = back_.place.of_here().thermostat.imposed_power;
        if (plan.imposed_driver)
            of_power.low += g * network.A_f;
        else
            adjoint::pull_input(power, drive, step, g * network.A_f, of_power);
        back_.of_network.A_f +=
            g * (plan.imposed_driver ? power.low : drive.at(power, step));
    }

    void pull_venting(ColumnsBack& columns) {
        const double per_band = 1 / back_.regime.zone.venting.band;
        physics::Venting& of = back_.place.of_here().venting;
        of.opens_above += columns.take();
        of.band -= columns.take() * per_band * per_band;
        pull_term(physics::Term::phi_ia, columns);
    }

    /// Of rho c V n / 3600.
    void pull_opening(int step, double g) {
        adjoint::PlaceBack place = back_.place;
        place.step = step;
        const physics::Zone& zone = back_.regime.zone;
        const double per = g * physics::rho_c_air / 3600;
        place.pull_air_change(zone.venting.air_change, per * zone.volume,
                              place.of_here().venting.air_change);
        place.of_here().volume += per * place.air_change(zone.venting.air_change);
    }

    /// Of half the rooms' spread times a gain; `reach` holds those of their spans, too.
    void pull_reach(double gain, double reach, Line& of_line) {
        of_line.gain += 0.5 * back_.regime.control.room_spread * reach;
        back_.of_control.room_spread += 0.5 * gain * reach;
    }

    void pull_lines() {
        const physics::Control& control = back_.regime.control;
        const double band = back_.regime.network.band;
        const Line heated_line = heating_line(back_.regime),
                   cooled_line = cooling_line(back_.regime);
        physics::Control& of = back_.of_control;
        const LineBack heating(
            heated_line, pull_share(heated_line, control.heated, of_heating_, of.heated),
            control.theta_H_set + 0.5 * band, band, control.phi_H_max);
        const LineBack cooling(
            cooled_line, pull_share(cooled_line, control.cooled, of_cooling_, of.cooled),
            control.theta_C_set - 0.5 * band, band, control.phi_C_max);
        of.theta_H_set += heating.theta_set;
        of.theta_C_set += cooling.theta_set;
        of.phi_H_max += heating.limit;
        of.phi_C_max += cooling.limit;
        back_.of_network.band +=
            heating.band + cooling.band + 0.5 * (heating.theta_set - cooling.theta_set);
        back_.of_map.theta_air[physics::Term::phi_h] += heating.slope;
        back_.of_map.theta_air[physics::Term::phi_c] -= cooling.slope;
    }

    /// Of share times a line: returns the line's adjoint.
    static Line pull_share(const Line& line, double share, const Line& of_product,
                           double& of_share) {
        of_share += of_product.asked * line.asked + of_product.gain * line.gain;
        return {share * of_product.asked, share * of_product.gain};
    }

    RegimeBack& back_;
    Line of_heating_, of_cooling_;  ///< of the season's share of rooms
};

template <class Back>
void pull_regime(RegimeBack& regime, int index, const LaneAdjoints& tables) {
    const ZonePlan& plan = regime.regime.plan;
    Back back(regime);
    back.pull_columns({tables.regimes + static_cast<long>(index) *
                                            plan.of_regime_columns() * tables.lanes,
                       tables.lanes});
    back.pull_rows(tables);
    back.pull_map(regime.regime.drive.axis.step_s);
}

}  // namespace

void pull_coefficients(const ZonePlan& plan, const physics::Building& building,
                       const physics::Drive& drive, NetworkPair& scratch,
                       const LaneAdjoints& tables, physics::Building& of_building) {
    auto& [network, maps, of_network] = scratch;
    for (int index = 0; index < plan.regimes.size(); ++index) {
        const Regime regime = make_regime(plan, index, building, drive, network, maps);
        adjoint::clear_adjoints(network, of_network);
        const adjoint::PlaceBack place{
            building, plan.zone, drive,
            plan.regimes.first[static_cast<std::size_t>(index)], of_building};
        RegimeBack back{regime, place, of_network};
        const auto pull =
            plan.is_standard() ? pull_regime<StandardBack> : pull_regime<GeneralBack>;
        pull(back, index, tables);
        adjoint::pull_radiant_split(network, back.of_split, of_network);
        adjoint::pull_control(place, regime.control, back.of_control);
        adjoint::pull_network(place, network, of_network);
    }
}

}  // namespace bemcal::kernel
