"""Known answers, and slopes and footings for which the decks of verification want a reference."""
import math
from dataclasses import dataclass
from typing import Callable

from outlines import bench, footing, pit
from soil import Soil
from weak_layer import weak_layer


@dataclass
class Case:
    """`make` gives the problem; a slope's answer is a factor of safety near `answer`, otherwise it is a multiplier or a force."""

    name: str
    make: Callable
    answer: float
    source: str
    slope: bool = False


def _bench(angle, friction, stability, cells, deep=0.5, tension=True):
    """A slope of height 1 at this angle with this γH/c; friction in degrees; with ground of `deep` and in front of it."""
    soil = Soil(1 / stability, friction, 1, tension)
    run = 1 / math.tan(math.radians(angle))
    return bench(soil, 1, run, deep, 1 if deep else 0, 1.6, cells)


def chen(angle, friction, stability):
    name = f"slope of {angle} degrees, friction {friction}, γH/c = {stability}"
    return Case(name, lambda: _bench(angle, friction, stability, 12, 0), 1, "Chen (1975)", True)


KNOWN = [
    Case("γH/c of a vertical cut without friction", lambda: bench(Soil(1, 0, 1), 1, 0, 0, 0, 1.3, 12, 1.5), 3.776, "Pastor; Makrodimopoulos and Martin (2007)"),
    Case("N_c, no friction", lambda: footing(Soil(1), True, 3.2, 1.6, 8), 2 + math.pi, "Prandtl (1920)"),
    Case("N_q, friction 20", lambda: footing(Soil(0, 20), True, 6.5, 3, 6, 1), 6.399, "Reissner (1924)"),
    Case("N_γ, friction 20, rough", lambda: footing(Soil(0, 20, 1), True, 3, 1.2, 10), 2.839, "Martin (2005)"),
    Case("N_γ, friction 20, smooth", lambda: footing(Soil(0, 20, 1), False, 3, 1.2, 10), 1.579, "Martin (2005)"),
    Case("bench of 45 degrees without friction, γH/c = 6", lambda: _bench(45, 0, 6, 10), 0.921, "limit analysis, 0.911 to 0.931", True),
    Case("N_c of a smooth round footing, no friction", lambda: footing(Soil(1), False, 2.4, 1.2, 5, axial=True), 5.69, "Shield (1955)"),
    Case("N_c of a rough round footing, no friction", lambda: footing(Soil(1), True, 2.6, 1.2, 5, axial=True), 6.05, "Eason and Shield (1960)"),
    Case("γH/c of a round pit, radius 100 H, no friction", lambda: pit(Soil(1, 0, 1), 100, 0, 1.5, 8), 3.776, "the vertical cut"),
    chen(45, 20, 16.16),
    chen(60, 20, 10.39),
    chen(60, 10, 7.26),
]


def layered(ratio, answer):
    return Case(f"Griffiths and Lane 3, weak layer of {ratio}", lambda: weak_layer(ratio, 8), answer, "read from figure 7", True)


def cracked(tension):
    """ACADS 1b: 2 to 1, 10 high, c = 32 kPa, friction 10, weight 20 kN/m3; `tension` False: no tension, in place of its crack."""
    name = "ACADS 1b" + ("" if tension else ", no tension")
    soil = Soil(32 / 200, 10, 1, tension, (0, math.degrees(math.atan(0.5))))
    return Case(name, lambda: bench(soil, 1, 2, 0.5, 1, 1.6, 9), 1.65, "Giam and Donald (1989)", True)


def round_pit(radius, friction, stability, cells=12):
    """Of radius H; friction in degrees."""
    name = f"round pit, radius {radius} H, friction {friction}, γH/c = {stability}"
    return Case(name, lambda: pit(Soil(1 / stability, friction, 1), radius, 0, 1.3, cells), 1, "", True)


WANTED = [
    layered(1, 1.47),
    layered(0.6, 1.4),
    layered(0.4, 1.05),
    layered(0.2, 0.6),
    cracked(True),
    cracked(False),
    Case("bench of 75 degrees without friction, γH/c = 4.5", lambda: _bench(75, 0, 4.5, 12), 1, "", True),
    Case("bench of 75 degrees, friction 20, γH/c = 7.5", lambda: _bench(75, 20, 7.5, 12), 1, "", True),
    round_pit(1, 0, 5.12),
    round_pit(1, 20, 8.4),
]
