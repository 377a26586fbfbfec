// Elasticity of the zones of a block.
#pragma once

namespace kaya {

/// Lame's constants of a block: stress = lambda trace(strain) + two_shear strain.
struct ElasticConstants {
    double lambda = 0, two_shear = 0;

    double bulk() const { return lambda + two_shear / 3; }
};

} // namespace kaya
