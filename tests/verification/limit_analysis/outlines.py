"""Meshes of slopes and footings."""
import numpy as np
from mesh import Mesh
from problem import FIXED, FOOTING, FREE, SMOOTH, SMOOTH_FOOTING, Problem


def graded(first, last, count):
    """Places of lines from 0 to 1 in a geometric series; its cells have the sizes first to last, in parts of each other."""
    sizes = np.geomspace(first, last, count)
    return np.concatenate([[0], np.cumsum(sizes) / sizes.sum()])


def bench(soil, height, run, deep, front, behind, cells, growth=3.0, sides=24):
    """A slope of `cells` over its height with its toe at the origin; its base is rough, its ends are smooth."""
    mesh, far = Mesh(), run + behind
    along = graded(1, growth, round(cells * (0.3 + (behind + 0.5 * run) / height / np.sqrt(growth))))
    mesh.patch([(0, 0), (far, 0), (far, height), (run, height)], along, cells, "soil")
    if deep > 0:
        down = max(2, round(cells * deep / height))
        mesh.patch([(0, -deep), (far, -deep), (far, 0), (0, 0)], along, down, "soil")
        level = 1 - graded(1, growth, round(cells * (0.3 + front / height / np.sqrt(growth))))[::-1]
        mesh.patch([(-front, -deep), (0, -deep), (0, 0), (-front, 0)], level, down, "soil")
    left = -front if deep > 0 else None

    def boundary(x, y):
        if y < 1e-6 - deep:
            return FIXED
        return SMOOTH if x > far - 1e-6 or (left is not None and x < left + 1e-6) else FREE

    return Problem(mesh.join(), {"soil": soil}, boundary, sides=sides)


def footing(soil, rough, width, depth, cells, pressure=0.0, growth=4.0, sides=24, axial=False):
    """A strip footing of half width 1, or a round one of radius 1, on the surface: half of it, with `cells` below it, smaller towards its edge."""
    mesh = Mesh()
    down = 1 - graded(1, growth, round(1.2 * cells * depth / np.sqrt(growth)))[::-1]
    mesh.patch([(0, -depth), (1, -depth), (1, 0), (0, 0)], graded(2, 1, cells), down, "soil")
    beside = graded(1, growth, round(cells * (width - 1) / np.sqrt(growth)))
    mesh.patch([(1, -depth), (width, -depth), (width, 0), (1, 0)], beside, down, "soil")

    def boundary(x, y):
        if y < 1e-6 - depth:
            return FIXED
        if x < 1e-6 or x > width - 1e-6:
            return SMOOTH
        return FREE if x > 1 else FOOTING if rough else SMOOTH_FOOTING

    return Problem(mesh.join(), {"soil": soil}, boundary, lambda x, y: pressure if x > 1 and y > -1e-6 else 0.0, sides, axial)


def pit(soil, radius, deep, behind, cells, growth=4.0, sides=24):
    """A round pit with an upright wall of height 1, `cells` over it; its bottom is the origin, ground below is `deep`. Base and outer side are rough."""
    mesh, far = Mesh(), radius + behind
    along = graded(1, growth, round(cells * (0.3 + behind / np.sqrt(growth))))
    mesh.patch([(radius, 0), (far, 0), (far, 1), (radius, 1)], along, cells, "soil")
    if deep > 0:
        down = 1 - graded(1, growth, max(2, round(1.2 * cells * deep / np.sqrt(growth))))[::-1]
        mesh.patch([(radius, -deep), (far, -deep), (far, 0), (radius, 0)], along, down, "soil")
        inside = 1 - graded(1, growth, max(2, round(1.2 * cells * radius / np.sqrt(growth))))[::-1]
        mesh.patch([(0, -deep), (radius, -deep), (radius, 0), (0, 0)], inside, down, "soil")

    def boundary(x, y):
        if y < 1e-6 - deep or x > far - 1e-6:
            return FIXED
        return SMOOTH if x < 1e-6 else FREE

    return Problem(mesh.join(), {"soil": soil}, boundary, sides=sides, axial=True)
