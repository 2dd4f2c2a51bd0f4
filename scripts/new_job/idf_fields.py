"""Fields of the EnergyPlus classes that `new --idf` reads, in their order in an IDF file, up to the last that is used.

Source: EnergyPlus Input Output Reference and Energy+.schema.epJSON, 8.9 to 26.1. REST names what repeats behind them.
"""
_DETAILED = "name surface_type construction_name zone_name space_name outside_boundary_condition " \
            "outside_boundary_condition_object sun_exposure wind_exposure view_factor_to_ground number_of_vertices"
_OF_KIND = _DETAILED.replace("surface_type ", "")
_EQUIPMENT = "name zone_or_zonelist_or_space_or_spacelist_name schedule_name design_level_calculation_method " \
             "design_level watts_per_floor_area watts_per_person fraction_latent fraction_radiant fraction_lost"
_FLOW = "name zone_or_zonelist_or_space_or_spacelist_name schedule_name design_flow_rate_calculation_method " \
        "design_flow_rate flow_rate_per_floor_area "
_BEHIND = "outside_boundary_condition_object"
_BY_LENGTH = "name construction_name zone_name space_name {} azimuth_angle tilt_angle starting_x_coordinate " \
             "starting_y_coordinate starting_z_coordinate length"
_SIMPLE = "name construction_name building_surface_name {} multiplier starting_x_coordinate starting_z_coordinate " \
          "length height"
_UNITARY = "name availability_schedule_name {}_air_inlet_node_name {}_air_outlet_node_name " \
           "supply_air_fan_operating_mode_schedule_name maximum_supply_air_temperature cooling_supply_air_flow_rate " \
           "heating_supply_air_flow_rate no_load_supply_air_flow_rate controlling_zone_or_thermostat_location " \
           "supply_fan_object_type supply_fan_name"
_COILS = "heating_coil_object_type heating_coil_name cooling_coil_object_type cooling_coil_name"
_TERMINAL = "name availability_schedule_name air_inlet_node_name air_outlet_node_name outdoor_air_mixer_object_type " \
            "outdoor_air_mixer_name cooling_supply_air_flow_rate heating_supply_air_flow_rate " \
            "no_load_supply_air_flow_rate no_load_supply_air_flow_rate_control_set_to_low_speed " \
            "cooling_outdoor_air_flow_rate heating_outdoor_air_flow_rate no_load_outdoor_air_flow_rate " \
            "supply_air_fan_object_type supply_air_fan_name"
_CRANKCASE = "crankcase_heater_capacity crankcase_heater_capacity_function_of_temperature_curve_name " \
             "maximum_outdoor_dry_bulb_temperature_for_crankcase_heater_operation"
_WATER_TO_AIR = "name availability_schedule_name water_inlet_node_name water_outlet_node_name air_inlet_node_name " \
                "air_outlet_node_name rated_air_flow_rate rated_water_flow_rate"
_BASEBOARD = "name availability_schedule_name heating_design_capacity_method heating_design_capacity " \
             "heating_design_capacity_per_floor_area fraction_of_autosized_heating_design_capacity"
_WEEK = "name sunday monday tuesday wednesday thursday friday saturday holiday"
MONTHS = ("january", "february", "march", "april", "may", "june", "july", "august", "september", "october", "november",
          "december")
_HOURS = " ".join(f"hour_{hour}" for hour in range(1, 25))

_TABLE = {
    "version": "version_identifier",
    "building": "name north_axis terrain",
    "globalgeometryrules": "starting_vertex_position vertex_entry_direction coordinate_system",
    "zone": "name direction_of_relative_north x_origin y_origin z_origin type multiplier ceiling_height volume "
            "floor_area zone_inside_convection_algorithm zone_outside_convection_algorithm part_of_total_floor_area",
    "zonelist": "name", "zonegroup": "name zone_list_name zone_list_multiplier",
    "space": "name zone_name", "spacelist": "name",
    "buildingsurface:detailed": _DETAILED,
    "wall:detailed": _OF_KIND, "roofceiling:detailed": _OF_KIND, "floor:detailed": _OF_KIND,
    **dict.fromkeys(("wall:exterior", "wall:adiabatic", "wall:underground"), f"{_BY_LENGTH.format('')} height"),
    **dict.fromkeys(("roof", "ceiling:adiabatic", "floor:groundcontact", "floor:adiabatic"),
                    f"{_BY_LENGTH.format('')} width"),
    "wall:interzone": f"{_BY_LENGTH.format(_BEHIND)} height",
    **dict.fromkeys(("ceiling:interzone", "floor:interzone"), f"{_BY_LENGTH.format(_BEHIND)} width"),
    "fenestrationsurface:detailed":
        "name surface_type construction_name building_surface_name outside_boundary_condition_object "
        "view_factor_to_ground shading_control_name frame_and_divider_name multiplier number_of_vertices " + " ".join(
            f"vertex_{k}_{axis}_coordinate" for k in range(1, 5) for axis in "xyz"),
    "window": _SIMPLE.format("frame_and_divider_name"), "glazeddoor": _SIMPLE.format("frame_and_divider_name"),
    "door": _SIMPLE.format(""),
    **dict.fromkeys(("window:interzone", "door:interzone", "glazeddoor:interzone"), _SIMPLE.format(_BEHIND)),
    "internalmass": "name construction_name zone_or_zonelist_name space_or_spacelist_name surface_area",
    "material": "name roughness thickness conductivity density specific_heat thermal_absorptance solar_absorptance",
    "material:nomass": "name roughness thermal_resistance thermal_absorptance solar_absorptance",
    "material:airgap": "name thermal_resistance",
    "material:roofvegetation":
        "name height_of_plants leaf_area_index leaf_reflectivity leaf_emissivity minimum_stomatal_resistance "
        "soil_layer_name roughness thickness conductivity_of_dry_soil density_of_dry_soil specific_heat_of_dry_soil "
        "thermal_absorptance solar_absorptance",
    "windowmaterial:simpleglazingsystem": "name u_factor solar_heat_gain_coefficient",
    "windowmaterial:glazing":
        "name optical_data_type window_glass_spectral_data_set_name thickness solar_transmittance_at_normal_incidence "
        "front_side_solar_reflectance_at_normal_incidence back_side_solar_reflectance_at_normal_incidence "
        "visible_transmittance_at_normal_incidence front_side_visible_reflectance_at_normal_incidence "
        "back_side_visible_reflectance_at_normal_incidence infrared_transmittance_at_normal_incidence "
        "front_side_infrared_hemispherical_emissivity back_side_infrared_hemispherical_emissivity conductivity",
    "windowmaterial:gas": "name gas_type thickness",
    "windowmaterial:gasmixture": "name thickness number_of_gases_in_mixture gas_1_type gas_1_fraction",
    "construction": "name outside_layer " + " ".join(f"layer_{k}" for k in range(2, 11)),
    "construction:ffactorgroundfloor": "name f_factor area perimeterexposed",
    "construction:cfactorundergroundwall": "name c_factor height",
    **dict.fromkeys(("site:groundtemperature:buildingsurface", "site:groundtemperature:fcfactormethod"),
                    " ".join(f"{month}_ground_temperature" for month in MONTHS)),
    "site:watermainstemperature":
        "calculation_method temperature_schedule_name annual_average_outdoor_air_temperature "
        "maximum_difference_in_monthly_average_outdoor_air_temperatures",
    "exterior:lights": "name schedule_name design_level control_option",
    "exterior:fuelequipment": "name fuel_use_type schedule_name design_level",
    "wateruse:equipment": "name end_use_subcategory peak_flow_rate flow_rate_fraction_schedule_name "
                          "target_temperature_schedule_name hot_water_supply_temperature_schedule_name "
                          "cold_water_supply_temperature_schedule_name zone_name",
    "wateruse:connections":
        "name inlet_node_name outlet_node_name supply_water_storage_tank_name reclamation_water_storage_tank_name "
        "hot_water_supply_temperature_schedule_name cold_water_supply_temperature_schedule_name "
        "drain_water_heat_exchanger_type drain_water_heat_exchanger_destination "
        "drain_water_heat_exchanger_u_factor_times_area",
    "waterheater:mixed":
        "name tank_volume setpoint_temperature_schedule_name deadband_temperature_difference maximum_temperature_limit "
        "heater_control_type heater_maximum_capacity heater_minimum_capacity heater_ignition_minimum_flow_rate "
        "heater_ignition_delay heater_fuel_type heater_thermal_efficiency part_load_factor_curve_name "
        "off_cycle_parasitic_fuel_consumption_rate off_cycle_parasitic_fuel_type "
        "off_cycle_parasitic_heat_fraction_to_tank on_cycle_parasitic_fuel_consumption_rate "
        "on_cycle_parasitic_fuel_type on_cycle_parasitic_heat_fraction_to_tank ambient_temperature_indicator "
        "ambient_temperature_schedule_name ambient_temperature_zone_name ambient_temperature_outdoor_air_node_name "
        "off_cycle_loss_coefficient_to_ambient_temperature off_cycle_loss_fraction_to_zone "
        "on_cycle_loss_coefficient_to_ambient_temperature on_cycle_loss_fraction_to_zone peak_use_flow_rate "
        "use_flow_rate_fraction_schedule_name",
    "people": "name zone_or_zonelist_or_space_or_spacelist_name number_of_people_schedule_name "
              "number_of_people_calculation_method number_of_people people_per_floor_area floor_area_per_person "
              "fraction_radiant sensible_heat_fraction activity_level_schedule_name",
    "lights": "name zone_or_zonelist_or_space_or_spacelist_name schedule_name design_level_calculation_method "
              "lighting_level watts_per_floor_area watts_per_person return_air_fraction",
    "electricequipment": _EQUIPMENT, "gasequipment": _EQUIPMENT.replace("watts_per", "power_per"),
    "zoneinfiltration:designflowrate": _FLOW + "flow_rate_per_exterior_surface_area air_changes_per_hour "
        "constant_term_coefficient temperature_term_coefficient velocity_term_coefficient "
        "velocity_squared_term_coefficient",
    "zoneventilation:designflowrate": _FLOW + "flow_rate_per_person air_changes_per_hour ventilation_type "
        "fan_pressure_rise fan_total_efficiency constant_term_coefficient temperature_term_coefficient "
        "velocity_term_coefficient velocity_squared_term_coefficient " + " ".join(
            f"{limit} {limit}_schedule_name" for limit in (
                "minimum_indoor_temperature", "maximum_indoor_temperature", "delta_temperature",
                "minimum_outdoor_temperature", "maximum_outdoor_temperature")) + " maximum_wind_speed",
    "designspecification:outdoorair":
        "name outdoor_air_method outdoor_air_flow_per_person outdoor_air_flow_per_zone_floor_area "
        "outdoor_air_flow_per_zone outdoor_air_flow_air_changes_per_hour outdoor_air_schedule_name",
    "sizing:zone":
        "zone_or_zonelist_name zone_cooling_design_supply_air_temperature_input_method "
        "zone_cooling_design_supply_air_temperature zone_cooling_design_supply_air_temperature_difference "
        "zone_heating_design_supply_air_temperature_input_method zone_heating_design_supply_air_temperature "
        "zone_heating_design_supply_air_temperature_difference zone_cooling_design_supply_air_humidity_ratio "
        "zone_heating_design_supply_air_humidity_ratio design_specification_outdoor_air_object_name",
    "controller:outdoorair":
        "name relief_air_outlet_node_name return_air_node_name mixed_air_node_name actuator_node_name "
        "minimum_outdoor_air_flow_rate maximum_outdoor_air_flow_rate economizer_control_type "
        "economizer_control_action_type economizer_maximum_limit_dry_bulb_temperature "
        "economizer_maximum_limit_enthalpy economizer_maximum_limit_dewpoint_temperature "
        "electronic_enthalpy_limit_curve_name economizer_minimum_limit_dry_bulb_temperature lockout_type "
        "minimum_limit_type minimum_outdoor_air_schedule_name",
    "zonecontrol:thermostat": "name zone_or_zonelist_name control_type_schedule_name " + " ".join(
        f"control_{k}_object_type control_{k}_name" for k in range(1, 5)),
    "thermostatsetpoint:dualsetpoint":
        "name heating_setpoint_temperature_schedule_name cooling_setpoint_temperature_schedule_name",
    "thermostatsetpoint:singleheating": "name setpoint_temperature_schedule_name",
    "thermostatsetpoint:singlecooling": "name setpoint_temperature_schedule_name",
    "thermostatsetpoint:singleheatingorcooling": "name setpoint_temperature_schedule_name",
    "hvactemplate:thermostat": "name heating_setpoint_schedule_name constant_heating_setpoint "
                               "cooling_setpoint_schedule_name constant_cooling_setpoint",
    "hvactemplate:zone:idealloadsairsystem":
        "zone_name template_thermostat_name system_availability_schedule_name maximum_heating_supply_air_temperature "
        "minimum_cooling_supply_air_temperature maximum_heating_supply_air_humidity_ratio "
        "minimum_cooling_supply_air_humidity_ratio heating_limit maximum_heating_air_flow_rate "
        "maximum_sensible_heating_capacity cooling_limit maximum_cooling_air_flow_rate maximum_total_cooling_capacity "
        "heating_availability_schedule_name cooling_availability_schedule_name dehumidification_control_type "
        "cooling_sensible_heat_ratio dehumidification_setpoint humidification_control_type humidification_setpoint "
        "outdoor_air_method outdoor_air_flow_rate_per_person outdoor_air_flow_rate_per_zone_floor_area "
        "outdoor_air_flow_rate_per_zone design_specification_outdoor_air_object_name "
        "demand_controlled_ventilation_type outdoor_air_economizer_type heat_recovery_type "
        "sensible_heat_recovery_effectiveness latent_heat_recovery_effectiveness",
    "zonehvac:equipmentconnections": "zone_name zone_conditioning_equipment_list_name "
                                     "zone_air_inlet_node_or_nodelist_name",
    "zonehvac:idealloadsairsystem":
        "name availability_schedule_name zone_supply_air_node_name zone_exhaust_air_node_name "
        "system_inlet_air_node_name maximum_heating_supply_air_temperature minimum_cooling_supply_air_temperature "
        "maximum_heating_supply_air_humidity_ratio minimum_cooling_supply_air_humidity_ratio heating_limit "
        "maximum_heating_air_flow_rate maximum_sensible_heating_capacity cooling_limit maximum_cooling_air_flow_rate "
        "maximum_total_cooling_capacity heating_availability_schedule_name cooling_availability_schedule_name "
        "dehumidification_control_type cooling_sensible_heat_ratio humidification_control_type "
        "design_specification_outdoor_air_object_name outdoor_air_inlet_node_name demand_controlled_ventilation_type "
        "outdoor_air_economizer_type heat_recovery_type sensible_heat_recovery_effectiveness "
        "latent_heat_recovery_effectiveness design_specification_zonehvac_sizing_object_name "
        "heating_fuel_efficiency_schedule_name heating_fuel_type cooling_fuel_efficiency_schedule_name "
        "cooling_fuel_type",
    "zonehvac:equipmentlist": "name load_distribution_scheme",
    "airloophvac:unitaryheatcool": _UNITARY.format("unitary_system", "unitary_system"),
    "airloophvac:unitary:furnace:heatcool": _UNITARY.format("furnace", "furnace"),
    "airloophvac:unitarysystem":
        "name control_type controlling_zone_or_thermostat_location dehumidification_control_type "
        "availability_schedule_name air_inlet_node_name air_outlet_node_name supply_fan_object_type supply_fan_name "
        "fan_placement supply_air_fan_operating_mode_schedule_name",
    "airloophvac:unitaryheatpump:airtoair":
        "name availability_schedule_name air_inlet_node_name air_outlet_node_name cooling_supply_air_flow_rate "
        "heating_supply_air_flow_rate no_load_supply_air_flow_rate controlling_zone_or_thermostat_location "
        f"supply_air_fan_object_type supply_air_fan_name {_COILS} supplemental_heating_coil_object_type "
        "supplemental_heating_coil_name maximum_supply_air_temperature_from_supplemental_heater "
        "maximum_outdoor_dry_bulb_temperature_for_supplemental_heater_operation fan_placement "
        "supply_air_fan_operating_mode_schedule_name",
    "zonehvac:packagedterminalairconditioner":
        f"{_TERMINAL} {_COILS} fan_placement supply_air_fan_operating_mode_schedule_name",
    "zonehvac:packagedterminalheatpump":
        f"{_TERMINAL} heating_coil_object_type heating_coil_name heating_convergence_tolerance "
        "cooling_coil_object_type cooling_coil_name cooling_convergence_tolerance "
        "supplemental_heating_coil_object_type supplemental_heating_coil_name "
        "maximum_supply_air_temperature_from_supplemental_heater "
        "maximum_outdoor_dry_bulb_temperature_for_supplemental_heater_operation fan_placement "
        "supply_air_fan_operating_mode_schedule_name",
    **dict.fromkeys(("fan:constantvolume", "fan:onoff"),
                    "name availability_schedule_name fan_total_efficiency pressure_rise maximum_flow_rate "
                    "motor_efficiency motor_in_airstream_fraction"),
    "fan:systemmodel":
        "name availability_schedule_name air_inlet_node_name air_outlet_node_name design_maximum_air_flow_rate "
        "speed_control_method electric_power_minimum_flow_rate_fraction design_pressure_rise motor_efficiency "
        "motor_in_air_stream_fraction design_electric_power_consumption design_power_sizing_method "
        "electric_power_per_unit_flow_rate electric_power_per_unit_flow_rate_per_unit_pressure fan_total_efficiency",
    "coil:heating:fuel": "name availability_schedule_name fuel_type burner_efficiency",
    "coil:heating:gas": "name availability_schedule_name burner_efficiency",
    "coil:heating:electric": "name availability_schedule_name efficiency",
    "coil:heating:dx:singlespeed": "name availability_schedule_name gross_rated_heating_capacity "
                                   "gross_rated_heating_cop",
    "boiler:hotwater": "name fuel_type nominal_capacity nominal_thermal_efficiency",
    "coil:cooling:dx:singlespeed": "name availability_schedule_name gross_rated_total_cooling_capacity "
                                   "gross_rated_sensible_heat_ratio gross_rated_cooling_cop",
    "chiller:electric:eir": "name reference_capacity reference_cop",
    "chiller:electric:reformulatedeir": "name reference_capacity reference_cop",
    "chiller:electric": "name condenser_type nominal_capacity nominal_cop",
    "chiller:constantcop": "name nominal_capacity nominal_cop",
    "coil:cooling:dx:twospeed": "name availability_schedule_name high_speed_gross_rated_total_cooling_capacity "
                                "high_speed_rated_sensible_heat_ratio high_speed_gross_rated_cooling_cop",
    "coil:cooling:dx:multispeed":
        "name availability_schedule_name air_inlet_node_name air_outlet_node_name condenser_air_inlet_node_name "
        "condenser_type minimum_outdoor_dry_bulb_temperature_for_compressor_operation supply_water_storage_tank_name "
        "condensate_collection_water_storage_tank_name apply_part_load_fraction_to_speeds_greater_than_1 "
        f"apply_latent_degradation_to_speeds_greater_than_1 {_CRANKCASE} basin_heater_capacity "
        "basin_heater_setpoint_temperature basin_heater_operating_schedule_name fuel_type number_of_speeds "
        "speed_1_gross_rated_total_cooling_capacity speed_1_gross_rated_sensible_heat_ratio "
        "speed_1_gross_rated_cooling_cop",
    "coil:heating:dx:multispeed":
        "name availability_schedule_name air_inlet_node_name air_outlet_node_name "
        "minimum_outdoor_dry_bulb_temperature_for_compressor_operation "
        "outdoor_dry_bulb_temperature_to_turn_on_compressor "
        f"{_CRANKCASE} defrost_energy_input_ratio_function_of_temperature_curve_name "
        "maximum_outdoor_dry_bulb_temperature_for_defrost_operation defrost_strategy defrost_control "
        "defrost_time_period_fraction resistive_defrost_heater_capacity "
        "apply_part_load_fraction_to_speeds_greater_than_1 fuel_type region_number_for_calculating_hspf "
        "number_of_speeds speed_1_gross_rated_heating_capacity speed_1_gross_rated_heating_cop",
    "coil:cooling:watertoairheatpump:equationfit":
        f"{_WATER_TO_AIR} gross_rated_total_cooling_capacity gross_rated_sensible_cooling_capacity "
        "gross_rated_cooling_cop",
    "coil:heating:watertoairheatpump:equationfit":
        f"{_WATER_TO_AIR} gross_rated_heating_capacity gross_rated_heating_cop",
    **dict.fromkeys(("heatpump:plantloop:eir:cooling", "heatpump:plantloop:eir:heating"),
                    "name load_side_inlet_node_name load_side_outlet_node_name condenser_type "
                    "source_side_inlet_node_name source_side_outlet_node_name heat_recovery_inlet_node_name "
                    "heat_recovery_outlet_node_name companion_heat_pump_name load_side_reference_flow_rate "
                    "source_side_reference_flow_rate heat_recovery_reference_flow_rate reference_capacity "
                    "reference_coefficient_of_performance"),
    "airconditioner:variablerefrigerantflow":
        "name availability_schedule_name gross_rated_total_cooling_capacity gross_rated_cooling_cop "
        "minimum_condenser_inlet_node_temperature_in_cooling_mode "
        "maximum_condenser_inlet_node_temperature_in_cooling_mode "
        "cooling_capacity_ratio_modifier_function_of_low_temperature_curve_name "
        "cooling_capacity_ratio_boundary_curve_name "
        "cooling_capacity_ratio_modifier_function_of_high_temperature_curve_name "
        "cooling_energy_input_ratio_modifier_function_of_low_temperature_curve_name "
        "cooling_energy_input_ratio_boundary_curve_name "
        "cooling_energy_input_ratio_modifier_function_of_high_temperature_curve_name "
        "cooling_energy_input_ratio_modifier_function_of_low_part_load_ratio_curve_name "
        "cooling_energy_input_ratio_modifier_function_of_high_part_load_ratio_curve_name "
        "cooling_combination_ratio_correction_factor_curve_name cooling_part_load_fraction_correlation_curve_name "
        "gross_rated_heating_capacity rated_heating_capacity_sizing_ratio gross_rated_heating_cop",
    "coil:heating:gas:multistage":
        "name availability_schedule_name air_inlet_node_name air_outlet_node_name temperature_setpoint_node_name "
        "part_load_fraction_correlation_curve_name off_cycle_parasitic_gas_load number_of_stages "
        "stage_1_gas_burner_efficiency",
    "coil:heating:electric:multistage":
        "name availability_schedule_name air_inlet_node_name air_outlet_node_name temperature_setpoint_node_name "
        "number_of_stages stage_1_efficiency",
    "boiler:steam": "name fuel_type maximum_operating_pressure theoretical_efficiency",
    "zonehvac:baseboard:convective:electric": f"{_BASEBOARD} efficiency",
    "zonehvac:baseboard:radiantconvective:electric": f"{_BASEBOARD} efficiency",
    "zonehvac:hightemperatureradiant":
        _BASEBOARD.replace("heating_design_capacity_method", "zone_name heating_design_capacity_method") +
        " fuel_type combustion_efficiency",
    "zonehvac:energyrecoveryventilator":
        "name availability_schedule_name heat_exchanger_name supply_air_flow_rate exhaust_air_flow_rate "
        "supply_air_fan_name exhaust_air_fan_name controller_name ventilation_rate_per_unit_floor_area "
        "ventilation_rate_per_occupant",
    "heatexchanger:airtoair:sensibleandlatent":
        "name availability_schedule_name nominal_supply_air_flow_rate sensible_effectiveness_at_100_heating_air_flow",
    "schedule:constant": "name schedule_type_limits_name hourly_value",
    "schedule:file": "name schedule_type_limits_name file_name column_number rows_to_skip_at_top "
                     "number_of_hours_of_data column_separator interpolate_to_timestep minutes_per_item",
    "runperiod": "name begin_month begin_day_of_month begin_year end_month end_day_of_month end_year "
                 "day_of_week_for_start_day",
    "schedule:compact": "name schedule_type_limits_name",
    "schedule:year": "name schedule_type_limits_name",
    "schedule:week:daily": " ".join(word if word == "name" else f"{word}_schedule_day_name"
                                    for word in _WEEK.split()),
    "schedule:week:compact": "name",
    "schedule:day:hourly": "name schedule_type_limits_name " + _HOURS,
    "schedule:day:interval": "name schedule_type_limits_name interpolate_to_timestep",
    "schedule:day:list": "name schedule_type_limits_name interpolate_to_timestep minutes_per_item",
}
FIELDS = {kind: names.split() for kind, names in _TABLE.items()}

# Fields that an object can have at most, of classes without a part that repeats which no version made shorter; below,
# classes whose fields are all laid out here.
MOST_FIELDS = {
    "building": 8, "globalgeometryrules": 5, "material": 9, "material:nomass": 6,
    "windowmaterial:simpleglazingsystem": 4, "windowmaterial:glazing": 21, "windowmaterial:gas": 14,
    "windowmaterial:gasmixture": 11, "people": 29, "lights": 17, "electricequipment": 11, "gasequipment": 12,
    "zoneinfiltration:designflowrate": 13, "zoneventilation:designflowrate": 27, "designspecification:outdoorair": 8,
    "exterior:lights": 5, "exterior:fuelequipment": 5, "wateruse:equipment": 10}
WHOLE = ("zone", "zonegroup", "internalmass", "material:airgap", "construction", "thermostatsetpoint:dualsetpoint",
         "thermostatsetpoint:singleheating", "thermostatsetpoint:singlecooling",
         "thermostatsetpoint:singleheatingorcooling", "schedule:constant", "schedule:day:hourly",
         "fenestrationsurface:detailed", "window", "glazeddoor", "door", "window:interzone", "door:interzone",
         "glazeddoor:interzone", "wall:exterior", "wall:adiabatic", "wall:underground", "roof", "ceiling:adiabatic",
         "floor:groundcontact", "floor:adiabatic", "wall:interzone", "ceiling:interzone", "floor:interzone")

_VERTICES = ("vertices", ("vertex_x_coordinate", "vertex_y_coordinate", "vertex_z_coordinate"))
REST = {
    **dict.fromkeys(("buildingsurface:detailed", "wall:detailed", "roofceiling:detailed", "floor:detailed"), _VERTICES),
    "zonehvac:equipmentlist": ("equipment", ("zone_equipment_object_type", "zone_equipment_name")),
    "zonelist": ("zones", ("zone_name",)), "spacelist": ("spaces", ("space_name",)),
    "wateruse:connections": ("connections", ("water_use_equipment_name",)),
    "schedule:compact": ("data", ("field",)),
    "schedule:year": ("schedule_weeks", ("schedule_week_name", "start_month", "start_day", "end_month", "end_day")),
    "schedule:week:compact": ("data", ("daytype_list", "schedule_day_name")),
    "schedule:day:interval": ("data", ("time", "value_until_time")),
    "schedule:day:list": ("extensions", ("value",)),
}
# Fields that a version brought, and the last version of those that went.
SINCE = {(kind, "space_name"): (9, 6) for kind, names in FIELDS.items() if "space_name" in names} | \
    {("internalmass", "space_or_spacelist_name"): (9, 6)} | \
    {(kind, "no_load_supply_air_flow_rate_control_set_to_low_speed"): (24, 1)
     for kind in ("zonehvac:packagedterminalairconditioner", "zonehvac:packagedterminalheatpump")} | \
    {(kind, "crankcase_heater_capacity_function_of_temperature_curve_name"): (23, 2)
     for kind in ("coil:cooling:dx:multispeed", "coil:heating:dx:multispeed")} | \
    {(kind, "availability_schedule_name"): (25, 2)
     for kind in FIELDS if kind.endswith("watertoairheatpump:equationfit")} | \
    {(kind, name): (24, 2) for kind in FIELDS if kind.startswith("heatpump:plantloop:eir:")
     for name in FIELDS[kind] if name.startswith("heat_recovery_")} | \
    {("zonehvac:idealloadsairsystem", name): (24, 2)
     for name in FIELDS["zonehvac:idealloadsairsystem"] if "_fuel_" in name} | \
    {("runperiod", "begin_year"): (9, 0), ("runperiod", "end_year"): (9, 0)}
# Names in epJSON files before 9.6.
FORMER = {"zone_or_zonelist_or_space_or_spacelist_name": ("zone_or_zonelist_name", "zone_name")}
UNTIL = {("fenestrationsurface:detailed", "shading_control_name"): (8, 9)}
