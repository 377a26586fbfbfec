"""Upper bound (Sloan 1989, Sloan and Kleeman 1995): velocities linear in each triangle, with jumps between triangles."""
import numpy as np
from problem import FIXED, FOOTING, FREE, SMOOTH, SMOOTH_FOOTING
from rows import Rows
from scipy.optimize import linprog


class Columns:
    """Velocities of corners first, then what is not negative: plastic multipliers and jumps, each with its dissipation."""

    def __init__(self, triangles):
        self.velocities = 6 * triangles
        self.cost = [0.0] * self.velocities

    def add(self, cost):
        self.cost.append(cost)
        return len(self.cost) - 1


def at(e, corner):
    """Columns of both velocities of a corner."""
    return [6 * e + 2 * corner, 6 * e + 2 * corner + 1]


def strains(problem, columns, rows):
    """The strain rate of a triangle is the sum of the normals of the planes of yield."""
    mesh = problem.mesh
    for e, name in enumerate(mesh.soils):
        planes = problem.soils[name].planes(problem.sides, False)
        flow = [columns.add(d * mesh.area[e]) for d in planes[:, 3]]
        x, y = zip(*(at(e, k) for k in range(3)))
        dx, dy = mesh.gradient[e].T
        rows.add([*x, *flow], [*dx, *-planes[:, 0]])
        rows.add([*y, *flow], [*dy, *-planes[:, 1]])
        rows.add([*x, *y, *flow], [*dy, *dx, *-planes[:, 2]])


def jump(columns, rows, place, side, soils, held):
    """The jump at one end of a side: slip both directions with the dilation of its soils; `held` is the side that moves less."""
    _, _, length, normal, tangent = side
    slips = []
    for soil in soils:
        for sign in (1, -1):
            slips.append((columns.add(0.5 * length * soil.cohesion), sign, soil.tangent))
        if not soil.tension:
            slips.append((columns.add(0.0), 0, 1.0))
    where = place + held
    for direction, part in ((normal, 2), (tangent, 1)):
        values = [-direction[0], -direction[1], *direction][: len(where)]
        rows.add(where + [s[0] for s in slips], values + [-s[part] for s in slips])


def sides(problem, columns, rows, power):
    mesh = problem.mesh
    for e, k, other, j in mesh.inner:
        soils = {problem.soils[mesh.soils[e]], problem.soils[mesh.soils[other]]}
        for own, its in ((k, (j + 1) % 3), ((k + 1) % 3, j)):
            jump(columns, rows, at(e, own), mesh.side(e, k), soils, at(other, its))
    for e, k, kind, pressure in problem.outer():
        side = mesh.side(e, k)
        _, _, length, normal, tangent = side
        for corner in (k, (k + 1) % 3):
            place = at(e, corner)
            if kind == FIXED:
                jump(columns, rows, place, side, {problem.soils[mesh.soils[e]]}, [])
            elif kind == FREE:
                power[place] -= 0.5 * length * pressure * normal
            elif kind == SMOOTH:
                rows.add(place, normal)
            else:
                rows.add([place[1]], [1.0], -mesh.corners[e][corner][0] if problem.axial else -1.0)
                if kind == FOOTING:
                    rows.add([place[0]], [1.0])


def solve(problem, columns, rows):
    """The load, or None where every load is carried; `rows` has the strains. Of bodies of revolution velocities are times r."""
    mesh = problem.mesh
    power, weights = np.zeros(columns.velocities), np.zeros(columns.velocities)
    sides(problem, columns, rows, power)
    for e, name in enumerate(mesh.soils):
        weights[6 * e + 1 : 6 * e + 6 : 2] -= mesh.area[e] * problem.soils[name].weight / 3
    cost = np.array(columns.cost)
    cost[: columns.velocities] -= power
    if problem.footed:
        cost[: columns.velocities] -= weights
    else:
        moving = np.flatnonzero(weights)
        rows.add(moving, weights[moving], 1.0)
    equal, right = rows.matrix(len(cost))
    bounds = [(None, None)] * columns.velocities + [(0, None)] * (len(cost) - columns.velocities)
    found = linprog(cost, None, None, equal, right, bounds, method="highs-ipm")
    if found.status in (2, 4):
        return None
    if found.status != 0:
        raise RuntimeError("upper bound: " + found.message)
    return found.fun


def upper_bound(problem):
    """The load, or None where every load is carried."""
    columns, rows = Columns(len(problem.mesh.soils)), Rows()
    strains(problem, columns, rows)
    return solve(problem, columns, rows)
