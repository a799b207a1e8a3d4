"""Builds the package for `pip install`: billet by its own CMake, then the module for this Python.

billet is built in the folder `build` of the repository where `./dev` has configured it, so that
nothing is compiled twice, else in `build/pip`. BILLET_PREFIX names an installed billet that is taken
in its place. The package holds the libraries and programs.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
TARGETS = ["billet", "billet_library", "billet-render", "billet_multigrid"]  # as far as configured
COMPONENTS = ["program", "development", "multigrid"]  # of its installation, as far as configured


def cmake(*words: object) -> None:
    command = ["cmake", *map(str, words)]
    print(" ".join(command), flush=True)
    try:
        subprocess.run(command, check=True)
    except FileNotFoundError:
        sys.exit("billet is built by CMake, which is not installed: ./dev build installs all it needs")
    except subprocess.CalledProcessError as error:
        sys.exit(f"cmake has ended with status {error.returncode}; ./dev build installs all it needs")


def jobs() -> int:
    """Compilers at once: 2 GB each."""
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return max(1, min(len(os.sched_getaffinity(0)), int(memory / 2e9)))


def build_billet() -> Path:
    """Builds library and programs; returns the build folder."""
    cache = ROOT / "build" / "CMakeCache.txt"
    if cache.exists() and f"CMAKE_HOME_DIRECTORY:INTERNAL={ROOT}\n" in cache.read_text():
        build = ROOT / "build"
    else:
        build = ROOT / "build" / "pip"
        cmake("-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
              "-DBILLET_RELAXED=ON", "-DBILLET_TESTS=OFF")  # fmt: skip
    if shutil.which("cmake") is None:
        sys.exit("billet is built by CMake, which is not installed: ./dev build installs all it needs")
    listed = subprocess.run(["cmake", "--build", build, "--target", "help"], capture_output=True, text=True)
    if listed.returncode != 0:
        sys.exit(f"{build} cannot be configured:\n{listed.stdout}{listed.stderr}")
    known = listed.stdout.split("\n")
    targets = [each for each in TARGETS if any(line.startswith(f"{each}:") for line in known)]
    cmake("--build", build, "--parallel", jobs(), "--target", *targets)
    return build


def version() -> str:
    found = re.search(r"^project\(billet VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(), re.M)
    assert found
    return found[1]


class BuildByCMake(build_ext):
    """The one extension, with the programs and libraries that it needs in the same package."""

    def build_extension(self, extension: Extension) -> None:
        work = Path(self.build_temp).resolve()
        installed, module = self.installed_billet(work), work / "module"
        package = Path(self.get_ext_fullpath(extension.name)).resolve().parent
        cmake("-S", HERE, "-B", module, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "--fresh",
              f"-DCMAKE_PREFIX_PATH={installed}", f"-DPython3_EXECUTABLE={sys.executable}",
              "-DBILLET_PYTHON_DIR=module")  # fmt: skip
        cmake("--build", module)
        cmake("--install", module, "--prefix", work, "--component", "python")
        package.mkdir(parents=True, exist_ok=True)
        for file in (work / "module").glob("_native*.so"):
            shutil.copy2(file, package)
        self.copy_installed(installed, package)

    @staticmethod
    def installed_billet(work: Path) -> Path:
        if "BILLET_PREFIX" in os.environ:
            return Path(os.environ["BILLET_PREFIX"]).resolve()
        build = build_billet()
        for component in COMPONENTS:
            cmake("--install", build, "--prefix", work / "installed", "--component", component)
        return work / "installed"

    @staticmethod
    def copy_installed(installed: Path, package: Path) -> None:
        """A wheel has no links: each library once, under the name that it is looked for by."""
        for folder in ("bin", "lib"):
            (package / folder).mkdir(exist_ok=True)
        for program in (installed / "bin").glob("billet*"):
            shutil.copy2(program, package / "bin")
        for library in [*installed.glob("lib*/libbillet*.so*"), *installed.glob("lib/*/libbillet*.so*")]:
            versions = library.name.partition(".so")[2].count(".")
            if versions == 1 or (versions == 0 and not library.is_symlink()):
                shutil.copy2(library, package / "lib" / library.name)


setup(version=version(), ext_modules=[Extension("billet._native", sources=[])], cmdclass={"build_ext": BuildByCMake})
