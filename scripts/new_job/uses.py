"""Kinds of use: people, loads, air, set-points, and a usual form.

Sources, by column:
  people, sensible    EN ISO 13790:2008 Table G.12: area and heat of a person
  lights              ASHRAE 90.1-2007 Table 9.5.1 (building area method), W/ft2 x 10.76; of dwellings in `equipment`
  equipment           ASHRAE 90.1-1989 Table 13-2, as in the User's Manual of later editions (W/ft2 x 10.76); dwellings:
                      EN 16798-1:2019 Annex C
  air                 ASHRAE 62.1-2019 Table 6-1: people's and area's outdoor air at the default occupancy, l/(s m2);
                      hospitals: EN ISO 13790 Table G.12, 1 m3/(h m2); university, library, assembly, sports and
                      industry have several kinds of rooms: judgement between their rows
  heating             EN ISO 13790 Table G.12, 20 degC (hospitals 22, warehouses 18), plus the 1 K that people set above
                      design; cooling: EN 16798-1 category II, 26 degC, in the United States 24 degC (DOE reference
                      buildings)
  hot water           EN ISO 13790 Table G.12, kWh/(m2 a)
  storeys             so that the DOE reference buildings have theirs (511 to 46,320 m2 of office: 1 to 12); schools,
                      universities and houses by judgement
  glass, height       share of glass in the facades and storey height: judgement, told in the job
"""
from dataclasses import dataclass

from new_job.refused import USAGE, Refused


@dataclass(frozen=True)
class Use:
    """Densities in W/m2 while in use, areas in m2, air in l/(s m2) while in use."""
    learn: str                 # whose usual hours a search begins from
    person_area: float
    person_heat: float         # W
    lights: float
    equipment: float
    air: float
    set_point: float = 21      # degC
    hot_water: float = 10      # kWh/(m2 a)
    height: float = 3.5        # m
    glass: float = 0.3
    storey_area: float = 400   # m2; storeys are the square root of the floor area over this
    is_cooled: bool = True     # where it is hot


USES = {
    "office": Use("office", 20, 80, 10.8, 8.1, 0.43),
    "school": Use("school", 10, 70, 12.9, 5.4, 2.35, storey_area=2000),
    "university": Use("office", 10, 70, 12.9, 8.1, 0.9, height=3.6, storey_area=300),
    "house": Use("home", 60, 70, 0, 2.4, 0.3, hot_water=10, height=2.6, glass=0.2, is_cooled=False, storey_area=25),
    "apartments": Use("home", 40, 70, 0, 3, 0.3, hot_water=20, height=2.8, glass=0.22, is_cooled=False,
                      storey_area=200),
    "retail": Use("shop", 10, 90, 16.1, 2.7, 1.17, height=4, glass=0.25, storey_area=3000),
    "hotel": Use("home", 40, 70, 10.8, 2.7, 0.55, hot_water=20, height=3, storey_area=270),
    "hospital": Use("home", 30, 80, 12.9, 10.8, 0.28, set_point=22, hot_water=30, height=3.8, storey_area=900),
    "clinic": Use("office", 20, 80, 10.8, 8.1, 0.43, set_point=22),
    "restaurant": Use("shop", 5, 100, 17.2, 1.1, 3.56, hot_water=60, storey_area=3000),
    "warehouse": Use("office", 100, 100, 8.6, 1.1, 0.3, set_point=18, hot_water=1.4, height=6, glass=0.05,
                     storey_area=1e9, is_cooled=False),
    "industry": Use("office", 20, 100, 14, 2.2, 0.3, set_point=18, height=5, glass=0.1, storey_area=1e9,
                    is_cooled=False),
    "laboratory": Use("office", 20, 80, 12.9, 10.8, 2.15, height=3.8),
    "library": Use("office", 10, 80, 14, 2.7, 0.9, height=4, storey_area=600),
    "assembly": Use("shop", 5, 80, 12.9, 2.7, 1.2, height=5, glass=0.2, storey_area=2000),
    "sports": Use("shop", 20, 100, 11.8, 2.7, 1.2, set_point=18, hot_water=80, height=5, glass=0.2, storey_area=3000),
    "other": Use("office", 20, 80, 10.8, 5.4, 0.43),
}
OTHER_NAMES = {"dwelling": "house", "home": "house", "flats": "apartments", "multifamily": "apartments",
               "shop": "retail", "store": "retail", "college": "university", "factory": "industry", "lab": "laboratory",
               "kindergarten": "school", "gym": "sports"}
SET_BACK = 16                  # degC; DOE reference buildings 15.6
COOLING_SET_POINT, COOLING_SET_POINT_US, COOLING_SET_BACK = 26, 24, 5  # degC, degC, K above the set-point


def read_use(text):
    """(name, Use)"""
    name = OTHER_NAMES.get(text.lower(), text.lower())
    if name not in USES:
        raise Refused(f"--use {text}: is no use that is known; expected one of {', '.join(USES)}", USAGE)
    return name, USES[name]
