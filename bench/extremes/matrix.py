"""Which runs are made: one axis at a time from the defaults, and a Latin sample over all of them."""

import random
from dataclasses import replace

from scenes import SCENES, UNITS, Setting, frictions

PENALTIES = (0.01, 1.0, 100.0, 1e4, 1e6)
INCREMENTS = (0.01, 1.0, 100.0)
POISSONS = (0.0, 0.3, 0.45, 0.499, 0.4999)
AXES = ("penalty", "friction", "increments", "units", "poisson")


def levels(axis, scene):
    return {"penalty": PENALTIES, "friction": frictions(scene), "increments": INCREMENTS,
            "units": tuple(UNITS), "poisson": POISSONS}[axis]


def changed(setting, axis, level):
    setting = replace(setting, **{axis: level})
    return replace(setting, short=setting.increments < 1.0)


def one_at_a_time(scene):
    """Around friction 0.1 and around friction 1: sliding and sticking."""
    for friction in ("mu 0.1", "mu 1"):
        start = Setting(scene, friction)
        for axis in AXES:
            for level in levels(axis, scene):
                if axis != "friction" or friction == "mu 1":
                    yield changed(start, axis, level)


def latin(count, seed):
    """`count` settings in which every level of every axis occurs equally often, to one."""
    dice = random.Random(seed)
    columns = {}
    for axis in ("scene", *AXES):
        choice = list(SCENES) if axis == "scene" else levels(axis, "block hex8")
        column = [choice[i % len(choice)] for i in range(count)]
        dice.shuffle(column)
        columns[axis] = column
    for i in range(count):
        setting = Setting(columns["scene"][i])
        for axis in AXES:
            setting = changed(setting, axis, columns[axis][i])
        # a tensor is for space only
        yield setting if setting.friction in frictions(setting.scene) else replace(setting, friction="mu 0.5")


def settings(count, seed):
    """All of them, each once, in a fixed order."""
    series = [s for scene in SCENES for s in one_at_a_time(scene)]
    return list(dict.fromkeys(series + list(latin(count, seed))))
