"""Areas, directions and volumes of an EnergyPlus file's zones.

Area and normal of a polygon by Newell's sum; volume by the divergence theorem, or floor times height where the
surfaces do not close. Surfaces by length and height (Wall:Exterior and its kin) are rectangles with a corner, an
azimuth and a tilt, turned as vertices are. A surface whose outside is another zone is one of that zone, too, seen from
there. Source: EnergyPlus Input Output Reference, Group Thermal Zone Description. Leaves out the origin of zones, which
turns nothing, but where a surface is seen from another.
"""
import math
from dataclasses import dataclass, field

import numpy as np

from new_job.idf import Object, number_of

DETAILED = ("BuildingSurface:Detailed", "Wall:Detailed", "RoofCeiling:Detailed", "Floor:Detailed")
# By length and height: what lies outside.
BY_LENGTH = {"Wall:Exterior": "outdoors", "Wall:Adiabatic": "adiabatic", "Wall:Underground": "ground",
             "Wall:Interzone": "surface", "Roof": "outdoors", "Ceiling:Adiabatic": "adiabatic",
             "Ceiling:Interzone": "surface", "Floor:GroundContact": "ground", "Floor:Adiabatic": "adiabatic",
             "Floor:Interzone": "surface"}
USUAL_TILT = {"wall": 90, "roof": 0, "ceiling": 0, "floor": 180}   # deg, where none is given
# Constructions that bring their own ground: EnergyPlus takes outdoor air behind them.
F_FACTOR = "Construction:FfactorGroundFloor"
C_FACTOR = "Construction:CfactorUndergroundWall"
OPENINGS = ("FenestrationSurface:Detailed", "Window", "GlazedDoor", "Door", "Window:Interzone", "GlazedDoor:Interzone",
            "Door:Interzone")
ACROSS = ("zone", "space", "surface")   # boundaries that may name another zone, which then has the surface, too
OTHER_SIDE = {"floor": "ceiling", "ceiling": "floor", "roof": "floor"}   # what a surface is from there
MOST_OPEN = 0.02               # of a zone's surface, by which its normals may fail to close


@dataclass(eq=False)           # a zone is itself
class Zone:
    """Areas in m2 and volumes in m3 of one; `multiplier` zones are alike."""
    name: str
    given: object
    turn: float                # deg, of its y axis from north
    multiplier: float
    surfaces: list = field(default_factory=list)
    area: float = 0
    volume: float = 0
    height: float = 0
    middle: float = 0          # m above ground
    is_conditioned: bool = False
    counts: bool = True        # part of the total floor area


@dataclass
class Surface:
    given: object
    zone: Zone
    points: np.ndarray         # (n, 3) m
    vector: np.ndarray         # area times outward normal, m2, in the zone's axes
    outside: str               # its boundary condition, in small letters
    openings: list = field(default_factory=list)
    is_mirrored: bool = False  # seen from behind: the first layer of its construction is inside

    @property
    def gross(self):
        return float(np.linalg.norm(self.vector))

    @property
    def net(self):
        return max(0.0, self.gross - sum(opening.area for opening in self.openings))

    @property
    def tilt(self):
        """[deg] 0 faces up."""
        return math.degrees(math.acos(max(-1, min(1, self.vector[2] / self.gross)))) if self.gross else 90

    @property
    def azimuth(self):
        """[deg] clockwise from north."""
        return (math.degrees(math.atan2(self.vector[0], self.vector[1])) + self.zone.turn) % 360

    @property
    def kind(self):
        said = self.given.word("surface_type")
        return said or self.given.kind.lower().partition(":")[0]


@dataclass
class Opening:
    given: object
    area: float
    is_glass: bool


def vector_of(points):
    return 0.5 * np.cross(points, np.roll(points, -1, axis=0)).sum(axis=0)


def points_of(given, groups):
    found = [[number_of(given, "vertices", said, -1e5, 1e5) for said in group] for group in groups if any(group)]
    if len(found) < 3 or any(len(point) != 3 for point in found):
        given.refuse("vertices", f"has {len(found)} vertices, or one without its three coordinates; expected three or "
                                 "more of x, y, z")
    return np.array(found)


def rectangle_of(given):
    """(4, 3) corners from the lower left one, seen from outside against the clock."""
    usual = USUAL_TILT[given.kind.lower().partition(":")[0]]
    azimuth = math.radians(given.number("azimuth_angle", 0, -360, 720))
    tilt = math.radians(given.number("tilt_angle", usual, 0, 180))
    corner = np.array([given.number(f"starting_{axis}_coordinate", 0, -1e5, 1e5) for axis in "xyz"])
    length, height = (given.number(key, 0, 0, 1e4) for key in ("length", "width" if usual != 90 else "height"))
    across = length * np.array([-math.cos(azimuth), math.sin(azimuth), 0])
    up = height * np.array([-math.sin(azimuth) * math.cos(tilt), -math.cos(azimuth) * math.cos(tilt), math.sin(tilt)])
    return np.array([corner, corner + across, corner + across + up, corner + up])


def list_of_zones(model):
    """{name: multiplier} of the groups."""
    factors = {}
    for group in model.all("ZoneGroup"):
        of_list = model.need(group, "zone_list_name", "ZoneList")
        for (name,) in of_list.rest:
            factors[name.lower()] = group.number("zone_list_multiplier", 1, 0, 1e4)
    return factors


def read_zones(model):
    """{name: Zone} with surfaces and openings; areas and volumes are set."""
    rules = next(iter(model.all("GlobalGeometryRules")), None)
    building = next(iter(model.all("Building")), None)
    is_relative = rules is None or rules.word("coordinate_system", "relative") != "world"
    is_clockwise = rules is not None and rules.word("vertex_entry_direction").startswith("clockwise")
    north = building.number("north_axis", 0) if building and is_relative else 0
    groups = list_of_zones(model)
    zones = {}
    for each in model.all("Zone"):
        refuse_twice(each, zones)
        turn = north + (each.number("direction_of_relative_north", 0) if is_relative else 0)
        factor = each.number("multiplier", 1, 0, 1e4) * groups.get(each.name.lower(), 1)
        zones[each.name.lower()] = Zone(each.name, each, turn, factor,
                                        counts=each.word("part_of_total_floor_area", "yes") != "no")
    surfaces = add_surfaces(model, zones, -1 if is_clockwise else 1)
    mirror(model, zones, surfaces, is_relative)
    for zone in zones.values():
        measure(zone)
    return zones


def refuse_twice(each, known):
    """A name that is there already: EnergyPlus would not run."""
    if each.name.lower() in known:
        each.refuse("name", "is defined twice; expected a name of its own for each")


def add_surfaces(model, zones, sign):
    """{name: Surface}, which are put into their zones, with openings."""
    surfaces = {}
    for each in model.all(*DETAILED, *BY_LENGTH):
        zone = zones.get(each.word("zone_name"))
        if zone is None:
            each.refuse("zone_name", f"{each.text('zone_name')!r} is no Zone of the file; expected one of its zones")
        refuse_twice(each, surfaces)
        surfaces[each.name.lower()] = made = surface_of(model, each, zone, sign)
        zone.surfaces.append(made)
    for each in model.all(*OPENINGS):
        owner = surfaces.get(each.word("building_surface_name"))
        if owner is None:
            each.refuse("building_surface_name", f"{each.text('building_surface_name')!r} is no surface of the file; "
                                                 "expected the name of a BuildingSurface:Detailed")
        owner.openings.append(opening_of(each))
    return surfaces


def zone_behind(model, zones, surfaces, surface):
    """The other zone that a surface's boundary names, as a zone or a space; None of other boundaries."""
    name = surface.given.word("outside_boundary_condition_object")
    if surface.outside not in ACROSS or not name or name in surfaces:
        return None
    space = model.find(name, "Space")
    found = zones.get(space.word("zone_name") if space else name)
    return found if found is not surface.zone else None


def mirror(model, zones, surfaces, is_relative):
    """Puts a surface whose outside is another zone into that one, too, as EnergyPlus does."""
    for surface in surfaces.values():
        other = zone_behind(model, zones, surfaces, surface)
        if other is not None:
            other.surfaces.append(from_behind(surface, other, is_relative))


def from_behind(surface, other, is_relative):
    """A surface as the zone behind it has it; it shares its openings."""
    given = surface.given
    kind = OTHER_SIDE.get(surface.kind, surface.kind)
    made = Object(given.file, given.kind, {
        **given.fields, "name": f"{given.name} from {other.name}", "surface_type": kind, "zone_name": other.name,
        "space_name": "", "outside_boundary_condition": "surface", "outside_boundary_condition_object": given.name})
    points = surface.points
    if is_relative:
        points = (points @ rotation(surface.zone.turn) + origin(surface.zone) - origin(other)) @ rotation(-other.turn)
    return Surface(made, other, points[::-1], -surface.vector @ rotation(surface.zone.turn - other.turn), "surface",
                   surface.openings, True)


def rotation(turn):
    """(3, 3) matrix behind a row (x, y, z): clockwise by degrees, as north axes turn."""
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def origin(zone):
    """Of a zone in the axes of the world; EnergyPlus turns it with the building, not with the zone."""
    north = zone.turn - zone.given.number("direction_of_relative_north", 0)
    return np.array([zone.given.number(f"{axis}_origin", 0) for axis in "xyz"]) @ rotation(north)


def surface_of(model, given, zone, sign):
    outside = next((says for kind, says in BY_LENGTH.items() if kind.lower() == given.kind.lower()), None)
    if outside is None:
        points = points_of(given, given.rest)
        return Surface(given, zone, points, sign * vector_of(points), given.word("outside_boundary_condition"))
    if outside == "ground" and model.find(given.text("construction_name"), F_FACTOR, C_FACTOR):
        outside = "groundfcfactormethod"
    points = rectangle_of(given)
    return Surface(given, zone, points, vector_of(points), outside)


def opening_of(each):
    factor = each.number("multiplier", 1, 0, 1e4)
    kind = each.word("surface_type") or each.kind.lower().partition(":")[0]
    if each.kind.lower() == "fenestrationsurface:detailed":
        groups = [[each.text(f"vertex_{k}_{axis}_coordinate") for axis in "xyz"] for k in range(1, 5)]
        area = float(np.linalg.norm(vector_of(points_of(each, groups))))
    else:
        area = each.number("length", 0, 0, 1e4) * each.number("height", 0, 0, 1e4)
    return Opening(each, area * factor, kind != "door")


def measure(zone):
    """Floor area, height and volume, as given or by the surfaces."""
    if not zone.surfaces:
        return
    height = np.array([(s.points[:, 2].min(), s.points[:, 2].max()) for s in zone.surfaces])
    low, high = height[:, 0].min(), height[:, 1].max()
    zone.middle = (low + high) / 2 + zone.given.number("z_origin", 0)
    floors = sum(s.gross for s in zone.surfaces if s.kind == "floor")
    zone.area = given_or(zone, "floor_area", floors)
    zone.height = given_or(zone, "ceiling_height", high - low)
    zone.volume = given_or(zone, "volume", volume_of(zone, floors))


def given_or(zone, key, found):
    """What the zone's own field says, if it is above 0: -9999 is EnergyPlus's own "not given"."""
    given = zone.given.number(key, 0)
    return given if given > 0 else found


def volume_of(zone, floors):
    vectors = sum(s.vector for s in zone.surfaces)
    if np.linalg.norm(vectors) > MOST_OPEN * sum(s.gross for s in zone.surfaces):
        return floors * zone.height
    middle = np.mean([s.points.mean(axis=0) for s in zone.surfaces], axis=0)
    return abs(sum(float(np.dot(s.vector, s.points[0] - middle)) for s in zone.surfaces)) / 3
