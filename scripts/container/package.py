"""Spack's recipe of bemcal. Versions are those of CMakeLists.txt. No release has an address yet, so it builds a
checkout: `spack repo create REPO`, copy this file to REPO/packages/bemcal, `spack repo add REPO`, and in the checkout
`spack dev-build bemcal@main`. The scripts' Python packages are left out: they run /usr/bin/python3."""
from spack.package import *


class Bemcal(CMakePackage):
    """A batch engine that calibrates hourly building energy models to measured meters."""

    license("Apache-2.0")

    version("main")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("mpi@3.0:")
    depends_on("hdf5@1.10: +hl")
    depends_on("eigen@3.4:")
    depends_on("fmt@9.1:")
    depends_on("boost@1.74:")
    depends_on("zlib-api")
    depends_on("tomlplusplus@3.3:")
    depends_on("cli11@2.1:")
    depends_on("xxhash@0.8:")
    depends_on("random123@1.14:")
    for family in ("aarch64", "ppc64le", "riscv64"):
        depends_on("simde@0.7:", when=f"target={family}:")

    def cmake_args(self):
        return [self.define("BEMCAL_TESTS", False), self.define("BEMCAL_BENCH", False)]
