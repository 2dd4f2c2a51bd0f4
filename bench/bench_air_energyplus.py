#!/usr/bin/python3
"""Air systems against EnergyPlus's coils, fans and terminals: the weeks of tests/energyplus/air_runs.py.

Usage: bench/bench_air_energyplus.py [--keep FOLDER] [RUN...]      (or: scripts/bench air_energyplus)

A run's report says what each zone asks for, its air, the weather, infiltration and people's vapour.
bemcal's `supply` makes coil and fan loads of them (air_system_hours.cpp), each zone with its own part of
the system. Its numbers are those of the model:

- flows: those that carry as much heat in bemcal, q = m c / 1200, with EnergyPlus's mass flow at the
  station's standard density and c of the run's mean room air;
- fan_power = flow x pressure / efficiency; fan_exponent so that half the flow takes what the curve says;
- bypass_factor from the states of the air before and after the coil, as rated or sized: the line through
  both meets saturation at the apparatus dew point;
- coil_enthalpy = rated capacity / mass flow, of DX coils; theta_supply of a unit of constant flow is the
  rated air behind coil and fan.

Nothing is fitted. What a zone asks for is what its supply air took, less what outdoor air brought. Loads
below LEAST_SHARE of a run's coil loads are compared with that. `known` once more takes from the report
what `supply` cannot know: the water that the rooms' air stores, and that the heat of a fan of constant
flow is a load of the room.
"""
import argparse
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "energyplus"))

import air_runs as model   # noqa: E402
import idf                 # noqa: E402

HOURS = pathlib.Path(os.environ.get("BEMCAL_BUILD", ROOT / "build" / "release")) / "bench" / "air_system_hours"
RHO_C = 1200                            # bemcal's air [J/(m3 K)]
VAPOUR = 2.501e6                        # [J/kg]
PEOPLE_VAPOUR = VAPOUR + 1860 * 24      # of steam at room temperature [J/kg]
RATED = (26.67, 19.44)                  # dry and wet bulb before a DX coil [degC]
CVRMSE, BIAS = 8, 3                     # asked [%]
LEAST_SHARE = 0.05                      # of a run's coil loads
TRUTH = {"cooling": "Cooling Coil Total Cooling Rate", "heating": "Heating Coil Heating Rate", "fan": "Fan Electricity Rate"}


def saturated(theta, pressure=101325.0):
    """[kg/kg] above 0 degC (Magnus)."""
    vapour = 611.2 * math.exp(17.62 * theta / (243.12 + theta))
    return 0.622 * vapour / (pressure - vapour)


def enthalpy(theta, w):
    return 1006 * theta + w * (VAPOUR + 1860 * theta)


def humidity(dry, wet):
    """[kg/kg] at a wet bulb."""
    return ((VAPOUR - 2326 * wet) * saturated(wet) - 1006 * (dry - wet)) / (VAPOUR + 1860 * dry - 4186 * wet)


def bypass(before, after):
    """From (temperature, humidity ratio) before and after a coil: bisection for the apparatus dew point."""
    (t_in, w_in), (t_out, w_out) = before, after
    slope = (w_in - w_out) / (t_in - t_out)
    low, high = -20.0, t_out
    while high - low > 1e-6:
        middle = (low + high) / 2
        if w_out - slope * (t_out - middle) > saturated(middle):   # the line is still above saturation
            low = middle
        else:
            high = middle
    return (t_out - high) / (t_in - high)


def rated_coil(density):
    """States before and after a DX coil."""
    t_in, w_in = RATED[0], humidity(*RATED)
    h_out = enthalpy(t_in, w_in) - model.CAPACITY_PER_FLOW / density
    # Sensible: at constant humidity; the rest is vapour.
    w_out = w_in - (1 - model.RATED_SENSIBLE) * model.CAPACITY_PER_FLOW / density / (VAPOUR + 1860 * t_in)
    t_out = (h_out - VAPOUR * w_out) / (1006 + 1860 * w_out)
    return (t_in, w_in), (t_out, w_out)


def water_coil(report):
    size = lambda what: report.size("Coil:Cooling:Water", f"Design Size Design {what}")   # noqa: E731
    return ((size("Inlet Air Temperature"), size("Inlet Air Humidity Ratio")),
            (size("Outlet Air Temperature"), size("Outlet Air Humidity Ratio")))


def standard_density(weather):
    """[kg/m3] at the station's height, 20 degC, dry."""
    elevation = float(weather.open().readline().split(",")[9])
    return 101325 * (1 - 2.25577e-5 * elevation) ** 5.2559 / (287 * 293.15)


def coil_and_fan(run, report, density, per_volume):
    """Numbers of the system that do not change from hour to hour."""
    is_dx = run.coil != "ChilledWater"
    before, after = rated_coil(density) if is_dx else water_coil(report)
    power = model.ZONE_FLOW * model.PRESSURE[run.variable] / model.FAN_EFFICIENCY
    q_design = model.ZONE_FLOW * per_volume
    half = sum(c * 0.5 ** k for k, c in enumerate(model.FAN_CURVE))
    return dict(variable=run.variable, is_moist=1, q_design=q_design, least_flow=model.LEAST_FLOW, fan_power=power,
                fan_exponent=math.log(half) / math.log(0.5), fan_heat=1, bypass_factor=bypass(before, after),
                coil_enthalpy=model.CAPACITY_PER_FLOW / density if is_dx else 0, economiser=run.economiser,
                heat_recovery=run.recovery, frost_limit=model.LEAST_EXHAUST,
                theta_supply=model.SUPPLY if run.variable else after[0] + power / (RHO_C * q_design))


class Hours:
    """A run's report as hours of air systems, the zones one after the other."""

    def __init__(self, run, report, density):
        self.run, self.report = run, report
        w = self.of_zones("Zone Air Humidity Ratio")
        self.step_w = w.reshape(-1, model.STEPS)[:, -1].reshape(run.zones, -1)   # at the hours' ends
        self.rho = RHO_C / (1006 + 1860 * w.mean())                        # dry air that carries RHO_C [kg/m3]
        self.per_volume = density / self.rho
        self.numbers = coil_and_fan(run, report, density, self.per_volume) | self.weather() | self.zones()
        if run.reset:
            cold = (model.RESET_NONE - self.numbers["theta_e"]) / (model.RESET_NONE - model.RESET_FULL)
            self.numbers["theta_supply"] = model.SUPPLY + model.RESET_BY * np.clip(cold, 0, 1)
        self.ask()

    def of_zones(self, name):
        return np.concatenate([self.report.hours(name, f"ROOM {k + 1}") for k in range(self.run.zones)])

    def weather(self):
        of = lambda name: np.tile(self.report.hours(name, "Environment"), self.run.zones)   # noqa: E731
        return dict(theta_e=of("Site Outdoor Air Drybulb Temperature"), w_e=of("Site Outdoor Air Humidity Ratio"),
                    pressure=of("Site Outdoor Air Barometric Pressure"))

    def zones(self):
        theta_air = self.of_zones("Zone Mean Air Temperature")
        clock = np.arange(len(theta_air)) % 24
        on = (clock >= model.FAN_HOURS[0]) & (clock < model.FAN_HOURS[1])
        q_e = on * model.ZONE_OUTDOOR * self.per_volume
        if self.run.fan_cycles:      # and brings outdoor air while it runs
            on = on & False
            q_e = np.array(self.report.hours("Air System Outdoor Air Mass Flow Rate")) / self.rho
        return dict(theta_air=theta_air, available=on, q_e=q_e,
                    q_inf=self.of_zones("Zone Infiltration Mass Flow Rate") / self.rho,
                    moisture=self.of_zones("Zone People Latent Gain Rate") / PEOPLE_VAPOUR)

    def ask(self):
        hour = self.numbers
        taken = -self.of_zones("Zone Air Heat Balance System Air Transfer Rate")
        net = taken - RHO_C * hour["q_e"] * (1 - self.run.recovery) * (hour["theta_air"] - hour["theta_e"])
        hour.update(heating=np.maximum(-net, 0), cooling=np.maximum(net, 0))

    def know(self):
        if not self.run.variable:
            hour = self.numbers
            net = hour["cooling"] - hour["heating"] + np.array(self.report.hours(TRUTH["fan"]))
            hour.update(fan_heat=0, heating=np.maximum(-net, 0), cooling=np.maximum(net, 0))
        volume = model.AREA * model.HEIGHT
        self.numbers["moisture"] = self.numbers["moisture"] - (
            self.rho * volume / 3600 * np.diff(self.step_w, axis=1, prepend=self.step_w[:, :1])).ravel()

    def loads(self):
        """{heating, cooling, fan}: [W] of all zones, each hour."""
        n = len(self.numbers["theta_air"])
        rows = np.column_stack([np.broadcast_to(np.asarray(values, dtype=float), n) for values in self.numbers.values()])
        text = ",".join(self.numbers) + "\n" + "".join(",".join(f"{x:.12g}" for x in row) + "\n" for row in rows)
        done = subprocess.run([HOURS], input=text, capture_output=True, text=True, check=True)
        names, *lines = done.stdout.split()
        table = np.array([line.split(",") for line in lines], dtype=float).reshape(self.run.zones, -1, 3).sum(axis=0)
        return dict(zip(names.split(","), table.T))


def errors(loads, report):
    """{load: (sum in kWh, CV(RMSE) in %, error of the sum in %)}."""
    true = {name: np.array(report.hours(variable)) for name, variable in TRUTH.items()}
    least = LEAST_SHARE * (true["cooling"].mean() + true["heating"].mean())
    found = {}
    for name, load in true.items():
        off, mean = loads[name] - load, max(load.mean(), least)
        found[name] = load.sum() / 1000, 100 * math.sqrt((off ** 2).mean()) / mean, 100 * off.mean() / mean
    return found


def compare(run, energyplus, folder):
    """Errors of a run, and those with more known."""
    weather, = (energyplus.parent / "WeatherData").glob(f"*{run.station}*.epw")
    report = idf.run(energyplus, model.objects(run), model.AMENDED, weather, folder)
    hours = Hours(run, report, standard_density(weather))
    found = errors(hours.loads(), report)
    hours.know()
    return found, errors(hours.loads(), report)


def show(name, cv, bias):
    print(f"{name}_cvrmse {cv:.1f} % {CVRMSE} {cv / CVRMSE:.2f}")
    print(f"{name}_sum {bias:.1f} % {BIAS} {abs(bias) / BIAS:.2f}")


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    options.add_argument("--keep", type=pathlib.Path, help="folder for EnergyPlus's files")
    options.add_argument("runs", nargs="*")
    given = options.parse_args()
    energyplus = idf.program()
    if energyplus is None:
        print(idf.HOW)
        sys.exit(77)
    with tempfile.TemporaryDirectory() as scratch:
        for run in model.RUNS:
            if given.runs and run.name not in given.runs:
                continue
            found, of_known = compare(run, energyplus, (given.keep or pathlib.Path(scratch)) / run.name)
            for load, (kilowatt_hours, cv, bias) in found.items():
                print(f"{run.name}_{load} {kilowatt_hours:.0f} kWh - -")
                show(f"{run.name}_{load}", cv, bias)
            for load in ("cooling", "heating"):
                show(f"{run.name}_{load}_known", *of_known[load][1:])


if __name__ == "__main__":
    main()
