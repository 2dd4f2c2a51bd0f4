"""What stands on a page: a picture with its words, a table, or a sentence."""
from dataclasses import dataclass

from report import theme
from report.words import unit_said

LONGEST_NAME, LONGEST_OF_THREE = 24, 20       # of a label; of the title of one of three panels [characters]


@dataclass
class Picture:
    svg: str                   # with marker colours
    alt: str
    caption: str
    title: str

    @property
    def uri(self):
        return theme.uri_of(self.svg)


@dataclass
class Table:
    title: str
    head: list                 # (words, whether its cells are numbers)
    rows: list                 # lists of texts


def picture(figure, title, alt, caption):
    return Picture(theme.svg_of(figure), alt, caption, title)


def short(name, longest=LONGEST_NAME):
    """With an ellipsis in the middle where it is too long for a label; its end tells names apart."""
    half = longest // 2
    return name if len(name) <= longest else f"{name[:half]}…{name[-half + 1:]}"


def unit_words(unit):
    """" [°C]"; nothing of a number without a unit."""
    return f" [{unit_said(unit)}]" if unit not in ("", "-", "1") and not unit.startswith("of ") else ""


def bare_unit(unit):
    """"°C", for a column of units; "" of a number without one."""
    return unit_words(unit).strip(" []")


def and_more(n, shown, things):
    """" 5 more parameters are not drawn.": where not all are shown."""
    left = n - shown
    return "" if left <= 0 else f" {left} more {things} are not drawn." if left > 1 else \
        f" 1 more {things.removesuffix('s')} is not drawn."
