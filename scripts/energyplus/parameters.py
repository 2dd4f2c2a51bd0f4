"""A table from parameters to what they change in a model: class, fields, and how.

Factors are on what the model says; set-points are shifted in K; U-values of walls and roofs by the resistance of the
layer that insulates most, with the films of ISO 6946; windows of panes become simple glazing systems of the U-value and
g by EN 673 and EN 410, but stay as they are while both factors are 1. Sizes that EnergyPlus finds follow by themselves.
Leaves out F and C factors, and windows whose glass is given by wavelength.
"""
import copy
import difflib
from fnmatch import fnmatch

from energyplus.changes import Term
from energyplus.failed import Failed
from new_job import idf, idf_envelope, idf_ideal
from new_job.refused import Refused

FLOWS = ("design_flow_rate", "flow_rate_per_floor_area", "flow_rate_per_exterior_surface_area", "flow_rate_per_person",
         "air_changes_per_hour")
LEVELS = ("lighting_level", "design_level", "watts_per_floor_area", "watts_per_person", "power_per_floor_area",
          "power_per_person")
FRESH_AIR = ("outdoor_air_flow_per_person", "outdoor_air_flow_per_zone_floor_area", "outdoor_air_flow_per_zone",
             "outdoor_air_flow_air_changes_per_hour")
# Factors: {parameter: ((class, fields, most), ...)}, perhaps with *; `most` is the largest that EnergyPlus takes.
FACTORS = {
    "infiltration": (("ZoneInfiltration:DesignFlowRate", FLOWS, None),
                     ("ZoneInfiltration:EffectiveLeakageArea", ("effective_air_leakage_area",), None),
                     ("ZoneInfiltration:FlowCoefficient", ("flow_coefficient",), None)),
    "outdoor_air": (("ZoneVentilation:DesignFlowRate", FLOWS, None),
                    ("DesignSpecification:OutdoorAir", FRESH_AIR, None),
                    ("Controller:OutdoorAir", ("minimum_outdoor_air_flow_rate",), None)),
    "lights": (("Lights", LEVELS, None),),
    "equipment": (("ElectricEquipment", LEVELS, None), ("GasEquipment", LEVELS, None)),
    "people": (("People", ("number_of_people", "people_per_floor_area"), None),),
    "heating_efficiency": (("Coil:Heating:Fuel", ("burner_efficiency",), 1),
                           ("Coil:Heating:Gas*", ("*burner_efficiency",), 1),
                           ("Coil:Heating:Electric*", ("*efficiency",), 1),
                           ("Coil:Heating:*", ("*gross_rated_heating_cop",), None),
                           ("Boiler:HotWater", ("nominal_thermal_efficiency",), 1),
                           ("Boiler:Steam", ("theoretical_efficiency",), 1),
                           ("ZoneHVAC:Baseboard:*Electric", ("efficiency",), 1)),
    "cooling_cop": (("Coil:Cooling:*", ("*gross_rated_cooling_cop",), None),
                    ("Coil:Cooling:DX:CurveFit:Speed", ("gross_cooling_cop",), None),
                    ("CoilPerformance:DX:Cooling", ("gross_rated_cooling_cop",), None),
                    ("Chiller:Electric*", ("reference_cop", "nominal_cop"), None),
                    ("Chiller:ConstantCOP", ("nominal_cop",), None)),
}
# Of which mode of ideal loads a parameter is.
EFFICIENCIES = {"heating_efficiency": "heating", "cooling_cop": "cooling"}
# Fields that count things per unit: their factor is the inverse.
INVERSE = {"people": (("People", ("floor_area_per_person",)),)}
# Fields that say which schedule a set-point follows: {parameter: ((class, field), ...)}.
SET_POINTS = {
    "heating_set_point": (("ThermostatSetpoint:DualSetpoint", "heating_setpoint_temperature_schedule_name"),
                          ("ThermostatSetpoint:SingleHeating", "setpoint_temperature_schedule_name"),
                          ("ThermostatSetpoint:SingleHeatingOrCooling", "setpoint_temperature_schedule_name")),
    "cooling_set_point": (("ThermostatSetpoint:DualSetpoint", "cooling_setpoint_temperature_schedule_name"),
                          ("ThermostatSetpoint:SingleCooling", "setpoint_temperature_schedule_name"),
                          ("ThermostatSetpoint:SingleHeatingOrCooling", "setpoint_temperature_schedule_name")),
}
NO_LIMIT = {"heating_set_point": 0, "cooling_set_point": 60}   # degC, at which nothing heats or cools
OPAQUE = ("u_walls", "u_roof")
WINDOWS = {"u_windows": "u_factor", "g_windows": "solar_heat_gain_coefficient"}
MOST = {"u_factor": 6.9, "solar_heat_gain_coefficient": 0.95}   # what EnergyPlus's simple glazing takes
FILMS = 0.17                   # m2 K/W, both films of a wall: ISO 6946
LEAST_RESISTANCE = 0.005       # m2 K/W, that a layer keeps
SURFACES = ("BuildingSurface:Detailed", "Wall:Detailed", "RoofCeiling:Detailed", "Wall:Exterior", "Roof")
OPENINGS = ("FenestrationSurface:Detailed", "Window", "GlazedDoor")
LAYERS = ("outside_layer", *(f"layer_{k}" for k in range(2, 11)))
SIMPLE = "WindowMaterial:SimpleGlazingSystem"
USUAL = (*FACTORS, *SET_POINTS, *OPAQUE, *WINDOWS)   # all names that need no row of their own
HOW = ("factor", "add", "value")
ROW = ("parameter", "class", "object", "field", "how")   # keys of a row
LEAST_ALIKE, MOST_NAMES = 0.6, 6   # of names that are told as the nearest; told where none is


class NothingChanges(Failed):
    """A parameter that the model has no object for."""


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def apply(model, values, rows, changes, plant):
    """Sets the model to the parameters' values; `changes` takes what set-points need, `plant` efficiencies of ideal
    loads. A parameter that finds nothing to change is a Failed.
    """
    check_rows(values, rows)
    for name, value in values.items():
        if not is_number(value):
            raise Failed(f"parameters: {name}: {value!r} is no number")
        of_rows = [row for row in rows if row.get("parameter") == name]
        count = apply_rows(model, name, value, of_rows) if of_rows else apply_usual(model, name, value, changes, plant)
        if not count:
            raise NothingChanges(f"parameters: {name}: {model.path} has nothing that it changes; take it out of "
                                 "run.json.in and of the job, or give it a row in \"rows\"")


def apply_usual(model, name, value, changes, plant):
    if name in FACTORS:
        return scale(model, FACTORS[name], value) + scale(model, [(*row, None) for row in INVERSE.get(name, ())],
                                                          1 / value if value else 1) + \
            plant.scale(name, value) + scale_fuels(model, name, value, changes, plant)
    if name in SET_POINTS:
        return shift(model, name, value, changes)
    if name in OPAQUE:
        return scale_opaque(model, name, value)
    if name in WINDOWS:
        return scale_windows(model, WINDOWS[name], value)
    raise Failed(f"parameters: {name}: is not known; expected one of {', '.join(USUAL)}, or a row for it in "
                 "\"rows\"" + nearest(name, USUAL))


def scale(model, table, value):
    """Of all objects; the count of fields."""
    return sum(scale_fields(fields, keys, most, value) for kind, keys, most in table for own in model.objects
               if fnmatch(own.lower(), kind.lower()) for _, fields in model.all(own))


def scale_fields(fields, keys, most, value):
    count = 0
    for key in [each for each in fields if any(fnmatch(each, key) for key in keys)]:
        if is_number(fields[key]):
            fields[key] = min(fields[key] * value, most or float("inf"))
            count += 1
        elif str(fields[key]).lower() == "autosize":
            count += 1     # EnergyPlus finds it from what is scaled elsewhere
    return count


def shift(model, name, value, changes):
    count = 0
    for kind, key in SET_POINTS[name]:
        for each, fields in model.all(kind):
            if value:
                changes.slot(kind, each, fields, key, NO_LIMIT[name]).terms.append(Term("add", f"{value!r}"))
            count += 1
    return count


def scale_fuels(model, name, value, changes, plant):
    """Of ideal loads with fuels of the model: their schedules of efficiency, of which an empty one is 1."""
    mode = EFFICIENCIES.get(name)
    if mode not in plant.own:
        return 0
    systems = model.all(idf_ideal.SYSTEM)
    for each, fields in systems if value != 1 else ():
        changes.slot(idf_ideal.SYSTEM, each, fields, idf_ideal.FUELS[mode][1]).terms.append(
            Term("factor", f"{value - 1!r}"))
    return len(systems)


def apply_rows(model, name, value, rows):
    """Rows of the user's own: class, object ("*": all), field, how."""
    for row in rows:
        key, how = row.get("field", ""), row.get("how", "value")
        if how not in HOW:
            raise Failed(f"rows: {name}: how: {how!r}; expected one of {', '.join(HOW)}")
        found = objects_of(model, name, row)
        if all(key not in fields for _, fields in model.all(row["class"])) and key not in model.fields_of(row["class"]):
            raise Failed(f"rows: {name}: field: {row['class']} has no {key!r}; EnergyPlus would leave it out"
                         + nearest(key, model.fields_of(row["class"])))
        for each, fields in found:
            own = fields.get(key)
            if how != "value" and not is_number(own):
                raise Failed(f"rows: {name}: {model.path}: {row['class']} {each!r}: {key!r} is "
                             f"{'not there' if own is None else repr(own)}; expected a field with a number"
                             + nearest(key, [each for each in fields if is_number(fields[each])]))
            fields[key] = value if how == "value" else own * value if how == "factor" else own + value
    return len(rows)


def objects_of(model, name, row):
    """[(name, fields)] that a row is of; never empty."""
    kind, said = row.get("class", ""), row.get("object", "*")
    known = model.all(kind)
    if not known:
        raise Failed(f"rows: {name}: class: {model.path} has no {kind!r}" + nearest(kind, model.objects))
    found = [(each, fields) for each, fields in known if said == "*" or each.lower() == str(said).lower()]
    if not found:
        raise Failed(f"rows: {name}: object: {model.path} has no {kind} {said!r}; \"*\" is all of them"
                     + nearest(said, [each for each, _ in known]))
    return found


def nearest(said, known):
    """What was meant, for the end of a message."""
    lower = {each.lower(): each for each in known}
    names = [lower[each] for each in difflib.get_close_matches(str(said).lower(), lower, 3, LEAST_ALIKE)]
    if names:
        return f"; the nearest: {', '.join(map(repr, names))}"
    return f"; there are: {', '.join(map(repr, list(known)[:MOST_NAMES]))}" + ", ..." * (len(known) > MOST_NAMES) \
        if known else ""


def check_rows(values, rows):
    """Keys of rows, and that each is of a parameter."""
    for row in rows:
        unknown = next((key for key in row if key not in ROW), None)
        if unknown is not None:
            raise Failed(f"rows: {unknown!r} is not known; expected keys {', '.join(ROW)}")
        if row.get("parameter") not in values:
            raise Failed(f"rows: parameter: {row.get('parameter')!r} is none of \"parameters\""
                         + nearest(row.get("parameter"), values))


def constructions_of(model, name):
    """Names, in small letters, of what outer walls or roofs are built of; of ceilings below attics, too."""
    conditioned = {zone.lower() for zone in model.conditioned()}
    surfaces = {each.lower(): (kind, fields) for kind in SURFACES for each, fields in model.all(kind)}
    found = set()
    for kind, fields in surfaces.values():
        what = fields.get("surface_type", kind.partition(":")[0]).lower()
        behind = fields.get("outside_boundary_condition", "outdoors" if kind in SURFACES[3:] else "").lower()
        if behind == "outdoors" and what == ("wall" if name == "u_walls" else "roof"):
            found.add(fields["construction_name"].lower())
        other = surfaces.get(str(fields.get("outside_boundary_condition_object", "")).lower())
        if name == "u_roof" and behind == "surface" and what == "ceiling" and other and \
                fields.get("zone_name", "").lower() in conditioned and \
                other[1].get("zone_name", "").lower() not in conditioned:
            found |= {fields["construction_name"].lower(), other[1]["construction_name"].lower()}
    return found


def resistance(kind, fields):
    if kind == "Material":
        return fields["thickness"] / fields["conductivity"]
    return fields.get("thermal_resistance", 0)


def scale_opaque(model, name, value):
    materials = {each.lower(): (kind, each, fields) for kind in ("Material", "Material:NoMass", "Material:AirGap")
                 for each, fields in model.all(kind)}
    count, named = 0, constructions_of(model, name)
    for each, fields in model.all("Construction"):
        if each.lower() not in named:
            continue
        layers = [(key, *materials[str(fields[key]).lower()]) for key in LAYERS
                  if str(fields.get(key)).lower() in materials]
        if layers:
            insulate(model, fields, layers, name, value)
            count += 1
    return count


def insulate(model, construction, layers, name, value):
    """The U-value times `value`, by the layer of the largest resistance, of which the construction gets its own."""
    key, kind, material, own = max(layers, key=lambda layer: resistance(layer[1], layer[3]))
    total = FILMS + sum(resistance(layer[1], layer[3]) for layer in layers)
    wanted = max(resistance(kind, own) + total / max(value, 1e-3) - total, LEAST_RESISTANCE)
    made = f"{material} for {name} {value:g}"
    of_this = f"{made} {wanted:.4g}"
    if model.find(kind, of_this) is None:
        fields = copy.deepcopy(own)
        if kind == "Material":
            fields["conductivity"] = fields["thickness"] / wanted
        else:
            fields["thermal_resistance"] = wanted
        model.add(kind, of_this, fields)
    construction[key] = of_this


def glazed(model):
    """Names, in small letters, of constructions of windows."""
    return {fields["construction_name"].lower() for kind in OPENINGS for _, fields in model.all(kind)
            if fields.get("surface_type", "Window").lower() != "door"}


def scale_windows(model, key, value):
    """Of each construction its own simple glazing system, scaled; none at 1."""
    count, named = 0, glazed(model)
    for each, fields in model.all("Construction"):
        if each.lower() in named and "windowmaterial" in kind_of_layer(model, fields["outside_layer"]):
            count += 1
            if value != 1:
                own = simple_glazing(model, each, fields)
                own[key] = min(own[key] * value, MOST[key])
    return count


def kind_of_layer(model, name):
    return next((kind.lower() for kind in model.objects if "material" in kind.lower() and
                 model.find(kind, name) is not None), "")


def simple_glazing(model, name, construction):
    """Fields of a window's simple glazing system, which stands in place of its panes."""
    made = f"{name} as a simple glazing system"
    known = model.find(SIMPLE, made)
    if known is not None:
        return known
    own = model.find(SIMPLE, construction["outside_layer"])
    if own is None:
        u_value, solar = panes(model, name)
        own = {"u_factor": u_value, "solar_heat_gain_coefficient": solar}
    model.add(SIMPLE, made, copy.deepcopy(own))
    for key in LAYERS[1:]:
        construction.pop(key, None)
    construction["outside_layer"] = made
    return model.find(SIMPLE, made)


def panes(model, name):
    """(U-value, g) of the layers of a construction."""
    try:
        read = as_read(model)
        glazing = idf_envelope.glazing_of(read, idf.Object(model.path, "Window", {"construction_name": name}))
    except Refused as error:
        raise Failed(f"u_windows, g_windows: {error}") from None
    return glazing.u_value, glazing.solar


def as_read(model):
    """The same objects, as the reader of `bemcal-batch new --idf` holds them."""
    return idf.Model(model.path, [idf.of_json(model.path, kind, name, fields)
                                  for kind, named in model.objects.items() for name, fields in named.items()])


