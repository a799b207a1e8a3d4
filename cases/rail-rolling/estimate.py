#!/usr/bin/env python3
"""Forces and torque of the pass by hand: part by part, each as flat rolling in plane strain.

Mean pressure by Ford and Alexander, p = k (pi/2 + L / (h0 + h1)), k the mean shear flow stress, L = sqrt(R dh) the
length of contact (dh: by both rolls), h0 and h1 the thickness before and after. The flow stress is that of
rail-steel-hot at 1000 degC, mean over the strain 2/sqrt(3) ln(h0/h1), at the mean rate of strain. The walls of the grooves
carry half of the head roll's and of the foot roll's force each, on their slopes; friction on them is left out.
Torque: two pairs of rolls, lever arm 0.45 L.
"""

import math

SPEED, TEMPERATURE = 860.0, 1000.0 # mm/s: mean of the bar in the gap; degC
A, M1, M2, M3, M7, M8 = 6022.9, -0.00337647, 0.337125, 0.036758, -0.872116, 0.00011175
EPS_MIN = 0.02


def flow_stress(strain, rate):
    strain = max(strain, EPS_MIN)
    return (A * math.exp(M1 * TEMPERATURE) * strain ** M2 * math.exp(M7 * strain) * rate ** (M3 + M8 * TEMPERATURE))


def part(name, radius, before, after, width, draft=None):
    """(force [N], length of contact [mm]) of flat rolling; `draft` [mm] of both rolls if not all of the reduction."""
    length = math.sqrt(radius * (draft or before - after))
    strain = 2.0 / math.sqrt(3.0) * math.log(before / after)
    rate = strain * SPEED / length
    steps = 200
    sigma = sum(flow_stress(strain * (i + 0.5) / steps, rate) for i in range(steps)) / steps
    pressure = sigma / math.sqrt(3.0) * (math.pi / 2.0 + length / (before + after))
    force = pressure * length * width
    print(f"{name:22} L {length:5.1f} mm  strain {strain:5.3f}  rate {rate:4.1f} /s  flow stress {sigma:5.1f} MPa"
          f"  pressure {pressure:5.1f} MPa  force {force / 1e3:6.0f} kN")
    return force, length


web, web_length = part("web", 450.0, 36.0, 30.5, 100.0)
sides, _ = part("sides of the head", 429.25, 76.0, 72.0, 30.0)
# One roll presses by 3 mm, walls stand behind (those of the head press by another 1.3 mm).
head, _ = part("running surface", 300.0, 37.0, 32.7, 76.0 - 16.0, 6.0)
foot, _ = part("foot", 300.0, 23.0, 20.0, 146.0, 6.0)
walls = 0.5 * (head * 0.3 + foot * 0.185)
print(f"horizontal roll: {web / 1e3:.0f} + {sides / 1e3:.0f} + {walls / 1e3:.0f} = {(web + sides + walls) / 1e3:.0f} kN")
print(f"its torque:      {0.45 * web_length * (web + sides) / 1e6:.1f} kN m")
