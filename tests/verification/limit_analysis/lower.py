"""Lower bound (Sloan 1988): stresses linear in each triangle, in equilibrium, within a polygon inside the circle of yield."""
import numpy as np
from problem import FIXED, FOOTING, FREE, SMOOTH_FOOTING
from rows import Rows
from scipy.optimize import linprog
from scipy.sparse import coo_matrix, hstack


def at(e, corner):
    """Columns of stress_x, stress_y and shear at a corner."""
    first = 9 * e + 3 * corner
    return [first, first + 1, first + 2]


def traction(normal, tangent):
    """Factors of the three stresses in the normal and the shear traction."""
    n, t = normal, tangent
    return [n[0] * n[0], n[1] * n[1], 2 * n[0] * n[1]], [n[0] * t[0], n[1] * t[1], n[0] * t[1] + n[1] * t[0]]


def divergence(mesh, e, at=at):
    """Columns and factors of the forces of the stresses in a triangle, level and upright."""
    level, upright = [[], []], [[], []]
    for k in range(3):
        x, y, xy = at(e, k)
        dx, dy = mesh.gradient[e, k]
        level[0] += [x, xy]
        level[1] += [dx, dy]
        upright[0] += [xy, y]
        upright[1] += [dx, dy]
    return level, upright


def equilibrium(problem, rows, multiplier):
    mesh = problem.mesh
    for e, soil in enumerate(mesh.soils):
        weight = problem.soils[soil].weight
        level, upright = divergence(mesh, e)
        rows.add(*level)
        if multiplier is None:
            rows.add(*upright, weight)
        else:
            rows.add(upright[0] + [multiplier], upright[1] + [-weight])


def joints(problem, rows, at=at):
    """Tractions are continuous between triangles."""
    mesh = problem.mesh
    for e, k, other, j in mesh.inner:
        *_, normal, tangent = mesh.side(e, k)
        for own, its in ((k, (j + 1) % 3), ((k + 1) % 3, j)):
            for part in traction(normal, tangent):
                rows.add(at(e, own) + at(other, its), part + [-v for v in part])


def surfaces(problem, rows, objective):
    """Tractions are given on the boundary; those of a footing are the objective."""
    mesh = problem.mesh
    for e, k, kind, pressure in problem.outer():
        if kind == FIXED:
            continue
        _, _, length, normal, tangent = mesh.side(e, k)
        across, along = traction(normal, tangent)
        for corner in (k, (k + 1) % 3):
            if kind in (FOOTING, SMOOTH_FOOTING):
                objective[at(e, corner)] += 0.5 * length * np.array(across)
            if kind != FOOTING:
                rows.add(at(e, corner), along)
            if kind == FREE:
                rows.add(at(e, corner), across, -pressure)


def yields(problem):
    mesh = problem.mesh
    row, column, value, right = [], [], [], []
    count = 0
    for e, soil in enumerate(mesh.soils):
        planes = problem.soils[soil].planes(problem.sides, True)
        for corner in range(3):
            row.append(np.repeat(count + np.arange(len(planes)), 3))
            column.append(np.tile(at(e, corner), len(planes)))
            value.append(planes[:, :3].ravel())
            right.append(planes[:, 3])
            count += len(planes)
    joined = (np.concatenate(part) for part in (value, row, column))
    value, row, column = joined
    return (row, column, value, count), np.concatenate(right)


def solve(within, limit, equal, objective):
    """The dual program is solved, which is faster; None where every load is carried, 0 where none is."""
    equal, right = equal
    bounds = [(0, None)] * len(limit) + [(None, None)] * len(right)
    matrix = hstack([within.T, equal.T]).tocsr()
    found = linprog(np.concatenate([limit, right]), None, None, matrix, -objective, bounds, method="highs-ipm")
    if found.status in (2, 4):
        return None
    if found.status == 3:
        return 0.0
    if found.status != 0:
        raise RuntimeError("lower bound: " + found.message)
    return found.fun


def lower_bound(problem):
    """The load; None where every load is carried, 0 where none is."""
    columns = 9 * len(problem.mesh.soils) + 1
    multiplier = None if problem.footed else columns - 1
    rows, objective = Rows(), np.zeros(columns)
    equilibrium(problem, rows, multiplier)
    joints(problem, rows)
    surfaces(problem, rows, objective)
    if multiplier is not None:
        objective[multiplier] = -1
    (row, column, value, count), limit = yields(problem)
    within = coo_matrix((value, (row, column)), shape=(count, columns))
    return solve(within, limit, rows.matrix(columns), objective)
