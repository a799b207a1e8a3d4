#!/usr/bin/env python3
"""Prints the slab method and the ideal torque for both passes; called with other widths in mm, for those."""

import math
import sys

RADIUS, MU = 20.0, 0.5 # mm
PASSES = ((10.0, 7.5), (7.5, 5.0)) # thickness, mm
HALF_WIDTHS = (10.25, 10.75) # mm, mean of before and after a pass as computed by billet
STEPS = 20000


def flow(strain):
    return 740.0 * (0.01 + strain) ** 0.2


def slab(before, after, first):
    """Force and torque of one roll per mm of width; tau = min(mu p, k)."""
    bite = math.acos(1.0 - (before - after) / (2.0 * RADIUS))
    step = bite / STEPS

    def two_k(angle):
        return 2.0 / math.sqrt(3.0) * flow(2.0 / math.sqrt(3.0) * math.log(first / height(angle)))

    def height(angle):
        return after + 2.0 * RADIUS * (1.0 - math.cos(angle))

    def hill(side):
        """(pressure, shear) at the middle of each step, on the exit side (+1) or the entry side (-1)."""
        thrust, rows = 0.0, [] # h q
        for i in range(STEPS) if side > 0 else reversed(range(STEPS)):
            angle = (i + 0.5) * step
            p = thrust / height(angle) + two_k(angle)
            tau = min(MU * p, 0.5 * two_k(angle))
            thrust += side * 2.0 * RADIUS * (p * math.sin(angle) + side * tau * math.cos(angle)) * step
            rows.append((p, side * tau))
        return rows[::side]

    force = torque = 0.0
    for i, sides in enumerate(zip(hill(1), hill(-1))):
        p, tau = min(sides)
        angle = (i + 0.5) * step
        force += RADIUS * (p * math.cos(angle) + tau * math.sin(angle)) * step
        torque -= RADIUS ** 2 * tau * step
    return force, torque


def ideal_torque(before, after, first):
    """Torque of one roll per mm of width that deforms without friction or redundant work."""
    steps = 1000
    span = math.log(before / after) / steps
    work = sum(2.0 / math.sqrt(3.0) * flow(2.0 / math.sqrt(3.0) * (math.log(first / before) + (i + 0.5) * span))
               for i in range(steps)) * span
    return 0.5 * after * RADIUS * work # at the speed of the roll, without forward slip


def main():
    widths = [float(word) for word in sys.argv[1:]] or HALF_WIDTHS
    for (before, after), width in zip(PASSES, widths):
        force, torque = slab(before, after, PASSES[0][0])
        print(f"{before:4g} -> {after:3g} mm, half width {width:g} mm: slab force {force * width:7.0f} N, "
              f"torque {torque * width:7.0f} N mm; ideal torque "
              f"{ideal_torque(before, after, PASSES[0][0]) * width:7.0f} N mm")


main()
