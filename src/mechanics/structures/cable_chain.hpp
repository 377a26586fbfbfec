// The slips of one cable that are in equilibrium with the places of its nodes in the rock: docs/theory/cables.md.
#pragma once

#include "base/vector.hpp"

#include <cstddef>
#include <vector>

namespace kaya {

/// Bars between neighbouring nodes and grout at the nodes, all perfectly plastic. Lengths, forces, tension positive.
struct CableChain {
    struct Bar {
        double stiffness = 0;     ///< force/length
        double gap = 0;           ///< elongation without slip and without plastic elongation
        double kept = 0;          ///< force without elongation
        double first_cosine = 1;  ///< between the bar and the cable's direction at its first node
        double second_cosine = 1; ///< the same at its second node
        double yield_tension = 0, yield_compression = 0;
        bool broken = false;
    };
    struct Grout {
        double stiffness = 0;  ///< force/length of slip; 0: the node slides freely
        double strength = 0;   ///< force
        double lost = 0;       ///< slip at which the grout carries no force
        bool anchored = false; ///< slip is fixed
    };
    std::vector<Bar> bars; ///< one less than nodes
    std::vector<Grout> grout;
    std::vector<double> slip; ///< in: where to begin; out: the equilibrium

    double elongation(std::size_t bar) const;
    double elastic_force(std::size_t bar) const;
    double bar_force(std::size_t bar) const;
    double grout_force(std::size_t node) const; ///< of the rock on the cable

    std::vector<Vec3> places; ///< of the nodes one step ago

    /// Newton's method for the minimum of a convex, piecewise quadratic energy, with a line search. Returns the largest residual force at a
    /// node that may slip.
    double solve();

private:
    double left_over(std::size_t node) const;
    double tolerance() const;
    double fill_step();

    std::vector<double> diagonal_, adjacent_, forces_, step_, before_; ///< kept for their memory
};

} // namespace kaya
