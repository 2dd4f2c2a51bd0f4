#!/usr/bin/python3
"""By how much the level of a building's energy use changes from one year to the next, beyond the
weather: what level_change of a posterior is set by, as one training year cannot tell it.

For each of the buildings in ../shared/data/nyc_bills with eleven bills or more in each of two years,
a regression of monthly use on outdoor temperature (a base, heating below one temperature and cooling
above another, none of them negative) is fitted to the first year. The change is the second year's
total over the predicted one; its spread is the interquartile range over 1.349, which a few wrong
bills do not move. Prints `name value unit reference ratio`.
"""
import numpy
import pandas
from scipy.optimize import nnls

import large_job

BILLS = large_job.ROOT.parent / "shared" / "data" / "nyc_bills" / "unretrofit_monthly_per_ft2.csv.gz"
LEAST_BILLS = 11


def terms(outdoor, heats_below, cools_above):
    return numpy.column_stack([numpy.ones_like(outdoor), numpy.maximum(heats_below - outdoor, 0),
                               numpy.maximum(outdoor - cools_above, 0)])


def regression(year):
    """Predicted use as a function of outdoor temperatures: with the best pair of temperatures."""
    outdoor, use = year.OAT_C.to_numpy(), year.usage.to_numpy()
    fits = [(nnls(terms(outdoor, *at), use), at)
            for at in ((low, high) for low in range(8, 22) for high in range(low, 24, 2))]
    (factors, _), at = min(fits, key=lambda fit: fit[0][1])
    return lambda outdoors: terms(outdoors, *at) @ factors


def change(bills):
    """Second year's use over that predicted, less 1; None where bills are missing."""
    years = [bills[bills.fiscal_year == year] for year in sorted(bills.fiscal_year.unique())[:2]]
    if len(years) < 2 or min(map(len, years)) < LEAST_BILLS or years[0].usage.mean() <= 0:
        return None
    first, second = years
    return second.usage.sum() / regression(first)(second.OAT_C.to_numpy()).sum() - 1


def main():
    if not BILLS.exists():
        print(f"skipped: no bills in {BILLS}")
        return
    bills = pandas.read_csv(BILLS).dropna(subset=["usage", "OAT_C"])
    for kind, of_kind in bills.groupby("energy_type"):
        changes = [change(of_one) for _, of_one in of_kind.groupby("bdbid")]
        changes = numpy.array([value for value in changes if value is not None])
        quarter, three_quarters = numpy.percentile(changes, [25, 75])
        spread = 100 * (three_quarters - quarter) / 1.349
        print(f"level_change_{kind.lower()} {spread:.1f} % - -")
        print(f"level_change_{kind.lower()}_buildings {len(changes)} - - -")


if __name__ == "__main__":
    main()
