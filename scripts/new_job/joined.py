"""Meters whose files follow one another in time, such as gas_2021.csv and gas_2022.csv, as one meter of all of them.

A job reads the files of a meter alike: quantity, column, unit, step and all that says how a file is read have to be the
same. Only what one file may not show (marks of thousands, gaps filled with zeros) may be absent from another. Readings
that two files have in common have to be the same. Leaves out bills, of which a job takes one file.
"""
MAY_BE_ABSENT = ("thousands", "zeros", "zero_run")


def is_same_meter(one, other):
    return (one.quantity, one.column) == (other.quantity, other.column)


def goes_on(one, other):
    """Whether the other begins where the first one ends, or within it, and ends later."""
    return one.first < other.first and one.last < other.last


def difference(one, other):
    """What keeps a job from reading the two as one; "" where nothing does."""
    keys = [{key: value for key, value in meter.keys.items() if key not in MAY_BE_ABSENT} for meter in (one, other)]
    in_both = [key for key in MAY_BE_ABSENT if key in one.keys and key in other.keys]
    if not (one.is_regular and other.is_regular):
        return "are bills, of which a job takes one file: put them into one"
    if (one.unit, one.factor, one.step) != (other.unit, other.factor, other.step):
        return "differ in unit or step: put them into one file, alike"
    if keys[0] != keys[1] or any(one.keys[key] != other.keys[key] for key in in_both):
        return "are written in two ways (dates, decimals, clock): put them into one file, alike"
    before = dict(one.series)
    if any(begin in before and before[begin] != value for begin, value in other.series):
        return "have two readings for the same time: correct one, or add them up if both are the building's"
    return ""


def join(one, other):
    """Adds the readings of the one that follows."""
    one.more.append(other.file)
    one.series = one.series + [row for row in other.series if row[0] > one.series[-1][0]]
    one.keys |= {key: value for key, value in other.keys.items() if key in MAY_BE_ABSENT}


def joined(meters, told):
    """In the order of time."""
    made = []
    for meter in sorted(meters, key=lambda each: each.first):
        like = [each for each in made if is_same_meter(each, meter) and goes_on(each, meter)]
        before = next((each for each in like if not difference(each, meter)), None)
        if before is not None:
            told.say(f"{meter.file}: {meter.column}: goes on from {before.files[-1]}; they are one meter")
            join(before, meter)
            continue
        if like:
            told.check(f"{meter.file}: {meter.column}: goes on from {like[0].files[-1]}, but they "
                       f"{difference(like[0], meter)}")
        made.append(meter)
    return [meter for meter in meters if any(meter is each for each in made)]
