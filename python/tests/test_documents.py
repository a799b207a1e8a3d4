"""The guide's blocks of code and the notebooks run as they stand."""

from __future__ import annotations

import json
import os
import re
import sys
from pathlib import Path

import pytest

import billet  # noqa: F401

ROOT = Path(__file__).resolve().parents[2]
GUIDE = ROOT / "docs" / "guide" / "python.md"
NOTEBOOKS = sorted((ROOT / "python" / "examples").glob("*.ipynb"))


def blocks(page: Path, language: str) -> list[tuple[int, str]]:
    """Line and text of each block of a language."""
    text = page.read_text()
    found = re.finditer(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    return [(text[: match.start(1)].count("\n"), match.group(1)) for match in found]


def test_every_block_of_the_guide_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In their order, in one program, in a folder with the files that the page names."""
    monkeypatch.chdir(tmp_path)
    [(_, case)] = blocks(GUIDE, "toml")
    (tmp_path / "case.toml").write_text(case)
    for name in ("case.toml", "chart.toml"):
        (tmp_path / f"ring-{name}").write_text((ROOT / "cases" / "ring-632" / name).read_text())
    names: dict[str, object] = {}
    found = blocks(GUIDE, "python")
    assert len(found) >= 8
    for line, text in found:
        exec(compile("\n" * line + text, str(GUIDE), "exec"), names)


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_a_notebook_runs(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    nbclient = pytest.importorskip("nbclient")
    nbformat = pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(sys.path))
    monkeypatch.delenv("MPLBACKEND", raising=False)  # the kernel's own puts pictures into cells
    notebook = nbformat.read(file, as_version=4)
    nbclient.NotebookClient(
        notebook, timeout=500, resources={"metadata": {"path": str(file.parent)}}
    ).execute()
    pictures = [
        output
        for cell in notebook.cells
        for output in cell.get("outputs", [])
        if "image/png" in output.get("data", {})
    ]
    assert pictures


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_a_notebook_names_no_machine(file: Path) -> None:
    notebook = json.loads(file.read_text())
    assert notebook["nbformat"] == 4
    assert not re.search(r"/(home|root|tmp)/", file.read_text())
    assert str(ROOT) not in file.read_text()
