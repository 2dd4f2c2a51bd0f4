"""Sheets of an Excel workbook (.xlsx) as rows of texts, for exports that come as one.

Source: ECMA-376: shared strings, cells by reference, dates as days since 1899-12-30 in cells whose style has a format
of dates. Not by openpyxl: `new` needs nothing but Python. Leaves out formulas without a stored value, and the calendar
of 1904.
"""
import contextlib
import datetime as dt
import re
import xml.etree.ElementTree as ElementTree
import zipfile
import zlib

from new_job.refused import Refused

SPACE = {"x": "http://schemas.openxmlformats.org/spreadsheetml/2006/main"}
EPOCH = dt.datetime(1899, 12, 30)
MOST_BYTES = 5e8               # of a sheet, unpacked
DATE_FORMATS = set(range(14, 23))  # of the standard's own


@contextlib.contextmanager
def opened(path):
    """The packed file; whatever is wrong with it is refused."""
    try:
        with zipfile.ZipFile(path) as packed:
            yield packed
    except (zipfile.BadZipFile, zlib.error, EOFError, RuntimeError, NotImplementedError, MemoryError, OSError,
            ElementTree.ParseError, ValueError, LookupError, AttributeError, TypeError, OverflowError) as error:
        raise Refused(f"{path}: is a workbook that cannot be read ({error}); save its sheet as CSV") from None


def is_workbook(path):
    if not zipfile.is_zipfile(path):
        return False
    with opened(path) as packed:
        return "xl/workbook.xml" in packed.namelist()


def part(packed, name):
    """None where it is not there."""
    if name not in packed.namelist():
        return None
    if packed.getinfo(name).file_size > MOST_BYTES:
        raise ValueError(f"{name} has more than {MOST_BYTES:g} bytes")
    return ElementTree.fromstring(packed.read(name))


def texts_of(root, path):
    """Of the shared strings: each may be of several runs."""
    return [] if root is None else ["".join(run.text or "" for run in item.iter(f"{{{SPACE['x']}}}t"))
                                    for item in root.findall(path, SPACE)]


def date_styles(root):
    """Indices of the cell styles that show dates."""
    if root is None:
        return set()
    own = {int(each.get("numFmtId")) for each in root.findall("x:numFmts/x:numFmt", SPACE)
           if re.search(r"[dy]", re.sub(r'"[^"]*"|\[[^]]*\]', "", each.get("formatCode", "").lower()))}
    return {k for k, style in enumerate(root.findall("x:cellXfs/x:xf", SPACE))
            if int(style.get("numFmtId", 0)) in DATE_FORMATS | own}


def column_of(reference):
    """"AB7" -> 27; Excel's last is XFD."""
    number = 0
    for letter in re.match(r"[A-Z]{1,3}", reference).group(0):
        number = 26 * number + ord(letter) - ord("A") + 1
    return number - 1


def cell_text(cell, shared, dates):
    value = cell.find("x:v", SPACE)
    if cell.get("t") == "inlineStr":
        return "".join(run.text or "" for run in cell.iter(f"{{{SPACE['x']}}}t"))
    if value is None or value.text is None:
        return ""
    if cell.get("t") == "s":
        return shared[int(value.text)]
    if cell.get("t") in (None, "n") and int(cell.get("s", 0)) in dates:
        return f"{EPOCH + dt.timedelta(days=float(value.text)):%Y-%m-%d}"
    return value.text


def rows_of(sheet, shared, dates):
    for row in sheet.findall("x:sheetData/x:row", SPACE):
        cells = {column_of(cell.get("r")): cell_text(cell, shared, dates) for cell in row.findall("x:c", SPACE)}
        yield [cells.get(k, "") for k in range(max(cells, default=-1) + 1)]


def sheets_in(path):
    """[rows of texts] of each sheet."""
    with opened(path) as packed:
        shared = texts_of(part(packed, "xl/sharedStrings.xml"), "x:si")
        dates = date_styles(part(packed, "xl/styles.xml"))
        names = sorted(name for name in packed.namelist() if re.fullmatch(r"xl/worksheets/sheet\d+\.xml", name))
        return [list(rows_of(part(packed, name), shared, dates)) for name in names]
