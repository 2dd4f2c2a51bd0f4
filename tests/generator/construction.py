"""A building as layers of material, and its thermal network with many nodes.

Every wall, roof, floor, slab and partition is a chain of finite volumes through its layers;
inside surfaces see the air by convection and each other through a radiant star. The air node
stays outside the matrix, since its air flows change from step to step.
"""
from dataclasses import dataclass, field

import numpy as np

MATERIALS = {  # conductivity [W/(m K)], density [kg/m3], specific heat [J/(kg K)]
    "concrete": (1.7, 2300, 900),
    "brick": (0.75, 1700, 850),
    "plaster": (0.7, 1400, 900),
    "gypsum": (0.25, 850, 1000),
    "insulation": (0.04, 40, 1300),
    "screed": (1.2, 2000, 900),
    "soil": (1.3, 1800, 1100),
    "wood": (0.14, 600, 1600),
    "hollow concrete": (0.606, 1244, 900),
}
CELL = {"insulation": 0.04, "soil": 0.3}  # largest cell [m]; others 0.05
H_OUT_CONVECTIVE, H_OUT_RADIANT = 15.0, 5.0  # outside films [W/(m2 K)]
H_IN_RADIANT = 5.1                           # inside, to the radiant star [W/(m2 K)]
RHO_C_AIR = 1200.0                           # [J/(m3 K)]


@dataclass
class Element:
    """Layers from outside to inside. `plane` = (tilt, azimuth) in the sun; `ground` = behind it
    is deep soil; neither = both faces are inside the zone."""
    name: str
    area: float
    layers: list
    plane: tuple = None
    ground: bool = False
    absorptance: float = 0.6
    h_inside: float = 2.5                   # convective film [W/(m2 K)]
    sun_share: float = 0.0                  # of the transmitted sun that falls on its inside
    conductance: float = 1.0                # factor on that of every layer


@dataclass
class Window:
    name: str
    area: float
    plane: tuple
    u_value: float
    g_value: float                          # at normal incidence
    frame: float = 0.2


@dataclass
class Network:
    """C dx/dt = -K x + air (theta_air) + sources, without the air node."""
    capacity: np.ndarray                    # [n] J/K
    conduction: np.ndarray                  # [n x n] W/K, with all couplings on its diagonal
    air: np.ndarray                         # [n] W/K to the air node
    outdoor: np.ndarray                     # [n] W/K to the outdoor air
    sky: np.ndarray                         # [n] W/K to the radiant surroundings
    ground: np.ndarray                      # [n] W/K to deep soil
    outer: dict                             # element -> node in the sun
    inner: dict                             # element -> inside node
    star: int


@dataclass
class Builder:
    n: int = 0
    capacity: list = field(default_factory=list)
    links: list = field(default_factory=list)
    tied: list = field(default_factory=list)   # (node, kind, conductance)

    def node(self, capacity=0.0):
        self.capacity.append(capacity)
        self.n += 1
        return self.n - 1

    def link(self, a, b, conductance):
        self.links.append((a, b, conductance))

    def tie(self, node, kind, conductance):
        self.tied.append((node, kind, conductance))


def cells_of(layers):
    """Finite volumes through the layers: resistance [m2 K/W] and capacity [J/(m2 K)]."""
    cells = []
    for material, thickness in layers:
        conductivity, density, heat = MATERIALS[material]
        n = int(np.ceil(thickness / CELL.get(material, 0.05)))
        d = thickness / n
        cells += [(d / conductivity, d * density * heat)] * n
    return cells


def add_chain(builder, element):
    """Nodes of an element; returns its outer and inner surface nodes."""
    outer = last = builder.node()
    resistance = 0.0
    for r, c in cells_of(element.layers):
        cell = builder.node(c * element.area)
        builder.link(last, cell, element.conductance * element.area / (resistance + r / 2))
        last, resistance = cell, r / 2
    inner = builder.node()
    builder.link(last, inner, element.conductance * element.area / resistance)
    return outer, inner


def add_inside(builder, node, area, h_convective, star):
    builder.tie(node, "air", h_convective * area)
    builder.link(node, star, H_IN_RADIANT * area)


def add_element(builder, element, star):
    outer, inner = add_chain(builder, element)
    add_inside(builder, inner, element.area, element.h_inside, star)
    if element.plane:
        builder.tie(outer, "outdoor", H_OUT_CONVECTIVE * element.area)
        builder.tie(outer, "sky", H_OUT_RADIANT * element.area)
    elif element.ground:
        builder.tie(outer, "ground", 1e3 * element.area)
    else:
        add_inside(builder, outer, element.area, 4.0, star)
    return outer, inner


def add_window(builder, window, star):
    """Two massless panes whose total resistance with films of 1/8 and 1/20 gives the U-value."""
    outer, inner = builder.node(), builder.node()
    glass = 1 / window.u_value - 1 / 20 - 1 / (3.0 + H_IN_RADIANT)
    builder.link(outer, inner, window.area / max(glass, 0.01))
    builder.tie(outer, "outdoor", H_OUT_CONVECTIVE * window.area)
    builder.tie(outer, "sky", H_OUT_RADIANT * window.area)
    add_inside(builder, inner, window.area, 3.0, star)
    return outer, inner


def make_network(elements, windows):
    builder = Builder()
    star = builder.node()
    ends = {e.name: add_element(builder, e, star) for e in elements}
    ends |= {w.name: add_window(builder, w, star) for w in windows}
    conduction = np.zeros((builder.n, builder.n))
    for a, b, g in builder.links:
        conduction[[a, b], [a, b]] += g
        conduction[[a, b], [b, a]] -= g
    ties = {kind: np.zeros(builder.n) for kind in ("air", "outdoor", "sky", "ground")}
    for node, kind, g in builder.tied:
        ties[kind][node] += g
        conduction[node, node] += g
    return Network(np.array(builder.capacity), conduction, **ties,
                   outer={k: v[0] for k, v in ends.items()},
                   inner={k: v[1] for k, v in ends.items()}, star=star)
