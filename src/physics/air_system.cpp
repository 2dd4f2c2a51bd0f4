/// One hour of an air system, steady within the hour: the heat that supply air has to
/// take from the zone, its flow, the fan, the mixed air, the coil with what it dries,
/// reheat at the terminals. The zone itself gets either its outdoor air by its own flow,
/// so that what it asks for holds already what outdoor air brings, or the least supply
/// air (`supplies`), so that it asks for what that leaves; nothing here changes its
/// temperature.
/// Source: energy and water balances of the streams, as in ASHRAE Handbook HVAC Systems
/// and Equipment 2016, chapter 4; coil by bypass factor and apparatus dew point
/// (ASHRAE Handbook Fundamentals 2017, 1.10); fan by a power of its flow (90.1, G3.1.3).
/// A coil with an enthalpy of its own (direct expansion) is on or off.
/// Left out: water that furniture and rooms store (but see fan_start), ducts' leaks and
/// heat, the mixing of several zones' return air, fan heat in hours of a constant flow
/// without a load, bypass of the recovery without an economiser, water that evaporates
/// from a coil that is off, a stage's capacity at another flow.
#include "physics/air_system.hpp"

#include "physics/moist_air.hpp"
#include "physics/network.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::physics {

namespace {

constexpr double c_air = 1020;  ///< of air with 8 g/kg of water, per dry air [J/(kg K)]
constexpr double rho_air = rho_c_air / c_air;  ///< dry air that carries rho_c_air [kg/m3]
constexpr double least_turning = 0.02;         ///< of q_design: a fan below that stands
constexpr double least_drop = 1;               ///< of supply air below the room [K]
constexpr double least_dew_point = 0.02;  ///< of a coil, which must not freeze [degC]
constexpr int most_steps = 60;            ///< of Newton's, or halvings to 1e-13

// A coil on or off takes less of air with less enthalpy. The slope is that of DOE-2's
// curve of capacity from rated air (26.7 degC, wet bulb 19.4 degC) and 35 degC outdoors
// to a wet bulb of 13 degC and 24 degC: mild air comes with mild weather.
constexpr double rated_enthalpy = 55.2e3;        // [J/kg]
constexpr double strength_by_enthalpy = 6.8e-6;  // [kg/J]

enum class Mode {
    passive,   ///< fan off: heat comes without it
    cycling,   ///< fan off by the clock, turning on to cool
    constant,  ///< supply temperature follows the load
    variable   ///< flow follows the load, terminals reheat
};

/// What set a flow.
enum class Limit { load, least, outdoor, turning, design };

/// What sets the coil's surface.
enum class Coil {
    modulates,   ///< on all the time: the load
    to_supply,   ///< on or off: the temperature of the supply air
    by_enthalpy  ///< on or off: what it takes from air that is as moist as it is
};

/// All that happens in an hour.
struct Way {
    Mode mode = Mode::passive;
    Limit limit = Limit::load;
    double D = 0;    ///< zone minus outdoors [K]
    double eta = 0;  ///< heat recovery, after frost [-]
    bool is_frosted = false;
    double asked = 0;           ///< heating, with what frost costs [W]
    double E = 0;               ///< to be taken from the zone by supply air [W]
    double drop = 0;            ///< supply air below the room [K]
    double q = 0;               ///< supply air [m3/s]
    double fan = 0;             ///< [W]
    double in_air = 0;          ///< of it, that coils see [W]
    double reheat = 0;          ///< [W]
    double net = 0;             ///< to be taken by the coil, negative: given [W]
    double recovered = 0;       ///< that a bypass leaves outdoors [W]
    double most_free = 0;       ///< that outdoor air can take [W]
    double free = 0;            ///< that it takes [W]
    double x_least = 0, x = 0;  ///< share of outdoor air [-]
    double sensible = 0;        ///< of the coil [W]
    Coil coil = Coil::modulates;
    double theta_mixed = 0;  ///< air before the coil [degC]
    double fall = 0;         ///< from there to the coil's surface, when it is on [K]
    bool is_dew_point_held = false;
    Saturated surface{};  ///< air at the coil's surface
    double k = 0, M = 0;  ///< air that meets it; outdoor air [kg/s]
    double y = 0,
           y_fall = 0;      ///< water of mixed air above the surface's [kg/kg], by fall
    double over = 1;        ///< of the water's balance [kg/s]
    double latent = 0;      ///< [W]
    double humidified = 0;  ///< [W]
};

Mode mode_of(const AirKind& kind, const AirHour& in) {
    if (in.available > 0) return kind.variable ? Mode::variable : Mode::constant;
    return in.cooling > 0 ? Mode::cycling : Mode::passive;
}

void recover(const AirKind& kind, const AirHour& in, Way& way) {
    way.D = in.theta_air - in.theta_e;
    way.eta = in.heat_recovery;
    way.is_frosted = way.D > 0 && in.theta_air - way.eta * way.D < in.frost_limit;
    if (way.is_frosted) way.eta = std::max(0.0, (in.theta_air - in.frost_limit) / way.D);
    if (kind.supplies) {
        way.asked = in.heating;
        way.E = in.cooling - in.heating +
                rho_c_air * in.q_supplied * (in.theta_air - in.theta_supply);
        return;
    }
    way.asked = in.heating + rho_c_air * in.q_e * (in.heat_recovery - way.eta) * way.D;
    way.E = in.cooling - in.heating + rho_c_air * in.q_e * (1 - in.heat_recovery) * way.D;
}

/// The larger flow, and what set it.
void raise(double flow, Limit limit, Way& way) {
    if (way.q >= flow) return;
    way.q = flow;
    way.limit = limit;
}

/// Of a flow that varies [m3/s].
double least_flow(const AirKind& kind, const AirHour& in) {
    return kind.supplies ? in.q_supplied : in.least_flow * in.available * in.q_design;
}

void set_flow(const AirKind& kind, const AirHour& in, Way& way) {
    if (way.mode == Mode::constant) {
        way.q = in.available * in.q_design;
        way.limit = Limit::design;
    } else {
        const double most = (way.mode == Mode::variable ? in.available : 1) * in.q_design;
        way.drop = std::max(in.theta_air - in.theta_supply, least_drop);
        // Of rooms that differ some may ask for heat: the others' flow is for them alone.
        const double to_cool = way.E + (kind.supplies ? in.heating : 0);
        way.q = to_cool / (rho_c_air * way.drop);
        way.limit = Limit::load;
        if (way.q > most) {
            way.q = most;
            way.limit = Limit::design;
        }
        if (way.mode == Mode::variable) raise(least_flow(kind, in), Limit::least, way);
    }
    raise(in.q_e, Limit::outdoor, way);
    raise(least_turning * in.q_design, Limit::turning, way);
}

void drive_fan(const AirHour& in, Way& way) {
    const double share = way.q / in.q_design;
    if (way.mode == Mode::variable)
        way.fan = in.fan_power * std::pow(share, in.fan_exponent);
    else
        way.fan = in.fan_power * (way.mode == Mode::constant ? in.available : share);
    way.in_air = in.fan_heat * way.fan;
    if (way.mode != Mode::variable)
        way.in_air = std::min(way.in_air, in.cooling + way.asked);
}

void mix(const AirKind& kind, const AirHour& in, Way& way) {
    if (way.mode == Mode::variable)
        way.reheat =
            std::max(0.0, rho_c_air * way.q * (in.theta_air - in.theta_supply) - way.E);
    const double of_room = kind.supplies
                               ? way.E - rho_c_air * in.q_e * (1 - way.eta) * way.D
                               : in.cooling - way.asked;
    way.net = of_room + way.reheat + way.in_air;
    way.x_least = way.x = in.q_e / way.q;
    way.sensible = std::max(0.0, way.net);
    if (!(in.economiser > way.x_least && way.D > 0 && way.net > 0)) return;
    way.recovered = rho_c_air * in.q_e * way.eta * way.D;
    way.most_free =
        way.recovered + rho_c_air * way.q * (in.economiser - way.x_least) * way.D;
    way.free = std::min(way.net, way.most_free);
    way.x += std::max(0.0, way.free - way.recovered) / (rho_c_air * way.q * way.D);
    way.sensible = way.net - way.free;
}

/// Water of mixed air above that at the coil's surface: the zone's water is in balance,
/// what outdoor air and people bring, the coil takes.
void balance(const AirKind& kind, const AirHour& in, double fall, Way& way) {
    const double dew_point = way.theta_mixed - fall;
    way.fall = fall;
    way.is_dew_point_held = dew_point < least_dew_point;
    way.surface = saturated_air(std::max(dew_point, least_dew_point), kind.pressure);
    way.k = way.sensible / (c_air * fall);
    way.over = way.M + way.k * (1 - way.x);
    way.y = (way.M * (in.w_e - way.surface.w) + (1 - way.x) * in.moisture) / way.over;
    const double colder = way.is_dew_point_held ? 0 : way.M * way.surface.per_kelvin;
    way.y_fall = (colder + way.y * (1 - way.x) * way.k / fall) / way.over;
}

double enthalpy_before_coil(const Way& way) {
    return enthalpy(way.theta_mixed, way.surface.w + way.y);
}

/// What a coil takes when it is on, of what it takes of rated air [-].
double strength(const Way& way) {
    return 1 + strength_by_enthalpy * (enthalpy_before_coil(way) - rated_enthalpy);
}

/// Enthalpy that air which meets the surface loses at a fall, above what the coil takes
/// [J/kg]. It grows with the fall.
double excess(const AirHour& in, const Way& way) {
    return c_air * way.fall + heat_of_vapour * std::max(way.y, 0.0) -
           in.coil_enthalpy / (1 - in.bypass_factor) * strength(way);
}

/// Of mixed air, which is linear in both: by water [J/kg], by temperature [J/(kg K)].
double enthalpy_by_water(const Way& way) {
    return enthalpy(way.theta_mixed, 1) - enthalpy(way.theta_mixed, 0);
}
double enthalpy_by_kelvin(const Way& way) {
    const double w = way.surface.w + way.y;
    return enthalpy(1, w) - enthalpy(0, w);
}

double excess_by_fall(const AirHour& in, const Way& way) {
    const double w_fall =
        way.y_fall - (way.is_dew_point_held ? 0 : way.surface.per_kelvin);
    return c_air + (way.y > 0 ? heat_of_vapour * way.y_fall : 0) -
           in.coil_enthalpy / (1 - in.bypass_factor) * strength_by_enthalpy *
               enthalpy_by_water(way) * w_fall;
}

/// From a fall that is too small: Newton's steps, halved where they leave the bracket.
void fall_by_enthalpy(const AirKind& kind, const AirHour& in, Way& way) {
    double low = way.fall;
    double high = std::max(low, in.coil_enthalpy / (c_air * (1 - in.bypass_factor)));
    balance(kind, in, high, way);
    for (int step = 0; step < most_steps && excess(in, way) < 0; ++step) {
        high *= 2;
        balance(kind, in, high, way);
    }
    double fall = high;
    for (int step = 0; step < most_steps; ++step) {
        balance(kind, in, fall, way);
        const double off = excess(in, way);
        (off > 0 ? high : low) = fall;
        double next = fall - off / excess_by_fall(in, way);
        if (!(next >= low && next <= high)) next = (low + high) / 2;
        if (std::fabs(next - fall) < 1e-13 * fall) break;
        fall = next;
    }
}

void set_coil(const AirKind& kind, const AirHour& in, Way& way) {
    way.theta_mixed = in.theta_air - way.x_least * (1 - way.eta) * way.D -
                      way.free / (rho_c_air * way.q);
    double depth = way.sensible / (rho_c_air * way.q);
    if (way.mode != Mode::variable && in.coil_enthalpy <= 0) {
        const double when_on =
            way.theta_mixed - in.theta_supply + way.in_air / (rho_c_air * way.q);
        if (when_on > depth) {
            way.coil = Coil::to_supply;
            depth = when_on;
        }
    }
    balance(kind, in, depth / (1 - in.bypass_factor), way);
    if (in.coil_enthalpy > 0 && excess(in, way) < 0) {
        way.coil = Coil::by_enthalpy;
        fall_by_enthalpy(kind, in, way);
    }
}

void dry(const AirKind& kind, const AirHour& in, Way& way) {
    way.M = rho_air * (way.x * way.q + in.q_inf);
    if (way.sensible > 0) {
        set_coil(kind, in, way);
        if (way.y > 0) way.latent = heat_of_vapour * way.k * way.y;
    }
    const double lacks = way.M * (in.least_w - in.w_e) - in.moisture;
    if (in.least_w > 0 && in.available > 0 && lacks > 0 && way.latent == 0)
        way.humidified = heat_of_vapour * lacks;
}

Way go(const AirKind& kind, const AirHour& in) {
    Way way;
    way.mode = mode_of(kind, in);
    if (way.mode == Mode::passive) return way;
    recover(kind, in, way);
    set_flow(kind, in, way);
    drive_fan(in, way);
    mix(kind, in, way);
    if (kind.is_moist) dry(kind, in, way);
    return way;
}

/// `go` in reverse: each step adds to what the steps before it gave. Adjoints have the
/// names of what they belong to.
struct Back {
    Back(const AirKind& of_kind, const AirHour& hour, const Way& of_way,
         const AirLoads& of)
        : kind(of_kind), in(hour), way(of_way), loads(of) {}

    AirHour pull() {
        if (way.mode == Mode::passive) {
            to.heating = loads.heating;
            return to;
        }
        fan = loads.fan;
        sensible = loads.cooling;
        reheat = loads.heating;
        pull_humidified();
        pull_latent();
        pull_mix();
        pull_fan();
        pull_flow();
        pull_recovery();
        return to;
    }

    double c() const { return rho_c_air * way.q; }

    void pull_water(double of_M) {
        x += of_M * rho_air * way.q;
        q += of_M * rho_air * way.x;
        to.q_inf += of_M * rho_air;
    }

    void pull_humidified() {
        if (way.humidified <= 0) return;
        const double lacks = loads.heating * heat_of_vapour;
        to.least_w += lacks * way.M;
        to.w_e -= lacks * way.M;
        to.moisture -= lacks;
        pull_water(lacks * (in.least_w - in.w_e));
    }

    void pull_latent() {
        if (way.latent <= 0) return;
        const double h = loads.cooling * heat_of_vapour;
        const double fall = pull_balance(h * way.y, h * way.k);
        const double b = in.bypass_factor;
        if (way.coil == Coil::by_enthalpy) {
            // The fall follows from an equation: of its adjoint that of the equation.
            pull_excess(-fall / excess_by_fall(in, way));
        } else {
            to.bypass_factor += fall * way.fall / (1 - b);
            pull_depth(fall / (1 - b));
        }
        pull_theta_mixed();
    }

    void pull_excess(double of_excess) {
        const double b = in.bypass_factor, at_rated = of_excess / (1 - b);
        to.coil_enthalpy -= at_rated * strength(way);
        to.bypass_factor -= at_rated / (1 - b) * in.coil_enthalpy * strength(way);
        const double of_enthalpy = -at_rated * in.coil_enthalpy * strength_by_enthalpy;
        const double w = of_enthalpy * enthalpy_by_water(way);
        pull_balance(0, of_excess * heat_of_vapour + w);
        theta_mixed += of_enthalpy * enthalpy_by_kelvin(way);
        if (!way.is_dew_point_held) theta_mixed += w * way.surface.per_kelvin;
    }

    /// From the adjoints of k and y: returns that of the fall.
    double pull_balance(double k, double y) {
        const double above = y / way.over, over = -y * way.y / way.over;
        k += over * (1 - way.x);
        to.w_e += above * way.M;
        to.moisture += above * (1 - way.x);
        x -= above * in.moisture + over * way.k;
        pull_water(above * (in.w_e - way.surface.w) + over);
        sensible += k * way.k / way.sensible;
        const double dew_point =
            way.is_dew_point_held ? 0 : -above * way.M * way.surface.per_kelvin;
        theta_mixed += dew_point;
        return -k * way.k / way.fall - dew_point;
    }

    void pull_depth(double depth) {
        if (way.coil == Coil::to_supply) {
            theta_mixed += depth;
            to.theta_supply -= depth;
            in_air += depth / c();
            q -= depth * way.in_air / (c() * way.q);
        } else {
            sensible += depth / c();
            q -= depth * way.sensible / (c() * way.q);
        }
    }

    void pull_theta_mixed() {
        to.theta_air += theta_mixed;
        x_least -= theta_mixed * (1 - way.eta) * way.D;
        eta += theta_mixed * way.x_least * way.D;
        D -= theta_mixed * way.x_least * (1 - way.eta);
        free -= theta_mixed / c();
        q += theta_mixed * way.free / (c() * way.q);
    }

    void pull_economiser() {
        free -= sensible;
        const double of_recovered = pull_share();
        double recovered = of_recovered;
        if (way.free < way.most_free) {
            net += free;
        } else {
            recovered += free;
            const double more = in.economiser - way.x_least;
            q += free * rho_c_air * more * way.D;
            to.economiser += free * c() * way.D;
            x_least -= free * c() * way.D;
            D += free * c() * more;
        }
        to.q_e += recovered * rho_c_air * way.eta * way.D;
        eta += recovered * rho_c_air * in.q_e * way.D;
        D += recovered * rho_c_air * in.q_e * way.eta;
    }

    /// The share of outdoor air: returns the adjoint of what is recovered.
    double pull_share() {
        x_least += x;
        if (way.free <= way.recovered) return 0;
        const double per = x / (c() * way.D);
        free += per;
        q -= x * (way.x - way.x_least) / way.q;
        D -= x * (way.x - way.x_least) / way.D;
        return -per;
    }

    void pull_mix() {
        if (way.most_free > 0)
            pull_economiser();
        else
            x_least += x;
        to.q_e += x_least / way.q;
        q -= x_least * way.x_least / way.q;
        net += way.net > 0 ? sensible : -loads.heating;
        pull_of_room();
        reheat += net;
        in_air += net;
        if (way.reheat <= 0) return;
        q += reheat * rho_c_air * (in.theta_air - in.theta_supply);
        to.theta_air += reheat * c();
        to.theta_supply -= reheat * c();
        E -= reheat;
    }

    void pull_of_room() {
        if (!kind.supplies) {
            to.cooling += net;
            asked -= net;
            return;
        }
        E += net;
        to.q_e -= net * rho_c_air * (1 - way.eta) * way.D;
        eta += net * rho_c_air * in.q_e * way.D;
        D -= net * rho_c_air * in.q_e * (1 - way.eta);
    }

    void pull_fan() {
        if (way.mode != Mode::variable && way.in_air < in.fan_heat * way.fan) {
            to.cooling += in_air;
            asked += in_air;
        } else {
            to.fan_heat += in_air * way.fan;
            fan += in_air * in.fan_heat;
        }
        const double share = way.q / in.q_design;
        double of_share = 0;
        if (way.mode == Mode::variable) {
            to.fan_power += fan * std::pow(share, in.fan_exponent);
            to.fan_exponent += fan * way.fan * std::log(share);
            of_share = fan * in.fan_exponent * way.fan / share;
        } else if (way.mode == Mode::constant) {
            to.fan_power += fan * in.available;
            to.available += fan * in.fan_power;
        } else {
            to.fan_power += fan * share;
            of_share = fan * in.fan_power;
        }
        q += of_share / in.q_design;
        to.q_design -= of_share * share / in.q_design;
    }

    /// Of `least_flow`, which a flow that varies has alone.
    void pull_least() {
        if (kind.supplies) {
            to.q_supplied += q;
            return;
        }
        to.least_flow += q * in.available * in.q_design;
        to.q_design += q * in.least_flow * in.available;
        to.available += q * in.least_flow * in.q_design;
    }

    void pull_flow() {
        const double on = way.mode == Mode::cycling ? 1 : in.available;
        double share = 0;  // of on q_design
        switch (way.limit) {
            case Limit::load:
                E += q / (rho_c_air * way.drop);
                if (kind.supplies) to.heating += q / (rho_c_air * way.drop);
                if (way.drop > least_drop) {
                    to.theta_air -= q * way.q / way.drop;
                    to.theta_supply += q * way.q / way.drop;
                }
                break;
            case Limit::least:
                pull_least();
                break;
            case Limit::design:
                share = 1;
                break;
            case Limit::outdoor:
                to.q_e += q;
                break;
            case Limit::turning:
                to.q_design += q * least_turning;
                break;
        }
        to.q_design += q * share * on;
        if (way.mode != Mode::cycling) to.available += q * share * in.q_design;
    }

    void pull_recovery() {
        to.cooling += E;
        to.heating += asked - E;
        if (kind.supplies)
            pull_supplied();
        else
            pull_brought();
        pull_efficiency();
    }

    void pull_supplied() {
        to.q_supplied += E * rho_c_air * (in.theta_air - in.theta_supply);
        to.theta_air += E * rho_c_air * in.q_supplied;
        to.theta_supply -= E * rho_c_air * in.q_supplied;
    }

    /// Of what outdoor air brings, and what frost costs.
    void pull_brought() {
        const double lost = asked * rho_c_air, brought = E * rho_c_air;
        to.q_e +=
            (lost * (in.heat_recovery - way.eta) + brought * (1 - in.heat_recovery)) *
            way.D;
        to.heat_recovery += (lost - brought) * in.q_e * way.D;
        eta -= lost * in.q_e * way.D;
        D += (lost * (in.heat_recovery - way.eta) + brought * (1 - in.heat_recovery)) *
             in.q_e;
    }

    void pull_efficiency() {
        if (!way.is_frosted) {
            to.heat_recovery += eta;
        } else if (way.eta > 0) {
            to.theta_air += eta / way.D;
            to.frost_limit -= eta / way.D;
            D -= eta * way.eta / way.D;
        }
        to.theta_air += D;
        to.theta_e -= D;
    }

    const AirKind& kind;
    const AirHour& in;
    const Way& way;
    const AirLoads& loads;
    AirHour to;
    double D = 0, eta = 0, asked = 0, E = 0, q = 0, fan = 0, in_air = 0, reheat = 0,
           net = 0, free = 0, x_least = 0, x = 0, sensible = 0, theta_mixed = 0;
};

}  // namespace

AirLoads supply(const AirKind& kind, const AirHour& hour) {
    const Way way = go(kind, hour);
    if (way.mode == Mode::passive) return {hour.heating, 0, 0};
    return {way.reheat + std::max(0.0, -way.net) + way.humidified,
            way.sensible + way.latent, way.fan};
}

AirHour pull_supply(const AirKind& kind, const AirHour& hour, const AirLoads& of_loads) {
    const Way way = go(kind, hour);
    return Back(kind, hour, way, of_loads).pull();
}

}  // namespace bemcal::physics
