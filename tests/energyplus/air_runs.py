"""Ten weeks of air systems as EnergyPlus models: boxes of our own with coils, fans and terminals from
its templates.

Each zone is 20 m x 20 m x 3 m, with two outdoor walls and windows; people, lights and machines of an
office from 8 to 18 on all seven days. Flows, fans and rated coils are given, water coils are sized by
EnergyPlus.
"""
from dataclasses import dataclass

AREA, HEIGHT = 20 * 20, 3       # [m2], [m] of a zone
ZONE_FLOW, ZONE_OUTDOOR = 1.6, 0.3    # [m3/s] of each zone
PRESSURE = {True: 1000, False: 500}   # of the fan [Pa], where the flow varies or not
FAN_EFFICIENCY, MOTOR_EFFICIENCY = 0.65, 0.9
FAN_CURVE = (0.00153028, 0.00520806, 1.1086242, -0.11635563)   # power by flow of EnergyPlus's variable speed motor
CAPACITY_PER_FLOW = 20e3        # rated, total, of a DX coil [W s/m3]
RATED_SENSIBLE = 0.75           # of the total
SUPPLY = 12.8                   # [degC]
LEAST_FLOW = 0.4                # of the terminals' largest
FAN_HOURS = (7, 19)
INFILTRATION = 0.2              # [1/h]
LEAST_EXHAUST = 1.7             # after recovery [degC]
# What the templates set otherwise: recovery without a bypass, frost held off by the exhaust's temperature.
AMENDED = {"Supply Air Outlet Temperature Control": "No", "Frost Control Type": "MinimumExhaustTemperature",
           "Threshold Temperature": LEAST_EXHAUST}
# The template's reset by outdoor air: so much warmer at the lower temperature, none at the upper [K, degC].
RESET_BY, RESET_FULL, RESET_NONE = 5.2, 15.6, 26.7


@dataclass(frozen=True)
class Run:
    name: str
    station: str                # part of the weather file's name
    month: int
    day: int                    # the first of seven
    variable: bool = True
    coil: str = "TwoSpeedDX"    # or ChilledWater; SingleSpeedDX where the flow is constant
    zones: int = 3
    economiser: bool = False
    recovery: float = 0         # sensible
    reset: bool = False
    night_cycle: bool = False   # and the cooling coil off by night where it is cold
    fan_cycles: bool = False    # with the coil, of a constant flow
    always_on: bool = False


RUNS = (
    Run("vav_dx_hot", "Tampa", 8, 7),
    Run("vav_water_hot_night", "Tampa", 8, 7, coil="ChilledWater", night_cycle=True),
    Run("vav_water_hot_recovery", "Sterling", 7, 16, coil="ChilledWater", recovery=0.7),
    Run("vav_dx_mild_economiser", "San.Francisco", 10, 2, economiser=True),
    Run("vav_water_mild_reset", "Sterling", 5, 7, coil="ChilledWater", economiser=True, reset=True),
    Run("vav_dx_cold_economiser", "Chicago", 1, 15, economiser=True),
    Run("vav_water_cold_recovery", "Chicago", 1, 15, coil="ChilledWater", recovery=0.7, night_cycle=True),
    Run("single_hot", "Tampa", 8, 7, variable=False, coil="SingleSpeedDX", zones=1),
    Run("single_hot_fan_cycles", "Tampa", 8, 7, variable=False, coil="SingleSpeedDX", zones=1, fan_cycles=True,
        always_on=True),
    Run("single_mild_economiser", "Sterling", 5, 7, variable=False, coil="SingleSpeedDX", zones=1, economiser=True),
    Run("single_cold", "Chicago", 1, 15, variable=False, coil="SingleSpeedDX", zones=1),
    Run("single_cold_recovery", "Chicago", 1, 15, variable=False, coil="SingleSpeedDX", zones=1, recovery=0.7),
)

STEPS = 60   # in an hour: return air has the temperature of the step before
EACH_STEP = ("Zone Air Humidity Ratio",)
HOURLY = ("Zone Mean Air Temperature", "Zone Air Heat Balance System Air Transfer Rate",
          "Zone People Latent Gain Rate", "Zone Infiltration Mass Flow Rate",
          "Air System Outdoor Air Mass Flow Rate",
          "Site Outdoor Air Drybulb Temperature", "Site Outdoor Air Humidity Ratio", "Site Outdoor Air Barometric Pressure",
          "Cooling Coil Total Cooling Rate", "Cooling Coil Sensible Cooling Rate", "Heating Coil Heating Rate",
          "Fan Electricity Rate", "Fan Air Mass Flow Rate")


def week(*parts):
    """Fields of a schedule alike on all days: (until, value)..."""
    fields = ["Through: 12/31", "For: AllDays"]
    for until, value in parts:
        fields += [f"Until: {until:02d}:00", value]
    return {"schedule_type_limits_name": "", "data": fields}


def schedules(run):
    start, stop = FAN_HOURS
    night = 26 if run.night_cycle else 29
    fan = week((24, 1)) if run.always_on else week((start, 0), (stop, 1), (24, 0))
    return {"fan": fan, "use": week((8, 0), (18, 1), (24, 0)), "outdoor": fan, "activity": week((24, 120)),
            "heating": week((start - 1, 16), (stop, 21), (24, 16)),
            "cooling": week((start, night), (stop, 24), (24, night)), "coil": fan if run.month == 1 else week((24, 1)),
            "mode": week((24, 0 if run.fan_cycles else 1))}


def walls():
    return {
        "Material": {
            "concrete": dict(roughness="Rough", thickness=0.15, conductivity=1.4, density=2200, specific_heat=880),
            "board": dict(roughness="Smooth", thickness=0.012, conductivity=0.16, density=800, specific_heat=840)},
        "Material:NoMass": {"insulation": dict(roughness="Smooth", thermal_resistance=2.5)},
        "WindowMaterial:SimpleGlazingSystem": {"pane": dict(u_factor=2, solar_heat_gain_coefficient=0.35)},
        "Construction": {"wall": dict(outside_layer="insulation", layer_2="board"),
                         "slab": dict(outside_layer="concrete"), "window": dict(outside_layer="pane")}}


def rooms(names):
    """Boxes in a row, apart from each other: walls to the south and the north are outdoors."""
    made = {kind: {} for kind in ("Zone", "Wall:Exterior", "Wall:Adiabatic", "Ceiling:Adiabatic", "Floor:Adiabatic", "Window")}
    for n, name in enumerate(names):
        made["Zone"][name] = dict(x_origin=40 * n, y_origin=0, z_origin=0)
        slab = dict(construction_name="slab", zone_name=name, starting_x_coordinate=0, starting_y_coordinate=0,
                    length=20, width=20)
        made["Floor:Adiabatic"][f"{name} floor"] = dict(slab, azimuth_angle=90, tilt_angle=180, starting_z_coordinate=0)
        made["Ceiling:Adiabatic"][f"{name} ceiling"] = dict(slab, azimuth_angle=180, tilt_angle=0, starting_z_coordinate=3)
        for azimuth, x, y in ((180, 0, 0), (90, 20, 0), (0, 20, 20), (270, 0, 20)):
            outdoors = azimuth in (0, 180)
            wall = f"{name} wall {azimuth}"
            made["Wall:Exterior" if outdoors else "Wall:Adiabatic"][wall] = dict(
                construction_name="wall", zone_name=name, azimuth_angle=azimuth, tilt_angle=90, starting_x_coordinate=x,
                starting_y_coordinate=y, starting_z_coordinate=0, length=20, height=HEIGHT)
            # The first room looks to the south, the second to the north.
            width = 16 if azimuth == (180, 0, None)[n] else 8
            if outdoors:
                made["Window"][f"{name} window {azimuth}"] = dict(
                    construction_name="window", building_surface_name=wall, starting_x_coordinate=1,
                    starting_z_coordinate=1, length=width, height=1.5)
    return made


def gains(names):
    made = {kind: {} for kind in ("People", "Lights", "ElectricEquipment", "ZoneInfiltration:DesignFlowRate")}
    for n, name in enumerate(names):
        people, power = ((30, 10), (30, 10), (5, 3))[n]    # the third room is hardly used, and reheated
        of = dict(zone_or_zonelist_or_space_or_spacelist_name=name)
        made["People"][f"{name} people"] = dict(
            of, number_of_people_schedule_name="use", number_of_people_calculation_method="People", number_of_people=people,
            fraction_radiant=0.3, activity_level_schedule_name="activity")
        for kind in ("Lights", "ElectricEquipment"):
            made[kind][f"{name} {kind}"] = dict(of, schedule_name="use", design_level_calculation_method="Watts/Area",
                                                watts_per_floor_area=power, fraction_radiant=0.3)
        made["ZoneInfiltration:DesignFlowRate"][f"{name} infiltration"] = dict(
            of, schedule_name="always", design_flow_rate_calculation_method="AirChanges/Hour",
            air_changes_per_hour=INFILTRATION, constant_term_coefficient=1)
    return made


def system(run, names):
    n = len(names)
    common = dict(
        system_availability_schedule_name="fan", supply_fan_maximum_flow_rate=n * ZONE_FLOW,
        supply_fan_total_efficiency=FAN_EFFICIENCY, supply_fan_delta_pressure=PRESSURE[run.variable],
        supply_fan_motor_efficiency=MOTOR_EFFICIENCY, supply_fan_motor_in_air_stream_fraction=1,
        cooling_coil_type=run.coil, cooling_coil_availability_schedule_name="coil", heating_coil_type="Electric", maximum_outdoor_air_flow_rate=n * ZONE_FLOW,
        minimum_outdoor_air_flow_rate=n * ZONE_OUTDOOR, minimum_outdoor_air_schedule_name="outdoor",
        economizer_type="DifferentialDryBulb" if run.economiser else "NoEconomizer", supply_fan_placement="DrawThrough",
        night_cycle_control="CycleOnAny" if run.night_cycle else "StayOff",
        heat_recovery_type="Sensible" if run.recovery else "None")
    if run.recovery:
        common["sensible_heat_recovery_effectiveness"] = run.recovery
    dx = dict(cooling_coil_gross_rated_total_capacity=CAPACITY_PER_FLOW * n * ZONE_FLOW,
              cooling_coil_gross_rated_sensible_heat_ratio=RATED_SENSIBLE)
    if not run.variable:
        return {"HVACTemplate:System:Unitary": {"unit": dict(
                    common, **dx, control_zone_or_thermostat_location_name=names[0],
                    supply_fan_operating_mode_schedule_name="mode")},
                "HVACTemplate:Zone:Unitary": {name: dict(zone_name=name,
                    template_unitary_system_name="unit", template_thermostat_name="rooms",
                    supply_air_maximum_flow_rate=ZONE_FLOW, outdoor_air_method="Flow/Zone",
                    outdoor_air_flow_rate_per_zone=ZONE_OUTDOOR) for name in names}}
    common.update(supply_fan_part_load_power_coefficients="VariableSpeedMotor", cooling_coil_design_setpoint=SUPPLY, heating_coil_design_setpoint=10,
                  minimum_outdoor_air_control_type="FixedMinimum", supply_fan_minimum_flow_rate=0,
                  cooling_coil_setpoint_reset_type="OutdoorAirTemperatureReset" if run.reset else "None")
    zones = {"HVACTemplate:Zone:VAV": {name: dict(zone_name=name,
        template_vav_system_name="unit", template_thermostat_name="rooms", supply_air_maximum_flow_rate=ZONE_FLOW,
        zone_minimum_air_flow_input_method="Constant", constant_minimum_air_flow_fraction=LEAST_FLOW,
        outdoor_air_method="Flow/Zone", outdoor_air_flow_rate_per_zone=ZONE_OUTDOOR, reheat_coil_type="Electric",
        damper_heating_action="Normal") for name in names}}
    if run.coil != "ChilledWater":
        return {"HVACTemplate:System:PackagedVAV": {"unit": dict(common, **dx)}, **zones}
    return {"HVACTemplate:System:VAV": {"unit": common}, **zones,
            "HVACTemplate:Plant:ChilledWaterLoop": {"water": dict(
                pump_control_type="Intermittent", chiller_plant_operation_scheme_type="Default",
                chilled_water_design_setpoint=7.22, condenser_plant_operation_scheme_type="Default")},
            "HVACTemplate:Plant:Chiller": {"chiller": dict(
                chiller_type="ElectricReciprocatingChiller", nominal_cop=3.2, condenser_type="AirCooled", priority=1)}}


def design_days():
    common = dict(dry_bulb_temperature_range_modifier_type="DefaultMultipliers", humidity_condition_type="WetBulb",
                  barometric_pressure=101325, wind_direction=0, rain_indicator="No", snow_indicator="No",
                  daylight_saving_time_indicator="No", solar_model_indicator="ASHRAEClearSky")
    return {"hot": dict(common, month=7, day_of_month=21, day_type="SummerDesignDay", maximum_dry_bulb_temperature=34,
                        daily_dry_bulb_temperature_range=9, wetbulb_or_dewpoint_at_maximum_dry_bulb=25, wind_speed=3,
                        sky_clearness=1),
            "cold": dict(common, month=1, day_of_month=21, day_type="WinterDesignDay", maximum_dry_bulb_temperature=-15,
                         daily_dry_bulb_temperature_range=0, wetbulb_or_dewpoint_at_maximum_dry_bulb=-15, wind_speed=5,
                         sky_clearness=0)}


def objects(run):
    names = [f"room {n + 1}" for n in range(run.zones)]
    return {
        "Version": {"": dict(version_identifier="25.2")},
        "Building": {"boxes": dict(terrain="City", solar_distribution="FullExterior", maximum_number_of_warmup_days=40)},
        "SimulationControl": {"": dict(
            do_zone_sizing_calculation="Yes", do_system_sizing_calculation="Yes", do_plant_sizing_calculation="Yes",
            run_simulation_for_sizing_periods="No", run_simulation_for_weather_file_run_periods="Yes")},
        "Timestep": {"": dict(number_of_timesteps_per_hour=STEPS)},
        "RunPeriod": {"week": dict(
            begin_month=run.month, begin_day_of_month=run.day, end_month=run.month, end_day_of_month=run.day + 6,
            day_of_week_for_start_day="Monday", use_weather_file_holidays_and_special_days="No",
            use_weather_file_daylight_saving_period="No", apply_weekend_holiday_rule="No",
            use_weather_file_rain_indicators="No", use_weather_file_snow_indicators="No")},
        "SizingPeriod:DesignDay": design_days(),
        "GlobalGeometryRules": {"": dict(
            starting_vertex_position="UpperLeftCorner", vertex_entry_direction="Counterclockwise",
            coordinate_system="Relative", rectangular_surface_coordinate_system="Relative")},
        **walls(), **rooms(names), **gains(names), "Schedule:Compact": {**schedules(run), "always": week((24, 1))},
        "HVACTemplate:Thermostat": {"rooms": dict(heating_setpoint_schedule_name="heating",
                                                  cooling_setpoint_schedule_name="cooling")},
        **system(run, names),
        "Output:SQLite": {"": dict(option_type="Simple")},
        "Output:Variable": {name: dict(key_value="*", variable_name=name, reporting_frequency=often)
                            for often, names in (("Hourly", HOURLY), ("Timestep", EACH_STEP)) for name in names},
    }
