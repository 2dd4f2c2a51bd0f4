"""A small office of two rooms as an EnergyPlus model: 288 m2, south and north, ideal loads with outdoor air.

What the user has: `model()`. What stands in its place when readings are made: other values of parameters (TRUTH) and an
effect that no description has (EFFECT). Values are our own, usual of a masonry building that was insulated once.
"""
VERSION = "25.2"
LENGTH, DEPTH, HEIGHT = 24, 6, 3.5       # m, of each room
GLASS = {"south": 0.4, "north": 0.25}    # share of the facade
ROOMS = {"South room": ("south", 0), "North room": ("north", DEPTH)}   # where its window is, and its y
TARGET = "zone_or_zonelist_or_space_or_spacelist_name"
WORK = "For: Weekdays"
# Factors on the model, set-points in K.
TRUTH = {"infiltration": 1.3, "lights": 0.9, "equipment": 1.2, "u_walls": 1.15, "u_windows": 1.1, "g_windows": 0.85,
         "heating_set_point": -0.5, "heating_efficiency": 0.93}
EFFECT = {"name": "warm evenings", "hook": "heating set-point", "unit": "K", "enters": "add", "column": "warm_evenings"}
EFFECT_HOURS, EFFECT_SIZE = (18, 22), 3  # of every day, K


OUTER = {"Wall": "Outer wall", "Roof": "Roof", "Floor": "Slab"}
MONTHS = ("january", "february", "march", "april", "may", "june", "july", "august", "september", "october", "november",
          "december")
GROUND = 15                              # degC, below the slab


def corner(x, y, z):
    return {"vertex_x_coordinate": x, "vertex_y_coordinate": y, "vertex_z_coordinate": z}


def box(y):
    """{face: corners}, seen from outside against the clock, the upper left one first."""
    a, b, c, d = (0, y), (LENGTH, y), (LENGTH, y + DEPTH), (0, y + DEPTH)

    def wall(left, right):
        return [(*left, HEIGHT), (*left, 0), (*right, 0), (*right, HEIGHT)]
    return {"south": wall(a, b), "east": wall(b, c), "north": wall(c, d), "west": wall(d, a),
            "roof": [(*d, HEIGHT), (*a, HEIGHT), (*b, HEIGHT), (*c, HEIGHT)],
            "floor": [(*a, 0), (*d, 0), (*c, 0), (*b, 0)]}


def surfaces():
    made = {}
    between = {"South room": "north", "North room": "south"}
    for room, (_, y) in ROOMS.items():
        for face, corners in box(y).items():
            kind = {"roof": "Roof", "floor": "Floor"}.get(face, "Wall")
            is_inner = between[room] == face
            other = next(each for each in ROOMS if each != room)
            made[f"{room} {face}"] = {
                "surface_type": kind, "zone_name": room,
                "construction_name": "Partition" if is_inner else OUTER[kind],
                "outside_boundary_condition": "Surface" if is_inner else "Ground" if face == "floor" else "Outdoors",
                **({"outside_boundary_condition_object": f"{other} {between[other]}"} if is_inner else {}),
                "sun_exposure": "NoSun" if is_inner or face == "floor" else "SunExposed",
                "wind_exposure": "NoWind" if is_inner or face == "floor" else "WindExposed",
                "vertices": [corner(*point) for point in corners]}
    return made


def windows():
    made = {}
    for room, (side, y) in ROOMS.items():
        wide = LENGTH * GLASS[side] / 0.6
        xs, at = ((LENGTH - wide) / 2, (LENGTH + wide) / 2), y if side == "south" else y + DEPTH
        left, right = xs if side == "south" else xs[::-1]
        points = [(left, at, 0.8 + 0.6 * HEIGHT), (left, at, 0.8), (right, at, 0.8), (right, at, 0.8 + 0.6 * HEIGHT)]
        made[f"{room} window"] = {"surface_type": "Window", "construction_name": "Double glazing",
                                  "building_surface_name": f"{room} {side}", "multiplier": 1, "number_of_vertices": 4,
                                  **{f"vertex_{k}_{axis}_coordinate": point["xyz".index(axis)]
                                     for k, point in enumerate(points, 1) for axis in "xyz"}}
    return made


def compact(weekdays, other, design):
    """Days as (hour until, value); `design`: of both design days."""
    def day(days):
        return [row for until, value in days for row in (f"Until: {until}:00", value)]
    rows = ["Through: 12/31", WORK, *day(weekdays), "For: SummerDesignDay WinterDesignDay", *day([(24, design)]),
            "For: AllOtherDays", *day(other)]
    return {"schedule_type_limits_name": "Any", "data": [{"field": row} for row in rows]}


def material(thickness, conductivity, density, heat):
    return {"roughness": "Rough", "thickness": thickness, "conductivity": conductivity, "density": density,
            "specific_heat": heat, "thermal_absorptance": 0.9, "solar_absorptance": 0.6}


def fabric():
    """Materials, constructions, surfaces."""
    return {
        "Material": {"Brick": material(0.24, 0.8, 1800, 900), "Concrete": material(0.2, 2, 2400, 1000),
                     "Plasterboard": material(0.025, 0.25, 900, 1000)},
        "Material:NoMass": {"Wall insulation": {"roughness": "Rough", "thermal_resistance": 1.8},
                            "Roof insulation": {"roughness": "Rough", "thermal_resistance": 3.5},
                            "Slab insulation": {"roughness": "Rough", "thermal_resistance": 1.5}},
        "WindowMaterial:SimpleGlazingSystem": {"Glass": {"u_factor": 2, "solar_heat_gain_coefficient": 0.55}},
        "Construction": {
            "Outer wall": {"outside_layer": "Wall insulation", "layer_2": "Brick"},
            "Roof": {"outside_layer": "Roof insulation", "layer_2": "Concrete"},
            "Slab": {"outside_layer": "Slab insulation", "layer_2": "Concrete"},
            "Partition": {"outside_layer": "Plasterboard", "layer_2": "Plasterboard"},
            "Double glazing": {"outside_layer": "Glass"}},
        "BuildingSurface:Detailed": surfaces(), "FenestrationSurface:Detailed": windows(),
        "GlobalGeometryRules": {"Rules": {"starting_vertex_position": "UpperLeftCorner",
                                          "vertex_entry_direction": "Counterclockwise",
                                          "coordinate_system": "Relative"}},
        "Site:GroundTemperature:BuildingSurface": {
            "Ground": {f"{month}_ground_temperature": GROUND for month in MONTHS}},
        "Zone": {room: {"multiplier": 1} for room in ROOMS}}


def use():
    """Schedules, people, lights, equipment, air."""
    def everywhere(kind, **fields):
        return {f"{room} {kind}": {TARGET: room, **fields} for room in ROOMS}
    return {
        "ScheduleTypeLimits": {"Any": {}},
        "Schedule:Constant": {"Activity": {"hourly_value": 120}, "Always": {"hourly_value": 1},
                              "Dual": {"hourly_value": 4}},
        "Schedule:Compact": {
            "Work": compact([(7, 0), (8, 0.4), (12, 1), (13, 0.7), (17, 1), (18, 0.4), (24, 0)], [(24, 0)], 0),
            "Light": compact([(7, 0.05), (18, 0.9), (20, 0.4), (24, 0.05)], [(24, 0.05)], 0),
            "Plugs": compact([(7, 0.25), (18, 1), (24, 0.25)], [(24, 0.25)], 0.25),
            "Air": compact([(6, 0), (18, 1), (24, 0)], [(24, 0)], 1),
            "Heat": compact([(5, 16), (18, 21), (24, 16)], [(24, 16)], 21),
            "Cold": compact([(6, 30), (18, 25), (24, 30)], [(24, 30)], 25)},
        "People": {f"{room} people": {TARGET: room, "number_of_people_schedule_name": "Work",
                                      "number_of_people_calculation_method": "Area/Person", "floor_area_per_person": 15,
                                      "fraction_radiant": 0.3, "activity_level_schedule_name": "Activity"}
                   for room in ROOMS},
        "Lights": everywhere("lights", schedule_name="Light", design_level_calculation_method="Watts/Area",
                             watts_per_floor_area=9, fraction_radiant=0.4, fraction_visible=0.2),
        "ElectricEquipment": everywhere("plugs", schedule_name="Plugs", design_level_calculation_method="Watts/Area",
                                        watts_per_floor_area=8, fraction_radiant=0.3),
        "ZoneInfiltration:DesignFlowRate": everywhere(
            "leaks", schedule_name="Always", design_flow_rate_calculation_method="AirChanges/Hour",
            air_changes_per_hour=0.4, constant_term_coefficient=1, temperature_term_coefficient=0,
            velocity_term_coefficient=0, velocity_squared_term_coefficient=0),
        "DesignSpecification:OutdoorAir": {"Fresh air": {
            "outdoor_air_method": "Flow/Area", "outdoor_air_flow_per_zone_floor_area": 0.0008,
            "outdoor_air_schedule_name": "Air"}}}


def plant():
    """Thermostats and ideal loads, node by node."""
    return {
        "ThermostatSetpoint:DualSetpoint": {"Set-points": {
            "heating_setpoint_temperature_schedule_name": "Heat",
            "cooling_setpoint_temperature_schedule_name": "Cold"}},
        "ZoneControl:Thermostat": {f"{room} thermostat": {
            "zone_or_zonelist_name": room, "control_type_schedule_name": "Dual",
            "control_1_object_type": "ThermostatSetpoint:DualSetpoint", "control_1_name": "Set-points"}
                                   for room in ROOMS},
        "ZoneHVAC:IdealLoadsAirSystem": {f"{room} air": {
            "zone_supply_air_node_name": f"{room} supply", "design_specification_outdoor_air_object_name": "Fresh air",
            "outdoor_air_inlet_node_name": f"{room} outdoor", "dehumidification_control_type": "None",
            "heating_limit": "NoLimit", "cooling_limit": "NoLimit"} for room in ROOMS},
        "OutdoorAir:NodeList": {"Outdoor nodes": {"nodes": [
            {"node_or_nodelist_name": f"{room} outdoor"} for room in ROOMS]}},
        "ZoneHVAC:EquipmentList": {f"{room} list": {"load_distribution_scheme": "SequentialLoad", "equipment": [{
            "zone_equipment_object_type": "ZoneHVAC:IdealLoadsAirSystem", "zone_equipment_name": f"{room} air",
            "zone_equipment_cooling_sequence": 1, "zone_equipment_heating_or_no_load_sequence": 1}]} for room in ROOMS},
        "ZoneHVAC:EquipmentConnections": {f"{room} nodes": {
            "zone_name": room, "zone_conditioning_equipment_list_name": f"{room} list",
            "zone_air_inlet_node_or_nodelist_name": f"{room} supply", "zone_air_node_name": f"{room} air node",
            "zone_return_air_node_or_nodelist_name": f"{room} return"} for room in ROOMS}}


def model():
    """{class: {name: {field: value}}}, an epJSON."""
    return {"Version": {"Version 1": {"version_identifier": VERSION}},
            "Building": {"Office": {"north_axis": 0, "terrain": "Suburbs", "maximum_number_of_warmup_days": 25,
                                    "solar_distribution": "FullExterior"}},
            "SimulationControl": {"Control": {"run_simulation_for_sizing_periods": "No",
                                              "run_simulation_for_weather_file_run_periods": "Yes"}},
            "RunPeriodControl:DaylightSavingTime": {"Summer time": {"start_date": "Last Sunday in March",
                                                                    "end_date": "Last Sunday in October"}},
            "Timestep": {"Timestep 1": {"number_of_timesteps_per_hour": 4}},
            "RunPeriod": {"Year": {"begin_month": 1, "begin_day_of_month": 1, "end_month": 12, "end_day_of_month": 31}},
            **fabric(), **use(), **plant()}
