"""Griffiths and Lane (1999), example 3: a slope of 2 to 1 without friction on ground of its own height, with a weak layer
parallel to its face, then level, then out at 45 degrees. Lengths over the height; the heel of the ground is the origin."""
import numpy as np
from mesh import Mesh
from problem import FIXED, FREE, SMOOTH, Problem
from soil import Soil

# From the crest to the ground in front of the toe: both sides of the layer (scaled from figure 6 of the paper), the ground
# above and the boundary below, with as many corners each, and the lengths between them that count for the mesh.
UPPER = [(0.8, 2), (1.92, 1.44), (3.6, 0.6), (4, 0.6), (4.8, 0.6), (5, 0.8), (5.2, 1)]
LOWER = [(0.6, 2), (1.88, 1.36), (3.8, 0.4), (4.2, 0.4), (4.8, 0.4), (5.1, 0.7), (5.4, 1)]
GROUND = [(0.8, 2), (2, 2), (3.6, 1.2), (4, 1), (4.8, 1), (5, 1), (5.2, 1)]
BASE = [(0, 2), (0, 0), (3.7, 0), (4.2, 0), (5, 0), (6, 0), (6, 1)]
LENGTHS = [1.2, 1.8, 0.4, 0.7, 0.35, 0.35]


def strips(mesh, one, other, places, soil):
    """Quads between two polylines with equal numbers of points; `places` from 0 (on `one`) to 1 (on `other`)."""
    for i in range(len(one) - 1):
        rows = [((1 - t) * one[i] + t * other[i], (1 - t) * one[i + 1] + t * other[i + 1]) for t in places]
        for (a, b), (d, c) in zip(rows, rows[1:]):
            mesh.quad([a, b, c, d], soil)


def weak_layer(ratio, cells, sides=24):
    """The weak layer has `ratio` of the strength of the other soil, c = 0.25 of the weight over the height."""
    counts = [max(1, round(length * cells)) for length in LENGTHS]

    def line(corners):
        corners = np.array(corners, float)
        parts = [p + np.linspace(0, 1, n + 1)[:-1, None] * (q - p) for p, q, n in zip(corners, corners[1:], counts)]
        return np.concatenate([*parts, corners[-1:]])

    mesh = Mesh()
    strips(mesh, line(BASE), line(LOWER), np.linspace(0, 1, round(0.7 * cells) + 1), "soil")
    strips(mesh, line(LOWER), line(UPPER), np.linspace(0, 1, max(2, round(0.25 * cells)) + 1), "layer")
    strips(mesh, line(UPPER), line(GROUND), np.linspace(0, 1, round(0.6 * cells) + 1), "soil")

    def boundary(x, y):
        if y < 1e-6:
            return FIXED
        return SMOOTH if x < 1e-6 or x > 6 - 1e-6 else FREE

    return Problem(mesh.join(), {"soil": Soil(0.25, 0, 1), "layer": Soil(0.25 * ratio, 0, 1)}, boundary, sides=sides)
