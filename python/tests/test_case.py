"""Cases: dictionary access, the reader's own errors, files."""

import copy
import os
import pickle
import subprocess
from pathlib import Path

import numpy as np
import pytest

import billet
from conftest import DISK


def said_by_check(file: Path, *words: str) -> str:
    done = subprocess.run(
        [billet.program(), "check", file, *words], capture_output=True, text=True, check=False
    )
    assert done.returncode == 3
    return done.stderr.strip().removeprefix("billet: ")


def test_values_are_those_of_the_file(case: billet.Case) -> None:
    assert case["title"] == "A disk"
    assert case["tool"]["punch"]["friction"]["m"] == 0.1
    assert case["tool.punch.friction.m"] == 0.1
    assert case["tool.0.motion.velocity.1"] == -1
    assert case["material.steel.elastic.young"] == "210 GPa"
    assert case["workpiece"]["mesh"]["cells"] == [4, 2]


def test_a_case_is_a_mapping(case: billet.Case) -> None:
    assert list(case) == [
        "title", "analysis", "workpiece", "material", "support", "tool", "measure", "time",
    ] or set(case) == {
        "title", "analysis", "workpiece", "material", "support", "tool", "measure", "time",
    }  # fmt: skip
    assert "time.end" in case
    assert "time.stop" not in case
    assert len(case["support"]) == 2
    assert case.get("contact") is None
    assert dict(case["tool.punch.friction"]) == {"law": "tresca", "m": 0.1}


def test_every_way_to_set_a_value_is_the_same(case: billet.Case) -> None:
    case["tool"]["punch"]["friction"]["m"] = 0.2
    assert case["tool.punch.friction.m"] == 0.2
    case["tool.punch.friction.m"] = np.float64(0.3)
    assert case["tool"]["punch"]["friction"]["m"] == 0.3
    case["workpiece.mesh.cells"][0] = np.int64(6)
    assert case["workpiece.mesh.cells"] == [6, 2]
    case["workpiece.mesh.cells"] = np.array([8, 4])
    assert case["workpiece.mesh.cells"] == [8, 4]


def test_tables_and_lists_are_set_as_a_whole(case: billet.Case) -> None:
    case["tool.punch.friction"] = {"law": "coulomb", "mu": 0.1}
    assert "m" not in case["tool.punch.friction"]
    case["support"].append({"where": "y = 5", "fix": ["x"]})
    assert case["support.2.where"] == "y = 5"
    del case["support"][2]
    assert len(case["support"]) == 2
    case["support"][1:] = [{"where": "y = 0", "fix": ["x", "y"]}]
    assert case["support.1.fix"] == ["x", "y"]


def test_several_changes_that_make_sense_together_only(case: billet.Case) -> None:
    with pytest.raises(billet.Error):
        case["tool.punch.friction.law"] = "coulomb"
    case.update({"tool.punch.friction": {"law": "coulomb", "mu": 0.1}, "time.end": 1.0})
    assert case["time.end"] == 1.0
    case["time"].update({"end": 2.0, "increments.max": 0.1})
    assert case["time.increments.max"] == 0.1


def test_a_removed_key_is_gone_and_may_come_back(case: billet.Case) -> None:
    case["contact.penalty"] = 50.0
    del case["contact"]
    assert "contact" not in case
    case["contact.penalty"] = 60.0
    assert case["contact.penalty"] == 60.0
    with pytest.raises(billet.Error, match="analysis"):
        del case["analysis"]
    assert case["analysis"] == "axisymmetric"


@pytest.mark.parametrize(
    ("key", "value", "written"),
    [
        ("tool.punch.friction.m", -1, "-1"),
        ("tool.punch.friktion.m", 0.2, "0.2"),
        ("tool.punsh.friction.m", 0.2, "0.2"),
        ("workpiece.element", "C3D8", '"C3D8"'),
        ("time.end", "long", '"long"'),
        ("material.steel.flow", {}, "{}"),
    ],
)
def test_a_refused_value_has_the_readers_text_and_changes_nothing(
    case_file: Path, key: str, value: object, written: str
) -> None:
    case = billet.Case.load(case_file)
    with pytest.raises(billet.Error) as error:
        case[key] = value
    assert str(error.value) == said_by_check(case_file, "--set", f"{key}={written}")
    assert case.text == DISK


def test_a_broken_file_has_the_readers_text(case_file: Path) -> None:
    case_file.write_text(DISK.replace("young", "yung").replace("m = 0.1", "m = 7"))
    with pytest.raises(billet.Error) as error:
        billet.Case.load(case_file)
    assert str(error.value) == said_by_check(case_file)
    assert len(str(error.value).splitlines()) >= 2


def test_a_broken_text_names_its_line() -> None:
    with pytest.raises(billet.Error, match=r"^case text:6:1: workpiece.metal: unknown key"):
        billet.Case.from_string(DISK.replace("material = ", "metal = "))


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(billet.Error, match="no.toml: there is no such file"):
        billet.Case.load(tmp_path / "no.toml")


def test_a_missing_key_suggests_what_is_meant(case: billet.Case) -> None:
    with pytest.raises(KeyError, match="tool.punch: there is no key 'frction'; did you mean 'friction'"):
        case["tool.punch.frction.m"]
    with pytest.raises(billet.MissingKey, match="known are punch"):
        case["tool"]["x"]
    with pytest.raises(billet.MissingKey):
        del case["contact"]
    with pytest.raises(IndexError):
        case["support"][2]


@pytest.mark.parametrize("value", [None, object(), {1, 2}, 1j])
def test_what_toml_has_no_word_for_is_refused(case: billet.Case, value: object) -> None:
    with pytest.raises(billet.Error, match="a case cannot hold"):
        case["title"] = value


@pytest.mark.parametrize("key", ["", "tool..m", "tool.", ".tool", 'a"b'])
def test_what_is_no_key_is_refused(case: billet.Case, key: str) -> None:
    with pytest.raises(billet.Error):
        case[key] = 1


@pytest.mark.parametrize("text", ['say "so"', "a\\b", "line\nbreak", "Fließgrenze", "x=1 # no"])
def test_any_text_comes_back(case: billet.Case, text: str, tmp_path: Path) -> None:
    case["title"] = text
    assert case["title"] == text
    case.save(tmp_path / "case.toml")
    assert billet.Case.load(tmp_path / "case.toml")["title"] == text


def test_names_with_spaces_stand_in_quotes(case: billet.Case) -> None:
    case.update({'material."steel 10"': case["material.steel"].copy(), "workpiece.material": "steel 10"})
    assert case["material"]["steel 10"]["elastic"]["poisson"] == 0.3
    case["material"]["steel 10"]["elastic.poisson"] = 0.29
    assert case['material."steel 10".elastic.poisson'] == 0.29


def test_an_unchanged_case_is_saved_as_it_was(case: billet.Case, tmp_path: Path) -> None:
    case.save(tmp_path / "same.toml")
    assert (tmp_path / "same.toml").read_text() == DISK


def test_a_changed_case_is_saved_with_its_changes(case: billet.Case, tmp_path: Path) -> None:
    case["tool.punch.friction.m"] = 0.25
    case.save(tmp_path / "changed.toml")
    again = billet.Case.load(tmp_path / "changed.toml")
    assert again["tool.punch.friction.m"] == 0.25
    assert again.resolved_text == case.resolved_text


def test_a_case_is_not_saved_where_its_files_are_not(tmp_path: Path) -> None:
    (tmp_path / "die.toml").write_text("points = [[20, 5], [0, 5]]\n")
    profile = DISK.replace(
        "plane = { point = [0, 5], normal = [0, -1] }", 'profile = "die.toml"'
    )
    assert profile != DISK
    case = billet.Case.from_string(profile, tmp_path)
    (tmp_path / "sub").mkdir()
    with pytest.raises(billet.Error, match="die.toml"):
        case.save(tmp_path / "sub" / "case.toml")
    assert not (tmp_path / "sub" / "case.toml").exists()


def test_a_file_that_cannot_be_written_is_named(case: billet.Case, tmp_path: Path) -> None:
    with pytest.raises(billet.Error, match="no-folder"):
        case.save(tmp_path / "no-folder" / "case.toml")


def test_a_copy_is_changed_alone(case: billet.Case) -> None:
    for other in (case.copy(), copy.copy(case), copy.deepcopy(case), pickle.loads(pickle.dumps(case))):
        other["time.end"] = 9.0
        assert case["time.end"] == 0.5


def test_changes_may_be_given_on_loading(case_file: Path) -> None:
    case = billet.Case.load(os.fspath(case_file), {"tool.punch.friction.m": 0.3, "time": {"end": 1}})
    assert (case["tool.punch.friction.m"], case["time.end"]) == (0.3, 1)
    assert "increments" not in case["time"]


def test_a_loop_over_values_does_not_pile_up(case: billet.Case) -> None:
    for m in np.linspace(0.0, 0.5, 300):
        case["tool.punch.friction.m"] = m
    assert case["tool.punch.friction.m"] == 0.5
    assert case.text.count("m = 0.5") == 1


def test_check_warns_and_advises(case: billet.Case) -> None:
    assert case.check() == ([], [])
    case["material.steel.elastic.young"] = 210
    warnings, _ = case.check()
    assert any("young" in line for line in warnings)
    case["material.steel.elastic.young"] = "210 GPa"
    case["tool.punch.motion.velocity"] = [0, -5000]
    case["time"] = {"end": 0.0005}
    assert any("heats the metal by about" in line for line in case.check().advice)


def die(name: str, m: float) -> dict[str, object]:
    """A second tool for the disk."""
    return {
        "name": name,
        "surface": {"plane": {"point": [0, 0], "normal": [0, 1]}},
        "motion": {"velocity": [0, 0]},
        "friction": {"law": "tresca", "m": m},
    }


def test_a_number_is_an_index_whatever_items_are_named(case: billet.Case) -> None:
    case["tool.punch.name"] = "1"
    case["tool"].append(die("0", 0.2))
    tools = case["tool"]
    assert (tools[0]["name"], tools[1]["name"], tools[-1]["name"]) == ("1", "0", "0")
    assert (tools["0"]["name"], tools["1"]["name"]) == ("0", "1")  # texts are names first
    assert [tool["name"] for tool in tools] == ["1", "0"]
    tools[1]["friction.m"] = 0.3
    tools[0]["friction"]["m"] = 0.4
    assert (case["tool.1.friction.m"], case["tool.0.friction.m"]) == (0.4, 0.3)
    tools[0] = die("1", 0.5)
    assert tools[0]["friction.m"] == 0.5
    del tools[1]
    assert tools.keys() == ["1"]


def test_a_change_before_a_tool_was_renamed_is_kept(case: billet.Case) -> None:
    case["tool"].append({"name": "die", "surface": {"plane": {"point": [0, 50], "normal": [0, -1]}}})
    case["tool.die.friction"] = {"law": "tresca", "m": 0.2}
    case["tool.die.friction.m"] = 0.25
    case["tool.die.name"] = "old"
    case["tool.punch.name"] = "die"
    case["tool.die.friction.m"] = 0.3
    assert case["tool.old.friction.m"] == 0.25
    assert case["tool.die.friction.m"] == 0.3


def test_a_tool_that_is_renamed_is_the_same_item(case: billet.Case) -> None:
    tool = case["tool"][0]
    tool.update({"name": "ram", "friction.m": 0.2})
    tool["friction.m"] = 0.3
    assert case["tool.ram.friction.m"] == 0.3


def test_an_item_is_refused_once_its_index_is_anothers(case: billet.Case) -> None:
    supports = case["support"]
    first, second, fix = supports[0], case["support.1"], supports[1]["fix"]
    supports.append({"where": "y = 5", "fix": ["x"]})
    second["fix"] = ["x", "y"]
    assert (first["where"], second["where"], fix) == ("x = 0", "y = 0", ["x", "y"])
    third = supports[2]
    del supports[1]
    assert first["where"] == "x = 0"
    for moved in (second, third, fix):
        with pytest.raises(billet.Error, match="support.* may be another item now"):
            moved.copy()
    with pytest.raises(billet.Error, match="take it anew"):
        third["fix"] = ["y"]
    with pytest.raises(billet.Error, match="take it anew"):
        third.update({"fix": ["y"]})
    case["support"] = [{"where": "y = 0", "fix": ["y"]}]
    with pytest.raises(billet.Error, match="take it anew"):
        first["where"]
    assert len(supports) == 1


def test_items_of_a_list_are_asked_for_by_name(case: billet.Case) -> None:
    tools = case["tool"]
    assert "punch" in tools and "die" not in tools and "0" not in tools
    assert "x" in case["support"][0]["fix"] and case["support"][0] in case["support"]
    assert tools.get("punch") == tools[0] and tools.get(0) == tools[0]
    assert tools.get("die") is None and tools.get(7, "none") == "none"
    assert tools.keys() == ["punch"] and case["support"].keys() == [0, 1]
    assert dict(tools)["punch"]["friction.m"] == 0.1


def test_lists_are_changed_as_a_whole_or_not_at_all(case: billet.Case) -> None:
    supports = case["support"]
    with pytest.raises(billet.Error):
        supports.extend([{"where": "y = 5", "fix": ["x"]}, {"wo": "y = 5"}])
    assert len(supports) == 2
    supports.reverse()
    assert [support["where"] for support in supports] == ["y = 0", "x = 0"]
    assert supports.pop(0) == {"where": "y = 0", "fix": ["y"]}
    assert [support["where"] for support in supports] == ["x = 0"]
    assert case.pop("measure") == [{"name": "half_height", "kind": "height"}]
    assert case.pop("measure", None) is None


def test_a_case_is_not_emptied(case: billet.Case) -> None:
    with pytest.raises(billet.Error, match="a case cannot be empty"):
        case.clear()
    with pytest.raises(billet.Error):
        case["tool.punch"].clear()
    assert case.text == DISK
    case["contact.penalty"] = 50.0
    case["contact"].clear()
    assert case["contact"] == {}


def test_what_is_no_index_is_told_as_such(case: billet.Case) -> None:
    with pytest.raises(IndexError, match="^support: there is no index 2: there are 2 items"):
        case["support"][2]
    with pytest.raises(IndexError, match="no index -2: there is one item"):
        del case["tool"][-2]
    with pytest.raises(TypeError, match="by an index or a name, not by 1.5"):
        case["support"][1.5]


def test_a_case_is_not_made_by_its_class() -> None:
    with pytest.raises(TypeError, match=r"billet.Case.load\(FILE\)"):
        billet.Case("disk.toml")  # type: ignore[arg-type]


def test_half_a_character_is_refused(case: billet.Case) -> None:
    with pytest.raises(billet.Error, match="no text that can be written"):
        case["title"] = "a\ud800b"
    with pytest.raises(billet.Error, match="no text that can be written"):
        case["material.\ud800"] = {}
    with pytest.raises(billet.Error, match="no text that can be written"):
        billet.Case.from_string("title = '\udc80'")
    with pytest.raises(TypeError, match="a text is needed"):
        billet.Case.from_string(DISK.encode())  # type: ignore[arg-type]
    assert case.text == DISK


def test_a_pickled_case_finds_its_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "sub").mkdir()
    (tmp_path / "die.toml").write_text("points = [[0, 5], [20, 5]]\n")
    (tmp_path / "sub" / "case.toml").write_text(
        DISK.replace("plane = { point = [0, 5], normal = [0, -1] }", 'profile = "../die.toml"')
    )
    monkeypatch.chdir(tmp_path / "sub")
    case = billet.Case.load("case.toml", allow_outside=True)
    stored = pickle.dumps(case)
    monkeypatch.chdir("/")
    for other in (pickle.loads(stored), pickle.loads(pickle.dumps(pickle.loads(stored).copy()))):
        other["time.end"] = 0.1
        assert billet.Run(other).tools == ("punch",)
