// Joints of rigid blocks whose places must be finer than eight: docs/theory/contacts.md, "Blocks that turn as they slide" and "Bonds that bend".
#pragma once

#include "laws/joint_model.hpp"
#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

/// Tensile strengths by row of joint properties, as stresses; 0 where a joint model has none.
std::vector<double> tensile_strengths(const Model& model, const JointRegistry& joints);

/// Whether a joint, whose tensile strength is given, is bent so that its bond will tear from one side while its places are still the eight
/// that are right for elastic joints.
bool must_be_finer(const Model& model, Row contact, double strength);

/// Why the places of a joint are finer.
enum class FinePlaces {
    none,
    turns, ///< it turns as it slides: a tenth of its diameter apart
    bends  ///< its bond bends or is torn in part: a tenth of its width apart
};
FinePlaces fine_places(const Model& model, Row contact, double strength);

} // namespace kaya
