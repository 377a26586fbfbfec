"""What both bounds are of: a mesh, its soils, what holds its boundary and which load is sought."""
from dataclasses import dataclass, field
from typing import Callable

# Kinds of boundary: free, fixed (rough), smooth, footing (rough), smooth footing.
FREE, FIXED, SMOOTH, FOOTING, SMOOTH_FOOTING = "free", "fixed", "smooth", "footing", "smooth footing"


@dataclass
class Problem:
    """Sought is the multiplier of all weights, or, where the boundary has a footing, the force that presses it down.
    `boundary` tells the kind of an outer side from its middle; a free side may carry `pressure`."""

    mesh: object
    soils: dict
    boundary: Callable
    pressure: Callable = field(default=lambda x, y: 0.0)
    sides: int = 24
    axial: bool = False  # a body of revolution about x = 0

    def outer(self):
        """Outer sides with their kind and pressure: (triangle, side, kind, pressure)."""
        for e, k in self.mesh.outer:
            p, q, *_ = self.mesh.side(e, k)
            middle = 0.5 * (p + q)
            yield e, k, self.boundary(*middle), self.pressure(*middle)

    @property
    def footed(self):
        return any("footing" in kind for _, _, kind, _ in self.outer())
