#!/usr/bin/python3
"""Every day of every calendar, 2000 to 2030, is that of Debian's python3-holidays, but for the days in DIFFERENT.

The reference is of February 2020: what became law later it cannot know, and it has mistakes. Each row says why
bemcal is right; a row that is not needed fails too. Countries that it does not have are held to published days in
tests/holidays: China, Cyprus, Korea, Latvia, Malta, Romania, Taiwan.
"""
import datetime
import os
import subprocess
import sys
import warnings

sys.modules["hijri_converter"] = None  # with it, the reference has estimates of its own
try:
    import holidays
except ImportError:
    print("no python3-holidays: skipped")
    sys.exit(77)
if not holidays.__version__.startswith("0.10."):
    print(f"python3-holidays is {holidays.__version__}, and the days are compared with 0.10: skipped")
    sys.exit(77)

PROGRAM = os.environ["BEMCAL_PROGRAM"]
LAST = 2030
FIRST = {"SG": 2001, "IN": 2010}

CLASSES = {"FR": "FRA", "IN": "IND", "GB": "England", "GB-ENG": "England", "GB-WLS": "Wales",
           "GB-SCT": "Scotland", "GB-NIR": "NorthernIreland"}
COUNTRIES = ("AT AU BE BG CA CH CZ DE DK EE ES FI FR GB GR HK HR HU IE IN IT JP LT LU NL NO NZ PL PT SE SG SI SK "
             "US").split()
STATES = {
    "AU": holidays.AU.PROVINCES, "CA": holidays.CA.PROVINCES, "CH": holidays.CH.PROVINCES,
    "DE": holidays.DE.PROVINCES, "NZ": holidays.NZ.PROVINCES, "US": holidays.US.STATES,
    "GB": ("ENG", "WLS", "SCT", "NIR")}

# places (a country has its states), + ours or - the reference's alone, the day's name there, its years, why
DIFFERENT = (
    ("AU", "+", "Easter and Anzac Day", "2011", "both fell on 25 April; the states gave the Tuesday"),
    ("AU", "+", "National Day of Mourning", "2022", "for Queen Elizabeth II, proclaimed in September 2022"),
    ("AU-ACT", "+", "Day after Anzac Day", "2020 2026", "declared by the territory"),
    ("AU-NSW", "+", "Day after Anzac Day", "2026 2027", "declared by the state for these years"),
    ("AU-NT", "-", "Anzac Day (Observed)", "2000-", "Public Holidays Act: after a Sunday only"),
    ("AU-QLD", "+", "Royal Queensland Show", "2020 2021", "moved by proclamation"),
    ("AU-QLD", "-", "The Royal Queensland Show", "2020 2021", "moved by proclamation"),
    ("AU-WA", "+", "Sovereign's Birthday", "2011 2018 2024", "proclaimed for another Monday or Friday"),
    ("AU-WA", "-", "Queen's Birthday", "2011 2018 2024", "proclaimed for another Monday or Friday"),
    ("AU-VIC", "+", "Friday before the Final", "2015 2020 2022", "gazetted by the date of the final"),
    ("AU-VIC", "-", "Grand Final Day", "2015 2020 2022", "its rule misses the gazetted dates"),
    ("BG", "+", "Easter Monday", "2000-", "labour code, art. 154: Easter is Friday to Monday"),
    ("BG", "+", "(day off", "2017-", "labour code, art. 154 (2), since 2017"),
    ("BG", "-", "Ден на народните будители", "2000-", "1 November is free for schools alone"),
    ("BG", "+", "Bridge by decree", "2010-", "decrees of the council of ministers, and a law for 2026"),
    ("CA", "+", "New Year's Day (day off", "2000-", "the next working day: 3 January 2011, 2022, 2028"),
    ("CA", "-", "New Year's Day (Observed)", "2000-", "the next working day, not the one before"),
    ("CA", "+", "Boxing Day (day off", "2000-", "where Christmas takes the Monday"),
    ("CA", "+", "Boxing Day", "2000-", "the weekend days themselves"),
    ("CA", "-", "Christmas Day (Observed)", "2000-", "the next working day, not the one before"),
    ("CA-YT", "+", "National Aboriginal Day", "2017-", "law of 2017"),
    ("CH-GE", "+", "Jeûne genevois", "2000-", "law of Geneva"),
    ("CH-GE", "-", "Berchtoldstag", "2000-", "not in the law of Geneva"),
    ("CH-GE", "-", "Escalade", "2000-", "not in the law of Geneva"),
    ("CA", "+", "Truth and Reconciliation", "2022-", "laws of provinces from 2022 on"),
    ("DE-MV", "+", "Frauentag", "2023-", "law of 2022"),
    ("DE-BE", "+", "Tag der Befreiung", "2025", "law of 2024"),
    ("DE-BE", "+", "Aufstand von 1953", "2028", "law of 2024"),
    ("DK", "-", "Store bededag", "2024-", "abolished by a law of 2023"),
    ("GB", "+", "Spring bank holiday", "2002 2022", "moved for the jubilees"),
    ("GB", "-", "Spring Bank Holiday", "2002 2022", "moved for the jubilees"),
    ("GB", "+", "Platinum Jubilee", "2022", "proclaimed after 2020"),
    ("GB", "+", "State funeral of Queen Elizabeth II", "2022", "proclaimed after 2020"),
    ("GB", "+", "Coronation", "2023", "proclaimed after 2020"),
    ("GB-NIR", "+", "Battle of the Boyne (day off", "2000-", "proclaimed each year for a weekend"),
    ("GB-SCT", "+", "St Andrew's Day (day off", "2007-", "the act of 2007 gives the Monday after a weekend"),
    ("GB-SCT", "+", "World Cup bank holiday", "2026", "proclaimed for 2026"),
    ("GB-SCT", "-", "St. Andrew's Day", "2000-2006", "the act is of 2007"),
    ("GR", "+", "Good Friday", "2000-", "a holiday of offices; the reference has Easter Monday alone"),
    ("GR", "+", "Labour Day, moved", "2021-", "ministers' decisions: not on a Sunday or in Holy Week"),
    ("GR", "-", "Εργατική Πρωτομαγιά", "2024", "decided: not on a Sunday or in Holy Week"),
    ("HK", "+", "Day following Mid-Autumn", "2022 2029", "ordinance of 2012: no longer the Saturday before"),
    ("HK", "-", "Chinese Mid-Autumn Festival", "2022 2029", "ordinance of 2012: no longer the Saturday before"),
    ("HR", "+", "Dan državnosti", "2020-", "law of November 2019"),
    ("HR", "-", "Dan državnosti", "2020-", "law of November 2019"),
    ("HR", "+", "Dan sjećanja", "2020-", "law of November 2019"),
    ("HR", "-", "Dan neovisnosti", "2020-", "law of November 2019"),
    ("HU", "+", "Szenteste", "2010-", "on weekends, which the reference leaves out"),
    ("HU", "+", "Szilveszter", "2012", "decree for 2012"),
    ("IE", "+", "St Brigid's Day", "2023-", "law of 2022"),
    ("IE", "+", "Remembrance of the pandemic", "2022", "law of 2022"),
    ("IN", "+", "Good Friday", "2010-", "gazetted; the reference has none of Easter"),
    ("IN", "+", "Mahavir Jayanti", "2010-", "gazetted; the reference has no day of a lunar calendar"),
    ("IN", "+", "Buddha Purnima", "2010-", "gazetted; the reference has no day of a lunar calendar"),
    ("IN", "+", "Guru Nanak's Birthday", "2010-", "gazetted; the reference has no day of a lunar calendar"),
    ("IN", "+", "Muharram", "2010-", "gazetted; the reference has no day of a lunar calendar"),
    ("IN", "+", "Milad-un-Nabi", "2010-", "gazetted; the reference has no day of a lunar calendar"),
    ("IN", "+", "Holi", "2010-", "gazetted; the reference has no day of a lunar calendar"),
    ("IN", "+", "Dussehra", "2010-", "gazetted; the reference has no day of a lunar calendar"),
    ("IN", "+", "Diwali", "2010-", "gazetted; the reference has no day of a lunar calendar"),
    ("IN", "+", "Id-ul-Fitr", "2010-", "gazetted; the reference has no day of a lunar calendar"),
    ("IN", "+", "Id-ul-Zuha", "2010-", "gazetted; the reference has no day of a lunar calendar"),
    ("IT", "+", "150 anni dell'Unità", "2011", "law of 2011"),
    ("IT", "+", "San Francesco", "2026-", "law of 2025"),
    ("JP", "+", "Emperor's Birthday (day off", "2025", "23 February is a Sunday"),
    ("JP", "+", "Marine Day", "2021", "law of December 2020: moved for the Olympics"),
    ("JP", "+", "Sports Day", "2021", "law of December 2020: moved for the Olympics"),
    ("JP", "+", "Mountain Day", "2021", "law of December 2020: moved for the Olympics"),
    ("JP", "-", "", "2021", "law of December 2020: moved for the Olympics"),
    ("LT", "+", "Vėlinės", "2020-", "law of 2019"),
    ("NZ", "+", "Matariki", "2022-", "law of 2022"),
    ("NZ", "+", "Memorial of Queen Elizabeth II", "2022", "law of 2022"),
    ("PL", "+", "Setna rocznica niepodległości", "2018", "law of November 2018"),
    ("PL", "+", "Wigilia", "2025-", "law of 2024"),
    ("SG", "+", "Chinese New Year (day off", "2006-", "Holidays Act, s. 4 (2): the next day that is free"),
    ("SG", "+", "Hari Raya Puasa", "2021-", "the reference has none after 2020"),
    ("SG", "+", "Hari Raya Haji", "2021-", "the reference has none after 2020"),
    ("SG", "+", "Deepavali", "2021-", "announced, where the reference estimates"),
    ("SG", "-", "Deepavali", "2021-", "announced, where the reference estimates"),
    ("SG", "-", "Vesak Day", "2025", "announced, where the reference estimates"),
    ("SG", "+", "Vesak Day", "2016", "the ministry's list: 21 May"),
    ("SG", "-", "Vesak Day", "2016", "the ministry's list: 21 May"),
    ("SG", "+", "Polling Day", "2011 2020 2023 2025", "elections of a president, and those after 2020"),
    ("SI", "+", "dan solidarnosti", "2023", "law of August 2023"),
    ("SK", "-", "Deň Ústavy", "2024-", "works since a law of 2023"),
    ("SK", "-", "Deň boja za slobodu", "2025-", "works since a law of 2025"),
    ("SK", "-", "Deň víťazstva", "2026", "works in 2026 by a law of 2025"),
    ("SK", "-", "Sedembolestná", "2026", "works in 2026 by a law of 2025"),
    ("US", "+", "Juneteenth", "2021-", "law of June 2021"),
    ("US-CA", "-", "Columbus Day", "2009-", "dropped by a law of 2009"),
    ("US-CA", "+", "Day after Thanksgiving", "2000-", "Government Code 6700"),
    ("US-TX", "-", "Columbus Day", "2000-", "Government Code 662.003: no day off"),
    ("US-VA", "+", "Day after Thanksgiving", "2000-", "Code of Virginia 2.2-3300"),
    ("US-VA", "+", "Election Day", "2020-", "law of 2020"),
    ("US-MO", "+", "Truman Day (day off", "2000-", "a Sunday gives the Monday, not the Tuesday"),
    ("US-MO", "-", "Truman Day", "2000-", "a Sunday gives the Monday, not the Tuesday"),
    ("US-VA", "-", "Lee Jackson Day", "2021-", "abolished by a law of 2020"),
)


def is_of_years(year, years):
    if "-" in years:
        first, last = years.split("-")
        return int(first) <= year <= int(last or LAST)
    return str(year) in years.split()


def reason_of(place, sign, day, name, needed):
    for row in DIFFERENT:
        its_place, its_sign, its_name, years, _ = row
        if place.startswith(its_place) and sign == its_sign and its_name in name and is_of_years(day.year, years):
            needed.add(row)
            return row
    return None


def reference(place, years):
    country, _, state = place.partition("-")
    kind = getattr(holidays, CLASSES.get(place, CLASSES.get(country, country)))
    options = {"include_sundays": False} if country in ("NO", "SE") else {}
    if state and country != "GB":
        options["state" if country == "US" else "prov"] = state
    return {day: name for day, name in kind(years=list(years), **options).items() if day.year in years}


def ours(place, years):
    """{day: the names, as printed}"""
    words = [PROGRAM, "describe", "holidays", place, f"{years[0]}-{years[-1]}"]
    lines = subprocess.run(words, capture_output=True, check=True, text=True).stdout.splitlines()
    days = {}
    for line in lines:
        days.setdefault(datetime.date.fromisoformat(line[:10]), []).append(line[16:])
    return {day: ", ".join(names) for day, names in days.items()}


def main():
    warnings.simplefilter("ignore")
    n_days, n_different, wrong, needed = 0, 0, [], set()
    places = COUNTRIES + [f"{country}-{state}" for country, states in STATES.items() for state in states]
    for place in places:
        years = range(FIRST.get(place, 2000), LAST + 1)
        mine, theirs = ours(place, years), reference(place, years)
        n_days += len(mine.keys() & theirs.keys())
        for day in sorted(mine.keys() ^ theirs.keys()):
            sign, name = ("+", mine[day]) if day in mine else ("-", theirs[day])
            n_different += 1
            if not reason_of(place, sign, day, name, needed):
                wrong.append(f"{place} {sign} {day} {name}")
    wrong += [f"no longer needed: {row}" for row in DIFFERENT if row not in needed]
    print("\n".join(wrong))
    print(f"{len(places)} places: {n_days} days are the same, {n_different} differ for {len(needed)} reasons")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
