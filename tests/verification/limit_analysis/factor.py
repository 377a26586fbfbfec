"""The factor by which strength is divided until a slope just carries its weight."""
import math
from dataclasses import replace


def factor(problem, bound, guess, tolerance=5e-4):
    """With `bound` lower_bound or upper_bound. Without friction the multiplier of the weights is the factor."""
    if all(s.friction == 0 for s in problem.soils.values()):
        return bound(problem)

    def multiplier(f):
        found = bound(replace(problem, soils={name: s.reduced(f) for name, s in problem.soils.items()}))
        return math.inf if found is None else found

    low = high = None
    f = guess
    while True:
        m = multiplier(f)
        if abs(m - 1) < tolerance:
            return f * m ** 0.5
        if m > 1:
            low = (f, m)
        else:
            high = (f, m)
        if low and high and math.isfinite(low[1]) and high[1] > 0:
            part = math.log(low[1]) / math.log(low[1] / high[1])
            f = low[0] * (high[0] / low[0]) ** part
        elif low and high:
            f = math.sqrt(low[0] * high[0])
        else:
            f *= min(max(m, 0.8), 1.25) ** 0.8
