"""What is added to a model so that hourly series reach it: Schedule:File, and schedules that a program changes.

A series is a column of one CSV file for a calendar year. A changed schedule is a Schedule:Constant that an
EnergyManagementSystem:Program sets to (own value + sums) x factors in each time step, where own value is the schedule
that stood in its place: holidays, seasons and summer time stay those of the model. Design days see no series: what a
building does sizes no plant. Source: EnergyPlus, Application Guide for EMS. Leaves out design days of other types than
SummerDesignDay and WinterDesignDay, which see the series of their date.
"""
from dataclasses import dataclass, field

PREFIX = "bemcal"
SERIES_FILE = "effects_series.csv"
DECIMALS = 6                   # of a series
WORKED, LIMIT = "changed", "limit"   # variables of the program
MOST_LETTERS = 70              # of a name
BEFORE = "BeginZoneTimestepBeforeInitHeatBalance"   # schedules are read after it
IN_USE = f"{PREFIX}_in_use"     # schedule: 0 on design days
AFTER = "BeginZoneTimestepAfterInitHeatBalance"     # heat is added after it, from what the last step found
DEAD_BAND = 0.1                # K, least distance of a thermostat's two set-points
THERMOSTAT = "thermostatsetpoint:"
DUAL = "thermostatsetpoint:dualsetpoint"
_HEAT, _COOL = "heating_setpoint_temperature_schedule_name", "cooling_setpoint_temperature_schedule_name"
OTHER_SET_POINT = {_HEAT: _COOL, _COOL: _HEAT}


@dataclass
class Term:
    how: str                   # add or factor
    what: str                  # number, or name of a series


@dataclass
class Slot:
    """A field that names a schedule; `usual` holds where it is empty."""
    kind: str
    name: str
    fields: dict
    key: str
    usual: float = 1
    terms: list = field(default_factory=list)
    least: object = None       # number, below which the value is not let
    own: str = ""              # schedule that stood there
    made: str = ""             # that stands there afterwards
    value: str = ""            # its actuator


class Changes:
    """Of one model in one calendar year; `finish` writes them."""

    def __init__(self, model, n_hours):
        self.model, self.n_hours = model, n_hours
        self.series, self.slots, self.sensors, self.actuators = {}, {}, {}, {}
        self.names, self.lines_of_heat, self.lines_of_schedules = set(), [], []
        self.of_walls = ""         # series by which outer faces are warmed

    def new_name(self, said):
        """Letters, digits and underscores, as a program of EMS takes them; no other differs by case alone."""
        plain = "".join(letter if letter.isalnum() and letter.isascii() else "_" for letter in said)
        base = f"{PREFIX}_{plain.removeprefix(PREFIX + '_')[:MOST_LETTERS]}"
        name = next(each for each in (base, *(f"{base}_{k}" for k in range(2, 10000)))
                    if each.lower() not in self.names)
        self.names.add(name.lower())
        return name

    def add_series(self, said, values):
        """Name of a schedule with these values, one for each hour of the year."""
        name = self.new_name(said)
        self.series[name] = values
        self.model.add("Schedule:File", name, {
            "file_name": SERIES_FILE, "column_number": len(self.series), "rows_to_skip_at_top": 1,
            "number_of_hours_of_data": self.n_hours, "column_separator": "Comma", "interpolate_to_timestep": "No",
            "minutes_per_item": 60, "adjust_schedule_for_daylight_savings": "No"})
        return name

    def act(self, series):
        """Name of a schedule for a field, which follows a series but on design days."""
        name, value = self.set_schedule(f"{series} acts")
        self.lines_of_schedules.append(f"SET {value} = {self.in_program(series)}")
        return name

    def in_use(self):
        """Name of 0 on design days, else 1, in a program."""
        if self.model.find("Schedule:Compact", IN_USE) is None:
            rows = ("Through: 12/31", "For: SummerDesignDay WinterDesignDay", "Until: 24:00", 0,
                    "For: AllOtherDays", "Until: 24:00", 1)
            self.model.add("Schedule:Compact", IN_USE, {"data": [{"field": row} for row in rows]})
        return self.sensor("Schedule Value", IN_USE)

    def slot(self, kind, name, fields, key, usual=1.0):
        """The one of a field, made once."""
        return self.slots.setdefault((kind.lower(), name.lower(), key), Slot(kind, name, fields, key, usual))

    def sensor(self, variable, key):
        """Name under which a program reads an output."""
        known = self.sensors.get((variable, key.lower()))
        if known:
            return known
        name = self.new_name(f"{key} {variable}")
        self.model.add("EnergyManagementSystem:Sensor", name, {
            "output_variable_or_output_meter_index_key_name": key, "output_variable_or_output_meter_name": variable})
        self.sensors[variable, key.lower()] = name
        return name

    def actuator(self, component, kind, control):
        name = self.new_name(f"{component} {control.split()[-1]}")
        self.model.add("EnergyManagementSystem:Actuator", name, {
            "actuated_component_unique_name": component, "actuated_component_type": kind,
            "actuated_component_control_type": control})
        self.actuators[component.lower(), control] = name
        return name

    def add_line(self, line):
        """Of the program that adds heat."""
        self.lines_of_heat.append(line)

    def heat(self, zone, said, radiant):
        """Name of an actuator of heat [W] in a zone, of either sign; no meter sees it."""
        name = self.new_name(f"{said} {zone}")
        self.model.add("OtherEquipment", name, {
            "fuel_type": "None", "zone_or_zonelist_or_space_or_spacelist_name": zone,
            "schedule_name": self.always(), "design_level_calculation_method": "EquipmentLevel", "design_level": 0,
            "fraction_latent": 0, "fraction_radiant": radiant, "fraction_lost": 0})
        return self.actuator(name, "OtherEquipment", "Power Level")

    def always(self):
        name = f"{PREFIX}_always"
        if self.model.find("Schedule:Constant", name) is None:
            self.model.add("Schedule:Constant", name, {"hourly_value": 1})
        return name

    def set_schedule(self, said):
        """(name, actuator) of a schedule that a program sets."""
        name = self.new_name(said)
        self.model.add("Schedule:Constant", name, {"hourly_value": 0})
        return name, self.actuator(name, "Schedule:Constant", "Schedule Value")

    def follow(self, said, parts, times):
        """Name of a schedule that is a sum of sensors times another one."""
        name, value = self.set_schedule(said)
        sums = [f"SET {value} = {value} + {part}" for part in parts[1:]]
        self.lines_of_schedules += [f"SET {value} = {parts[0]}", *sums, f"SET {value} = {value} * {times}"]
        return name

    def in_program(self, series):
        return f"{self.sensor('Schedule Value', series)} * {self.in_use()}"

    def write_slots(self):
        """Lines of the program that changes schedules; fields that would follow the same one share it."""
        lines, made = [], {}
        for slot in self.slots.values():
            slot.own = slot.fields.get(slot.key)
        for slot in self.slots.values():
            known = made.setdefault(self.content(slot), slot)
            if known is slot:
                lines += self.lines_of(slot)
            slot.made, slot.value = known.made, known.value
            slot.fields[slot.key] = slot.made
        return lines

    def content(self, slot):
        """What its schedule follows from."""
        def of(one):
            return str(one.own).lower(), one.usual, one.least, tuple((term.how, term.what) for term in one.terms)
        other = self.other_set_point(slot)
        is_thermostat = slot.kind.lower().startswith(THERMOSTAT)
        return (of(slot), slot.key if is_thermostat else "", slot.own is None and slot.key,
                other and (of(other) if isinstance(other, Slot) else other.lower()))

    def lines_of(self, slot):
        slot.made = self.new_name(f"{slot.own or slot.name} changed")
        self.model.add("Schedule:Constant", slot.made, {"hourly_value": slot.usual})
        slot.value = self.actuator(slot.made, "Schedule:Constant", "Schedule Value")
        start = self.sensor("Schedule Value", slot.own) if slot.own else slot.usual
        lines = [f"SET {WORKED} = {start}"]
        for term in slot.terms:
            what = self.in_program(term.what) if term.what in self.series else term.what
            lines.append(f"SET {WORKED} = {WORKED} " + (f"+ {what}" if term.how == "add" else f"* (1 + {what})"))
        if slot.least is not None:
            lines.append(f"SET {WORKED} = @Max {WORKED} {slot.least}")
        lines += [*self.keep_apart(slot), f"SET {slot.value} = {WORKED}"]
        if slot.own and slot.kind.lower().startswith(THERMOSTAT):   # it reads 0 before the first step: `usual` holds
            lines = [f"IF {start} == 0", f"SET {slot.value} = Null", "ELSE", *lines, "ENDIF"]
        return lines

    def other_set_point(self, slot):
        """Of a thermostat with two: its Slot, or the name of its schedule; None of others."""
        key = OTHER_SET_POINT.get(slot.key)
        if slot.kind.lower() != DUAL or not slot.fields.get(key):
            return None
        return self.slots.get((slot.kind.lower(), slot.name.lower(), key)) or slot.fields[key]

    def keep_apart(self, slot):
        """A thermostat whose heating set-point is above that of cooling ends EnergyPlus: the changed one yields."""
        other = self.other_set_point(slot)
        if other is None or isinstance(other, Slot) and not other.value:
            return []              # it comes later, and then yields
        value = other.value if isinstance(other, Slot) else self.sensor("Schedule Value", other)
        sign, function = ("-", "@Min") if slot.key.startswith("heating") else ("+", "@Max")
        return [f"SET {LIMIT} = {value} {sign} {DEAD_BAND}", f"SET {WORKED} = {function} {WORKED} {LIMIT}"]

    def add_program(self, said, lines, point):
        if not lines:
            return
        name = self.new_name(said)
        self.model.add("EnergyManagementSystem:Program", name, {"lines": [{"program_line": line} for line in lines]})
        self.model.add("EnergyManagementSystem:ProgramCallingManager", f"{name}_call", {
            "energyplus_model_calling_point": point, "programs": [{"program_name": name}]})

    def finish(self):
        self.add_program("schedules", [*self.lines_of_schedules, *self.write_slots()], BEFORE)
        if self.lines_of_heat:
            self.add_program("heat", [f"IF {self.in_use()} == 0", "RETURN", "ENDIF", *self.lines_of_heat], AFTER)

    def write_series(self, folder):
        """The CSV file of all Schedule:File objects, beside the model."""
        if not self.series:
            return
        columns = [[repr(round(float(value), DECIMALS)) for value in values] for values in self.series.values()]
        with open(folder / SERIES_FILE, "w", encoding="utf-8") as file:
            file.write(",".join(self.series) + "\n")
            file.writelines(",".join(row) + "\n" for row in zip(*columns))
