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
TUTORIALS = ROOT / "docs" / "tutorials"
NOTEBOOKS = sorted((ROOT / "python" / "examples").glob("*.ipynb"))


def blocks(page: Path, language: str) -> list[tuple[int, str]]:
    """Line and text of each block of a language."""
    text = page.read_text()
    found = re.finditer(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    return [(text[: match.start(1)].count("\n"), match.group(1)) for match in found]


def run_python(page: Path) -> int:
    """Runs the blocks of a page in their order, in one program; returns how many they are."""
    names: dict[str, object] = {}
    found = blocks(page, "python")
    for line, text in found:
        exec(compile("\n" * line + text, str(page), "exec"), names)
    return len(found)


def test_every_block_of_the_guide_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In a folder with the files that the page names."""
    monkeypatch.chdir(tmp_path)
    [(_, case)] = blocks(GUIDE, "toml")
    (tmp_path / "case.toml").write_text(case)
    for name in ("case.toml", "chart.toml"):
        (tmp_path / f"ring-{name}").write_text((ROOT / "cases" / "ring-632" / name).read_text())
    assert run_python(GUIDE) >= 8


def test_the_tutorial_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Next to the case of the first tutorial; it prints what the page says."""
    pytest.importorskip("matplotlib")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "disc").mkdir()
    case = next(text for _, text in blocks(TUTORIALS / "first-case.md", "toml") if "analysis" in text)
    (tmp_path / "disc" / "case.toml").write_text(case)
    page = TUTORIALS / "scripting.md"
    assert run_python(page) >= 7
    printed = capsys.readouterr().out
    for said in re.findall(r"It prints `(.*?)`", page.read_text()):
        assert said in printed
    assert (tmp_path / "force-over-friction.png").stat().st_size > 5000


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
