"""The text of an EnergyPlus file: its encoding, and lines that are not EnergyPlus's. UTF-16 and Windows-1252 are read,
which EnergyPlus does not."""
import codecs

from new_job.refused import NO_INPUT, Refused

BYTE_ORDER_MARKS = ((codecs.BOM_UTF8, "utf-8-sig"), (codecs.BOM_UTF16_LE, "utf-16"), (codecs.BOM_UTF16_BE, "utf-16"))
WINDOWS = "cp1252"             # of western Europe; what is no UTF-8 is taken for it
MOST_LETTERS = 60              # of a line of the file in a message


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


def decoded(given):
    """(text, encoding) of an IDF file's bytes."""
    encoding = encoding_of(given) or "utf-8"
    try:
        return given.decode(encoding), encoding
    except UnicodeDecodeError:
        encoding = WINDOWS if encoding == "utf-8" else encoding
        return given.decode(encoding, errors="replace"), encoding


def of_idf(path, checks):
    """`checks` takes a line on an encoding that is guessed."""
    given = read_bytes(path)
    if not encoding_of(given) and b"\0" in given:
        raise Refused(f"{path}: has bytes of 0, as UTF-16 or a file that is no text; expected an IDF file in UTF-8")
    if not given.strip():
        raise Refused(f"{path}: is empty; expected an EnergyPlus file")
    text, encoding = decoded(given)
    if encoding == WINDOWS:
        checks.append(f"{path}: is not UTF-8; it was read as Windows-1252: save it as UTF-8 if letters are wrong")
    text = "\n".join(text.splitlines())
    refuse_macros(path, text)
    return text


def of_json(path):
    given = read_bytes(path)
    if encoding_of(given):
        raise Refused(f"{path}: begins with a byte order mark ({encoding_of(given)}); expected epJSON in UTF-8 without "
                      "one")
    try:
        return given.decode("utf-8")
    except UnicodeDecodeError:
        raise Refused(f"{path}: is not UTF-8; save it as UTF-8") from None
