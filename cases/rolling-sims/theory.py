#!/usr/bin/env python3
"""Roll force and torque of plane-strain rolling after Sims and after Orowan: prints them.

usage: theory.py [m]     friction factor of the whole arc for Orowan, 1 by default

Both take a perfectly plastic, rigid-plastic strip between rigid rolls, without tensions. 2k is its yield stress in plane
strain, s the pressure of the roll, phi the angle from the exit plane, h the height there, f the horizontal force
of compression, both signs: upper behind the neutral point (exit), lower before it (entry).

Orowan (1943): each arc between the rolls flows as in Nadai's wedge. Shear m k at the roll,
    df/dphi = 2 R (s sin(phi) +- m k cos(phi)),   f = h (s - 2k w +- m k (1/phi - 1/tan(phi))),
    w = 1/sin(phi) * integral over theta from 0 to phi of sqrt(1 - (m theta/phi)^2) cos(theta),
integrated from the exit and from the entry, f = 0 at both; the lower of the two pressures counts.
Sims (1954): the same with m = 1 for small angles, w = pi/4, in closed form.
"""

import math
import sys

R, H1, H2, TWO_K = 200.0, 20.0, 14.0, 100.0 # mm, mm, mm, MPa
ALPHA = math.acos(1.0 - (H1 - H2) / (2.0 * R))


def sims():
    """Force and torque of a roll [N/mm, N mm/mm], neutral angle [rad]."""
    r, q = 1.0 - H2 / H1, math.sqrt(R / H2)
    root = math.sqrt((1.0 - r) / r)
    alpha = math.sqrt((H1 - H2) / R)
    neutral = math.tan(math.pi / 8.0 / q * math.log(1.0 - r) + 0.5 * math.atan(1.0 / root)) / q
    height = H2 + R * neutral**2
    factor = (0.5 * math.pi * root * math.atan(1.0 / root) - 0.25 * math.pi
              - root * q * math.log(height / H2) + 0.5 * root * q * math.log(1.0 / (1.0 - r)))
    return TWO_K * math.sqrt(R * (H1 - H2)) * factor, TWO_K * R * R * (0.5 * alpha - neutral), neutral


def mean_of(f, low, high, parts=40):
    """Integral by Gauss's midpoints in the angle whose sine runs along: the root is smooth there."""
    total = 0.0
    for i in range(parts):
        turn = 0.5 * math.pi * (i + 0.5) / parts
        total += f(low + (high - low) * math.sin(turn)) * math.cos(turn)
    return total * 0.5 * math.pi / parts * (high - low)


def thickness(phi):
    return H2 + 2.0 * R * (1.0 - math.cos(phi))


def pressure(phi, f, m, side):
    if phi < 1e-9:
        return f / thickness(phi) + TWO_K * mean_of(lambda x: math.sqrt(1.0 - (m * x)**2), 0.0, 1.0)
    w = mean_of(lambda t: math.sqrt(1.0 - (m * t / phi)**2) * math.cos(t), 0.0, phi) / math.sin(phi)
    return f / thickness(phi) + TWO_K * w - side * 0.5 * TWO_K * m * (1.0 / phi - 1.0 / math.tan(phi))


def march(m, side, parts):
    """Pressures from the exit (side 1) or entry (side -1), at parts + 1 angles from 0 to ALPHA."""
    def slope(phi, f):
        return 2.0 * R * (pressure(phi, f, m, side) * math.sin(phi) + side * 0.5 * m * TWO_K * math.cos(phi))
    step = side * ALPHA / parts
    phi, f, values = (0.0 if side > 0 else ALPHA), 0.0, []
    for i in range(parts + 1):
        values.append(pressure(max(phi, 0.0), f, m, side))
        if i < parts:
            k1 = slope(phi, f)
            k2 = slope(phi + step / 2, f + step / 2 * k1)
            k3 = slope(phi + step / 2, f + step / 2 * k2)
            k4 = slope(max(phi + step, 0.0), f + step * k3)
            f += step * (k1 + 2 * k2 + 2 * k3 + k4) / 6
            phi += step
    return values if side > 0 else values[::-1]


def orowan(m, parts=400):
    out, into = march(m, 1, parts), march(m, -1, parts)
    force = torque = neutral = 0.0
    for i in range(parts):
        phi = (i + 0.5) * ALPHA / parts
        ahead = out[i] + out[i + 1] < into[i] + into[i + 1]
        s = 0.5 * ((out[i] + out[i + 1]) if ahead else (into[i] + into[i + 1]))
        shear = (-0.5 if ahead else 0.5) * m * TWO_K
        neutral += ALPHA / parts if ahead else 0.0
        force += (s * math.cos(phi) + shear * math.sin(phi)) * R * ALPHA / parts
        torque += shear * R * R * ALPHA / parts
    return force, torque, neutral


if __name__ == "__main__":
    m = float(sys.argv[1]) if len(sys.argv) > 1 else 1.0
    for name, (force, torque, neutral) in (("Sims", sims()), (f"Orowan, m = {m:g}", orowan(m))):
        slip = thickness(neutral) / H2 * math.cos(neutral) - 1.0
        print(f"{name:16} force {force:8.2f} N/mm   torque {torque:9.1f} N mm/mm   "
              f"neutral angle {math.degrees(neutral):.3f} degrees   forward slip {slip:.4f}")
