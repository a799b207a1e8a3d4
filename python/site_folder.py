"""Prints where packages lie below a prefix for the Python that runs this: "lib/python3.11/..."."""

import pathlib
import site
import sysconfig

LOCAL = pathlib.Path("/usr/local")


def site_folder() -> pathlib.PurePath:
    for folder in map(pathlib.Path, site.getsitepackages()):
        if LOCAL in folder.parents:
            found = folder.relative_to(LOCAL)
            return found.relative_to("local") if found.parts[0] == "local" else found
    return pathlib.Path(sysconfig.get_path("platlib")).relative_to(sysconfig.get_path("data"))


if __name__ == "__main__":
    print(site_folder().as_posix())
