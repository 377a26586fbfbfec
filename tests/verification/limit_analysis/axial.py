"""Bounds for bodies of revolution about r = 0, loaded and moving without twist; x is r and y is z.

Lower bound: r times the stress is linear in each triangle, so that the hoop stress, which equilibrium gives, is even in it. The weight
is carried by the same pressure in all directions, which needs no triangles; the rest has no weight. Upper bound: r times the velocity is
linear in each triangle, so that r² times the strain rate is, and a flow without change of volume needs none of r times the velocity
either. Yield at the corners is yield in the triangle, and dissipation is at most that of the corners: both bounds are rigorous where
free sides are level or upright."""
import math

import lower
import numpy as np
import upper
from problem import FOOTING, FREE, SMOOTH, SMOOTH_FOOTING
from rows import Rows

FLOOR = 1e-9


def strength(soil):
    """sin(friction) and the radius of the circle of yield without mean stress."""
    f = math.radians(soil.friction)
    return math.sin(f), soil.cohesion * math.cos(f)


def circle(sides):
    angle = 2 * math.pi * np.arange(sides) / sides
    return np.cos(angle), np.sin(angle)


def excess(corners):
    """How far r times z lies above the plane through its corners, at most: on a side, as it has no top inside."""
    across = np.roll(corners, -1, 0) - corners
    return max(0.0, float(np.max(-across[:, 0] * across[:, 1]))) / 4


def hoop(e):
    return 13 * e + 12


def at(e, corner):
    """Columns of r times radial, upright and shear stress at a corner; the next is the radius of the circle."""
    first = 13 * e + 4 * corner
    return [first, first + 1, first + 2]


def equilibrium(problem, rows):
    mesh = problem.mesh
    for e in range(len(mesh.soils)):
        level, upright = lower.divergence(mesh, e, at)
        rows.add([hoop(e)] + level[0], [-1.0] + level[1])
        rows.add(*upright)


def surfaces(problem, rows, objective, multiplier):
    """Tractions at outer sides, less the pressure that carries the weight."""
    mesh = problem.mesh
    for e, k, kind, pressure in problem.outer():
        weight = problem.soils[mesh.soils[e]].weight
        _, _, length, normal, tangent = mesh.side(e, k)
        across, along = lower.traction(normal, tangent)
        for corner in (k, (k + 1) % 3):
            r, z = mesh.corners[e][corner]
            if kind in (FOOTING, SMOOTH_FOOTING):
                objective[at(e, corner)] += length * np.array(across)  # 2 π over the area of the footing, π
            if kind in (FREE, SMOOTH, SMOOTH_FOOTING) and r > FLOOR:
                rows.add(at(e, corner), along)
            if kind == FREE and multiplier is None:
                rows.add(at(e, corner), across, -r * (pressure + weight * z))
            elif kind == FREE:
                rows.add(at(e, corner) + [multiplier], across + [r * weight * z], -r * pressure)


def yields(problem, multiplier):
    """Yield of the circle in the plane of r and z, and of the hoop stress with its ends."""
    mesh, rows = problem.mesh, Rows()
    cosine, sine = circle(problem.sides)
    shrink = math.cos(math.pi / problem.sides)
    for e, name in enumerate(mesh.soils):
        soil = problem.soils[name]
        s, c = strength(soil)
        more = excess(mesh.corners[e])
        for corner in range(3):
            r, z = mesh.corners[e][corner]
            x, y, xy = at(e, corner)
            radius = xy + 1
            for a, b in zip(cosine, sine):
                rows.add([x, y, xy, radius], [0.5 * a, -0.5 * a, b, -shrink])
            # The pressure that carries the weight adds as much to all three.
            added = soil.weight * (r * z + more)
            for values, twist, part in ([s / 2, s / 2, 1], 0, 1), ([(1 + s) / 2, (1 + s) / 2, 1 + s], s - 1, 2), ([(s - 1) / 2, (s - 1) / 2, 1 - s], 1 + s, 2):
                columns, factors, right = [x, y, radius], list(values), part * c * r
                if twist:
                    columns.append(hoop(e))
                    factors.append(twist * r)
                if s and multiplier is None:
                    right -= part * s * added
                elif s:
                    columns.append(multiplier)
                    factors.append(part * s * added)
                rows.add(columns, factors, right)
    return rows


def lower_bound(problem):
    """As that of the plane; of a footing of radius 1 the mean pressure."""
    columns = 13 * len(problem.mesh.soils) + 1
    multiplier = None if problem.footed else columns - 1
    rows, objective = Rows(), np.zeros(columns)
    equilibrium(problem, rows)
    lower.joints(problem, rows, at)
    surfaces(problem, rows, objective, multiplier)
    if multiplier is not None:
        objective[multiplier] = -1
    within, limit = yields(problem, multiplier).matrix(columns)
    return lower.solve(within, limit, rows.matrix(columns), objective)


def weights(corners):
    """Integrals of the three shape functions over r, from the corner with the least r outwards; infinite ones of corners on the axis
    are 0, as nothing strains there."""
    first = int(np.argmin(corners[:, 0]))
    order = [first, (first + 1) % 3, (first + 2) % 3]
    p, q, t = corners[order]
    twice = abs((q[0] - p[0]) * (t[1] - p[1]) - (q[1] - p[1]) * (t[0] - p[0]))
    places, factors = np.polynomial.legendre.leggauss(12)
    places, factors = 0.5 * (places + 1), 0.5 * factors
    u, v = np.meshgrid(places, places, indexing="ij")
    area = np.outer(factors, factors) * u * twice
    shapes = [1 - u, u * (1 - v), u * v]
    r = sum(n * corner[0] for n, corner in zip(shapes, (p, q, t)))
    found = np.zeros(3)
    for corner, n in zip(order, shapes):
        if corners[corner, 0] > FLOOR:
            found[corner] = float((area * n / r).sum())
    return found


def strains(problem, columns, rows):
    """r² times the strain rate of a corner is the sum of the normals of its planes of yield."""
    mesh = problem.mesh
    cosine, sine = circle(problem.sides)
    for e, name in enumerate(mesh.soils):
        s, c = strength(problem.soils[name])
        share = weights(mesh.corners[e])
        dx, dy = mesh.gradient[e].T
        x, y = (list(part) for part in zip(*(upper.at(e, k) for k in range(3))))
        for corner in range(3):
            r = mesh.corners[e][corner][0]
            place = upper.at(e, corner)
            if r < FLOOR:
                rows.add(place[:1], [1.0])
                rows.add(place[1:], [1.0])
                continue
            flow = [columns.add(0.0) for _ in cosine]
            ends = [columns.add(part * c * share[corner]) for part in (1, 2, 2)]
            mean = [-s / 2, -(1 + s) / 2, (1 - s) / 2]
            rows.add(x + place[:1] + flow + ends, [*r * dx, -1.0, *-0.5 * cosine, *mean])
            rows.add(y + flow + ends, [*r * dy, *0.5 * cosine, *mean])
            rows.add(x + y + place[1:] + flow, [*r * dy, *r * dx, -1.0, *-sine])
            rows.add(place[:1] + ends[1:], [1.0, 1 - s, -1 - s])
            rows.add(flow + ends, [1.0] * len(flow) + [-1.0, -1 - s, s - 1])


def upper_bound(problem):
    """As that of the plane; of a footing of radius 1 the mean pressure."""
    columns, rows = upper.Columns(len(problem.mesh.soils)), Rows()
    strains(problem, columns, rows)
    load = upper.solve(problem, columns, rows)
    return 2 * load if problem.footed and load is not None else load
