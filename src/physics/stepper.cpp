/// A building's step, zone by zone. Zones see each other by the air temperature of the
/// step before, so their order does not matter: a link is one more ventilation flow.
/// Source: ISO 13790:2008, Annex C (hour); the coupling is our own, explicit in time.
/// Without refinements the standard's hour is called. Meters are left to meters.cpp.
#include "physics/stepper.hpp"

#include "base/error.hpp"
#include "physics/air_hour.hpp"
#include "physics/zone_radiator.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace bemcal::physics {

namespace {

/// The standard's hour: hour.hpp and nothing else.
StepResult standard_step(const Network& network, const HourDrive& drive,
                         const Control& control, const ZoneState& before, double dt) {
    const NodeGains gains = split_gains(network, drive);
    const double phi_hc =
        power_for_set_point(network, drive, gains, control, before.theta_m, dt);
    StepResult result;
    result.theta = advance_hour(network, drive, gains, before.theta_m, phi_hc, dt);
    result.after = before;
    result.after.theta_m = result.theta.theta_m_t;
    result.after.theta_air = result.theta.theta_air;
    result.phi_heating = std::max(phi_hc, 0.0);
    result.phi_cooling = std::max(-phi_hc, 0.0);
    return result;
}

/// What ties a zone's air to another's [W/K].
struct AirLink {
    std::size_t zone;
    double H;
};

/// A coupling's conductance acts on both of its zones, its air flow on the zone that it
/// enters.
std::vector<AirLink> air_links(const Building& building, const Drive& drive,
                               std::size_t zone, int step) {
    std::vector<AirLink> links;
    for (const ZoneCoupling& coupling : building.zones[zone].couplings)
        links.push_back({static_cast<std::size_t>(coupling.zone),
                         drive.at(coupling.conductance, step) +
                             rho_c_air * drive.at(coupling.air_flow, step) / 3600});
    for (std::size_t other = 0; other < building.zones.size(); ++other)
        for (const ZoneCoupling& coupling : building.zones[other].couplings)
            if (static_cast<std::size_t>(coupling.zone) == zone)
                links.push_back({other, drive.at(coupling.conductance, step)});
    return links;
}

/// A link enters as a ventilation flow with the other zone's air as its supply.
void add_link(const AirLink& link, double theta_other, Network& network,
              HourDrive& hour) {
    const double H_ve = network.H_ve + link.H;
    if (H_ve <= 0) return;
    hour.theta_sup = (network.H_ve * hour.theta_sup + link.H * theta_other) / H_ve;
    network.H_ve = H_ve;
}

void reject_tight(const std::vector<AirLink>& links, const Building& building,
                  std::size_t zone, int step, double H_tr_is) {
    double H = 0;
    for (const AirLink& link : links) H += link.H;
    if (H <= H_tr_is) return;
    throw CannotSimulate(fmt::format(
        "zone {}, step {}: its couplings to other zones sum to {:.6g} W/K, more than ties "
        "its air to its own surfaces, H_tr,is = {:.6g} W/K; zones with so much in common "
        "are one zone",
        building.zones[zone].name, step, H, H_tr_is));
}

}  // namespace

void reject_tight_coupling(const Building& building, const Drive& drive, std::size_t zone,
                           int step, double H_tr_is) {
    reject_tight(air_links(building, drive, zone, step), building, zone, step, H_tr_is);
}

class Stepper::ZoneRun {
  public:
    ZoneRun(const Building& building, const Drive& drive, std::size_t zone)
        : building_(&building), drive_(&drive), index_(zone) {
        state_.theta_m = state_.theta_m2 = state_.theta_air = drive.theta_start;
        if (const auto& radiator = building.zones[zone].radiator)
            radiator_.emplace(*radiator, drive.theta_start);
    }

    double theta_air() const { return state_.theta_air; }

    std::size_t n_states() const {
        return own_states + (radiator_ ? radiator_->n_states() : 0);
    }

    void write_state(std::span<double> state) const {
        state[0] = state_.theta_m;
        state[1] = state_.theta_m2;
        state[2] = state_.theta_air;
        state[3] = state_.phi_emitter;
        if (radiator_) radiator_->write_state(state.subspan(own_states));
    }

    void set_state(std::span<const double> state) {
        state_ = {state[0], state[1], state[2], state[3]};
        if (radiator_) radiator_->set_state(state.subspan(own_states));
    }

    StepResult advance(int step, const std::vector<double>& theta_air) {
        const Zone& zone = building_->zones[index_];
        make_network(*building_, zone, *drive_, step, network_);
        HourDrive hour = hour_drive(*building_, zone, network_, *drive_, step);
        couple(step, theta_air, hour);
        hour.phi_vent = venting_power(zone, *drive_, step, state_.theta_air);
        const Control control = control_at(zone, *drive_, step);
        const auto room = [&](const HourDrive& with) {
            const auto one_step = zone.structure.any() || zone.thermostat.rooms_differ()
                                      ? advance_step
                                      : standard_step;
            return one_step(network_, with, control, state_, drive_->axis.step_s);
        };
        StepResult result =
            radiator_ ? radiator_->advance(*drive_, step, hour, room) : room(hour);
        if (zone.air_system >= 0) let_system_supply(zone, step, result);
        check(step, result);
        state_ = result.after;
        return result;
    }

  private:
    void couple(int step, const std::vector<double>& theta_air, HourDrive& hour) {
        const std::vector<AirLink> links = air_links(*building_, *drive_, index_, step);
        if (links.empty()) return;
        for (const AirLink& link : links) {
            check(step, link);
            add_link(link, theta_air[link.zone], network_, hour);
        }
        reject_tight(links, *building_, index_, step, network_.H_tr_is);
        reject_ringing(building_->zones[index_], step, network_, drive_->axis.step_s);
    }

    /// Heat that the zone asks for becomes what coils and fan take.
    void let_system_supply(const Zone& zone, int step, StepResult& result) const {
        const AirLoads loads = system_loads(*building_, zone, *drive_, step,
                                            {result.phi_heating, result.phi_cooling, 0},
                                            result.theta.theta_air);
        result.phi_heating = loads.heating;
        result.phi_cooling = loads.cooling;
        result.phi_fan = loads.fan;
    }

    void check(int step, const AirLink& link) const {
        if (!(link.H >= 0))
            throw CannotSimulate(fmt::format(
                "zone {}, step {}: coupling to zone {} = {} W/K is not a number >= 0",
                name(), step, building_->zones[link.zone].name, link.H));
    }

    void check(int step, const StepResult& result) const {
        const double sum = result.theta.theta_air + result.theta.theta_m_t +
                           result.phi_heating + result.phi_cooling;
        if (!std::isfinite(sum))
            throw CannotSimulate(
                fmt::format("zone {}, step {}: temperature {} degC, heating {} W, "
                            "cooling {} W: not finite",
                            name(), step, result.theta.theta_air, result.phi_heating,
                            result.phi_cooling));
    }

    const std::string& name() const { return building_->zones[index_].name; }

    static constexpr std::size_t own_states = 4;  ///< the numbers of a ZoneState

    const Building* building_;
    const Drive* drive_;
    std::size_t index_;
    ZoneState state_;
    Network network_;
    std::optional<RadiatorRun> radiator_;
};

Stepper::Stepper(const Building& building, const Drive& drive)
    : theta_air_(building.zones.size(), drive.theta_start),
      results_(building.zones.size()) {
    zones_.reserve(building.zones.size());
    for (std::size_t zone = 0; zone < building.zones.size(); ++zone)
        zones_.emplace_back(building, drive, zone);
}

Stepper::Stepper(Stepper&&) noexcept = default;
Stepper::~Stepper() = default;

std::size_t Stepper::n_states() const {
    std::size_t n = 0;
    for (const ZoneRun& zone : zones_) n += zone.n_states();
    return n;
}

void Stepper::write_state(std::span<double> state) const {
    for (const ZoneRun& zone : zones_) {
        zone.write_state(state);
        state = state.subspan(zone.n_states());
    }
}

void Stepper::set_state(std::span<const double> state) {
    for (std::size_t zone = 0; zone < zones_.size(); ++zone) {
        zones_[zone].set_state(state);
        state = state.subspan(zones_[zone].n_states());
        theta_air_[zone] = zones_[zone].theta_air();
    }
}

std::span<const StepResult> Stepper::advance(int step) {
    for (std::size_t zone = 0; zone < zones_.size(); ++zone)
        results_[zone] = zones_[zone].advance(step, theta_air_);
    for (std::size_t zone = 0; zone < zones_.size(); ++zone)
        theta_air_[zone] = zones_[zone].theta_air();
    return results_;
}

}  // namespace bemcal::physics
