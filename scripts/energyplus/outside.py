"""Hooks of weather, walls and windows.

A facade is one of eight directions, or the roof, as in the job. Sun that comes or goes is a share of what windows
transmit. Leaves out what panes absorb of it, and films: a shift of the boundary acts at 1 / 0.04 W/(m2 K) of ISO 6946.
"""
from energyplus import parameters
from energyplus.changes import PREFIX
from energyplus.parameters import as_read
from energyplus.place import HOURS_OF_ROOM, CannotEnter, internal, is_constant, program, rooms, sensors_of_room
from new_job import idf_envelope, idf_geometry
from new_job.refused import Refused

H_OUTSIDE = 25                 # W/(m2 K), 1 / 0.04 of ISO 6946: a shift of the boundary as heat on the outer face
SOURCES, SOURCE = "SurfaceProperty:HeatBalanceSourceTerm", "outside_face_heat_source_term_schedule_name"
SIDES = ("north", "north-east", "east", "south-east", "south", "south-west", "west", "north-west")
ROOF_TILT = 22.5               # deg, below which a window is the roof's


def warm_outdoors(at):
    at.of_year(at.values)


def shift_air(at, component, kind, control, series):
    """Several effects add up."""
    known = at.changes.actuators.get((component.lower(), control))
    act = known or at.changes.actuator(component, kind, control)
    at.changes.add_line(f"SET {act} = {known or at.changes.sensor(HOURS_OF_ROOM[1], '*')} + {series}")


def warm_supply(at):
    """Outdoor air that zones and air systems take in."""
    series = at.changes.sensor("Schedule Value", at.series(at.values))
    for zone in rooms(at):
        shift_air(at, zone, "Zone", "Outdoor Air Drybulb Temperature", series)
    for node, _ in at.model.all("OutdoorAir:Node"):
        shift_air(at, node, "Outdoor Air System Node", "Drybulb Temperature", series)


def outer(at, kinds):
    """Names of surfaces to outdoors."""
    return [name for kind in kinds for name, fields in at.model.all(kind)
            if fields.get("outside_boundary_condition", "").lower() == "outdoors"]


def warm_walls(at):
    """The shift of the boundary as heat on outer faces: K times 1 / 0.04 W/(m2 K). Several effects add up."""
    names = outer(at, parameters.SURFACES[:3])
    if not names:
        raise CannotEnter("the model has no opaque surface to outdoors that is described by its corners")
    known = next((fields[SOURCE] for name, fields in at.model.all(SOURCES) if name.startswith(PREFIX)), None)
    if known:
        at.changes.series[known] = at.changes.series[known] + at.values * H_OUTSIDE
        return
    series = at.series(at.values * H_OUTSIDE)
    for name in names:
        at.model.add(SOURCES, at.changes.new_name(f"{at.effect.name} {name}"), {"surface_name": name, SOURCE: series})


def geometry(at):
    try:
        return idf_geometry.read_zones(as_read(at.model))
    except Refused as error:
        raise CannotEnter(f"its geometry is not read: {error}") from None


def facade_of(surface):
    return "roof" if surface.tilt < ROOF_TILT else SIDES[round(surface.azimuth / 45) % 8]


def windows(at):
    """[(zone, opening, surface)] of conditioned zones on the effect's facade."""
    conditioned, facade = {zone.lower() for zone in at.model.conditioned()}, at.effect.says("facade")
    found = [(zone.given.name, opening, surface) for key, zone in geometry(at).items() if key in conditioned
             for surface in zone.surfaces if surface.outside == "outdoors" for opening in surface.openings
             if opening.is_glass and facade in ("", facade_of(surface))]
    if not found:
        raise CannotEnter(f"there is no window{' to the ' + facade if facade else ''}")
    return found


def warm_windows(at):
    """The air that windows see."""
    names = [opening.given.name for _, opening, _ in windows(at)]
    series = at.changes.sensor("Schedule Value", at.series(at.values))
    for name in names:
        shift_air(at, name, "Surface", "Outdoor Air Drybulb Temperature", series)


def change_sun(at):
    """The share of the sun through windows that comes or goes, as radiant heat in the zone."""
    series, of_zone = at.changes.sensor("Schedule Value", at.series(at.values)), {}
    for zone, opening, _ in windows(at):
        of_zone.setdefault(zone, []).append(
            at.changes.sensor("Surface Window Transmitted Solar Radiation Rate", opening.given.name))
    for zone, suns in of_zone.items():
        program(at, zone, at.effect.name, ["SET {heat} = 0", *(f"SET {{heat}} = {{heat}} + {sun}" for sun in suns),
                                           f"SET {{heat}} = {{heat}} * {series}"], radiant=1.0)


def change_walls(at):
    """A constant factor on U-values is that; one of time is its share of the heat that outer surfaces conduct."""
    if is_constant(at):
        for name in parameters.OPAQUE:
            parameters.scale_opaque(at.model, name, 1 + at.values.max())
        return
    series, conditioned = at.changes.sensor("Schedule Value", at.series(at.values)), set(rooms(at))
    of_zone = {}
    for kind in parameters.SURFACES[:3]:
        for name, fields in at.model.all(kind):
            zone = next(iter(at.model.zones_named(fields.get("zone_name", ""))), None)
            if zone in conditioned and fields.get("outside_boundary_condition", "").lower() == "outdoors":
                of_zone.setdefault(zone, []).append(
                    at.changes.sensor("Surface Inside Face Conduction Heat Transfer Rate", name))
    for zone, flows in of_zone.items():
        program(at, zone, at.effect.name, ["SET {heat} = 0", *(f"SET {{heat}} = {{heat}} + {flow}" for flow in flows),
                                           f"SET {{heat}} = {{heat}} * {series}"], radiant=1.0)


def change_glass(at):
    """A constant factor on U-values is that; one of time is its share of U A times the difference of temperature."""
    if is_constant(at):
        parameters.scale_windows(at.model, "u_factor", 1 + at.values.max())
        return
    series, read, of_zone = at.changes.sensor("Schedule Value", at.series(at.values)), as_read(at.model), {}
    for zone, opening, _ in windows(at):
        of_zone[zone] = of_zone.get(zone, 0) + opening.area * idf_envelope.glazing_of(read, opening.given).u_value
    for zone, conductance in of_zone.items():
        room, outdoor = sensors_of_room(at, zone)
        program(at, zone, at.effect.name, [f"SET {{heat}} = {conductance:.4f} * {outdoor} - {conductance:.4f} * {room}",
                                           f"SET {{heat}} = {{heat}} * {series}"], radiant=0.5)


def add_neighbour(at):
    """A conductance per floor area to another temperature, which the effect has to say."""
    column = at.effect.more.get("temperature")
    if not isinstance(column, (int, float)):
        raise CannotEnter("its series has the conductance, but no key says the temperature behind it")
    series = at.changes.sensor("Schedule Value", at.series(at.values))
    for zone in rooms(at):
        (room, _), area = sensors_of_room(at, zone), internal(at, zone, "Zone Floor Area")
        program(at, zone, at.effect.name, [f"SET {{heat}} = {column} * {area} - {room} * {area}",
                                           f"SET {{heat}} = {{heat}} * {series}"], radiant=0.5)
