"""A building from an EnergyPlus file: envelope, loads, air, set-points, plant, and what was left out.

Zones with a thermostat are put together, or each is a room by itself; multipliers count. Leaves out air between rooms,
and what LEFT_OUT names.
"""
from dataclasses import dataclass, field

from new_job import idf, idf_envelope, idf_fans, idf_geometry, idf_ideal, idf_outside, idf_plant, idf_room, \
    idf_schedules, idf_use, idf_ventilators
from new_job.building import Load
from new_job.envelopes import Envelope
from new_job.refused import DATA, Refused

EXCHANGERS = "heatexchanger:airtoair"
# Beginnings of classes that a job could have, and what to do.
LEFT_OUT = (
    ("shading:", "shading objects; write shading_factor where they matter"),
    ("windowshadingcontrol", "blinds; the solar transmittance is without them"),
    ("windowproperty:shadingcontrol", "blinds; the solar transmittance is without them"),
    ("zonemixing", "air between zones"), ("zonecrossmixing", "air between zones"),
    ("airflownetwork:", "the air network; correct the flows"),
    ("zoneinfiltration:effectiveleakagearea", "infiltration by leakage area"),
    ("zoneinfiltration:flowcoefficient", "infiltration by flow coefficient"),
    ("zoneventilation:windandstackopenarea", "air through openings; venting_air_change may stand for it"),
    (EXCHANGERS, "heat recovery; write heat_recovery in the flow"),
    ("waterheater:stratified", "hot water; a load may stand for it"),
    ("waterheater:heatpump", "hot water; a load may stand for it"), ("otherequipment", "other equipment"),
    ("hotwaterequipment", "equipment by hot water"), ("steamequipment", "equipment by steam"),
    ("daylighting:", "lights that daylight dims"), ("energymanagementsystem:program", "programs of EnergyPlus"),
    ("refrigeration:", "refrigeration"), ("generator:", "generators"),
    ("zonehvac:lowtemperatureradiant", "radiant systems"),
    ("zonebaseboard:outdoortemperaturecontrolled", "baseboards by outdoor temperature; a load may stand for them"),
    ("electricequipment:ite", "computers that air cools; a load may stand for them"),
    *((kind, "fans; an [[air_system]] may stand for them")
      for kind in ("fan:variablevolume", "fan:componentmodel", "fan:zoneexhaust")),
    ("runperiodcontrol:specialdays", "holidays; those of --place hold"))
HVAC_TEMPLATES = "hvactemplate:"
LEAST_SIZE = 1                 # m2 and m3, below which nothing is a room
SD_OF_FILE = 0.25              # of the factor on U-values that a modeller wrote down
IDEAL = (idf_ideal.SYSTEM, idf_ideal.TEMPLATE)
AIR, ECONOMIZER, NO_ECONOMIZER = "Controller:OutdoorAir", "economizer_control_type", "noeconomizer"


@dataclass(eq=False)           # a room is itself
class Room:
    """Zones that are one in the job; the whole building is one, too."""
    name: str
    area: float                # m2 of floor
    volume: float              # m3
    shell: object
    loads: dict                # {name: Profile in W/m2}
    infiltration: object       # profile, 1/h
    ventilation: object        # profile, 1/h
    heating: object            # profile, degC; None without
    cooling: object
    heat_recovery: float = 0   # share of the ventilation's heat
    heating_capacity: float = None   # W/m2; None without a limit
    cooling_capacity: float = None


@dataclass
class Described:
    file: str
    whole: Room
    rooms: list                # the whole, or one of each zone
    heating_machines: object   # idf_plant.Machines
    cooling_machines: object
    is_ideal: bool
    fans_say: str
    left_out: list = field(default_factory=list)
    checks: list = field(default_factory=list)

    @property
    def heaters(self):
        """[(class, carrier, efficiency or COP)]"""
        return self.heating_machines.known

    @property
    def coolers(self):
        return self.cooling_machines.known

    @property
    def has_thermostat(self):
        return self.whole.heating is not None or self.whole.cooling is not None


def size_of(zones):
    """(floor area, volume) [m2, m3]; a zone that is no part of the building's floor area has one by itself."""
    return (sum(zone.area * zone.multiplier for zone in zones if zone.counts or len(zones) == 1),
            sum(zone.volume * zone.multiplier for zone in zones))


class Reader:
    """Of rooms, one after the other."""

    def __init__(self, model, left_out, hours, dark, set_points):
        self.model, self.left_out, self.hours, self.dark = model, left_out, hours, dark
        self.schedules = idf_schedules.Schedules(model, set_points)
        self.zones = idf_geometry.read_zones(model)
        idf_use.mark_conditioned(model, self.zones, left_out)
        self.rooms = [zone for zone in self.zones.values() if zone.is_conditioned]
        self.envelope = self.fans = self.outside = None

    def whole(self):
        area, volume = size_of(self.rooms)
        if area < LEAST_SIZE or volume < LEAST_SIZE:
            raise idf_use.no_zone(self.model, f"{area:g} m2 and {volume:g} m3")
        room = self.room("building", self.rooms)
        if not room.shell.surfaces:
            raise idf_use.no_zone(self.model, "no surface to outdoors or ground of a zone with a thermostat")
        if room.shell.adiabatic:
            self.left_out.append(f"{room.shell.adiabatic:.0f} m2 of adiabatic surfaces: nothing passes them")
        return room

    def each(self, whole):
        """A room of each zone with a floor; `whole` has their constructions."""
        rooms = [self.room(idf_envelope.plain(zone.name), [zone], whole.shell) for zone in self.rooms
                 if zone.area >= LEAST_SIZE and zone.volume >= LEAST_SIZE]
        apart = sum(sum(room.shell.between.values()) for room in rooms) / 2
        if apart:
            self.left_out.append(f"{apart:.0f} W/K between rooms: stands in the job behind #, for coupled zones have "
                                 "no derivatives, which a loop needs; other studies can do without")
        return rooms

    def room(self, name, zones, known=None):
        use = idf_use.Reader(self.model, self.zones, self.schedules, self.left_out, zones)
        loads = use.loads()
        infiltration, others = use.infiltration()
        self.envelope = self.envelope or idf_envelope.Reader(self.model, self.zones, self.left_out, others)
        shell = self.envelope.read(zones, known)
        heating, cooling = use.set_points()
        area, volume = size_of(zones)
        air, recovered = use.ventilation()
        self.fans = self.fans or idf_fans.load_of(self.model, use.schedules, size_of(self.rooms)[0])
        if self.outside is None:
            self.outside = idf_outside.loads_of(self.model, use, self.zones, self.dark, size_of(self.rooms)[0],
                                                self.left_out)
        if "people" in loads and len(self.hours) >= idf_room.LEAST_HOURS:
            gains = sum(profile.share * profile.values for profile in loads.values()) + \
                self.fans.share * self.fans.values * area
            balance = idf_room.Balance(shell, shell.capacity(area) * area, infiltration + (1 - recovered) * air,
                                       gains, (heating, cooling))
            loads["people"].values = use.people_heat(balance.temperatures(self.hours))
        for profile in loads.values():
            profile.values = profile.values / area
        if self.fans.values.any():
            loads["fans"] = self.fans
        loads |= self.outside
        return Room(name, area, volume, shell, loads, infiltration / volume, air / volume, heating, cooling, recovered,
                    *(None if limit is None else limit / area for limit in map(use.capacity, idf_ideal.MODES)))


def read_building(path, has_rooms=False, hours=(), site=None, has_summer_time=False,
                  set_points=idf_schedules.USUAL_SET_POINTS):
    """`hours`: of the weather (weather.hours_of); without a year of them people are in rooms half-way between the
    set-points. `site`: (latitude, longitude, UTC offset), for its nights. `set_points`: of the use, where a file of
    their schedule is not there."""
    model, left_out = idf.read_model(path), []
    refuse_templates(model)
    reader = Reader(model, left_out, hours, idf_outside.dark_share(site, has_summer_time), set_points)
    whole = reader.whole()
    rooms = reader.each(whole) if has_rooms else [whole]
    heating, cooling = (idf_plant.machines(model, reader.schedules, mode)
                        for mode in (idf_plant.HEATING, idf_plant.COOLING))
    found = Described(path, whole, rooms, heating, cooling, bool(model.all(*IDEAL)), idf_fans.says(model))
    of_whole = [line for mode in idf_ideal.MODES if not has_rooms and getattr(whole, f"{mode}_capacity") is None
                for line in idf_ideal.left_out_of_whole(model, reader.schedules, mode)]
    found.left_out = list(dict.fromkeys([*left_out, *left_out_of(model), *of_whole,
                                         *idf_ideal.left_out_of(model, reader.schedules)]))
    found.checks = model.checks
    return found


def refuse_templates(model):
    """Templates of systems: what they stand for is known once EnergyPlus has expanded them."""
    templates = [several[0].kind for kind, several in model.objects.items() if kind.startswith(HVAC_TEMPLATES)
                 and kind not in idf.FIELDS]
    if templates:
        raise Refused(f"{model.file}: {', '.join(templates)}: templates of systems are not read; run EnergyPlus's "
                      "ExpandObjects and give its expanded.idf", DATA)


def left_out_of(model):
    of_units = idf_ventilators.exchangers_of_units(model)
    for beginning, says in LEFT_OUT:
        kinds = [[each for each in several if not (kind.startswith(EXCHANGERS) and each.name.lower() in of_units)]
                 for kind, several in model.objects.items() if kind.startswith(beginning)]
        kinds = [several for several in kinds if several]
        if kinds:
            yield f"{sum(map(len, kinds))} {kinds[0][0].kind}{' and the like' if len(kinds) > 1 else ''}: {says}"
    continuous = [fan for fan in idf_fans.variable_fans(model) if fan.kind.lower() == "fan:systemmodel"]
    if continuous:
        yield f"{len(continuous)} Fan:SystemModel of continuous speed: fans; an [[air_system]] may stand for them"
    controllers = model.all(AIR)
    cooling = [each for each in controllers if each.word(ECONOMIZER, NO_ECONOMIZER) != NO_ECONOMIZER]
    if cooling:
        yield f"economizers of {len(cooling)} of {len(controllers)} {AIR}; [[effect]] name = \"economiser\" may " \
              "stand for them, or a loop finds air that cools"


def envelope_of(found):
    """What the priors ask of an envelope."""
    opaque, glazing = found.whole.shell.opaque.values(), found.whole.shell.glazing.values()
    most = max(each.u_value for each in opaque)
    return Envelope(most, most, most, max((g.u_value for g in glazing), default=0),
                    max((g.solar for g in glazing), default=0), float(found.whole.infiltration.mean()), found.file,
                    SD_OF_FILE, False)


def loads_of(found, others):
    """Those of the file, and hot water, which is a table's where the file has none."""
    names = {"equipment": "equipment", "lights": "lights", "people": "people, sensible", "fans": found.fans_say,
             idf_outside.OUTSIDE_LIGHTS: "lights outside",
             **dict.fromkeys(idf_outside.OUTSIDE_EQUIPMENT.values(),
                             "equipment outside, and all that draws in zones without a thermostat"),
             idf_outside.HOT_WATER: "hot water, with losses of its tanks"}
    loads = [Load(name, float(profile.values.max()), name, profile.carrier, names.get(name, "equipment by gas"))
             for name, profile in found.whole.loads.items()]
    return [*loads, *(load for load in others if load.name == idf_outside.HOT_WATER and
                      load.name not in found.whole.loads)]
