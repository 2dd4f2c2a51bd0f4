#!/usr/bin/python3
"""Loops on buildings that EnergyPlus simulates with an effect that their description does not know.

    bench_energyplus_cases.py [--folder DIR] [--only CASE ...]

The files are DOE's small office (so), medium office (mo) and mid-rise apartments (ap), of the package pyenergyplus-
lbnl beside EnergyPlus; the descriptions by hand and the weather are those of ../shared/energyplus/so_null, mo_null
and ap_null. An effect is put into the file, both years are simulated, noise is that of the cases there. What begins
on a day is the file without it before that day and the file with it after, and so is what comes every summer. No case
of ../shared is among them.
Prints what was found in each and `name value unit reference ratio`: cases named right, false names, and the geometric
mean over energies of the hourly held-out error of `after` over that of `before` (no effect accepted).
"""
import json
import re
import shutil
import sys
from dataclasses import dataclass

import bench_idf_loads as loads
import h5py
import large_job
import numpy as np
import pandas

import reports    # noqa: E402  (found by bench_idf_loads)
from report import result as stored  # noqa: E402

NULL = {"so": "so_null", "mo": "mo_null", "ap": "ap_null"}
MODELS = loads.MODELS | {"mo_null": "RefBldgMediumOfficeNew2004_Chicago.idf"}
JUNE, SEPTEMBER = "06-01", "09-01"
OF_USE = ": use"        # ends the name of the half of an effect that acts on use
GAS_OF_APARTMENTS = ("Heating:NaturalGas", "WaterSystems:NaturalGas")   # as their description: hot water, too
SLAB = "ext-slab"       # of the ground floor
# Name, roughness, resistance [m2 K/W] of 1.2 m of clay (ISO 13370). Without mass: a run warms up on one day alone.
SOIL = ("Material:NoMass", "soil", "Rough", f"{1.2 / 1.5}")
ECONOMIZER = 8          # field of its control type
FIRST_GROUND = 6        # field of the monthly temperatures of the first depth


def objects_of(text):
    """[[class, field, ...]] of a file's text."""
    bare = "\n".join(line.partition("!")[0] for line in text.splitlines())
    return [[field.strip() for field in each.split(",")] for each in bare.split(";") if each.strip()]


def text_of(objects):
    return "".join(",\n  ".join(fields) + ";\n" for fields in objects)


def is_a(fields, kind):
    return fields[0].lower() == kind.lower()


def scaled(kind, places, factor):
    """Numbers of a class, by their place, times a factor."""
    def change(objects):
        for fields in objects:
            for place in places if is_a(fields, kind) else ():
                if place < len(fields) and re.fullmatch(r"[-\d.eE+]+", fields[place]):
                    fields[place] = f"{float(fields[place]) * factor:.6g}"
        return objects
    return change


def days_of(fields):
    """[(days, [24 values])] of a Schedule:Compact of a whole year; nothing of others."""
    blocks = []
    for field, value in zip(fields[3:], [*fields[4:], ""]):
        if field.lower().startswith("through") and "12/31" not in field:
            return []
        if field.lower().startswith("for"):
            blocks.append((field, []))
        elif field.lower().startswith("until"):
            until = int(re.search(r"(\d+):", field)[1])
            hours = blocks[-1][1]
            hours += [float(value)] * (until - len(hours))
    return blocks


def schedule(pattern, new_hours):
    """Whole-year schedules whose name fits; `new_hours(days, hours, others)` gives the hours of a block."""
    def change(objects):
        for fields in objects:
            if not is_a(fields, "Schedule:Compact") or not re.fullmatch(pattern, fields[1], re.I):
                continue
            blocks = days_of(fields)
            made = [fields[0], fields[1], fields[2], "Through: 12/31"]
            for days, hours in blocks:
                made.append(days)
                for k, value in enumerate(new_hours(days, hours, dict(blocks))):
                    made += [f"Until: {k + 1:02d}:00", f"{value:.6g}"]
            if blocks:
                fields[:] = made
        return objects
    return change


def raised(first, last, size):
    return lambda days, hours, _: [value + size * (first <= k < last) for k, value in enumerate(hours)]


def more(first, last, size):
    """As raised, of a share, which is 1 at most."""
    return lambda days, hours, _: [min(value + size * (first <= k < last), 1) for k, value in enumerate(hours)]


def at_least(first, last, size):
    """No less in these hours of days that have any."""
    return lambda days, hours, _: [max(value, size * (max(hours) > 0) * (first <= k < last))
                                   for k, value in enumerate(hours)]


def later(by):
    return lambda days, hours, _: hours[-by:] + hours[:-by]


def saturday_as_monday(days, hours, others):
    monday = next(those for kind, those in others.items() if "weekdays" in kind.lower())
    return monday if "saturday" in days.lower() else hours


def earlier(by):
    """Begins so many hours before."""
    return lambda days, hours, _: [max(hours[k:k + by + 1]) for k in range(24)]


def as_weekdays(days, hours, others):
    """On all days that are not named."""
    monday = next(those for kind, those in others.items() if "weekdays" in kind.lower())
    return monday if "allotherdays" in days.lower() else hours


def closed(pattern, before, last):
    """Whole-year schedules whose name fits, as on days that are not named from the day after one to another."""
    def change(objects):
        for fields in objects:
            if is_a(fields, "Schedule:Compact") and re.fullmatch(pattern, fields[1], re.I):
                usual = fields[4:]
                others = usual[next(k for k, field in enumerate(usual) if "allotherdays" in field.lower()) + 1:]
                fields[3:] = [f"Through: {before}", *usual, f"Through: {last}", "For: AllDays", *others,
                              "Through: 12/31", *usual]
        return objects
    return change


def blinds(least_sun):
    """White ones indoors, let down where the sun on a window [W/m2] is more."""
    def change(objects):
        rooms = {fields[1].lower(): fields[4] for fields in objects if is_a(fields, "BuildingSurface:Detailed")}
        panes = {}
        for fields in objects:
            if is_a(fields, "FenestrationSurface:Detailed") and fields[2].lower() == "window":
                panes.setdefault(rooms[fields[4].lower()], []).append(fields[1])
        shade = ["WindowMaterial:Shade", "bench blind", "0.1", "0.6", "0.1", "0.6", "0.9", "0", "0.005", "0.1", "0.05",
                 "0.5", "0.5", "0.5", "0.5", "0"]
        return [*objects, shade, *(
            ["WindowShadingControl", f"bench blinds {room}", room, "1", "InteriorShade", "", "OnIfHighSolarOnWindow",
             "", f"{least_sun}", "No", "No", "bench blind", "FixedSlatAngle", "", "", "", "Group", *of_room]
            for room, of_room in panes.items())]
    return change


def economised(objects):
    for fields in objects:
        if is_a(fields, "Controller:OutdoorAir"):
            fields[ECONOMIZER] = "DifferentialDryBulb"
    return objects


def vented(schedule_hours, least_room, flow):
    """Air through windows where the room is warmer than outdoors and than a limit."""
    def change(objects):
        first, last = schedule_hours
        inside = [first <= k < last if first < last else k >= first or k < last for k in range(24)]
        made = ["Schedule:Compact", "bench venting", "Fraction", "Through: 12/31", "For: AllDays"]
        for k, is_open in enumerate(inside):
            made += [f"Until: {k + 1:02d}:00", "1" if is_open else "0"]
        zones = [fields[2] for fields in objects if is_a(fields, "People")]
        return [*objects, made, *(["ZoneVentilation:DesignFlowRate", f"bench venting {zone}", zone, "bench venting",
                                   "AirChanges/Hour", "", "", "", f"{flow}", "Natural", "0", "1", "1", "0", "0", "0",
                                   f"{least_room}", "", "100", "", "1"] for zone in zones)]
    return change


def by_wind(objects):
    """Infiltration by wind alone, as much as before at 4 m/s."""
    for fields in objects:
        if is_a(fields, "ZoneInfiltration:DesignFlowRate"):
            fields[9:13] = ["0", "0", "0.25", "0"]
    return objects


@dataclass(frozen=True)
class Case:
    """`since`: month and day of the first year from which it holds; `every`: the first month and day on which it holds,
    and the first on which it does not, of both years; `meter`: (column, factor) of a meter alone."""
    change: object = None
    since: str = ""
    every: tuple = ()
    meter: tuple = ()
    names: tuple = ()


USE = "BLDG_(OCC|LIGHT|EQUIP)_SCH"
LIGHTS = ("lights replaced",)
WIND = ("wind infiltration", "infiltration by strong wind", "wind in leaks")
SATURDAY = ("people work on Saturdays", "Saturdays worked", "other hours than declared", "Saturday mornings worked")
BLINDS = ("blinds",)
NIGHT_AIR = ("night purge", "outdoor air at night", "windows opened in warm rooms")
CASES = {
    "so_effstep": Case(scaled("Coil:Heating:Fuel", [4], 0.8), "02-01", names=("new or serviced boiler",)),
    "so_meterstep": Case(meter=("elec_kWh", 1.12), since=SEPTEMBER, names=("step of a meter",)),
    "so_thermo": Case(schedule("HTGSETP_SCH", raised(15, 22, 1.5)), names=("heating set-point of some hours",)),
    "so_wind": Case(by_wind, names=WIND),
    "so_windows": Case(vented((7, 19), 23, 3), names=("windows opened in warm rooms", "windows opened while occupied",
                                                      "economiser")),
    "so_saturday": Case(schedule(USE, saturday_as_monday), names=SATURDAY),
    "so_late": Case(schedule(USE, later(2)), names=("use earlier or later", "schedules earlier or later",
                                                    "other hours than declared")),
    "so_copstep": Case(scaled("Coil:Cooling:DX:SingleSpeed", [5], 0.75), "07-01", names=("new or serviced chiller",)),
    "so_coolset": Case(schedule("CLGSETP_SCH", raised(12, 18, -1.5)), names=("cooling set-point of some hours",)),
    "so_leaks": Case(scaled("ZoneInfiltration:DesignFlowRate", [5, 6, 7, 8], 0.4), "10-01",
                     names=("leaks sealed or opened",)),
    "so_nights": Case(schedule("BLDG_EQUIP_SCH", more(0, 6, 0.3)), names=("use at night",)),
    "so_fans": Case(schedule("HVACOperationSchd", at_least(22, 24, 1)),
                    names=("plant runs on after hours", "other hours than declared")),
    "so_film": Case(scaled("WindowMaterial:SimpleGlazingSystem", [3], 0.5), "05-01",
                    names=("film on windows", "retrofit of windows")),
    "so_lights": Case(scaled("Lights", [5, 6, 7], 0.6), "03-15", names=LIGHTS),
    "so_early": Case(schedule("HTGSETP_SCH|HVACOperationSchd", earlier(3)),
                     names=("early start", "other hours than declared", "heating set-point of some hours")),
    "so_sundays": Case(schedule("(HTG|CLG)SETP_SCH|HVACOperationSchd", as_weekdays),
                       names=("plant runs at weekends as on weekdays", "other hours than declared")),
    "so_colder": Case(schedule("HTGSETP_SCH", raised(0, 24, -1.5)), "11-01", names=("heating set-point changed",)),
    "so_air": Case(scaled("DesignSpecification:OutdoorAir", [3, 4, 5, 6], 1.8), "02-15",
                   names=("air flow of fans changed",)),
    "so_august": Case(closed(USE, "7/31", "8/21"), names=("holidays with the plant running",)),
    "mo_setback": Case(schedule("HTGSETP_SCH", raised(0, 5, 3)),
                       names=("no set-back at night", "heating set-point of some hours")),
    "mo_lights": Case(scaled("Lights", [5, 6, 7], 0.6), "03-15", names=LIGHTS),
    "mo_leaks": Case(scaled("ZoneInfiltration:DesignFlowRate", [5, 6, 7, 8], 2.5), "10-01",
                     names=("leaks sealed or opened",)),
    "mo_economiser": Case(economised, names=("economiser", "economiser of the air system")),
    "mo_nights": Case(schedule("BLDG_EQUIP_SCH", more(0, 6, 0.3)), names=("use at night",)),
    "mo_wind": Case(by_wind, names=WIND),
    "mo_plugstep": Case(scaled("ElectricEquipment", [5, 6, 7], 1.35), JUNE, names=("tenants move in or out",)),
    "mo_saturday": Case(schedule(USE, saturday_as_monday), names=SATURDAY),
    "mo_coolset": Case(schedule("CLGSETP_SCH", raised(12, 18, -1.5)), names=("cooling set-point of some hours",)),
    "mo_copstep": Case(scaled("Coil:Cooling:DX:TwoSpeed", [5, 19], 0.75), "07-01", names=("new or serviced chiller",)),
    "ap_leaks": Case(scaled("ZoneInfiltration:DesignFlowRate", [5, 6, 7, 8], 0.4), "10-01",
                     names=("leaks sealed or opened",)),
    "ap_setback": Case(schedule("APT_HTGSETP_SCH", raised(0, 6, -2)),
                       names=("heating set-point of some hours", "no set-back at night")),
    "ap_meterstep": Case(meter=("gas_kWh", 0.88), since="02-15", names=("step of a meter", "new or serviced boiler")),
    "ap_plugstep": Case(scaled("ElectricEquipment", [5, 6, 7], 1.4), JUNE, names=("tenants move in or out",)),
    "ap_copstep": Case(scaled("Coil:Cooling:DX:SingleSpeed", [5], 0.75), "07-01", names=("new or serviced chiller",)),
    "ap_dayset": Case(schedule("APT_HTGSETP_SCH", raised(9, 16, 2)), names=("heating set-point of some hours",)),
    "ap_lights": Case(scaled("Lights", [5, 6, 7], 2), "10-15", names=LIGHTS),
    "ap_nights": Case(schedule("APT_EQP_SCH", more(0, 6, 0.4)), names=("use at night",)),
    "ap_wind": Case(by_wind, names=WIND),
    "ap_windows": Case(vented((0, 24), 24, 2), names=("windows opened in warm rooms", "windows opened while occupied")),
    "ap_coolset": Case(schedule("APT_CLGSETP_SCH", raised(18, 24, -1.5)), names=("cooling set-point of some hours",)),
    "so_shift": Case(schedule(".*", later(1)), names=("schedules earlier or later", "other hours than declared")),
    "so_blinds": Case(blinds(150), names=BLINDS),
    "so_nightair": Case(vented((22, 6), 20, 3), names=NIGHT_AIR),
    "mo_satfull": Case(schedule(f"{USE}|(HTG|CLG)SETP_SCH|HVACOperationSchd|MinOA.*", saturday_as_monday),
                       names=SATURDAY),
    "mo_blinds": Case(blinds(150), names=BLINDS),
    "mo_nightair": Case(vented((22, 6), 20, 3), names=NIGHT_AIR),
    "ap_summertime": Case(schedule(".*", later(-1)), every=("03-26", "10-29"), names=("summer time not applied",)),
    "ap_nightair": Case(vented((22, 6), 20, 3), names=NIGHT_AIR),
}


def on_soil(objects, weather):
    """The ground floor on what the description says, over the first depth of the weather file's ground; no economiser,
    which the medium office's file has, and its description has not."""
    line = next(line for line in weather.read_text().splitlines() if line.startswith("GROUND TEMPERATURES"))
    months = line.split(",")[FIRST_GROUND:FIRST_GROUND + 12]
    rest = [list(fields) for fields in objects if not is_a(fields, "Site:GroundTemperature:BuildingSurface")]
    for fields in rest:
        if is_a(fields, "Construction") and fields[1].lower() == SLAB:
            fields.insert(2, SOIL[1])
        if is_a(fields, "Controller:OutdoorAir"):
            fields[ECONOMIZER] = "NoEconomizer"
    return [*rest, ["Site:GroundTemperature:BuildingSurface", *months], list(SOIL)]


def hour_of(year, day):
    """The first one of a month and day ("06-01")."""
    return (pandas.Timestamp(f"{year}-{day}") - pandas.Timestamp(f"{year}-01-01")).days * 24


def within(begin, end, this, without):
    """(year, hours) of this from one hour to another, and without the effect else."""
    year, hours = this
    holds = np.zeros(len(next(iter(hours.values()))), bool)
    holds[begin:end] = True
    return year, {column: np.where(holds, values, without[1][column]) for column, values in hours.items()}


def at_times(effect, years, without):
    """Both years with the effect where it holds."""
    if effect.every:
        return [within(*(hour_of(year[0], day) for day in effect.every), year, usual)
                for year, usual in zip(years, without)]
    begin = hour_of(years[0][0], effect.since)
    return [within(begin, None, years[0], without[0]), *years[1:]]


def with_effect(energyplus, case, effect, folder):
    """Both years, with the effect from its day on."""
    source = reports.file_like(energyplus, MODELS[NULL[case[:2]]])
    if source is None:
        print(f"skipped: {reports.HOW}")
        sys.exit(loads.SKIPPED)
    plain = folder.parent / f"{case[:2]}.idf"
    weather = loads.CASES / NULL[case[:2]] / "weather_train.epw"
    plain.write_text(text_of(on_soil(objects_of(source.read_text(errors="replace")), weather)))
    energies = loads.ENERGIES | ({"gas_kWh": GAS_OF_APARTMENTS} if case.startswith("ap") else {})
    years = without = None
    if effect.since or effect.every or effect.meter:
        without = list(loads.years(energyplus, NULL[case[:2]], plain, folder / "without", energies))
    if effect.change:
        changed = folder / "changed.idf"
        changed.write_text(text_of(effect.change(objects_of(plain.read_text()))))
        years = list(loads.years(energyplus, NULL[case[:2]], changed, folder / "with", energies))
    else:
        column, factor = effect.meter
        years = [(year, {**hours, column: factor * hours[column]}) for year, hours in without]
    return at_times(effect, years, without) if effect.since or effect.every else years


def write_case(case, years, folder):
    """A folder as scripts/run_case takes it."""
    null, dice = loads.CASES / NULL[case[:2]], np.random.default_rng([loads.NOISE_SEED, *case.encode()])
    for name in ("building.json", *(f"weather_{part}.epw" for part in loads.PARTS)):
        shutil.copyfile(null / name, folder / name)
    for (year, hours), name in zip(years, ("measured.csv", "measured_test.csv")):
        loads.write_table(folder / name, loads.noisy_table(year, hours, dice))


def score(folder, effect):
    """(names that are right, others, geometric mean of after over before)"""
    found = [one["name"].removesuffix(OF_USE) for one in json.loads((folder / "out" / "effects.json").read_text())]
    with h5py.File(folder / "out" / "result.h5") as file:
        structure = [one.name for one in stored.Loop(file, f"{folder.name}/loop").refinements]
    right = [name for name in found + structure if name in effect.names]
    measured = pandas.read_csv(folder / "measured_test.csv", index_col=0)
    before, after = (pandas.read_csv(folder / "out" / f"{which}.csv", index_col=0) for which in ("before", "after"))
    ratios = [loads.error(after[column], measured[column], "kWh") / loads.error(before[column], measured[column], "kWh")
              for column in measured if column != loads.ROOM]
    return right, [name for name in found if name not in right], float(np.exp(np.mean(np.log(ratios))))


def main():
    energyplus, names, made_in = loads.asked(__doc__, CASES, "energyplus_cases")
    scores = {}
    for case in names:
        folder = made_in / case
        folder.mkdir(parents=True, exist_ok=True)
        if not (folder / "measured_test.csv").exists():
            write_case(case, with_effect(energyplus, case, CASES[case], folder), folder)
        loads.run(large_job.ROOT / "scripts" / "run_case", folder, folder / "out", "--ranks", 1, "--force")
        right, others, ratio = scores[case] = score(folder, CASES[case])
        print(f"# {case}: right: {', '.join(right) or '-'}; others: {', '.join(others) or '-'}; "
              f"after / before {ratio:.2f}", flush=True)
    n_right = sum(bool(right) for right, _, _ in scores.values())
    n_false = sum(len(others) for _, others, _ in scores.values())
    mean = float(np.exp(np.mean([np.log(ratio) for _, _, ratio in scores.values()])))
    print(f"energyplus_cases_right {n_right} of {len(scores)} 0.8 {n_right / len(scores) / 0.8:.2f}")
    print(f"energyplus_cases_false {n_false} effects 0 {n_false / len(scores):.2f}")
    print(f"energyplus_cases_after_over_before {mean:.3f} - 1 {mean:.3f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
