"""Hooks of weather, walls and windows.

A facade is one of eight directions, or the roof, as in the job. Sun that comes or goes is a share of what windows
transmit. A shift of the boundary is heat on the outer face, by its film as EnergyPlus last found it. A conductance that
changes in some hours is a share of the steady heat from face to face. Leaves out what panes absorb of less sun, and
what walls store of more heat.
"""
from energyplus import parameters
from energyplus.parameters import as_read
from energyplus.place import (HOURS_OF_ROOM, CannotEnter, internal, is_constant, nodes_of, program, rooms,
                              sensors_of_room)
from new_job import idf_envelope, idf_geometry
from new_job.refused import Refused

# Parts of an outer face's film [W/(m2 K)], as outputs of EnergyPlus.
FILM = tuple(f"Surface Outside Face {part} Heat Transfer Coefficient" for part in (
    "Convection", "Thermal Radiation to Sky", "Thermal Radiation to Ground", "Thermal Radiation to Air"))
FACES = "Surface Outside Face Temperature", "Surface Inside Face Temperature"
SOURCES, SOURCE = "SurfaceProperty:HeatBalanceSourceTerm", "outside_face_heat_source_term_schedule_name"
SIDES = ("north", "north-east", "east", "south-east", "south", "south-west", "west", "north-west")
RADIANT_OF_WALLS, RADIANT_OF_GLASS = 1.0, 0.5   # shares of heat that they give off inside
ROOF_TILT = 22.5               # deg, below which a window is the roof's


def warm_outdoors(at):
    at.of_year(at.values)


def shift_air(at, component, kind, control, series):
    """Several effects add up."""
    known = at.changes.actuators.get((component.lower(), control))
    act = known or at.changes.actuator(component, kind, control)
    at.changes.add_line(f"SET {act} = {known or at.changes.sensor(HOURS_OF_ROOM[1], '*')} + {series}")


def intakes(model):
    """Nodes, in small letters, at which air systems take in outdoor air; that of condensers is none."""
    nodes = {name.lower() for name, _ in model.all("OutdoorAir:Node")}
    for _, fields in model.all("OutdoorAir:NodeList"):
        for row in fields.get("nodes", []):
            nodes |= nodes_of(model, row.get("node_or_nodelist_name", ""))
    condensers = {str(value).lower() for named in model.objects.values() for fields in named.values()
                  for key, value in fields.items() if "condenser" in key and "node" in key}
    return sorted(nodes - condensers)


def warm_supply(at):
    """Outdoor air that zones and air systems take in."""
    series = at.changes.sensor("Schedule Value", at.series(at.values))
    for zone in rooms(at):
        shift_air(at, zone, "Zone", "Outdoor Air Drybulb Temperature", series)
    for node in intakes(at.model):
        shift_air(at, node, "Outdoor Air System Node", "Drybulb Temperature", series)


def outer(at, kinds):
    """Names of surfaces to outdoors."""
    return [name for kind in kinds for name, fields in at.model.all(kind)
            if fields.get("outside_boundary_condition", "").lower() == "outdoors"]


def warm_walls(at):
    """The shift of the boundary [K] times the outer face's film [W/(m2 K)], as heat there. Several effects add up."""
    names = outer(at, parameters.SURFACES[:3])
    if not names:
        raise CannotEnter("the model has no opaque surface to outdoors that is described by its corners")
    if at.changes.of_walls:
        at.changes.series[at.changes.of_walls] = at.changes.series[at.changes.of_walls] + at.values
        return
    at.changes.of_walls = at.series(at.values)
    shift = at.changes.in_program(at.changes.of_walls)
    for name in names:
        heat = at.changes.follow(f"{at.effect.name} {name}", [at.changes.sensor(part, name) for part in FILM], shift)
        at.model.add(SOURCES, at.changes.new_name(f"{at.effect.name} {name}"), {"surface_name": name, SOURCE: heat})


def geometry(at):
    try:
        return idf_geometry.read_zones(as_read(at.model))
    except Refused as error:
        raise CannotEnter(f"its geometry is not read: {error}") from None


def facade_of(surface):
    return "roof" if surface.tilt < ROOF_TILT else SIDES[round(surface.azimuth / 45) % 8]


def windows(at):
    """[(zone, opening, surface)] of conditioned zones on the effect's facade."""
    conditioned = {zone.lower() for zone in at.model.conditioned()}
    facade = at.effect.says("facade").removesuffix(" facade")   # "south facade", "roof"
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
    """A constant factor on U-values is that; one of time is its share of the steady heat through outer surfaces."""
    if is_constant(at):
        for name in parameters.OPAQUE:
            parameters.scale_opaque(at.model, name, 1 + at.values.max())
        return
    conditioned, read = {zone.lower() for zone in at.model.conditioned()}, as_read(at.model)
    found = [(zone.given.name, surface.given.name, surface.net * steady(read, surface.given))
             for key, zone in geometry(at).items() if key in conditioned
             for surface in zone.surfaces if surface.outside == "outdoors"]
    conduct(at, found, RADIANT_OF_WALLS)


def steady(read, surface):
    """[W/(m2 K)] from face to face."""
    try:
        return idf_envelope.opaque_of(read, surface, 0, 0).bare
    except Refused as error:
        raise CannotEnter(f"a U-value is not read: {error}") from None


def change_glass(at):
    """The same of windows."""
    if is_constant(at):
        parameters.scale_windows(at.model, "u_factor", 1 + at.values.max())
        return
    read = as_read(at.model)
    conduct(at, [(zone, opening.given.name, opening.area * without_films(
        idf_envelope.glazing_of(read, opening.given).u_value)) for zone, opening, _ in windows(at)], RADIANT_OF_GLASS)


def without_films(u_value):
    return 1 / max(1 / u_value - parameters.FILMS, parameters.LEAST_RESISTANCE)


def conduct(at, found, radiant):
    """The series' share of the heat through surfaces, in their zones. `found`: (zone, surface, W/K of its faces)."""
    series, of_zone = at.changes.sensor("Schedule Value", at.series(at.values)), {}
    for zone, name, conductance in found:
        outside, inside = (at.changes.sensor(face, name) for face in FACES)
        of_zone.setdefault(zone, []).append(f"{conductance:.4f} * {outside} - {conductance:.4f} * {inside}")
    for zone, flows in of_zone.items():
        program(at, zone, at.effect.name, ["SET {heat} = 0", *(f"SET {{heat}} = {{heat}} + {flow}" for flow in flows),
                                           f"SET {{heat}} = {{heat}} * {series}"], radiant)


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
