"""Triangles in plane strain with their own corners, and the edges between them."""
import numpy as np


class Mesh:
    """`corners` (triangles, 3, 2), counterclockwise; `soils` names the soil of each; `edges` pairs them: see `join`."""

    def __init__(self):
        self.corners, self.soils = [], []

    def patch(self, points, along, across, soil):
        """Quads between four corners given counterclockwise, split into four triangles each. `along` and `across` are
        counts, or the relative places of the lines from 0 to 1."""
        a, b, c, d = (np.array(p, float) for p in points)
        u, v = (np.linspace(0, 1, n + 1) if np.isscalar(n) else np.asarray(n) for n in (along, across))

        def at(s, t):
            return (1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * d + s * c)

        for i in range(len(u) - 1):
            for j in range(len(v) - 1):
                self.quad([at(u[i], v[j]), at(u[i + 1], v[j]), at(u[i + 1], v[j + 1]), at(u[i], v[j + 1])], soil)

    def quad(self, q, soil):
        """Four triangles round the crossing of the diagonals; a quad with two equal corners is a triangle, split in three."""
        q = [p for k, p in enumerate(q) if np.linalg.norm(p - q[k - 1]) > 1e-9]
        if len(q) < 3:
            return
        if len(q) == 4:
            d, e = q[2] - q[0], q[3] - q[1]
            s = np.linalg.solve(np.array([d, -e]).T, q[1] - q[0])[0]
            middle = q[0] + s * d
        else:
            middle = sum(q) / 3
        for k, p in enumerate(q):
            self.corners.append(np.array([p, q[(k + 1) % len(q)], middle]))
            self.soils.append(soil)

    def join(self):
        """Finds the edges: `inner` has (triangle, side, triangle, side), `outer` (triangle, side). Side k goes from
        corner k to k + 1."""
        self.corners = np.array(self.corners)
        x, y = self.corners[..., 0], self.corners[..., 1]
        self.area = 0.5 * ((x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (x[:, 2] - x[:, 0]) * (y[:, 1] - y[:, 0]))
        if self.area.min() <= 0:
            raise ValueError("a triangle is turned over")
        # Gradients of the shape functions: (triangles, 3 corners, 2).
        self.gradient = np.stack([np.roll(y, -1, 1) - np.roll(y, -2, 1), np.roll(x, -2, 1) - np.roll(x, -1, 1)], 2)
        self.gradient /= 2 * self.area[:, None, None]
        seen, self.inner = {}, []
        for e, triangle in enumerate(self.corners):
            keys = [tuple(np.round(p, 6) + 0.0) for p in triangle]
            for k in range(3):
                other = seen.pop((keys[(k + 1) % 3], keys[k]), None)
                if other:
                    self.inner.append((e, k) + other)
                else:
                    seen[keys[k], keys[(k + 1) % 3]] = (e, k)
        self.outer = list(seen.values())
        return self

    def side(self, e, k):
        """Ends, length, outward normal and tangent of a side."""
        p, q = self.corners[e][k], self.corners[e][(k + 1) % 3]
        length = np.linalg.norm(q - p)
        tangent = (q - p) / length
        return p, q, length, np.array([tangent[1], -tangent[0]]), tangent
