"""One self-contained HTML page of a result's studies: no script, no request.

What a kind has is the table in kinds; of a loop it is loop.html. A part that cannot be drawn is a sentence.
"""
import pathlib
import re
from dataclasses import dataclass, field

import jinja2
from markupsafe import Markup

from report import answers, guard, loop, theme
from report.kinds import KINDS
from report.picture import Picture, Table
from report.words import listed, number, said

SAID_OF_RESULT = ("program", "version", "seed", "result_hash")


@dataclass
class Part:
    heading: str
    pictures: list = field(default_factory=list)
    tables: list = field(default_factory=list)
    sentences: list = field(default_factory=list)

    def add(self, one):
        place = {Picture: self.pictures, Table: self.tables}.get(type(one), self.sentences)
        place.append(one)

    def __bool__(self):
        return bool(self.pictures or self.tables or self.sentences)


@dataclass
class Section:
    """A study on the page."""
    name: str
    question: str
    remarks: list
    parts: list
    answer: str = ""
    loop: Markup = Markup("")
    loop_pictures: list = field(default_factory=list)

    @property
    def id(self):
        return slug(self.name)

    @property
    def pictures(self):
        return self.loop_pictures + [picture for part in self.parts for picture in part.pictures]


def slug(text):
    return re.sub(r"[^a-z0-9]+", "-", text.lower()).strip("-") or "study"


def remarks_of(study):
    """(head, sentence) of what went wrong in it."""
    lines = []
    if study.damage:
        lines.append(("Damaged:", f"this study cannot be read: {study.damage}"))
    if study.text("shortfall"):
        lines.append(("Falls short:", f"{study.text('shortfall')}."))
    reasons = study.texts("failed_item_reason") or study.texts("failed_reason")
    n_failed = study.number("n_failed")
    if n_failed > 0 or study.texts("failed_item_reason"):
        why = f": {listed(list(dict.fromkeys(reasons))[:3])}" if reasons else ""
        n = n_failed if n_failed > 0 else len(reasons)
        lines.append(("Failed:", f"{number(n, 6)} simulation{'' if n == 1 else 's'}{why}."))
    return lines


def parts_of(study):
    """By heading, in the table's order."""
    parts = {}
    for row in KINDS[study.kind].parts if study.kind in KINDS else ():
        part = parts.setdefault(row.heading, Part(row.heading))
        if not study.knows(*row.needs):
            continue
        try:
            with guard.reading(study.path):
                for one in row.make(study):
                    part.add(one)
        except guard.Refused as refused:
            part.add(f"A part is not shown, since its numbers do not fit together: {refused}.")
    return [part for part in parts.values() if part]


def environment():
    made = jinja2.Environment(loader=jinja2.FileSystemLoader(pathlib.Path(__file__).parent), autoescape=True,
                              trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    made.filters["said"] = said
    return made


def answer_of(study):
    try:
        with guard.reading(study.path):
            return answers.answer(study)
    except guard.Refused:      # the part that draws them tells that the numbers do not fit together
        return ""


def said_kind(kind):
    return "Kennedy and O'Hagan" if kind == "kennedy_ohagan" else kind.replace("_", " ")


def section_of(study, name):
    kind = KINDS.get(study.kind)
    question = kind.question if kind else "a kind that has no pictures"
    answers_what = question if study.name == study.kind else f"{said_kind(study.kind)}: {question}"
    section = Section(name, answers_what, remarks_of(study), [])
    if study.damage:
        return section
    if study.loop:
        numbers = loop.contents(study.loop)
        section.loop = Markup(environment().get_template("loop.html").render(numbers))
        section.loop_pictures = loop.pictures_in(numbers)
    else:
        section.parts, section.answer = parts_of(study), answer_of(study)
    if not section.parts and not section.loop and not section.remarks:
        section.remarks.append(("No pictures:", "it stores nothing that can be drawn."))
    return section


def findings_table(result):
    several = len(result.findings) > 1
    rows = [([building] if several else []) + [finding.series, finding.finding, finding.action]
            for building, findings in result.findings.items() for finding in findings]
    head = ([("building", False)] if several else []) + [("series", False), ("finding", False),
                                                         ("done about it", False)]
    return Table("Findings", head, rows) if rows else None


POSTERIOR = "posterior"
WITHOUT_EFFECTS = ("Without what the loop found:", "this is of the model as the job has it. With the effects and "
                   "functions of the loop values and savings are others, and its values “after” are to be believed; "
                   "bemcal-batch adopt writes a job with them, for a posterior of its own.")


def title_of(result):
    """The building, or the job where there are several or none."""
    buildings = [building for building in result.findings if building]
    return buildings[0] if len(buildings) == 1 else result.title or "Result"


def place_of(study):
    """In the order of the table of kinds: the loop first, then that of a job."""
    kinds = list(KINDS)
    return kinds.index(study.kind) if study.kind in kinds else len(kinds)


def sections_of(result):
    several = len(result.findings) > 1
    studies = sorted(result.studies, key=lambda study: (study.building, place_of(study)))
    sections = [section_of(study, study.path if several else study.name) for study in studies]
    lacking = {study.building for study in studies if study.loop and (study.loop.effects or study.loop.functions)}
    for study, section in zip(studies, sections):
        if study.kind == POSTERIOR and study.building in lacking:
            section.remarks.append(WITHOUT_EFFECTS)
    return sections


def html_of(result, sections=None):
    """The page as text."""
    return environment().get_template("page.html").render(
        title=title_of(result), sections=sections or sections_of(result), findings=findings_table(result),
        said_of_result=[f"{name.replace('_', ' ')} {result.attributes[name]}" for name in SAID_OF_RESULT
                        if name in result.attributes],
        colours={name: (light, dark) for name, light, dark in theme.COLOURS.values()})


def figures_of(sections):
    """(file name, SVG that stands alone) of every picture, in the page's order."""
    taken = {}
    for section in sections:
        for picture in section.pictures:
            name = f"{section.id}-{slug(picture.title)}"
            taken[name] = taken.get(name, 0) + 1
            suffix = f"-{taken[name]}" if taken[name] > 1 else ""
            yield f"{name}{suffix}.svg", theme.by_itself(picture.svg, picture.alt)
