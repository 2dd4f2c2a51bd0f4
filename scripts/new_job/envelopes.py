"""U-values by country and year: u_values.csv beside this file, ASHRAE 90.1 by climate zone, or a wide guess.

Source of the United States' rows: ASHRAE 90.1-2004, 90.1-2007 and 90.1-2013, Tables 5.5, nonresidential: walls of steel
framing, roofs with insulation above deck, fixed windows, of 2007 those of storefronts (Btu/(h ft2 F)). Older
buildings of the United States have the guess: no table by climate zone is here. Zones: ASHRAE 169, by degree days of
heating (to 18 degC) and cooling (from 10 degC). Solar transmittance by panes: EN ISO 13790 Annex G. Air changes by age
are judgement within EN 15242's levels of tightness. Leaves out retrofits: a renewed envelope takes the year of its
renewal.
"""
import csv
import pathlib
from dataclasses import dataclass

TABLE = pathlib.Path(__file__).with_name("u_values.csv")
BTU = 5.678                    # W/(m2 K) of a Btu/(h ft2 F)
# Until and with the year, by zone 1 to 8: wall, roof, window [Btu/(h ft2 F)], g of the window.
US_ROWS = (
    (2007, "ASHRAE 90.1-2004", (.124, .124, .124, .124, .084, .084, .064, .064), (.063,) * 7 + (.048,),
     (1.22, 1.22, .57, .57, .57, .57, .57, .46), (.25, .25, .25, .39, .39, .39, .49, .49)),
    (2013, "ASHRAE 90.1-2007", (.124, .124, .084, .064, .064, .064, .064, .064), (.063,) + (.048,) * 7,
     (1.20, .70, .60, .50, .45, .45, .40, .40), (.25, .25, .25, .40, .40, .40, .45, .45)),
    (9999, "ASHRAE 90.1-2013", (.124, .084, .077, .064, .055, .049, .049, .037),
     (.048, .039, .039, .032, .032, .032, .028, .028), (.57, .57, .50, .42, .42, .42, .38, .38),
     (.25, .25, .25, .40, .40, .40, .45, .45)),
)
US_FIRST = 2005                # a building is of a standard some years after it
US_FLOOR = 0.4                 # W/(m2 K) of a slab on ground, b = 0.5; 90.1 limits its edge only
# Until: wall, roof, floor, window: middling of all tables, where a country has none.
GUESS = ((1979, 1.4, 1.2, 1.0, 4.5), (1999, 0.8, 0.6, 0.7, 3.3), (9999, 0.4, 0.3, 0.4, 2.2))
SD_OF_TABLE, SD_OF_GUESS = 0.35, 0.6  # of the factor on all U-values
G_OF_U = ((4, 0.85), (2.3, 0.75), (1.3, 0.62), (0, 0.5))  # one pane, two, coated, three
TIGHTNESS = ((1979, 0.6), (1999, 0.45), (9999, 0.3))      # 1/h
ZONES = ((1, 5000), (2, 3500), (3, 2500))  # cooling degree days above which a zone is 1, 2 or 3
COLD_ZONES = ((4, 3000), (5, 4000), (6, 5000), (7, 7000))  # heating degree days up to which


@dataclass(frozen=True)
class Envelope:
    """U-values [W/(m2 K)]; `says`: where they are from; `sd`: of the prior of a factor on them."""
    wall: float
    roof: float
    floor: float
    window: float
    g: float
    infiltration: float        # 1/h
    says: str
    sd: float
    is_guess: bool


def rows_of(country):
    with open(TABLE, encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return [row for row in rows if row["country"] == country]


def until(rows, year):
    """The first row that holds in a year; a row begins with its last year."""
    return next(row for row in rows if year <= int(row[0]))


def g_of(window):
    return next(g for u, g in G_OF_U if window > u)


def climate_zone(cooling_days, heating_days):
    """ASHRAE 169's, of degree days a year."""
    for zone, least in ZONES:
        if cooling_days > least:
            return zone
    if heating_days <= 2000:
        return 3
    return next((zone for zone, most in COLD_ZONES if heating_days <= most), 8)


def envelope(wall, roof, floor, window, year, says, sd, g=None, is_guess=False):
    return Envelope(wall, roof, floor, window, g or g_of(window), until(TIGHTNESS, year)[1], says, sd, is_guess)


def american(year, zone):
    _, standard, walls, roofs, windows, gs = until(US_ROWS, year)
    k = zone - 1
    return envelope(round(walls[k] * BTU, 2), round(roofs[k] * BTU, 2), US_FLOOR, round(windows[k] * BTU, 2), year,
                    f"{standard}, climate zone {zone}", SD_OF_TABLE, gs[k])


def guessed(year):
    _, wall, roof, floor, window = until(GUESS, year)
    return envelope(wall, roof, floor, window, year, "guessed by age, middling of the tables of other countries",
                    SD_OF_GUESS, is_guess=True)


def envelope_of(country, place, year, zone):
    """The country's own table, its neighbour's, or a guess."""
    owner = place.neighbour or country
    rows = rows_of(owner)
    if owner == "US" and year >= US_FIRST:
        return american(year, zone)
    if not rows:
        return guessed(year)
    row = next(row for row in rows if year <= int(row["until"]))
    source = {"TABULA": "TABULA building typology (dwellings)", "RdSAP": "RdSAP 2012 and Building Regulations"}
    values = [float(row[part]) for part in ("wall", "roof", "floor", "window")]
    last = row["until"]
    of = f"{source[row['source']]}, {owner}, " + (f"up to {last}" if last != "9999" else "newest")
    return envelope(*values, year, of, SD_OF_TABLE)
