"""A job file as a document of tomlkit, which keeps comments and order.

tomlkit (0.11) loses tables of two lists that alternate: [[zone.surface]], [[zone.window]], [[zone.surface]]. Those of a
list are put together first, each with the comments above it; that nothing is lost is checked by Python's own reader.
Leaves out a line inside of a text or an array that looks like a heading: such a file is refused.
"""
import re
import tomllib

import tomlkit

HEADING = re.compile(r"\s*\[\[?\s*([A-Za-z_\"'][^\[\]#,]*?)\s*\]\]?\s*(#.*)?$")
COMMENT = re.compile(r"\s*#")


class Block:
    """A table: its heading, the comments above it and its keys, then the tables inside of it."""

    def __init__(self, names=()):
        self.names, self.lines, self.inner = names, [], []

    def text(self):
        """Tables of a list stand together where the first of them stands."""
        lists = {}
        for block in self.inner:
            lists.setdefault(block.names, []).append(block)
        inner = "".join(block.text() for blocks in lists.values() for block in blocks)
        return "".join(self.lines) + inner


def names_in(heading):
    """"zone.surface" as a path; a name between quotes may hold anything."""
    return tuple(name.strip() for name in re.findall(r"\"[^\"]*\"|'[^']*'|[^.]+", heading))


def comments_above(lines):
    """Taken off the end of a table's lines."""
    k = len(lines)
    while k > 0 and COMMENT.match(lines[k - 1]):
        k -= 1
    above = lines[k:]
    del lines[k:]
    return above


def together(text):
    """The same file with the tables of each list one after the other."""
    whole = Block()
    place = [whole]                        # the table of the line, in those that hold it
    for line in text.splitlines(keepends=True):
        heading = HEADING.match(line.rstrip("\r\n"))
        if heading:
            block = Block(names_in(heading.group(1)))
            block.lines = comments_above(place[-1].lines)
            while len(place) > 1 and block.names[:len(place[-1].names)] != place[-1].names \
                    or place[-1].names == block.names:
                place.pop()
            place[-1].inner.append(block)
            place.append(block)
        place[-1].lines.append(line)
    return whole.text()


def is_same(text, other):
    """Whether both say the same."""
    try:
        return tomllib.loads(text) == tomllib.loads(other)
    except ValueError:
        return False


def parse(text):
    """Raises ValueError with a sentence where it is no TOML, or none that can be changed without a loss."""
    document = tomlkit.parse(text)
    if tomlkit.dumps(document) == text:
        return document
    ordered = together(text)
    if is_same(ordered, text):
        document = tomlkit.parse(ordered)
        if tomlkit.dumps(document) == ordered:
            return document
    raise ValueError("tables of a list have others between them; expected each list in one place, such as all "
                     "[[zone.surface]] and then all [[zone.window]]")
