#!/usr/bin/python3
"""The Debian package of cpack holds program, jobs, scripts and texts, and a quickstart that checks; container files
name the same base and take their packages from scripts/install-packages; Spack's recipe has CMakeLists.txt's versions.
No container is built here."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CONTAINER = ROOT / "scripts" / "container"
INSTALL_PACKAGES = ROOT / "scripts" / "install-packages"
LISTED = ["bin/bemcal-batch", "share/bemcal/jobs/quickstart/quickstart.toml", "share/bemcal/jobs/slurm/one_node.sbatch",
          "share/bemcal/scripts/result_report", "share/bemcal/scripts/result_tables",
          "share/bemcal/scripts/new_job/u_values.csv",
          "share/bemcal/scripts/python/bemcal/__init__.py", "share/man/man1/bemcal-batch.1",
          "share/man/man5/bemcal-job.5",
          "share/bash-completion/completions/bemcal-batch", "share/zsh/site-functions/_bemcal-batch",
          "share/doc/bemcal/LICENSE", "share/doc/bemcal/CHANGELOG.md", "share/doc/bemcal/CITATION.cff",
          "share/doc/bemcal/copyright"]
# Names of a library in CMakeLists.txt and in Spack; zlib-api is virtual and has no version there.
IN_SPACK = {"MPI": "mpi", "HDF5": "hdf5", "Eigen3": "eigen", "fmt": "fmt", "Boost": "boost", "ZLIB": "zlib-api",
            "tomlplusplus": "tomlplusplus", "CLI11": "cli11", "xxHash": "xxhash",
            "Random123": "random123", "SIMDe": "simde"}
WITH_THE_COMPILER, OF_THE_TESTS, VIRTUAL = {"OpenMP"}, {"GTest"}, {"ZLIB"}


def output(*command, **options):
    return subprocess.run(command, check=True, capture_output=True, text=True, **options).stdout


class Containers(unittest.TestCase):
    FILES = ("Containerfile", "bemcal.def")

    def text(self, name):
        """The file without its comments."""
        return re.sub(r"^#.*\n", "", (CONTAINER / name).read_text(), flags=re.M)

    def test_have_one_base(self):
        bases = [base for name in self.FILES for base in re.findall(r"^(?:FROM|From:) (\S+)", self.text(name), re.M)]
        self.assertEqual(len(bases), 4, "two files with two stages each")
        self.assertEqual(len(set(bases)), 1, bases)

    def test_take_packages_from_the_one_list(self):
        listed = set(output(INSTALL_PACKAGES, "--list", "build", "run", "package").split())
        for name in self.FILES:
            with self.subTest(name):
                text = self.text(name)
                self.assertEqual(re.findall(r"install-packages ([a-z ]+?)\s*(?:\\)?\n", text), ["build package", "run"])
                self.assertFalse(listed & set(re.findall(r"[\w.+-]+", text)), "a package is named here, too")

    def test_have_shell_that_parses(self):
        posts = self.text("bemcal.def").split("%post\n")[1:]
        self.assertEqual(len(posts), 2)
        for post in posts:
            lines = re.split(r"^(?:%|Bootstrap)", post, flags=re.M)[0]
            subprocess.run(["sh", "-n"], input=lines, text=True, check=True)

    def test_copy_files_that_exist(self):
        copied = re.findall(r"^COPY (?!--from)(\S+) ", self.text("Containerfile"), re.M)
        files = self.text("bemcal.def").split("%files\n")[1].split("%post")[0].split()[::2]
        self.assertEqual(set(copied) - {"scripts/install-packages"}, set(files))
        for name in files:
            self.assertTrue((ROOT / name).exists(), name)


class Spack(unittest.TestCase):
    def test_has_the_versions_of_cmake(self):
        cmake = (ROOT / "CMakeLists.txt").read_text()
        needed = dict(re.findall(r"^\s*bemcal_(?:find|lacks)\((\w+) ([\d.]+) ", cmake, re.M))
        recipe = (CONTAINER / "package.py").read_text()
        compile(recipe, "package.py", "exec")
        depends = dict(re.findall(r'depends_on\("([\w-]+)(?:@([\d.]+):)?', recipe))
        self.assertEqual(set(needed) - WITH_THE_COMPILER - OF_THE_TESTS, set(IN_SPACK))
        for library, name in IN_SPACK.items():
            self.assertEqual(depends.get(name), "" if library in VIRTUAL else needed[library], library)
        self.assertEqual(depends["cmake"], re.search(r"cmake_minimum_required\(VERSION ([\d.]+)\)", cmake)[1])


class Debian(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        lacking = [tool for tool in ("cpack", "dpkg-deb", "dpkg-shlibdeps", "file") if not shutil.which(tool)]
        if lacking or "BEMCAL_BUILD" not in os.environ:
            raise unittest.SkipTest(f"no {', '.join(lacking) or 'BEMCAL_BUILD'}: the Debian package is skipped")
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        config = pathlib.Path(os.environ["BEMCAL_BUILD"], "CPackConfig.cmake")
        output("cpack", "--config", config, "-B", cls.folder.name, cwd=cls.folder.name)
        cls.package, = pathlib.Path(cls.folder.name).glob("bemcal_*.deb")
        cls.usr = pathlib.Path(cls.folder.name, "root", "usr")
        output("dpkg-deb", "-x", cls.package, cls.usr.parent)

    def field(self, name):
        return output("dpkg-deb", "-f", self.package, name).strip()

    def test_is_named_by_version_and_architecture(self):
        version = re.search(r"project\(bemcal VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
        architecture = output("dpkg", "--print-architecture").strip()
        self.assertEqual(self.package.name, f"bemcal_{version}_{architecture}.deb")

    def test_holds_what_is_listed_under_usr_alone(self):
        for name in LISTED:
            self.assertTrue((self.usr / name).is_file() and (self.usr / name).stat().st_size, name)
        self.assertEqual([path.name for path in self.usr.parent.iterdir()], ["usr"])
        self.assertFalse((self.usr / "share/bemcal/scripts/container").exists())

    def test_depends_on_libraries_and_recommends_what_scripts_need(self):
        depends = re.findall(r"(?:^|, )([\w.+-]+)", self.field("Depends"))
        for library in ("libc6", "libhdf5", "libopenmpi", "libgomp1"):
            self.assertTrue(any(name.startswith(library) for name in depends), f"{library} of {depends}")
        needed = output(INSTALL_PACKAGES, "--list", "run").split()
        self.assertEqual(set(self.field("Recommends").split(", ")), set(needed))

    def test_checks_its_own_quickstart(self):
        run = subprocess.run([self.usr / "bin/bemcal-batch", "check", self.usr / LISTED[1]], cwd="/",
                             capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)


if __name__ == "__main__":
    tests = unittest.main(verbosity=0, exit=False)
    if not tests.result.wasSuccessful():
        sys.exit(1)
    if tests.result.skipped:
        print(*{reason for _, reason in tests.result.skipped})
        sys.exit(77)
