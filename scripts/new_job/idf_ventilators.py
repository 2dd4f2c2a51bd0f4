"""What ventilates a zone by itself in an EnergyPlus file: ZoneVentilation:DesignFlowRate, and heat recovery units.

A flow of ZoneVentilation is its design flow times the constant coefficient; one that a limit keeps off in ordinary
conditions is none. Source: EnergyPlus Input Output Reference, Groups Airflow and Zone Forced Air Units. Leaves out what
temperature and wind add, economisers and frost control of units, and that supply and exhaust may differ.
"""
from new_job import idf_fans, idf_schedules

# Rooms are heated to at least the one and cooled to at most the other, outdoors is between these for half of a year
# or more, and such are the difference and the wind: a limit within these is a control, and no flow of all hours.
ROOM, OUTDOORS = (20, 24), (5, 20)     # degC
DIFFERENCE, WIND = 10, 4               # K, m/s
# (limit, EnergyPlus's default, value up to which or from which the air flows in ordinary conditions)
LEAST = (("minimum_indoor_temperature", -100, ROOM[0]), ("delta_temperature", -100, DIFFERENCE),
         ("minimum_outdoor_temperature", -100, OUTDOORS[0]))
MOST = (("maximum_indoor_temperature", 100, ROOM[1]), ("maximum_outdoor_temperature", 100, OUTDOORS[1]),
        ("maximum_wind_speed", 40, WIND))
SLOPES = ("temperature_term_coefficient", "velocity_term_coefficient", "velocity_squared_term_coefficient")
INSTEAD = "venting_air_change may stand for it"
UNIT = "ZoneHVAC:EnergyRecoveryVentilator"
EXCHANGER, EFFECTIVENESS = "HeatExchanger:AirToAir:SensibleAndLatent", "sensible_effectiveness_at_100_heating_air_flow"
PER_AREA, PER_PERSON = 0.000508, 0.00236   # m3/(s m2) and m3/s, EnergyPlus's defaults where it finds a unit's flow


def limit_of(thing, schedules, key, usual):
    """A limit, the mean of its schedule where it has one."""
    scheduled = f"{key}_schedule_name"
    return schedules.of(thing, scheduled).mean() if thing.text(scheduled) else thing.number(key, usual)


def control_of(thing, schedules):
    """What keeps a flow off in ordinary conditions, as "minimum_indoor_temperature 29.4"; "" of one that flows."""
    values = {key: limit_of(thing, schedules, key, usual) for key, usual, _ in (*LEAST, *MOST)}
    off = [key for key, _, ordinary in LEAST if values[key] > ordinary]
    off += [key for key, _, ordinary in MOST if values[key] < ordinary]
    return f"{off[0]} {values[off[0]]:.3g}" if off else ""


def share_of_design(thing, schedules, left_out):
    """Of a ZoneVentilation's design flow that counts as a flow of all hours of its schedule."""
    name, slopes = f'{thing.kind} "{thing.name}"', " and ".join(key for key in SLOPES if thing.number(key, 0))
    control, constant = control_of(thing, schedules), thing.number("constant_term_coefficient", 1)
    if control:
        left_out.append(f"{name}: {control} keeps it off in ordinary conditions; {INSTEAD}")
    elif constant <= 0:
        left_out.append(f"{name}: flows by {slopes or 'nothing'}, without a constant part; {INSTEAD}")
    elif slopes:
        left_out.append(f"{slopes} of {name}; its constant part was taken")
    return 0 if control else max(constant, 0)


def units_of(model, zones, left_out):
    """[(zone, unit)] of heat recovery units, by the zones' lists of equipment."""
    equipment = idf_fans.equipment_of(model)
    found = [(zones[zone], unit) for unit in model.all(UNIT) for zone, names in equipment.items()
             if unit.name.lower() in names and zone in zones]
    served = {unit.name.lower() for _, unit in found}
    left_out += [f'{unit.kind} "{unit.name}": stands in no zone\'s ZoneHVAC:EquipmentList' for unit in model.all(UNIT)
                 if unit.name.lower() not in served]
    return found


def flow_of(unit, zone, people):
    """[m3/s] of a unit."""
    found = unit.number("ventilation_rate_per_unit_floor_area", PER_AREA, 0, 1) * zone.area + \
        unit.number("ventilation_rate_per_occupant", PER_PERSON, 0, 1) * people
    return unit.number("supply_air_flow_rate", found, 0, 1e4)


def effectiveness(model, unit, left_out):
    """Sensible, of a unit's heat exchanger at its full flow."""
    exchanger = model.find(unit.text("heat_exchanger_name"), EXCHANGER)
    if exchanger is None:
        left_out.append(f'heat recovery of {unit.kind} "{unit.name}", whose exchanger is no {EXCHANGER}; write '
                        "heat_recovery in the flow")
        return 0
    return exchanger.number(EFFECTIVENESS, 0, 0, 1)


def flows_of_units(model, zones, schedules, people, left_out):
    """[(zone, profile of a unit's flow [m3/h], its effectiveness)]"""
    return [(zone, 3600 * flow_of(unit, zone, people.get(zone.name, 0)) *
             (schedules.of(unit, "availability_schedule_name") + idf_schedules.constant(0)),
             effectiveness(model, unit, left_out)) for zone, unit in units_of(model, zones, left_out)]


def exchangers_of_units(model):
    """Names of those that are read with their unit."""
    return {unit.word("heat_exchanger_name") for unit in model.all(UNIT)}
