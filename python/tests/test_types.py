"""The package's types: complete, and right."""

from __future__ import annotations

import inspect
import subprocess
import sys
from pathlib import Path

import pytest

import billet

PACKAGE = Path(__file__).resolve().parents[1]


def test_mypy_finds_nothing(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--cache-dir", tmp_path, "--config-file", "pyproject.toml"],
        cwd=PACKAGE, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout


def test_whatever_is_public_says_what_it_is() -> None:
    for name in billet.__all__:
        item = getattr(billet, name)
        assert item.__doc__, name
        if not inspect.isclass(item) or issubclass(item, BaseException):
            continue
        for member, value in vars(item).items():
            documented = isinstance(value, property) or inspect.isfunction(value)
            if documented and not member.startswith("_"):
                assert value.__doc__, f"{name}.{member}"


def test_the_stub_of_the_module_is_complete() -> None:
    from billet import _native

    stub = (PACKAGE / "billet" / "_native.pyi").read_text()
    for item in (_native.Case, _native.Run, _native.Increment):
        for member in vars(item):
            if not member.startswith("_"):
                assert f"def {member}(" in stub or f"    {member}: " in stub, member
