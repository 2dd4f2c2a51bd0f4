"""Countries: their clock, and whose envelopes are taken where a country has no table of its own.

Summer time: the European Union's and the United States' rules, which the program knows. The offset is that of standard
time, of a country with one zone. A neighbour is one of like climate and building practice, by judgement; it is told.
"""
from dataclasses import dataclass

from new_job.refused import USAGE, Refused


@dataclass(frozen=True)
class Place:
    """`offset`: of standard time to UTC [h]; None where the country has several zones."""
    name: str
    summer_time: str           # none, eu, us
    offset: float = None
    neighbour: str = ""        # whose table of U-values; "" = its own, or none
    is_hot: bool = False       # most buildings but houses have cooling


def eu(name, offset, neighbour="", is_hot=False):
    return Place(name, "eu", offset, neighbour, is_hot)


PLACES = {
    "AT": eu("Austria", 1), "BE": eu("Belgium", 1), "BG": eu("Bulgaria", 2), "CH": eu("Switzerland", 1, "AT"),
    "CY": eu("Cyprus", 2, is_hot=True), "CZ": eu("Czechia", 1), "DE": eu("Germany", 1), "DK": eu("Denmark", 1),
    "EE": eu("Estonia", 2, "PL"), "ES": eu("Spain", 1, is_hot=True), "FI": eu("Finland", 2, "SE"),
    "FR": eu("France", 1), "GB": eu("United Kingdom", 0), "GR": eu("Greece", 2, is_hot=True),
    "HR": eu("Croatia", 1, "SI"), "HU": eu("Hungary", 1), "IE": eu("Ireland", 0), "IT": eu("Italy", 1, is_hot=True),
    "LT": eu("Lithuania", 2, "PL"), "LU": eu("Luxembourg", 1, "BE"), "LV": eu("Latvia", 2, "PL"),
    "MT": eu("Malta", 1, "CY", True), "NL": eu("Netherlands", 1), "NO": eu("Norway", 1), "PL": eu("Poland", 1),
    "PT": eu("Portugal", 0, "ES", True), "RO": eu("Romania", 2, "BG"), "RS": eu("Serbia", 1), "SE": eu("Sweden", 1),
    "SI": eu("Slovenia", 1), "SK": eu("Slovakia", 1, "CZ"),
    "US": Place("United States", "us", is_hot=True), "CA": Place("Canada", "us", neighbour="US"),
    "AU": Place("Australia", "none", is_hot=True), "NZ": Place("New Zealand", "none", 12),
    "CN": Place("China", "none", 8, is_hot=True), "HK": Place("Hong Kong", "none", 8, is_hot=True),
    "IN": Place("India", "none", 5.5, is_hot=True), "JP": Place("Japan", "none", 9, is_hot=True),
    "KR": Place("South Korea", "none", 9, is_hot=True), "SG": Place("Singapore", "none", 8, is_hot=True),
    "TW": Place("Taiwan", "none", 8, is_hot=True),
}
WITH_HOLIDAYS = set(PLACES) - {"RS"}
# Years of which the program knows the holidays (its message names them): usual ones, and others.
HOLIDAYS_KNOWN = (2000, 2050)
HOLIDAYS_KNOWN_OF = {"CN": (2010, 2050), "KR": (2010, 2050), "TW": (2011, 2050), "IN": (2010, 2030), "SG": (2001, 2030)}
# As bemcal-batch describe holidays lists them; other countries have one calendar, and take any state.
STATES = {
    "AU": "ACT NSW NT QLD SA TAS VIC WA", "CA": "AB BC MB NB NL NS NT NU ON PE QC SK YT",
    "CH": "AG AI AR BE BL BS FR GE GL GR JU LU NE NW OW SG SH SO SZ TG TI UR VD VS ZG ZH",
    "DE": "BB BE BW BY HB HE HH MV NI NW RP SH SL SN ST TH", "GB": "ENG NIR SCT WLS",
    "NZ": "AUK CAN CIT HKB MBH NSN NTL OTA STC STL TKI WGN WTL",
    "US": "AK AL AR AS AZ CA CO CT DC DE FL FM GA GU HI IA ID IL IN KS KY LA MA MD ME MH MI MN MO MP MS MT NC ND NE NH "
          "NJ NM NV NY OH OK OR PA PR PW RI SC SD TN TX UT VA VI VT WA WI WV WY"}
WITHOUT_SUMMER_TIME = {"US-AZ", "US-HI", "CA-SK"}


def read_place(text):
    """(code, state or "", Place)"""
    code, _, state = text.upper().partition("-")
    if code == "UK":
        code = "GB"
    if code not in PLACES:
        raise Refused(f"--place {text}: is no country that is known; expected one of {', '.join(sorted(PLACES))}, "
                      "perhaps with a state, as DE-BY or US-NY", USAGE)
    if state and code in STATES and state not in STATES[code].split():
        raise Refused(f"--place {text}: {state} is no state of {PLACES[code].name} that is known; expected one of "
                      f"{STATES[code]}", USAGE)
    return code, state, PLACES[code]


def are_holidays_known(code, first, last):
    """Of the years from first to last."""
    least, most = HOLIDAYS_KNOWN_OF.get(code, HOLIDAYS_KNOWN)
    return code in WITH_HOLIDAYS and least <= first and last <= most


def summer_time_of(code, state):
    return "none" if f"{code}-{state}" in WITHOUT_SUMMER_TIME else PLACES[code].summer_time
