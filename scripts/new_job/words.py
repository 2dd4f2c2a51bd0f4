"""What a column, a file or a line of an export says of quantity and unit, by the words in its name.

Units are those that a job knows (`describe job`: [[meter]] unit), with a factor where it lacks one. Steam and tons of
cooling: ENERGY STAR Portfolio Manager, Technical Reference: Thermal Energy Conversions (1 klb of steam = 1,194 kBtu,
1 ton hour = 12 kBtu, 1 US gallon of fuel oil No. 2 = 138 kBtu). Words: English, German, French, Italian, Spanish.
"""
import re

KWH_PER_KBTU = 0.293071
OF_OIL = 138                   # kBtu of a US gallon
# What the words say, the job's unit, factor on the readings. The first that is found holds.
UNITS = (
    (r"kwh|kilowatt ?hours?|thousand watt hours?", "kWh", 1),
    (r"gwh", "MWh", 1000),
    (r"mwh|megawatt ?hours?|million watt hours?", "MWh", 1),
    (r"wh|watt ?hours?", "Wh", 1),
    (r"mmbtu|million btu|mbtu", "kBtu", 1000),
    (r"kbtu|thousand btu", "kBtu", 1),
    (r"btu", "kBtu", 0.001),
    (r"therms?|thms?", "therm", 1), (r"dth|dekatherms?|decatherms?", "therm", 10),
    (r"mcf|kcf|thousand cubic feet|1000 ?ft3|1000 cubic feet", "CCF", 10),
    (r"hcf|100 ?ft3", "100 ft3", 1),           # of Great Britain's older meters
    (r"ccf|hundred cubic feet|100 cubic feet", "CCF", 1),
    (r"cf|ft3|cubic feet", "CCF", 0.01),
    (r"m3|nm3|cubic met(?:er|re)s?|kubikmeter", "m3", 1),
    (r"gj|gigajoules?", "GJ", 1), (r"mj|megajoules?", "MJ", 1), (r"kj|kilojoules?", "kJ", 1), (r"j|joules?", "J", 1),
    (r"ton ?hours?|tonh|rth", "kBtu", 12),
    (r"klbs?|mlbs?|thousand pounds", "kBtu", 1194),
    (r"gallons?", "kBtu", OF_OIL),
    (r"kw|kilowatts?", "kW", 1), (r"mw|megawatts?", "MW", 1), (r"w|watts?", "W", 1),
    (r"degc|celsius|c", "degC", 1), (r"degf|fahrenheit|f", "degF", 1), (r"kelvin", "K", 1),
)
PER_HOUR = re.compile(r"(?:/\s*|\bper |\bpro )(?:h|hrs?|hours?|std|stunden?)\b", re.IGNORECASE)
UNIT_NAMES = (*dict.fromkeys(unit for _, unit, _ in UNITS), "ft3")    # the last: of no word, as it is two things
TEMPERATURES, POWERS = ("degC", "degF", "K"), ("kW", "MW", "W")
VOLUMES = ("m3", "ft3", "100 ft3", "CCF")     # energies of gas alone
OF_GAS = (*VOLUMES, "therm")

# Readings that are no meter's.
OTHERS = (r"outdoor|outside|ambient|oat|t out|dry ?bulb|dew|t dew|t ext|weather|humidity|rh|wind|cloud|irradiance|"
          r"ghi|dni|dhi|solar|sun|pressure|precip|rain|snow|flow|return|cum|cost|price|eur|usd|"
          r"tariff|estimated|estimation|holiday|occupan|co2|water use|"
          r"export|feed in|fed in|einspeis|inject|generat|pv|photovolt|reactive|k?varh?|k?vah?")
# The same, unless the name says an energy: "heat demand kWh", "gas volume m3".
OTHERS_WITHOUT_ENERGY = r"volume|count|id|days?|month|year|hour|hourly|demand|peak|minutes?"
WATER = r"water|wasser|eau|acqua|agua"
QUANTITIES = (
    ("air_temperature", r"t in|t air|t room|indoor|room temp|room air|zone temp|inside temp|raumtemp|t zone"),
    ("cooling", r"chilled|chw"),
    ("electricity", r"elec|strom|electri|elettr|lectri|kwh el"),     # also of what heats or cools
    ("cooling", r"cool|cold|kaelte|kälte|klima|froid|freddo|frio"),
    ("gas", r"gas|natural ?gas|erdgas|gaz|metano|fuel|oil|propane|lpg|diesel"),
    ("district", r"district|fernw|steam|hot ?water|heat|waerme|wärme|chaleur|chauffage|calore|riscald|calor|dh"),
    ("electricity", r"power|main"),
)
QUANTITY_NAMES = ("gas", "electricity", "district", "heating", "cooling", "air_temperature")
END, START = r"end|ending|ends|to|until|bis|fin|ende|hour ending", r"start|begin|beginning|from|von|debut|anfang"
# A date on which a meter was read, or a bill written: what was used until then.
READ_DATE = r"read|reading|bill|billing|invoice|statement|ablesung|ablesedatum|rechnung|releve|facture|lettura|lectura"


def spaced(name):
    """Words of a name, in small letters: "Gas_kWh (net)" -> "gas kwh net"."""
    apart = re.sub(r"(?<=[a-z]{2})(?=[A-Z][a-z])", " ", name)
    apart = apart.replace("³", "3").replace("²", "2").replace("°C", "degC").replace("°F", "degF")
    return " ".join(re.findall(r"[^\W_]+", apart.lower()))


def says(pattern, name, whole=False):
    """Whether a word of the name begins so, or is so as a whole."""
    end = r"\b" if whole else ""
    return re.search(rf"\b(?:{pattern}){end}", spaced(name)) is not None


def is_other(name):
    """Whether it is no energy and no room temperature, by its name."""
    unit, factor = named_unit(name) or ("", 1)
    if says(WATER, name) and (unit in VOLUMES or factor == OF_OIL):
        return True                                   # litres and gallons of water
    is_energy = unit and unit not in (*TEMPERATURES, *POWERS)
    return says(OTHERS, name) or not is_energy and says(OTHERS_WITHOUT_ENERGY, name)


def quantity_of(name):
    """None where nothing says it."""
    return next((quantity for quantity, pattern in QUANTITIES if says(pattern, name)), None)


def unit_of(name, quantity=None):
    """(unit, factor) or None. An energy per hour is a power."""
    found = named_unit(name, quantity)
    if found and found[0] not in (*TEMPERATURES, *POWERS) and PER_HOUR.search(name):
        return "kW", found[1] * kwh_per_unit(found[0])
    return found


def named_unit(name, quantity=None):
    """The same without a word on the time. A letter alone is a unit of temperature only of one."""
    for pattern, unit, factor in UNITS:
        is_temperature = unit in TEMPERATURES
        if quantity is not None and is_temperature != (quantity == "air_temperature"):
            continue
        if quantity not in (None, "gas") and unit in VOLUMES:
            continue
        if says(pattern, name, whole=True):
            return unit, factor
    return None


def kwh_per_unit(unit, step_hours=1):
    """[kWh] of a reading of 1; natural gas at 11.2 kWh/m3 and 102.6 kBtu/CCF, as the program reads it."""
    gas = 39.5 * 1.02264 / 3.6
    return {"kWh": 1, "Wh": 1e-3, "MWh": 1e3, "J": 1 / 3.6e6, "kJ": 1 / 3600, "MJ": 1 / 3.6, "GJ": 1e3 / 3.6,
            "kBtu": KWH_PER_KBTU, "therm": 100 * KWH_PER_KBTU, "m3": gas, "ft3": gas * 0.0283168,
            "100 ft3": gas * 2.83168, "CCF": 102.6 * KWH_PER_KBTU,
            "kW": step_hours, "W": step_hours / 1e3, "MW": step_hours * 1e3}[unit]
