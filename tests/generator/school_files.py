"""Paper 2's school room as files: weather, measurements, register, truth."""
import gzip
import json

from school import MEASURED_FROM, drawn_school, measure
from simulate import part_of
from weather import write_weather


def measured_text(measured):
    lines = ["time,room_C,adjacent_C,supply_C,flow"]
    for row in zip(measured.times, measured.room, measured.adjacent, measured.supply, measured.flow):
        stamp = str(row[0])[:16].replace("T", " ")
        lines.append(f"{stamp},{row[1]:.1f},{row[2]:.1f},{row[3]:.1f},{row[4]:g}")
    return "\n".join(lines) + "\n"


def write_school(folder, seed):
    folder.mkdir(parents=True, exist_ok=True)
    school = drawn_school(seed)
    measured = measure(school)
    times = measured.weather.times
    first = int((times < MEASURED_FROM).sum())
    write_weather(folder / "weather_2013.csv", part_of(measured.weather, first, len(times)))
    with open(folder / "measured_2013.csv.gz", "wb") as raw:
        with gzip.GzipFile(filename="", fileobj=raw, mode="wb", mtime=0) as out:
            out.write(measured_text(measured).encode("ascii"))
    register = "".join(f"{day},{n}\n" for day, n in sorted(measured.register.items()))
    (folder / "register.csv").write_text("date,persons\n" + register)
    truth = {name: float(f"{value:.4g}") for name, value in school.truth.items()}
    (folder / "truth.json").write_text(json.dumps({"seed": seed, **truth}, indent=1) + "\n")
