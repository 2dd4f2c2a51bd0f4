#!/usr/bin/python3
"""Loops on buildings of DOE that nobody described by hand: `new --idf` does, with and without an effect.

    bench_unseen_buildings.py [--folder DIR] [--only CASE ...]

The files are DOE's retail (rt), strip mall (sm), restaurants (qs, fr), warehouse (wh), small hotel (sh) and primary
school (ps) of the package pyenergyplus-lbnl, without light outdoors; the weather is that of ../shared/energyplus/
so_null. Readings are the room temperature, all gas and all electricity by EnergyPlus, with the noise of the cases
there. An effect is put into the file, the description does not know it; what begins on a day is the file without it
before that day. Prints what was found in each, its held-out errors by the hour of plain, before and after, and
`name value unit reference ratio`: effects of nulls, of which some are what EnergyPlus has and a description by
`new --idf` lacks (economizers, part-load curves, refrigerators), and cases named right. A case takes two to five
minutes. Needs EnergyPlus and pyenergyplus-lbnl (tests/energyplus/reports.py) and ../shared.
"""
import sys

import bench_energyplus_cases as made
import bench_idf_loads as loads    # also finds idf and reports
import numpy as np
import pandas

import reports    # noqa: E402

MODELS = {"rt": "Stand-aloneRetail", "sm": "StripMall", "qs": "QuickServiceRestaurant", "fr": "FullServiceRestaurant",
          "wh": "Warehouse", "sh": "SmallHotel", "ps": "PrimarySchool"}
CASE_OF_WEATHER = "so_null"
METERS = {"gas_kWh": ("NaturalGas:Facility",), "elec_kWh": ("Electricity:Facility",)}
OUTDOORS = "Exterior:Lights"
COLDER = made.schedule("HTGSETP_SCH", made.raised(0, 24, -1.5))
CASES = {**{f"{building}_null": made.Case() for building in MODELS},
         "rt_lights": made.Case(made.scaled("Lights", [5, 6, 7], 0.65), "04-10", names=made.LIGHTS),
         "rt_colder": made.Case(COLDER, "11-01", names=("heating set-point changed",)),
         "sm_plug": made.Case(made.scaled("ElectricEquipment", [5, 6, 7], 1.5), made.JUNE,
                              names=("equipment added or removed", "tenants move in or out")),
         "sm_boiler": made.Case(made.scaled("Coil:Heating:Fuel", [4], 0.8), "02-01",
                                names=("new or serviced boiler",)),
         "ps_lights": made.Case(made.scaled("Lights", [5, 6, 7], 0.65), "04-10", names=made.LIGHTS),
         "sh_leaks": made.Case(made.scaled("ZoneInfiltration:DesignFlowRate", [5, 6, 7, 8], 0.4), "10-01",
                               names=("leaks sealed or opened",))}


def simulated(energyplus, model, folder):
    """[(year, {column: hours})] of both years."""
    return [(year, loads.measured_in(run, METERS))
            for year, run in loads.metered_years(energyplus, CASE_OF_WEATHER, model, folder, METERS)]


def write_case(energyplus, name, effect, folder):
    """The building's file as its description knows it, and readings with the effect."""
    source = reports.file_like(energyplus, f"RefBldg{MODELS[name[:2]]}New2004_Chicago.idf")
    if source is None:
        print(f"skipped: {reports.HOW}")
        sys.exit(loads.SKIPPED)
    plain, changed = folder / "model.idf", folder / "changed.idf"
    plain.write_text(reports.with_objects(source, [], OUTDOORS))
    objects = made.objects_of(plain.read_text())
    changed.write_text(made.text_of(effect.change(objects)) if effect.change else plain.read_text())
    years = simulated(energyplus, changed, folder / "with")
    if effect.since:
        years = made.begun_on(effect.since, years, simulated(energyplus, plain, folder / "without"))
    dice = np.random.default_rng([loads.NOISE_SEED, *name.encode()])
    loads.write_table(folder / "readings.csv", pandas.concat([loads.noisy_table(*year, dice) for year in years]))


def errors_in_words(loop):
    return "; ".join(f"{row.channel} {' '.join(f'{error:.3g}' for error in row.error)}"
                     for row in loop.judged_errors() if row.resolution == "hourly")


def main():
    energyplus, names, made_in = loads.asked(__doc__, CASES, "unseen_buildings")
    of_nulls, right = {}, {}
    for name in names:
        folder = made_in / name
        folder.mkdir(parents=True, exist_ok=True)
        if not (folder / "readings.csv").exists():
            write_case(energyplus, name, CASES[name], folder)
        loop = loads.loop_of_file(folder / "job.toml", folder / "model.idf", folder / "readings.csv",
                                  (loads.ROOM, *METERS), CASE_OF_WEATHER)
        found = [effect.name for effect in loop.effects]
        if CASES[name].names:
            right[name] = any(one in CASES[name].names for one in found)
        else:
            of_nulls[name] = len(found)
        print(f"# {name}: {', '.join(found) or 'nothing'}; {errors_in_words(loop)}", flush=True)
    print(f"unseen_buildings_effects_of_nulls {sum(of_nulls.values())} of_{len(of_nulls)} 0 -")
    print(f"unseen_buildings_named_right {sum(right.values())} of_{len(right)} - -")
    return 0


if __name__ == "__main__":
    sys.exit(main())
