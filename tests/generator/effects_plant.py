"""Effects of controls, plant and meters."""
import numpy as np

from effect import NO_HANDLER, Effect, days_of_year, run_plant, scale_meter, stepped


def _weekend_setback_missing(d, office, size):
    on = ~d.open_day & (d.hour >= 7) & (d.hour < 19)
    d.heating_set[on] += size * (office.heating_set - d.heating_set[on])
    d.cooling_set[on] += size * (office.cooling_set - d.cooling_set[on])


def _early_start(d, office, size):
    run_plant(d, office, d.open_day & (d.hour >= 7 - size) & (d.hour < 7))


def _heating_drift(d, office, size):
    d.heating_set += size * np.clip(d.years, 0, None)


def _heating_curve(d, office, size):
    d.heating_set += size * (10 - d.theta_e)


def _summer_set_point(d, office, size):
    d.cooling_set[(d.theta_e > 27) & (d.cooling_set < office.cooling_set + 1)] -= size


def _cooling_locked(d, office, size):
    d.cooling_on[days_of_year(d, 335, int(size))] = 0


def _heating_locked(d, office, size):
    d.heating_on[days_of_year(d, int(size), 310)] = 0


def _demand_response(d, office, size):
    d.cooling_set[days_of_year(d, 151, 273) & (d.hour >= 14) & (d.hour < 18)] += size


def _reheat(d, office, size):
    d.reheat = size


def _part_load(d, office, size):
    d.part_load_loss = size


def _cop_temperature(d, office, size):
    d.cop_slope = size


def _degraded_cop(d, office, size):
    d.cop_factor *= 1 - size * np.maximum(d.elapsed, 0)


def _degraded_boiler(d, office, size):
    d.efficiency_factor *= 1 - size * np.maximum(d.elapsed, 0)


def _latent_load(d, office, size):
    d.latent_share = size


def _standing_losses(d, office, size):
    d.gas_use += size * office.floor_area


def _hot_water(d, office, size):
    d.gas_use[(d.hour >= 18) & (d.hour < 21)] += size * office.floor_area


def _meter_late(d, office, size):
    d.hours_late = round(size)


def step_of(meter):
    def apply(d, office, size):
        scale_meter(d, meter, np.where(stepped(d), 1 + size, 1.0))
    return apply


def meter_step(meter, needs=""):
    return Effect(f"{meter} meter scaled from a day of the first year on", 0.15, "-",
                  step_of(meter), 0.1, 0.3, True, needs)


EFFECTS = {
    "weekend_setback_missing": Effect("weekday set-points on days off, as a share", 1.0, "-",
                                      _weekend_setback_missing, 0.5, 1),
    "early_start": Effect("plant starts before the hour that is declared", 2.0, "h",
                          _early_start, 1, 4),
    "heating_drift": Effect("heating set-point that rises every year", 1.0, "K/a",
                            _heating_drift, 0.5, 2, True),
    "heating_curve": Effect("heating set-point higher the colder it is", 0.05, "K/K",
                            _heating_curve, 0.02, 0.1),
    "summer_set_point": Effect("cooling set-point lowered on hot days", 1.0, "K",
                               _summer_set_point, 0.5, 2),
    "cooling_locked": Effect("no cooling before this day of the year and in December", 80.0, "d",
                             _cooling_locked, 60, 130),
    "heating_locked": Effect("no heating from this day of the year until 6 November", 110.0, "d",
                             _heating_locked, 75, 110),
    "demand_response": Effect("cooling set-point raised on summer afternoons", 2.0, "K",
                              _demand_response, 1, 3),
    "reheat": Effect("air cooled and heated again: heating as a share of cooling", 0.2, "-",
                     _reheat, 0.1, 0.4, needs=NO_HANDLER),
    "part_load": Effect("boiler less efficient at small loads", 0.25, "-", _part_load, 0.1, 0.4,
                        needs="boiler"),
    "cop_temperature": Effect("cooling COP that falls with the outdoor temperature", 0.02, "1/K",
                              _cop_temperature, 0.012, 0.03),
    "degraded_cop": Effect("cooling COP lost by the end of the period", 0.2, "-", _degraded_cop,
                           0.14, 0.4),
    "degraded_boiler": Effect("boiler efficiency lost by the end of the period", 0.2, "-",
                              _degraded_boiler, 0.14, 0.4, needs="boiler"),
    "latent_load": Effect("the coil dries the fresh air: share of the moisture removed", 0.8,
                          "-", _latent_load, 0.4, 1, needs=NO_HANDLER),
    "standing_losses": Effect("gas that burns at all hours", 2.0, "W/m2", _standing_losses, 1, 4,
                              needs="boiler"),
    "hot_water": Effect("hot water in the evening, which nobody declared", 8.0, "W/m2",
                        _hot_water, 4, 15, needs="boiler"),
    "electricity_step": meter_step("electricity"),
    "cooling_step": meter_step("cooling"),
    "heating_step": meter_step("heating"),
    "gas_step": meter_step("gas", "boiler"),
    "meter_late": Effect("all meters' clocks are late", 1.0, "h", _meter_late, 1, 2),
}
