"""Mohr-Coulomb soil and its polygon of yield."""
import math
from dataclasses import dataclass, replace

import numpy as np


@dataclass(frozen=True)
class Soil:
    cohesion: float
    friction: float = 0.0  # degrees
    weight: float = 0.0
    tension: bool = True  # False: no principal stress is tensile

    def reduced(self, factor):
        t = math.tan(math.radians(self.friction)) / factor
        return replace(self, cohesion=self.cohesion / factor, friction=math.degrees(math.atan(t)))

    @property
    def tangent(self):
        return math.tan(math.radians(self.friction))

    def planes(self, sides, inside):
        """Rows (a, b, c, d) of a stress_x + b stress_y + c shear <= d. The circle of yield has `sides` planes, with their
        corners on it (`inside`) or tangent to it."""
        angle = 2 * math.pi * np.arange(sides) / sides
        f = math.radians(self.friction)
        shrink = math.cos(math.pi / sides) if inside else 1.0
        circles = [(math.sin(f), self.cohesion * math.cos(f))] + ([] if self.tension else [(1.0, 0.0)])
        rows = []
        for slope, limit in circles:
            s, c = 0.5 * slope * shrink, 0.5 * np.cos(angle)
            rows.append(np.stack([c + s, s - c, np.sin(angle), np.full(sides, limit * shrink)], 1))
        return np.concatenate(rows)
