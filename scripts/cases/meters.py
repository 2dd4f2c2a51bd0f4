"""The columns of measured.csv as meters."""
import os

from cases.folder import columns_of, numbers_in
from cases.toml import section, texts

# name: column, quantity, unit
CHANNELS = {"T_air_C": ("air", "air_temperature", "degC"),
            "heat_kWh": ("heat", "heating", "kWh"), "cool_kWh": ("cold", "cooling", "kWh"),
            "elec_kWh": ("electricity", "electricity", "kWh"), "gas_kWh": ("gas", "gas", "kWh")}
LEAST_HEATED_SHARE = 0.1


def heat_interval(files):
    """Heat that is needed in a few hours only says nothing hour by hour."""
    readings = list(numbers_in(files, "heat_kWh"))
    heated = sum(reading > 0 for reading in readings)
    return "monthly" if heated < LEAST_HEATED_SHARE * len(readings) else None


def channels(case, files):
    """Columns that are measured, or that would be."""
    columns = columns_of(files[0]) if files else case["channels"]
    return [column for column in columns if column in CHANNELS]


def meters(case, manner):
    """Without files they are predicted only."""
    paths = [manner.place(os.path.basename(file)) for file in manner.files]
    for column in channels(case, manner.files):
        name, quantity, unit = CHANNELS[column]
        by_month = column == "heat_kWh" and manner.heat_by_month and paths
        source = dict(column=column, stamp="end", gaps="missing",
                      file=texts(paths) if len(paths) > 1 else paths[0]) if paths else {}
        yield section("[[meter]]", name=name, quantity=quantity, unit=unit,
                      interval=heat_interval(manner.files) if by_month else manner.interval,
                      **source)
