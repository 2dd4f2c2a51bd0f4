"""The quickstart's office: the recipe behind jobs/quickstart, effect included."""
import numpy as np

from case import Recipe
from office import Office

HOLIDAYS = ("2021-01-01", "2021-02-11/2021-02-17", "2021-04-05", "2021-05-03/2021-05-05",
            "2021-06-14", "2021-09-20/2021-09-21", "2021-10-01/2021-10-07", "2022-01-03",
            "2022-01-31/2022-02-06", "2022-04-04/2022-04-05", "2022-05-02/2022-05-04",
            "2022-06-03", "2022-09-12", "2022-10-03/2022-10-07")


def days_of(spans):
    """Every day of spans like "2021-10-01/2021-10-07"."""
    days = []
    for span in spans:
        first, _, last = span.partition("/")
        days += [str(d) for d in np.arange(first, np.datetime64(last or first) + 1,
                                           dtype="datetime64[D]")]
    return tuple(days)


DESIGN = Office(heating_set=20.5, heating_setback=17.0, cooling_setback=29.0,
                heating_capacity=45.0, holidays=days_of(HOLIDAYS))

RECIPE = Recipe(climate="hot_humid", first_day="2021-01-01", n_days=730, seed=11, design=DESIGN,
                effects={"saturday_operation": 5.0})
