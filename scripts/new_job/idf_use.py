"""Loads, air and set-points of an EnergyPlus file, of all its conditioned zones together or of one.

Each is a sum of power or flow times schedule, or a mean of set-points by floor area. Infiltration's coefficients are
taken at usual differences of temperature and wind, wind at the zone's height by EnergyPlus's terrain. Sensible heat of
people: EnergyPlus Engineering Reference, People. Leaves out sizes that EnergyPlus finds, controls, air networks, and
that outdoor air is denser than the room's (3 % more infiltration by mass in Chicago).
"""
import functools
import math

import numpy as np

from new_job import idf, idf_fans, idf_ideal, idf_schedules, idf_ventilators
from new_job.profile import Profile
from new_job.refused import Refused

USUAL_DIFFERENCE, USUAL_WIND = 10, 4     # K and m/s at 10 m, for coefficients of infiltration
# Wind at a height: exponent and boundary layer [m], EnergyPlus Engineering Reference; the weather's is country.
TERRAINS = {"country": (0.14, 270), "suburbs": (0.22, 370), "city": (0.33, 460), "urban": (0.22, 370),
            "ocean": (0.10, 210)}
WIND_HEIGHT = 10               # m
# Where the room's temperature is not known, it is half-way between the set-points, this above heating's at most [K].
MOST_ABOVE = 3
ROOM = 22                      # degC, where a zone has not both
PER_PERSON = 0.00944           # m3/s, EnergyPlus's default of DesignSpecification:OutdoorAir
# Types of a thermostat's control, and what each does.
CONTROLS = {0: (), 1: ("heating",), 2: ("cooling",), 3: ("heating", "cooling"), 4: ("heating", "cooling")}
OF_OBJECT = ("none", "detailedspecification")   # methods by which a template names an object, or nothing
TARGET = "zone_or_zonelist_or_space_or_spacelist_name"
LOADS = (("lights", "Lights", "lighting_level", "electricity"),
         ("equipment", "ElectricEquipment", "design_level", "electricity"),
         ("gas_equipment", "GasEquipment", "design_level", "gas"))
NOT_IN_ROOM = ("fraction_latent", "fraction_lost", "return_air_fraction")   # of a load's power


class Reader:
    def __init__(self, model, zones, schedules, left_out, rooms):
        """`rooms`: the conditioned zones that are read."""
        self.model, self.zones, self.schedules, self.left_out, self.rooms = model, zones, schedules, left_out, rooms
        self.people = {}       # {zone: number at the most}
        self.present = {}      # {zone: profile of their number}

    def targets(self, thing, key):
        """[(zone, its floor area or that of the space)] which a field names."""
        name = thing.word(key)
        if name in self.zones:
            zone = self.zones[name]
            return [(zone, zone.area)]
        of_list = self.model.find(name, "ZoneList", "SpaceList")
        if of_list is not None:
            return [pair for (each,) in of_list.rest if each for pair in self.one(thing, key, each.lower())]
        return self.one(thing, key, name)

    def one(self, thing, key, name):
        if name in self.zones:
            return [(self.zones[name], self.zones[name].area)]
        space = self.model.find(name, "Space")
        if space is None or space.word("zone_name") not in self.zones:
            thing.refuse(key, f"{thing.text(key)!r} is no zone, space or list of the file; expected the name of one")
        zone = self.zones[space.word("zone_name")]
        floors = [s for s in zone.surfaces if s.kind == "floor" and s.given.word("space_name") == name]
        return [(zone, sum(s.gross for s in floors) or zone.area)]

    def conditioned_targets(self, thing, key=TARGET, tells=True):
        """Those among the rooms; zones without a thermostat are told."""
        found = self.targets(thing, key)
        for zone, _ in found:
            if tells and not zone.is_conditioned:
                self.left_out.append(f'{thing.kind} of zone "{zone.name}", which has no thermostat')
        return [(zone, area) for zone, area in found if zone in self.rooms]

    def count_people(self, thing, area):
        method = thing.word("number_of_people_calculation_method", "people")
        if method == "people/area":
            return area * thing.number("people_per_floor_area", 0, 0, 1e3)
        if method == "area/person":
            return area / thing.number("floor_area_per_person", 1e9, 1e-3, 1e12)
        return thing.number("number_of_people", 0, 0, 1e6)

    def read_people(self):
        """[W], sensible."""
        for thing in self.model.all("People"):
            for zone, area in self.conditioned_targets(thing):
                number = self.count_people(thing, area)
                self.people[zone.name] = self.people.get(zone.name, 0) + number
                self.present[zone.name] = self.present.get(zone.name, 0) + \
                    number * self.schedules.of(thing, "number_of_people_schedule_name")
        return self.people_heat()

    def people_heat(self, building=None):
        """[W], sensible. `building`: temperatures of all rooms together, (8, 24) [degC]."""
        total, rooms = idf_schedules.constant(0), self.room_temperatures(building)
        for thing in self.model.all("People"):
            for zone, area in self.targets(thing, TARGET):
                if zone not in self.rooms:
                    continue
                activity = self.schedules.of(thing, "activity_level_schedule_name")
                share = thing.number("sensible_heat_fraction", None, 0, 1)
                heat = sensible(activity, rooms.get(zone.name, ROOM)) if share is None else share * activity
                total += zone.multiplier * self.count_people(thing, area) * heat * \
                    self.schedules.of(thing, "number_of_people_schedule_name")
        return total

    def room_temperatures(self, building):
        """{zone: profile} [degC] within the set-points; half-way where the building's is not known."""
        return {zone.name: np.minimum((heating + cooling) / 2, heating + MOST_ABOVE) if building is None else
                np.clip(building, heating, cooling)
                for zone, (heating, cooling) in self.thermostats() if heating is not None and cooling is not None}

    def power(self, thing, level, zone, area):
        """[W] of one zone."""
        method = thing.word("design_level_calculation_method")
        unit = "power" if thing.kind.lower() == "gasequipment" else "watts"
        if method in ("watts/area", "power/area"):
            return area * thing.number(f"{unit}_per_floor_area", 0, 0, 1e5)
        if method in ("watts/person", "power/person"):
            return self.people.get(zone.name, 0) * thing.number(f"{unit}_per_person", 0, 0, 1e6)
        return thing.number(level, 0, 0, 1e9)

    def read_load(self, kind, level, carrier):
        total, heat = idf_schedules.constant(0), 0.0
        for thing in self.model.all(kind):
            share = max(0, 1 - sum(thing.number(key, 0, 0, 1) for key in NOT_IN_ROOM))
            for zone, area in self.conditioned_targets(thing, tells=False):
                power = zone.multiplier * self.power(thing, level, zone, area)
                added = power * self.schedules.of(thing, "schedule_name")
                total += added
                heat += share * added.mean()
        return Profile(total, heat / total.mean() if total.any() else 1, carrier)

    def without_thermostat(self):
        """{carrier: [W]} of what draws in zones without a thermostat, which no room feels."""
        found = {}
        for _, kind, level, carrier in LOADS:
            for thing in self.model.all(kind):
                for zone, area in self.targets(thing, TARGET):
                    if zone.is_conditioned:
                        continue
                    power = zone.multiplier * self.power(thing, level, zone, area)
                    found[carrier] = found.get(carrier, 0) + power * self.schedules.of(thing, "schedule_name")
        return found

    def loads(self):
        """{name: Profile in W}"""
        found = {"people": Profile(self.read_people())}
        found |= {name: self.read_load(kind, level, carrier) for name, kind, level, carrier in LOADS}
        return {name: profile for name, profile in found.items() if profile.values.max() > 0}

    def infiltration_of(self, thing, zone, area):
        """[m3/h] at a schedule of 1 and usual weather."""
        method = thing.word("design_flow_rate_calculation_method", "flow/zone")
        outer = [s for s in zone.surfaces if s.outside == "outdoors"]
        walls = [s for s in outer if 60 <= s.tilt <= 120]
        per_outer = thing.number("flow_rate_per_exterior_surface_area", 0, 0, 100)
        flows = {"flow/zone": lambda: thing.number("design_flow_rate", 0, 0, 1e5),
                 "flow/area": lambda: area * thing.number("flow_rate_per_floor_area", 0, 0, 100),
                 "flow/exteriorarea": lambda: per_outer * sum(s.gross for s in outer),
                 "flow/exteriorwallarea": lambda: per_outer * sum(s.gross for s in walls),
                 "airchanges/hour": lambda: zone.volume * thing.number("air_changes_per_hour", 0, 0, 1e3) / 3600}
        if method not in flows:
            thing.refuse("design_flow_rate_calculation_method", f"{method!r} is none; expected {', '.join(flows)}")
        wind = self.wind_at(zone.middle)
        factor = thing.number("constant_term_coefficient", 1) + \
            thing.number("temperature_term_coefficient", 0) * USUAL_DIFFERENCE + \
            thing.number("velocity_term_coefficient", 0) * wind + \
            thing.number("velocity_squared_term_coefficient", 0) * wind**2
        return 3600 * flows[method]() * max(factor, 0)

    def wind_at(self, height):
        building = next(iter(self.model.all("Building")), None)
        exponent, layer = TERRAINS.get(building.word("terrain", "suburbs") if building else "suburbs",
                                       TERRAINS["suburbs"])
        of_weather, its_layer = TERRAINS["country"]
        return USUAL_WIND * (its_layer / WIND_HEIGHT)**of_weather * (max(height, 0.1) / layer)**exponent

    def infiltration(self):
        """(profile of the rooms, {zone without a thermostat: mean}) [m3/h]"""
        total, others = idf_schedules.constant(0), {}
        for thing in self.model.all("ZoneInfiltration:DesignFlowRate"):
            for zone, area in self.targets(thing, TARGET):
                flow = self.infiltration_of(thing, zone, area) * self.schedules.of(thing, "schedule_name")
                if zone in self.rooms:
                    total += zone.multiplier * flow
                elif not zone.is_conditioned:
                    others[zone.name] = others.get(zone.name, 0) + float(flow.mean())
        return total, others

    def outdoor_air(self, thing, zone, people):
        """[m3/h] of a DesignSpecification:OutdoorAir, by a number or a profile of people."""
        method = thing.word("outdoor_air_method", "flow/person")
        changes = thing.number("outdoor_air_flow_air_changes_per_hour", 0, 0, 1e3)
        parts = {"flow/person": people * thing.number("outdoor_air_flow_per_person",
                                                      PER_PERSON if method == "flow/person" else 0, 0, 10),
                 "flow/area": zone.area * thing.number("outdoor_air_flow_per_zone_floor_area", 0, 0, 10),
                 "flow/zone": thing.number("outdoor_air_flow_per_zone", 0, 0, 1e4),
                 "airchanges/hour": zone.volume * changes / 3600}
        if method == "maximum":
            return 3600 * functools.reduce(np.maximum, parts.values())
        return 3600 * (parts[method] if method in parts else sum(parts.values()))

    def ventilation(self):
        """(profile [m3/h], share of its heat that is recovered) by systems, heat recovery units and ZoneVentilation."""
        units = [each for each in idf_ventilators.flows_of_units(self.model, self.zones, self.schedules, self.people,
                                                                 self.left_out) if each[0] in self.rooms]
        by_units = sum(zone.multiplier * flow for zone, flow, _ in units)
        recovered = sum(zone.multiplier * share * flow.mean() for zone, flow, share in units)
        by_systems, of_systems = self.by_systems({zone for zone, flow, _ in units if flow.any()})
        total, recovered = by_units + by_systems + self.by_zones(), recovered + of_systems
        return total, float(recovered / total.mean()) if recovered else 0

    def by_systems(self, ventilated):
        """(profile [m3/h], the mean of what has its heat recovered) of the rooms but those that a unit of their own
        ventilates."""
        total, recovered = idf_schedules.constant(0), 0
        key = "minimum_outdoor_air_schedule_name"
        openings = [self.schedules.of(each, key) for each in self.model.all("Controller:OutdoorAir") if each.text(key)]
        damper = sum(openings) / len(openings) if openings else 1
        of_time = idf_fans.shares_of_time(self.model, self.schedules, self.left_out)
        by_systems = [(each, zone, damper * of_time.get(zone.name.lower(), 1))
                      for each in self.model.all("Sizing:Zone")
                      for zone, _ in self.conditioned_targets(each, "zone_or_zonelist_name")]
        ideal = [(each, zone, idf_ideal.availability(self.schedules, each)) for each, zone in self.ideal_loads()]
        for each, zone, share in ideal or by_systems:
            thing = self.fresh_air(each)
            if thing is not None and zone not in ventilated:
                people = (self.present if idf_ideal.is_by_people(each) else self.people).get(zone.name, 0)
                flow = zone.multiplier * self.outdoor_air(thing, zone, people) * share * \
                    self.schedules.of(thing, "outdoor_air_schedule_name")
                total += flow
                recovered += idf_ideal.effectiveness(each) * flow.mean()
        return total, recovered

    def ideal_loads(self):
        """[(system, its room)], by the node between, the zone's list of equipment, or a template's zone."""
        names = {}             # of nodes and equipment: {name: zones}
        for each in self.model.all("ZoneHVAC:EquipmentConnections"):
            names.setdefault(each.word("zone_air_inlet_node_or_nodelist_name"), []).append(each.word("zone_name"))
        for zone, equipment in idf_fans.equipment_of(self.model).items():
            for name in equipment:
                names.setdefault(name, []).append(zone)
        found = [(each, self.zones.get(name)) for each in self.model.all(idf_ideal.SYSTEM) for name in dict.fromkeys(
            zone for key in (each.word("zone_supply_air_node_name"), each.name.lower()) if key
            for zone in names.get(key, ()))]
        found += [(each, zone) for each in self.model.all(idf_ideal.TEMPLATE)
                  for zone, _ in self.conditioned_targets(each, "zone_name")]
        return [(each, zone) for each, zone in found if zone in self.rooms]

    def capacity(self, mode):
        """[W] of the rooms' ideal loads; None where one of the rooms has no limit."""
        limits = {}
        for system, zone in self.ideal_loads():
            limits[zone] = limits.get(zone, 0) + zone.multiplier * idf_ideal.capacity(self.schedules, system, mode)
        total = sum(limits.get(zone, math.inf) for zone in self.rooms)
        return total if math.isfinite(total) else None

    def by_zones(self):
        """[m3/h] of ZoneVentilation."""
        total = idf_schedules.constant(0)
        for thing in self.model.all("ZoneVentilation:DesignFlowRate"):
            share = idf_ventilators.share_of_design(thing, self.schedules, self.left_out)
            for zone, area in self.conditioned_targets(thing):
                total += zone.multiplier * share * self.own_flow(thing, zone, area) * \
                    self.schedules.of(thing, "schedule_name")
        return total

    def fresh_air(self, system):
        """What a system says of its outdoor air, None where it has none; a template may say it itself."""
        is_template = system.kind.lower() == idf_ideal.TEMPLATE.lower()
        if is_template and system.word("outdoor_air_method", "none") not in OF_OBJECT:
            fields = {key.replace("_rate_", "_"): value for key, value in system.fields.items()
                      if key.startswith("outdoor_air")}
            return idf.Object(system.file, system.kind, {"name": system.word("zone_name"), **fields})
        name = system.text("design_specification_outdoor_air_object_name")
        thing = self.model.find(name, "DesignSpecification:OutdoorAir")
        if name and thing is None:
            self.left_out.append(f'outdoor air "{name}"')
        return thing

    def own_flow(self, thing, zone, area):
        method = thing.word("design_flow_rate_calculation_method", "flow/zone")
        if method == "flow/area":
            return 3600 * area * thing.number("flow_rate_per_floor_area", 0, 0, 100)
        if method == "flow/person":
            return 3600 * self.people.get(zone.name, 0) * thing.number("flow_rate_per_person", 0, 0, 100)
        if method == "airchanges/hour":
            return zone.volume * thing.number("air_changes_per_hour", 0, 0, 1e3)
        return 3600 * thing.number("design_flow_rate", 0, 0, 1e5)

    def set_points(self):
        """(heating, cooling) profiles [degC], means by floor area; None where no thermostat is there."""
        sums, areas = [0, 0], [0.0, 0.0]
        for zone, pair in self.thermostats():
            for k, profile in enumerate(pair):
                if profile is not None and zone in self.rooms:
                    weight = zone.area * zone.multiplier
                    sums[k] = sums[k] + weight * profile
                    areas[k] += weight
        return tuple(total / area if area else None for total, area in zip(sums, areas))

    def thermostats(self):
        """(zone, (heating, cooling)) of each."""
        for control in self.model.all("ZoneControl:Thermostat"):
            pair = self.pair_of(control)
            for zone, _ in self.targets(control, "zone_or_zonelist_name"):
                yield zone, pair
        for each in self.model.all("HVACTemplate:Zone:IdealLoadsAirSystem"):
            thing = self.model.need(each, "template_thermostat_name", "HVACTemplate:Thermostat")
            for zone, _ in self.targets(each, "zone_name"):
                yield zone, tuple(
                    self.schedules.of(thing, f"{mode}_setpoint_schedule_name")
                    if thing.text(f"{mode}_setpoint_schedule_name")
                    else idf_schedules.constant(thing.number(f"constant_{mode}_setpoint", usual, -50, 100))
                    for mode, usual in (("heating", 20), ("cooling", 26)))

    def pair_of(self, control):
        heating = cooling = None
        for k in range(1, 5):
            kind, name = control.text(f"control_{k}_object_type"), control.text(f"control_{k}_name")
            if not name:
                continue
            thing = self.model.need(control, f"control_{k}_name", kind)
            kind = kind.lower()
            if kind.endswith("dualsetpoint"):
                heating = self.schedules.of(thing, "heating_setpoint_temperature_schedule_name")
                cooling = self.schedules.of(thing, "cooling_setpoint_temperature_schedule_name")
            if kind.endswith(("singleheating", "singleheatingorcooling")):
                heating = self.schedules.of(thing, "setpoint_temperature_schedule_name")
            if kind.endswith(("singlecooling", "singleheatingorcooling")):
                cooling = self.schedules.of(thing, "setpoint_temperature_schedule_name")
        shares = self.shares_controlled(control)
        return heating if shares["heating"] else None, cooling if shares["cooling"] else None

    def shares_controlled(self, control):
        """{mode: share of the year in which a thermostat's type of control has it}; what is there at times is told."""
        name, known = control.word("control_type_schedule_name"), self.schedules.shares_controlled
        if name not in known:
            known[name] = shares_of_control(self.schedules.of(control, "control_type_schedule_name"))
        for mode, share in known[name].items():
            if 0 < share < 1:
                self.left_out.append(f"{control.kind}: control_type_schedule_name: {mode} is off in {1 - share:.0%} of "
                                     f"the year; {mode}_limit of the zone, or a schedule, may stand for it")
        return known[name]


def shares_of_control(types):
    """{mode: share of the year} of a profile of types of control; all of it where some are no types."""
    if not np.isin(types, list(CONTROLS)).all():
        return dict.fromkeys(idf_ideal.MODES, 1)
    return {mode: float(np.isin(types, [kind for kind, modes in CONTROLS.items() if mode in modes]).mean())
            for mode in idf_ideal.MODES}


def sensible(activity, room):
    """[W] of a person's activity [W] in a room [degC]."""
    m, t = activity, room
    return np.clip(6.461927 + 0.946892 * m + 0.0000255737 * m**2 + 7.139322 * t - 0.0627909 * t * m
                   + 0.0000589172 * t * m**2 - 0.198550 * t**2 + 0.000940018 * t**2 * m
                   - 0.00000149532 * t**2 * m**2, 0, m)


def mark_conditioned(model, zones, told):
    """Zones with a thermostat; with none in the file those with equipment, else all."""
    named = set()
    for kind, key in (("ZoneControl:Thermostat", "zone_or_zonelist_name"), ("HVACTemplate:Zone:IdealLoadsAirSystem",
                                                                            "zone_name"),
                      ("ZoneHVAC:EquipmentConnections", "zone_name")):
        if kind.startswith("ZoneHVAC") and named:
            break
        for thing in model.all(kind):
            of_list = model.find(thing.text(key), "ZoneList")
            named |= {name.lower() for (name,) in of_list.rest} if of_list else {thing.word(key)}
    for name, zone in zones.items():
        zone.is_conditioned = not named or name in named
    if not any(zone.is_conditioned and zone.area for zone in zones.values()):
        raise no_zone(model, "no zone with a floor")
    without = [zone.name for zone in zones.values() if not zone.is_conditioned]
    if without:
        told.append(f"zones without a thermostat: {', '.join(without)}; a factor on the loss through them is kept")


def no_zone(model, why):
    return Refused(f"{model.file}: has {why}; expected Zone and BuildingSurface:Detailed with floors and outer walls")
