"""Cases that the tests share."""

from pathlib import Path

import pytest

import billet

DISK = """\
title    = "A disk"
analysis = "axisymmetric" # x is the radius, y the axis

[workpiece]
element  = "quad8"
material = "steel"
mesh     = { box = [[0, 0], [10, 5]], cells = [4, 2] }

[material.steel]
elastic = { young = "210 GPa", poisson = 0.3 }
flow    = { law = "swift", K = 740, eps0 = 0.01, n = 0.2 }

[[support]]
where = "x = 0"
fix   = ["x"]

[[support]]
where = "y = 0"
fix   = ["y"]

[[tool]]
name     = "punch"
surface  = { plane = { point = [0, 5], normal = [0, -1] } }
motion   = { velocity = [0, -1] }
friction = { law = "tresca", m = 0.1 }

[[measure]]
name = "half_height"
kind = "height"

[time]
end        = 0.5
increments = { max = 0.05 }
"""


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "long: takes minutes; of `./dev test --all`")


@pytest.fixture
def case() -> billet.Case:
    return billet.Case.from_string(DISK)


@pytest.fixture
def case_file(tmp_path: Path) -> Path:
    file = tmp_path / "case.toml"
    file.write_text(DISK)
    return file


@pytest.fixture(scope="session")
def finished(tmp_path_factory: pytest.TempPathFactory) -> billet.Results:
    """Results of the disk, by the program."""
    folder = tmp_path_factory.mktemp("disk")
    (folder / "case.toml").write_text(DISK)
    return billet.simulate(folder / "case.toml", folder / "results", threads=1)
