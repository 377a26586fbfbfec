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
    faces: tuple = (0.0,)  # without tension: inclinations of free faces, in degrees, along which soil is to carry

    def reduced(self, factor):
        friction = math.degrees(math.atan(self.tangent / factor))
        return replace(self, cohesion=self.cohesion / factor, friction=friction)

    @property
    def tangent(self):
        return math.tan(math.radians(self.friction))

    def planes(self, sides, inside):
        """Rows (a, b, c, d) of a stress_x + b stress_y + c shear <= d. The circle of yield has `sides` planes, with their
        corners on it (`inside`) or tangent to it."""
        angle = 2 * math.pi * np.arange(sides) / sides
        f = math.radians(self.friction)
        shrink = np.full(sides, math.cos(math.pi / sides) if inside else 1.0)
        rows = [self.cone(angle, shrink, math.sin(f), self.cohesion * math.cos(f))]
        if not self.tension:
            if inside:  # compression along a free face is a corner
                along = [math.radians(180 + 2 * face) for face in self.faces]
                corners = np.unique(np.round(np.mod(np.concatenate([angle, along]), 2 * math.pi), 9))
                half = 0.5 * (np.roll(corners, -1) - corners + np.where(np.arange(len(corners)) < len(corners) - 1, 0, 2 * math.pi))
                angle, shrink = corners + half, np.cos(half)
            rows.append(self.cone(angle, shrink, 1.0, 0.0))
        return np.concatenate(rows)

    @staticmethod
    def cone(angle, shrink, slope, limit):
        """Planes with these directions of a circle whose radius is limit less slope times the mean stress."""
        s, c = 0.5 * slope * shrink, 0.5 * np.cos(angle)
        return np.stack([c + s, s - c, np.sin(angle), limit * shrink], 1)
