"""The envelope of an EnergyPlus file: U-values, glazing, and surfaces that are alike in construction and direction.

U-values have the films of ASHRAE 90.1, as in EnergyPlus's reports; a simple glazing system has its own. Panes: gaps
by EN 673, solar energy by EN 410 with what each pane absorbs. Mass: ISO 13790, 12.3.1, up to 0.1 m, the middle, or
insulation. F factors: U = F P / A. Zones without a thermostat are a factor b on what lies before them (ISO 13789); what
the sun brings their roofs, as to an attic, and what these lose to the sky goes on as heat does. Leaves out shading
objects, frames and dividers, blinds, moisture, and materials that change.
"""
from dataclasses import dataclass, field

import numpy as np

from new_job.idf_fields import MONTHS
from new_job.idf_geometry import C_FACTOR, F_FACTOR

IP = 0.17611                   # m2 K/W of a ft2 h F/Btu
R_OUTSIDE, R_WALL, R_UP, R_DOWN = 0.17 * IP, 0.68 * IP, 0.61 * IP, 0.92 * IP   # m2 K/W, ASHRAE 90.1 A9.4.1
# Behind which the sun warms a surface: ISO 13790's. R_OUTSIDE is that of a winter's wind; over a year EnergyPlus has
# 0.05 at the walls and 0.04 on the roof of DOE's strip mall (../shared/energyplus/so_null's weather).
R_IN_SUN = 0.04
STEEP, OVERHANG = 60, 120      # deg of tilt, between which a surface is a wall
R_GLASS_OUTSIDE = 0.04         # m2 K/W, EN 673: 1/25
R_GLASS_INSIDE = 0.13          # 1/7.7
GAP_TEMPERATURE, GAP_DIFFERENCE = 283, 15   # K, EN 673
SIGMA = 5.67e-8                # W/(m2 K4)
# Conductivity [W/(m K)], density [kg/m3], viscosity [kg/(m s)], heat [J/(kg K)] at 10 degC: EN 673 Table 1.
GASES = {"air": (0.02496, 1.232, 1.761e-5, 1008), "argon": (0.01684, 1.699, 2.164e-5, 519),
         "krypton": (0.0090, 3.560, 2.400e-5, 245), "xenon": (0.00529, 5.689, 2.226e-5, 161)}
ABSORPTANCE, EMISSIVITY = 0.7, 0.9   # EnergyPlus's where none is given
PANE_CONDUCTIVITY = 0.9        # W/(m K), EnergyPlus's default
MASS_DEPTH = 0.1               # m
CAPACITIES = (80000, 600000)   # J/(m2 K) of floor, to which the capacity of the layers is cut
INSULATION, INSULATION_R = 0.1, 0.3   # W/(m K) and m2 K/W, from which a layer is insulation
AIR = 0.34                     # Wh/(m3 K)
SOIL_R = (0.0607, 0.3479)      # m2 K/W and m2 K/W per m of depth: EnergyPlus Engineering Reference, C-factor walls
# What the job calls the ground, and {of it: (class, what a month has that is not given [degC])}.
GROUND, FACTOR_GROUND = "ground", "ground of F and C factors"
GROUND_CLASSES = {GROUND: ("Site:GroundTemperature:BuildingSurface", 18),
                  FACTOR_GROUND: ("Site:GroundTemperature:FCfactorMethod", 13)}
GROUNDS = ("ground", "foundation", "groundslabpreprocessoraverage", "groundslabpreprocessorcore",
           "groundslabpreprocessorperimeter", "groundbasementpreprocessoraveragewall",
           "groundbasementpreprocessoraveragefloor")
ROOF_VEGETATION = "Material:RoofVegetation"   # its soil is a layer; plants and water are left out
USUAL_SOIL = {"thickness": 0.1, "conductivity_of_dry_soil": 0.35}   # m, W/(m K): EnergyPlus's where none is given
LAYERS = ("Material", "Material:NoMass", "Material:AirGap", ROOF_VEGETATION)
GLASS = ("WindowMaterial:SimpleGlazingSystem", "WindowMaterial:Glazing")
GAPS = ("WindowMaterial:Gas", "WindowMaterial:GasMixture")


@dataclass
class Part:
    """Surfaces or windows that are alike."""
    construction: str
    azimuth: int               # deg
    tilt: int                  # deg
    boundary: str = "outdoors"
    adjustment: float = 1
    area: float = 0            # m2, times multipliers


@dataclass
class Opaque:
    """`bare`: without films, W/(m2 K)."""
    name: str
    u_value: float
    bare: float
    absorptance: float
    emissivity: float
    r_outside: float

    def film_in_sun(self):
        """[m2 K/W], where a share of what passes has the sun, that share of it."""
        return self.r_outside * R_IN_SUN / R_OUTSIDE


@dataclass
class Buffer:
    """A zone without a thermostat: its factor b, and the outer face that it gives what lies below its roof."""
    factor: float
    absorptance: float = 0
    emissivity: float = 0
    r_outside: float = 0       # m2 K/W; 0 without a roof in the sun


@dataclass
class Glazing:
    name: str
    u_value: float
    solar: float
    says: str


@dataclass
class Shell:
    """The envelope of the conditioned zones."""
    opaque: dict = field(default_factory=dict)     # {name: Opaque}
    glazing: dict = field(default_factory=dict)
    surfaces: dict = field(default_factory=dict)   # {key: Part}
    windows: dict = field(default_factory=dict)
    heat_capacity: float = 0                       # J/K
    adiabatic: float = 0                           # m2
    between: dict = field(default_factory=dict)    # {other conditioned zone: W/K}
    grounds: dict = field(default_factory=dict)    # {boundary: (12,) degC}

    @property
    def conductance(self):
        """[W/K] of all parts."""
        return sum(p.area * p.adjustment * self.opaque[p.construction].u_value for p in self.surfaces.values()) + \
            sum(p.area * self.glazing[p.construction].u_value for p in self.windows.values())

    def capacity(self, area):
        """[J/(m2 K)] of a floor area."""
        return min(max(self.heat_capacity / area, CAPACITIES[0]), CAPACITIES[1])


def ground_temperatures(model):
    """{boundary: (12,) degC}. What has F and C factors without temperatures lies outdoors."""
    found = {GROUND: np.full(len(MONTHS), float(GROUND_CLASSES[GROUND][1]))}
    for name, (kind, usual) in GROUND_CLASSES.items():
        for each in model.all(kind):
            found[name] = np.array([each.number(f"{month}_ground_temperature", usual, -50, 60) for month in MONTHS])
    return found


def film(tilt):
    return R_UP if tilt < STEEP else R_DOWN if tilt > OVERHANG else R_WALL


def layers_of(model, construction):
    """Objects of the layers, the first outside."""
    keys = ("outside_layer", *(f"layer_{k}" for k in range(2, 11)))
    return [model.need(construction, key, *LAYERS, *GLASS, *GAPS) for key in keys if construction.text(key)]


def resistance(layer):
    """[m2 K/W]"""
    if not is_solid(layer):
        return need_number(layer, "thermal_resistance", 0, 1e3)
    return layer_number(layer, "thickness", 1e-9, 100) / layer_number(layer, of_soil(layer, "conductivity"), 1e-4, 1e4)


def is_solid(layer):
    return layer.kind.lower() in ("material", ROOF_VEGETATION.lower())


def of_soil(layer, key):
    """Name of a field of a Material, or of the dry soil of a green roof."""
    return f"{key}_of_dry_soil" if layer.kind.lower() == ROOF_VEGETATION.lower() else key


def layer_number(layer, key, least, most):
    """A green roof has EnergyPlus's own where its field is empty; of a Material it has to be there."""
    usual = USUAL_SOIL.get(key) if layer.kind.lower() == ROOF_VEGETATION.lower() else None
    return need_number(layer, key, least, most) if usual is None else layer.number(key, usual, least, most)


def need_number(thing, key, least, most):
    value = thing.number(key, None, least, most)
    if value is None:
        thing.refuse(key, f"is empty; expected a number from {least:g} to {most:g}")
    return value


def opaque_of(model, surface, r_inside, r_outside):
    """Of a surface or door."""
    construction = model.need(surface, "construction_name", "Construction", F_FACTOR, C_FACTOR)
    kind = construction.kind.lower()
    if kind == F_FACTOR.lower():
        area = need_number(construction, "area", 0.01, 1e7)
        u = need_number(construction, "f_factor", 0, 100) * construction.number("perimeterexposed", 0, 0, 1e6) / area
        return Opaque(construction.name, u, u, ABSORPTANCE, EMISSIVITY, 0)
    if kind == C_FACTOR.lower():
        depth = need_number(construction, "height", 0.01, 100)
        bare = 1 / (1 / need_number(construction, "c_factor", 0.001, 100) + SOIL_R[0] + SOIL_R[1] * depth)
        return Opaque(construction.name, 1 / (1 / bare + r_inside), bare, ABSORPTANCE, EMISSIVITY, 0)
    layers = layers_of(model, construction)
    if any(layer.kind.lower().startswith("windowmaterial") for layer in layers) or not layers:
        construction.refuse("outside_layer", "has no opaque layers, but a surface or door is of it; expected Material")
    total = sum(resistance(layer) for layer in layers)
    outer = layers[0]
    return Opaque(construction.name, 1 / (total + r_inside + r_outside), 1 / max(total, 1e-9),
                  outer.number("solar_absorptance", ABSORPTANCE, 0, 1),
                  outer.number("thermal_absorptance", EMISSIVITY, 0, 1), r_outside)


def gap_conductance(gap, emissivity, other):
    """[W/(m2 K)] of a vertical one: EN 673."""
    kind = (gap.word("gas_type") or gap.word("gas_1_type", "air"))
    conductivity, density, viscosity, heat = GASES.get(kind, GASES["air"])
    width = need_number(gap, "thickness", 1e-4, 1)
    grashof = 9.81 * width**3 * GAP_DIFFERENCE * density**2 / (GAP_TEMPERATURE * viscosity**2)
    nusselt = max(1, 0.035 * (grashof * viscosity * heat / conductivity)**0.38)
    radiation = 4 * SIGMA * GAP_TEMPERATURE**3 / (1 / emissivity + 1 / other - 1)
    return radiation + nusselt * conductivity / width


def panes_value(layers):
    """(U-value, g) of panes with gaps between."""
    panes, gaps = layers[::2], layers[1::2]
    faces = [(pane.number("front_side_infrared_hemispherical_emissivity", 0.84, 0.001, 1),
              pane.number("back_side_infrared_hemispherical_emissivity", 0.84, 0.001, 1)) for pane in panes]
    r_pane = [pane.number("thickness", 0.003, 1e-4, 1) / pane.number("conductivity", PANE_CONDUCTIVITY, 0.01, 100)
              for pane in panes]
    r_gap = [1 / gap_conductance(gap, a[1], b[0]) for gap, a, b in zip(gaps, faces, faces[1:])]
    total = R_GLASS_OUTSIDE + sum(r_pane) + sum(r_gap) + R_GLASS_INSIDE
    transmitted, absorbed = solar_of(panes)
    outward = R_GLASS_OUTSIDE + np.cumsum([0, *r_gap]) + np.cumsum(r_pane) - np.array(r_pane) / 2
    return 1 / total, transmitted + float(np.dot(absorbed, outward / total))


def solar_of(panes):
    """(transmitted, absorbed by each pane) of a beam at normal incidence, by its flows between the panes."""
    t, front, back = (np.array([pane.number(f"{key}_at_normal_incidence", usual, 0, 1) for pane in panes])
                      for key, usual in (("solar_transmittance", 0.8), ("front_side_solar_reflectance", 0.07),
                                         ("back_side_solar_reflectance", 0.07)))
    n = len(panes)
    # Unknowns: inward flows behind panes 0..n-1, and outward flows before them.
    system, known = np.eye(2 * n), np.zeros(2 * n)
    for k in range(n):
        if k:
            system[k, k - 1] -= t[k]
            system[n + k, k - 1] -= front[k]
        else:
            known[k], known[n + k] = t[0], front[0]
        if k + 1 < n:
            system[k, n + k + 1] -= back[k]
            system[n + k, n + k + 1] -= t[k]
    flows = np.linalg.solve(system, known)
    inward, outward = np.array([1, *flows[:n]]), np.array([*flows[n:], 0])
    return float(inward[n]), [float(inward[k] + outward[k + 1] - inward[k + 1] - outward[k]) for k in range(n)]


def glazing_of(model, opening):
    construction = model.need(opening, "construction_name", "Construction")
    layers = layers_of(model, construction)
    kinds = [layer.kind.lower() for layer in layers]
    if kinds == [GLASS[0].lower()]:
        return Glazing(construction.name, need_number(layers[0], "u_factor", 0.01, 10),
                       need_number(layers[0], "solar_heat_gain_coefficient", 0.01, 1), "simple glazing system")
    glass, gas = {GLASS[1].lower()}, {kind.lower() for kind in GAPS}
    if not layers or set(kinds[::2]) != glass or not set(kinds[1::2]) <= gas or len(kinds) % 2 == 0:
        construction.refuse("outside_layer", f"layers {', '.join(kinds)} are no window that is read; expected "
                            "WindowMaterial:SimpleGlazingSystem, or :Glazing with :Gas between")
    return Glazing(construction.name, *panes_value(layers), "of its panes and gaps: EN 673, EN 410")


def mass_of(model, surface, is_mirrored=False):
    """[J/(m2 K)] of its inner face, which is that of the first layer where it is mirrored."""
    construction = model.find(surface.text("construction_name"), "Construction")
    total, depth = 0, 0
    if construction is None:
        return 0
    layers = layers_of(model, construction)
    limit = min(MASS_DEPTH, sum(layer.number("thickness", 0) for layer in layers if is_solid(layer)) / 2)
    for layer in layers if is_mirrored else reversed(layers):
        if resistance(layer) > INSULATION_R and not (
                is_solid(layer) and layer.number(of_soil(layer, "conductivity"), 1) >= INSULATION):
            break
        if is_solid(layer):
            taken = min(layer.number("thickness", 0), limit - depth)
            total += taken * layer.number(of_soil(layer, "density"), 0, 0, 1e5) * \
                layer.number(of_soil(layer, "specific_heat"), 0, 0, 1e5)
            depth += taken
    return total


def is_in_sun(surface):
    return surface.outside == "outdoors" and surface.given.word("sun_exposure", "sunexposed") != "nosun"


def plain(name):
    """Without what means something in a parameter's target."""
    return name.replace(".", "_").replace("*", "_")


class Reader:
    """Puts surfaces together into Shells; lines of what it leaves out go to `left_out`."""

    def __init__(self, model, zones, left_out, air_flows):
        self.model, self.zones, self.left_out = model, zones, left_out
        self.air_flows = air_flows                 # {zone: m3/h of infiltration}
        self.owner = {s.given.name.lower(): zone for zone in zones.values() for s in zone.surfaces}
        self.shell, self.buffers, self.rooms, self.is_known = None, {}, [], False

    def read(self, rooms, known=None):
        """Shell of some conditioned zones. `known`: one whose constructions it has."""
        self.shell = Shell(known.opaque, known.glazing) if known else Shell()
        self.rooms, self.is_known = rooms, known is not None
        self.shell.grounds = ground_temperatures(self.model)
        for surface in (surface for zone in rooms for surface in zone.surfaces):
            self.add(surface)
        for mass in self.model.all("InternalMass"):
            for zone in self.zones_of(mass):
                if zone in rooms:
                    self.shell.heat_capacity += mass_of(self.model, mass) * zone.multiplier * \
                        mass.number("surface_area", 0, 0, 1e7)
        return self.shell

    def zones_of(self, mass):
        """Zones that have it, each by its own area: one, those of a list, or of spaces."""
        name = mass.word("zone_or_zonelist_name") or mass.word("space_or_spacelist_name")
        of_list = self.model.find(name, "ZoneList", "SpaceList")
        for each in [name] if of_list is None else [cell.lower() for group in of_list.rest for cell in group if cell]:
            space = self.model.find(each, "Space")
            zone = self.zones.get(each) or (self.zones.get(space.word("zone_name")) if space else None)
            if zone is not None:
                yield zone

    def behind(self, surface):
        """(boundary, b, outer film), or None of what nothing passes."""
        outside, r = surface.outside, film(surface.tilt)
        if outside == "outdoors":
            return "outdoors", 1, R_OUTSIDE
        if outside in GROUNDS:
            if outside == "foundation":
                self.left_out.append("Foundation:Kiva: floors and walls of it lie on the ground of "
                                     f"{GROUND_CLASSES[GROUND][0]}")
            return GROUND, 1, 0
        if outside == "groundfcfactormethod":
            return FACTOR_GROUND if FACTOR_GROUND in self.shell.grounds else "outdoors", 1, 0
        other = self.neighbour(surface)
        if outside == "adiabatic" or other is surface.zone:
            self.shell.adiabatic += surface.gross * surface.zone.multiplier
            return None
        if outside in ("surface", "zone", "space"):
            if other is None:
                key = "outside_boundary_condition_object"
                surface.given.refuse(key, f"{surface.given.text(key)!r} is no surface or zone of the file; expected "
                                          "the name of one")
            if not other.is_conditioned:
                return "outdoors", self.buffer_of(other).factor, r
            if other not in self.rooms:
                u_value = opaque_of(self.model, surface.given, r, r).u_value
                name, conductance = plain(other.name), surface.net * surface.zone.multiplier * u_value
                self.shell.between[name] = self.shell.between.get(name, 0) + conductance
            return None
        self.left_out.append(f'surface "{surface.given.name}": outside boundary condition '
                             f'"{surface.given.text("outside_boundary_condition")}"; taken as adiabatic')
        return None

    def neighbour(self, surface):
        name = surface.given.word("outside_boundary_condition_object")
        space = self.model.find(name, "Space") if name else None
        return self.owner.get(name) or self.zones.get(space.word("zone_name") if space else name)

    def buffer_of(self, zone):
        """What a zone without a thermostat does before a room: b is H to outdoors over all H."""
        if zone.name not in self.buffers:
            inner = self.inner_loss(zone) / max(zone.multiplier, 1)
            outer = self.outer_loss(zone) + AIR * self.air_flows.get(zone.name, 0)
            total = outer + inner if outer else 0
            self.buffers[zone.name] = Buffer(outer / total, *self.roof_of(zone, total)) if total else Buffer(0)
        return self.buffers[zone.name]

    def roof_of(self, zone, total):
        """(absorptance, emissivity, outer film) of a zone's roofs in the sun, as all of its H [W/K] lets them through;
        nothing where it has none."""
        roofs = [(s, opaque_of(self.model, s.given, film(s.tilt), R_OUTSIDE)) for s in zone.surfaces
                 if s.tilt < STEEP and is_in_sun(s)]
        losses = [s.net * made.u_value for s, made in roofs]
        if not sum(losses):
            return ()
        return (float(np.average([made.absorptance for _, made in roofs], weights=losses)),
                float(np.average([made.emissivity for _, made in roofs], weights=losses)),
                R_OUTSIDE * sum(losses) / total)

    def inner_loss(self, zone):
        """[W/K] from all zones with a thermostat into one without."""
        return sum(s.net * s.zone.multiplier * opaque_of(self.model, s.given, film(s.tilt), film(s.tilt)).u_value
                   for other in self.zones.values() if other.is_conditioned for s in other.surfaces
                   if self.neighbour(s) is zone)

    def outer_loss(self, zone):
        """[W/K] of its surfaces and windows to outdoors and ground."""
        total = 0.0
        for s in zone.surfaces:
            if s.outside in ("outdoors", "groundfcfactormethod", *GROUNDS):
                r_outside = R_OUTSIDE if s.outside == "outdoors" else 0
                total += s.net * opaque_of(self.model, s.given, film(s.tilt), r_outside).u_value
                total += sum(o.area * glazing_of(self.model, o.given).u_value for o in s.openings if o.is_glass)
        return total

    def add(self, surface):
        model, zone, given = self.model, surface.zone, surface.given
        self.shell.heat_capacity += mass_of(model, given, surface.is_mirrored) * surface.net * zone.multiplier
        found = self.behind(surface)
        if found is None:
            return
        boundary, b, r_outside = found
        self.add_opaque(given, surface, surface.net, boundary, b, r_outside)
        for opening in surface.openings:
            if not opening.is_glass:
                self.add_opaque(opening.given, surface, opening.area, boundary, b, r_outside)
            elif surface.outside == "outdoors":
                self.add_window(opening, surface)
            else:
                self.left_out.append(f'window "{opening.given.name}": it is not outdoors')

    def add_opaque(self, given, surface, area, boundary, b, r_outside):
        made = opaque_of(self.model, given, film(surface.tilt), r_outside)
        is_f_factor = self.model.find(made.name, F_FACTOR) is not None
        made.name = "ground floor (F factor)" if is_f_factor else made.name
        direction = self.direction_of(surface, made)
        if is_f_factor:
            self.add_f_factor(made, area * surface.zone.multiplier)
        else:
            made.name = self.name_of(made)
        self.put(self.shell.surfaces, made.name, direction, boundary, round(b, 4), area * surface.zone.multiplier)

    def direction_of(self, surface, made):
        """(azimuth, tilt) [deg] of what the sun reaches, else nothing. Below a roof of another zone it is as flat as
        the sky, and what is made of it has that roof's outer face."""
        if is_in_sun(surface):
            return round(surface.azimuth) % 360 if 0.5 < surface.tilt < 179.5 else 0, round(surface.tilt)
        other = self.neighbour(surface)
        if other is None or other.is_conditioned or not self.buffer_of(other).r_outside:
            return None, None
        buffer = self.buffer_of(other)
        made.absorptance, made.emissivity, made.r_outside = buffer.absorptance, buffer.emissivity, buffer.r_outside
        return 0, 0

    def name_of(self, made):
        """A construction has a name for each of its films."""
        base = plain(made.name)
        names = (base if k == 1 else f"{base} ({k})" for k in range(1, 99))
        for name in names:
            known = self.shell.opaque.get(name)
            if known is None or abs(known.u_value - made.u_value) < 1e-9 and \
                    (known.r_outside, known.absorptance) == (made.r_outside, made.absorptance):
                self.shell.opaque.setdefault(name, made)
                return name
        return made.name

    def add_f_factor(self, made, area):
        """One construction for all: the mean by area."""
        if self.is_known:
            return
        known = self.shell.opaque.setdefault(made.name, made)
        before = sum(p.area for p in self.shell.surfaces.values() if p.construction == made.name)
        known.u_value = known.bare = (known.u_value * before + made.u_value * area) / max(before + area, 1e-9)

    def add_window(self, opening, surface):
        name = opening.given.text("construction_name").lower()
        made = next((g for g in self.shell.glazing.values() if g.name.lower() == plain(name)), None) or \
            glazing_of(self.model, opening.given)
        made.name = plain(made.name)
        self.shell.glazing[made.name] = made
        if opening.given.text("frame_and_divider_name"):
            self.left_out.append("frames and dividers of windows (WindowProperty:FrameAndDivider)")
        tilt = round(surface.tilt)
        self.put(self.shell.windows, made.name, (round(surface.azimuth) % 360 if tilt else 0, tilt), "outdoors", 1,
                 opening.area * surface.zone.multiplier)

    @staticmethod
    def put(parts, name, direction, boundary, b, area):
        part = parts.setdefault((name, direction, boundary, b), Part(name, *direction, boundary, b))
        part.area += area
