"""The text of an EnergyPlus file: its encoding, and lines that are not EnergyPlus's. UTF-16 is read, which EnergyPlus
does not."""
import codecs

from new_job.refused import NO_INPUT, Refused

BYTE_ORDER_MARKS = ((codecs.BOM_UTF8, "utf-8-sig"), (codecs.BOM_UTF16_LE, "utf-16"), (codecs.BOM_UTF16_BE, "utf-16"))
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


def of_idf(path):
    given = read_bytes(path)
    encoding = encoding_of(given)
    if not encoding and b"\0" in given:
        raise Refused(f"{path}: has bytes of 0, as UTF-16 or a file that is no text; expected an IDF file in UTF-8")
    text = "\n".join(given.decode(encoding or "utf-8", errors="replace").splitlines())
    refuse_macros(path, text)
    return text


def of_json(path):
    given = read_bytes(path)
    if encoding_of(given):
        raise Refused(f"{path}: begins with a byte order mark ({encoding_of(given)}); expected epJSON in UTF-8 without "
                      "one")
    return given.decode("utf-8", errors="replace")
