"""Sections of a job file as text.

Not by tomlkit: `new`, which uses this, needs nothing but Python, and its comments stand in one column.
"""
import json


def number(value):
    return f"{value:.6g}"


def numbers(values):
    return "[" + ", ".join(f"{v:g}" for v in values) + "]"


def texts(values):
    return "[" + ", ".join(json.dumps(v) for v in values) + "]"


def section(heading, **keys):
    """A section; None is left out, str is quoted unless it is a table or a list already."""
    lines = [heading]
    for key, value in keys.items():
        if value is None:
            continue
        if isinstance(value, str) and value[:1] not in "{[\"":
            value = json.dumps(value)
        elif not isinstance(value, str):
            value = number(value)
        lines.append(f"{key} = {value}")
    return "\n".join(lines) + "\n"


def scheduled(value, schedule, low=0.0):
    low_part = f", low = {number(low)}" if low else ""
    return f'{{value = {number(value)}{low_part}, schedule = "{schedule}"}}'
