// What solve control moves: a load that is scaled, or a boundary that is driven. docs/push-over.md
#pragma once

#include "base/vector.hpp"

#include <string>

namespace kaya {

/// One force on one displacement. Velocity, load and reaction are those of the last step.
class Push {
public:
    virtual ~Push() = default;

    virtual double velocity() const = 0; ///< of the displacement
    virtual double load() const = 0;
    virtual double force() const = 0;     ///< load times this times displacement is the work of the load
    virtual Vec3 reaction() const = 0;    ///< of all supports but a driven one
    virtual bool is_boundary() const = 0; ///< a boundary, no load
    /// Adjusts to masses, and to bodies that have come or gone. Throws Diagnostic when none is left.
    virtual void renew() = 0;
    /// Whether bodies have come or gone since the last renew().
    virtual bool is_outdated() const = 0;
    /// Sets the load, or the velocity, of the next step. `velocity` is velocity().
    virtual void advance(double velocity, double wanted) = 0;
    /// A driven boundary stops; a load stays.
    virtual void end() = 0;
    virtual bool turns() const = 0; ///< the displacement is a rotation
    /// For pictures: quantity and unit.
    virtual std::string load_name() const = 0;
    /// Why a run ends when the load is 0.
    virtual std::string end_of_load() const = 0;
};

} // namespace kaya
