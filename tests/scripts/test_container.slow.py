#!/usr/bin/python3
"""buildah builds Containerfile on a Debian 12 of mmdebstrap, named as the base that it asks for. The image checks the
quickstart and runs it on two ranks. Skipped where one of both is not installed, or where this user may not build. A
quarter of an hour, most of it compiling. Nothing is pulled, and nothing is left outside of a temporary folder."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECIPE = ROOT / "scripts" / "container" / "Containerfile"
SKIPPED = 77
QUICKSTART = "/usr/share/bemcal/jobs/quickstart/quickstart.toml"
ISOLATION = ["--isolation", "chroot", "--network", "host"]    # needs no namespaces of its own


def output(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))} ended with {done.returncode}:\n{done.stdout[-4000:]}"
                 f"{done.stderr[-4000:]}")
    return done.stdout.strip()


def context(folder):
    """What the recipe copies, without builds and results."""
    for name in set(re.findall(r"^COPY (?!--from)(\w[\w.]*)", RECIPE.read_text(), re.M)):
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
        copy(ROOT / name, folder / name)
    return folder


def main(folder):
    buildah = ["buildah", "--root", folder / "images", "--runroot", folder / "run", "--storage-driver", "vfs"]
    base = re.search(r"^FROM (\S+)", RECIPE.read_text(), re.M)[1]
    release = re.search(r"debian:(\d+)", base)[1]
    output("mmdebstrap", "--variant=minbase", {"12": "bookworm"}[release], folder / "base.tar")
    first = output(*buildah, "from", "scratch")
    output(*buildah, "add", "-q", first, folder / "base.tar", "/")
    output(*buildah, "commit", "-q", "--rm", first, base)

    output(*buildah, "build", *ISOLATION, "--pull-never", "-f", RECIPE, "-t", "bemcal", context(folder / "context"))
    image = output(*buildah, "from", "--pull-never", "bemcal")
    run = [*buildah, "run", *ISOLATION, image, "--"]
    print(output(*run, "bemcal-batch", "--version"))
    output(*run, "bemcal-batch", "check", QUICKSTART)
    told = output(*run, "mpirun", "--oversubscribe", "-np", "2", "bemcal-batch", "run", QUICKSTART,
                  "-o", "/data/quickstart.h5")
    page = output(*run, "ls", "/data")
    assert "quickstart.h5" in page and "quickstart.html" in page, page + told
    assert "after" in told, told


if __name__ == "__main__":
    lacking = [tool for tool in ("buildah", "mmdebstrap") if not shutil.which(tool)]
    if lacking:
        print(f"no {', '.join(lacking)}: the container is not built")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as temporary:
        pathlib.Path(temporary, "context").mkdir()
        main(pathlib.Path(temporary))
