// Shear strength of a slip surface over its effective normal stress.
#pragma once

namespace kaya {

/// tau = cohesion + normal stress * tan_friction; compression positive.
struct Coulomb {
    double cohesion = 0; ///< stress
    double tan_friction = 0;
    double at(double normal_stress) const { return cohesion + normal_stress * tan_friction; }
};

/// One of the strength criteria of slip surfaces. All stresses are in the unit of the deck.
class Strength {
public:
    /// Infinite strength: no slip surface passes through it.
    Strength() = default;

    /// `friction` in degrees.
    static Strength coulomb(double cohesion, double friction);

    struct Barton {
        double residual_friction = 0; ///< degrees
        double jrc = 0;               ///< at the scale of the joint
        double jcs = 0;               ///< stress, at the scale of the joint
        double largest_angle = 70;    ///< degrees; Barton and Choubey 1977
    };
    /// tau = n tan(friction + JRC log10(JCS/n)), Barton 1973.
    static Strength barton(const Barton&);

    struct HoekBrown {
        double strength = 0; ///< of intact rock under uniaxial compression, stress
        double mb = 0, s = 0, a = 0.5;
    };
    /// sigma1 = sigma3 + sci (mb sigma3/sci + s)^a, Hoek, Carranza-Torres and Corkum 2002, as its envelope of shear stresses.
    static Strength hoek_brown(const HoekBrown&);

    bool fails() const { return kind_ != Kind::none; }
    /// Whether the tangent is the same at every normal stress.
    bool is_linear() const { return kind_ == Kind::coulomb; }
    /// The tangent of the envelope at a normal stress (taken as 0 or more).
    Coulomb tangent(double normal_stress) const;

private:
    enum class Kind { none, coulomb, barton, hoek_brown };
    Kind kind_ = Kind::none;
    Coulomb line_;
    Barton barton_;
    HoekBrown hoek_brown_;
};

} // namespace kaya
