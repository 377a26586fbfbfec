#include "mechanics/contact/fine_places.hpp"

#include "laws/property_roles.hpp"
#include "mechanics/contact/contact_slip.hpp"
#include "model/measure/overlap_rows.hpp"

#include <algorithm>
#include <limits>

namespace kaya {

namespace {

/// Of the strength: a pull from which a joint gets finer places, one below which it has them no more, and the difference of tractions that
/// counts as bending.
constexpr double near_strength = 0.5, far_from_strength = 0.25, bending = 0.1;

/// Sub-contacts inside of the polygon of a joint with as few as possible.
constexpr Row inner = 4;

struct Pull {
    double greatest = -std::numeric_limits<double>::infinity(), least = std::numeric_limits<double>::infinity();
    bool open = false, bonded = false; ///< any place is open, or pulls
};

Pull pull_of(const Model& model, Row contact) {
    const auto& s = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[contact];
    Pull pull;
    for (Row row = span.first; row < span.end(); ++row) {
        if (!(s.area[row] > 0)) continue;
        const double traction = -s.normal_force[row] / s.area[row];
        pull.greatest = std::max(pull.greatest, traction);
        pull.least = std::min(pull.least, traction);
        pull.open = pull.open || (s.normal_force[row] == 0 && s.normal_displacement[row] > 0);
        pull.bonded = pull.bonded || s.normal_force[row] < 0;
    }
    return pull;
}

/// Whether more than so many sub-contacts of a joint lie inside of its polygon; they follow those at its corners.
bool has_inside(const Model& model, const Span& span, Row places) {
    return span.count > places && model.sub_contacts.type[span.end() - 1 - places] == SubContactType::face_face;
}
bool is_fine(const Model& model, const Span& span) { return has_inside(model, span, inner); }

} // namespace

std::vector<double> tensile_strengths(const Model& model, const JointRegistry& joints) {
    std::vector<double> strengths;
    strengths.reserve(model.joint_properties.size());
    for (const JointProperties& properties : model.joint_properties) {
        const JointModel* joint = joints.find(properties.model);
        double strength = 0;
        for (std::size_t i = 0; joint != nullptr && i < std::min(joint->properties.size(), properties.values.size());
             ++i)
            if (strength_part(joint->properties[i].role) == StrengthPart::tension)
                strength = std::max(strength, properties.values[i]);
        strengths.push_back(strength);
    }
    return strengths;
}

bool must_be_finer(const Model& model, Row contact, double strength) {
    const Span span = model.contacts.sub_contacts[contact];
    if (!(strength > 0) || !between_rigid(model, contact)) return false;
    if (!has_inside(model, span, 0) || is_fine(model, span)) return false;
    const Pull pull = pull_of(model, contact);
    return pull.greatest > near_strength * strength && pull.greatest - pull.least > bending * strength;
}

FinePlaces fine_places(const Model& model, Row contact, double strength) {
    const bool is_joint = model.contacts.kind[contact] == ContactKind::joint;
    if (is_joint && must_be_finer(model, contact, strength)) return FinePlaces::bends;
    if (is_joint && turns_as_it_slides(model, contact)) return FinePlaces::turns;
    const Span span = model.contacts.sub_contacts[contact];
    if (!(strength > 0) || !is_fine(model, span)) return FinePlaces::none;
    const auto still = [&] {
        if (!is_joint) return model.contacts.torn[contact] != 0;
        const Pull pull = pull_of(model, contact);
        return pull.greatest > far_from_strength * strength || (pull.open && pull.bonded);
    };
    return still() ? FinePlaces::bends : FinePlaces::none;
}

} // namespace kaya
