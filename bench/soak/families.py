"""The families of forming jobs: each is a function that makes one job from random numbers. Lengths in mm, times in s.

Every job is one that a press could do: tools meet the part, strokes end before tools meet each other, closed dies have
the volume of the part and some flash. Tools lie on the left of the way along a profile."""

import bulk
import space
import thin

FAMILIES = {family.__name__.replace("_", "-"): family for family in (
    bulk.upsetting, bulk.ring, bulk.heading, bulk.flash, bulk.cavity, bulk.can, bulk.double_cup, bulk.extrusion,
    bulk.drawing, bulk.indentation, bulk.rolling, bulk.spike, bulk.hammer, bulk.press, bulk.sequence, thin.bending,
    thin.folding, thin.tube, thin.cup, space.relief, space.solid)}
