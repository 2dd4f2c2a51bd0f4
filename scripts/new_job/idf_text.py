"""The text of an EnergyPlus file: its encoding, lines that are not EnergyPlus's, and objects that cannot be.

UTF-16 is read, which EnergyPlus does not. A decimal comma is found only where it makes an object longer than its class.
"""
import codecs

from new_job import idf
from new_job.idf_fields import MOST_FIELDS, WHOLE
from new_job.refused import NO_INPUT, Refused

BYTE_ORDER_MARKS = ((codecs.BOM_UTF8, "utf-8-sig"), (codecs.BOM_UTF16_LE, "utf-16"), (codecs.BOM_UTF16_BE, "utf-16"))
JSON = (".epjson", ".json")
MOST_LETTERS = 60              # of a line of the file in a message
COUNTED = (25, 2)              # the version whose numbers of fields are known: later classes may have more


def encoding_of(given):
    """By its byte order mark; "" without."""
    return next((name for mark, name in BYTE_ORDER_MARKS if given.startswith(mark)), "")


def read_bytes(path):
    try:
        with open(path, "rb") as file:
            return file.read()
    except OSError as error:
        raise Refused(f"{path}: {error.strerror}; expected an EnergyPlus file, .idf or .epJSON", NO_INPUT) from None


def refuse_macros(path, text):
    """Lines of EP-Macro, which EnergyPlus does not read either."""
    line = next((line.strip() for line in text.splitlines() if line.lstrip().startswith("##")), None)
    if line:
        raise Refused(f"{path}: {line[:MOST_LETTERS]!r} is a line of EP-Macro; run EnergyPlus's EPMacro and give its "
                      "out.idf")


def refuse_more(path, row, version):
    """An object with more fields than its class has: a comma within a number would shift all behind it."""
    kind, values = row[0].lower(), row[1:]
    while values and not values[-1]:
        values = values[:-1]
    most = len(idf.fields_in(kind, version)) if kind in WHOLE else MOST_FIELDS.get(kind, len(values))
    if len(values) > most and version <= COUNTED:
        raise Refused(f'{path}: {row[0]} "{values[0]}": has {len(values)} fields; expected {most} at most. A number '
                      "has a point, no comma: 10.76")


def decoded(path, given):
    encoding = encoding_of(given)
    if not encoding and b"\0" in given:
        raise Refused(f"{path}: has bytes of 0, as UTF-16 or a file that is no text; expected an IDF file in UTF-8")
    return "\n".join(given.decode(encoding or "utf-8", errors="replace").splitlines())


def objects_of_idf(path, given):
    text = decoded(path, given)
    refuse_macros(path, text)
    rows = idf.split_objects(path, text)
    said = next((row[1] for row in rows if row[0].lower() == "version" and len(row) > 1), None)
    if said is None:
        raise Refused(f"{path}: has no object Version; expected an input file of {idf.ADVICE}")
    version = idf.version_of(path, said)
    for row in rows:
        refuse_more(path, row, version)
    return [idf.of_row(path, row, version) for row in rows]


def read_model(path):
    given = read_bytes(path)
    if not path.lower().endswith(JSON):
        return idf.Model(path, objects_of_idf(path, given))
    if encoding_of(given):
        raise Refused(f"{path}: begins with a byte order mark ({encoding_of(given)}); expected epJSON in UTF-8 without "
                      "one")
    return idf.read_model(path)
