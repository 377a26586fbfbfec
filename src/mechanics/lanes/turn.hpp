// Rotation of one rigid block, or of eight, in a step.
#pragma once

#include "mechanics/lanes/triple.hpp"

namespace kaya {

/// A unit vector after a small rotation, normalised by one step of Newton's method for 1/sqrt, since its length is almost 1.
template <class T> TripleOf<T> turned_a_little(const TripleOf<T>& unit, const TripleOf<T>& turn) {
    const TripleOf<T> turned = unit + turn.cross(unit);
    return (1.5 - 0.5 * turned.dot(turned)) * turned;
}

/// Rotates a block with angular momentum `momentum` for one step by the implicit midpoint rule, with the velocity at mid-step found by
/// fixed-point iteration. Momentum is conserved to the last bit and energy has no drift (Simo and Wong 1991, Int. J. Numer. Meth. Eng. 31).
/// The inertia is in the block's own axes. Returns the velocity. Each of eight blocks stops iterating independently.
template <class T> TripleOf<T> turn(RotorOf<T>& orientation, const SymmetricInverseOf<T>& inverse_inertia,
                                    const TripleOf<T>& momentum, double step) {
    const RotorOf<T> start = orientation;
    const TripleOf<T> own = start.conjugate().turned(momentum); // in the block's axes, as all that follows
    TripleOf<T> velocity = inverse_inertia * own;
    auto settled = T{} != T{};
    for (int i = 0; i < 8 && !all(settled); ++i) {
        // In axes that rotate with the block, the momentum rotates in the opposite direction.
        const RotorOf<T> half = RotorOf<T>::by(0.5 * step * velocity);
        const TripleOf<T> next = half.turned(inverse_inertia * half.conjugate().turned(own)), change = next - velocity;
        velocity = {settled ? velocity.x : next.x, settled ? velocity.y : next.y, settled ? velocity.z : next.z};
        settled = settled | (change.dot(change) <= 1e-30 * next.dot(next));
    }
    const RotorOf<T> end = start * RotorOf<T>::by(step * velocity);
    // Its length is 1 but for rounding: one step of Newton's method for 1/sqrt makes it so again.
    const T scale = 1.5 - 0.5 * (end.w * end.w + end.v.dot(end.v));
    orientation = {scale * end.w, scale * end.v};
    return start.turned(velocity);
}

} // namespace kaya
