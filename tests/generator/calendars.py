"""Public holidays on working days, as they fell, by country (Zurich is a canton): dates that move with
Easter, with the moon, or to the next Monday. From the governments' lists; written down and not
reckoned, so that they are no copy of any rule. They cover a case of two years from 2021, and its
settling days.

Left out: working weekends that make up for a holiday, and the days that go with them."""
import numpy as np

HOLIDAYS = {
    "England": """
        2020-12-25 2020-12-28
        2021-01-01 2021-04-02 2021-04-05 2021-05-03 2021-05-31 2021-08-30 2021-12-27 2021-12-28
        2022-01-03 2022-04-15 2022-04-18 2022-05-02 2022-06-02 2022-06-03 2022-08-29 2022-09-19
        2022-12-26 2022-12-27""",
    "Zurich": """
        2020-12-25
        2021-01-01 2021-04-02 2021-04-05 2021-05-13 2021-05-24
        2022-04-15 2022-04-18 2022-05-26 2022-06-06 2022-08-01 2022-12-26""",
    "Hong Kong": """
        2020-12-25
        2021-01-01 2021-02-12 2021-02-15 2021-04-02 2021-04-05 2021-04-06 2021-05-19 2021-06-14
        2021-07-01 2021-09-22 2021-10-01 2021-10-14 2021-12-27
        2022-02-01 2022-02-02 2022-02-03 2022-04-05 2022-04-15 2022-04-18 2022-05-02 2022-05-09
        2022-06-03 2022-07-01 2022-09-12 2022-10-04 2022-12-26 2022-12-27""",
}
COUNTRY_OF = {"cool_maritime": "England", "continental": "Zurich", "hot_humid": "Hong Kong"}


def holidays_of(climate):
    """Of the country that has this climate."""
    return np.array(HOLIDAYS[COUNTRY_OF[climate]].split(), "datetime64[D]")
