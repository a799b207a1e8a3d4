#!/usr/bin/env python3
"""The sheet as a rigid-plastic membrane without friction: writes reference.csv, punch force over its way.

usage: membrane.py [ELEMENTS STEP]     (60 elements, increments of 0.5 mm)

Independent of billet: rings with the strains e1 = ln(l/l0) along the meridian and e2 = ln(r/r0) around, no bending, no elasticity,
Mises' metal that flows as in plane stress. In an increment the sheet takes the shape that makes the sum over the rings of
    volume * W(p_old + dp),   dp = 2/sqrt(3) sqrt(de1^2 + de1 de2 + de2^2),   W = integral of 589 (1e-4 + p)^0.216 dp
smallest (flow rule and equilibrium follow), found by Newton's method. The middle surface is kept off a sphere and an arc that
are half the thickness at the start larger than punch and die, by a penalty.
"""

import math
import pathlib
import sys

K, EPS0, N = 589.0, 1e-4, 0.216 # MPa
PUNCH, DIE, CLAMPED, THICKNESS = 50.8, 6.35, 59.18, 1.0 # mm
PENALTY, ROUND = 2e4, 1e-5 # MPa/mm; strain below which an increment's dp is rounded
SPHERE, ARC = PUNCH + THICKNESS / 2, DIE + THICKNESS / 2


class Sheet:
    def __init__(self, count):
        self.count = count
        self.r0 = [CLAMPED * i / count for i in range(count + 1)]
        self.p = [0.0] * count
        self.old = [(0.0, 0.0)] * count # e1, e2

    def strains(self, x, i):
        (ra, za), (rb, zb) = x[i], x[i + 1]
        return (math.log(math.hypot(rb - ra, zb - za) / (self.r0[i + 1] - self.r0[i])),
                math.log((ra + rb) / (self.r0[i] + self.r0[i + 1])))

    def volume(self, i):
        return math.pi * (self.r0[i + 1]**2 - self.r0[i]**2) * THICKNESS

    def growth(self, x, i):
        e1, e2 = self.strains(x, i)
        a, b = e1 - self.old[i][0], e2 - self.old[i][1]
        return a, b, 2.0 / math.sqrt(3.0) * math.sqrt(a * a + a * b + b * b + ROUND**2)

    def gaps(self, x, i, h):
        """(gap, direction, stiffness) of a node on punch and die."""
        r, z = x[i]
        area = 2.0 * math.pi * max(self.r0[i], 0.25 * self.r0[1]) * self.r0[1]
        for cr, cz, radius in ((0.0, h - SPHERE, SPHERE), (CLAMPED, ARC, ARC)):
            distance = math.hypot(r - cr, z - cz)
            if distance < radius:
                yield distance - radius, ((r - cr) / distance, (z - cz) / distance), distance, PENALTY * area

    def energy(self, x, h):
        total = 0.0
        for i in range(self.count):
            total += self.volume(i) * K / (N + 1.0) * (EPS0 + self.p[i] + self.growth(x, i)[2])**(N + 1.0)
        return total + sum(0.5 * k * g * g for i in range(self.count) for g, _, _, k in self.gaps(x, i, h))

    def force(self, x, h):
        """Upward, on the sheet by the punch, which stands below it."""
        return sum(-k * g * n[1] for i in range(self.count) for g, n, _, k in self.gaps(x, i, h)
                   if x[i][0] < 0.9 * CLAMPED)

    def system(self, x, h):
        """Gradient, and half of the symmetric band: band[i][k] is the entry (i, i + k)."""
        size = 2 * (self.count + 1)
        gradient, band = [0.0] * size, [[0.0] * 4 for _ in range(size)]
        for i in range(self.count):
            (ra, za), (rb, zb) = x[i], x[i + 1]
            a, b, dp = self.growth(x, i)
            length, double = math.hypot(rb - ra, zb - za), ra + rb
            c, s = (rb - ra) / length, (zb - za) / length
            g1 = [-c / length, -s / length, c / length, s / length]
            g2 = [1.0 / double, 0.0, 1.0 / double, 0.0]
            stress = K * (EPS0 + self.p[i] + dp)**N
            slope = N * stress / (EPS0 + self.p[i] + dp)
            v1, v2 = 4.0 / 3.0 * (a + 0.5 * b) / dp, 4.0 / 3.0 * (b + 0.5 * a) / dp # of dp
            h11, h22, h12 = ((4.0 / 3.0 - v1 * v1) / dp, (4.0 / 3.0 - v2 * v2) / dp, (2.0 / 3.0 - v1 * v2) / dp)
            w11, w22, w12 = (slope * v1 * v1 + stress * h11, slope * v2 * v2 + stress * h22, slope * v1 * v2 + stress * h12)
            bend = [[(1.0 - 2.0 * c * c) / length**2, -2.0 * c * s / length**2],
                    [-2.0 * c * s / length**2, (1.0 - 2.0 * s * s) / length**2]]
            volume = self.volume(i)
            for j in range(4):
                gradient[2 * i + j] += volume * stress * (v1 * g1[j] + v2 * g2[j])
                for k in range(j, 4):
                    entry = w11 * g1[j] * g1[k] + w22 * g2[j] * g2[k] + w12 * (g1[j] * g2[k] + g2[j] * g1[k])
                    entry += stress * v1 * bend[j % 2][k % 2] * (1.0 if j // 2 == k // 2 else -1.0)
                    if j % 2 == 0 and k % 2 == 0:
                        entry -= stress * v2 / double**2
                    band[2 * i + j][k - j] += volume * entry
        for i in range(self.count):
            for g, n, distance, k in self.gaps(x, i, h):
                for j in range(2):
                    gradient[2 * i + j] += k * g * n[j]
                    for m in range(j, 2):
                        curved = g / distance * ((1.0 if j == m else 0.0) - n[j] * n[m])
                        band[2 * i + j][m - j] += k * (n[j] * n[m] + curved)
        return gradient, band

    def solve(self, gradient, band, damping):
        """The step; None if the matrix is not positive. r of the middle and the clamped node are held."""
        size, held = len(gradient), {0, len(gradient) - 2, len(gradient) - 1}
        u = [row[:] for row in band]
        rhs = [-g for g in gradient]
        for i in range(size):
            u[i][0] += damping
        for i in held:
            rhs[i] = 0.0
            u[i] = [1e30, 0.0, 0.0, 0.0]
            for k in range(1, 4):
                if i >= k:
                    u[i - k][k] = 0.0
        for i in range(size):
            if u[i][0] <= 0.0:
                return None
            for k in range(1, min(4, size - i)):
                factor = u[i][k] / u[i][0]
                if factor:
                    for m in range(k, min(4, size - i)):
                        u[i + k][m - k] -= factor * u[i][m]
                    rhs[i + k] -= factor * rhs[i]
        for i in reversed(range(size)):
            rhs[i] = (rhs[i] - sum(u[i][k] * rhs[i + k] for k in range(1, min(4, size - i)))) / u[i][0]
        return rhs

    def equilibrium(self, x, h):
        damping, energy = 0.0, self.energy(x, h)
        for _ in range(2000):
            gradient, band = self.system(x, h)
            free = gradient[1:-2]
            if max(map(abs, free)) < 1e-3:
                return x
            step = self.solve(gradient, band, damping)
            while step is None:
                damping = max(4.0 * damping, 10.0)
                step = self.solve(gradient, band, damping)
            share = min(1.0, 1.0 / max(map(abs, step)))
            while True:
                trial = [(r + share * step[2 * i], z + share * step[2 * i + 1]) for i, (r, z) in enumerate(x)]
                new = self.energy(trial, h)
                if new <= energy + 1e-12 * abs(energy) or share < 1e-6:
                    break
                share *= 0.5
            damping = 0.3 * damping if share > 0.2 else max(4.0 * damping, 10.0)
            if new <= energy + 1e-12 * abs(energy):
                x, energy = trial, new
        raise RuntimeError(f"no equilibrium at {h} mm: {max(map(abs, free)):.3g} N")

    def commit(self, x):
        for i in range(self.count):
            self.p[i] += self.growth(x, i)[2]
            self.old[i] = self.strains(x, i)


def main(count, step, last=40.0):
    sheet, h = Sheet(count), 2.0
    x = [(r, max(0.0, h * (1.0 - r / CLAMPED))) for r in sheet.r0]
    with open(pathlib.Path(__file__).with_name("reference.csv"), "w", encoding="utf-8") as out:
        out.write("displacement,force,largest_strain\n")
        while h <= last + 1e-9:
            before, x = x, sheet.equilibrium(x, h)
            sheet.commit(x)
            out.write(f"{h:g},{sheet.force(x, h):.1f},{max(sheet.p):.4f}\n")
            if h > 2.0: # as fast as in the increment before
                x = [(2 * r - r0, 2 * z - z0) for (r, z), (r0, z0) in zip(x, before)]
            h += step


if __name__ == "__main__":
    main(*(float(w) if i else int(w) for i, w in enumerate(sys.argv[1:] or ["60", "0.5"])))
