#include "mechanics/contact/contact_slip.hpp"

#include "model/measure/measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kaya {

namespace {

/// The least motion over the greatest: below, eight places of a square miss the sum of friction by more than half a percent.
constexpr double turning = 0.6;
/// A joint slides when a place has slipped this part of its size, the square root of its area; blocks that settle slip less, and pay for no finer sub-contacts.
constexpr double sliding = 0.01;

/// Whether each place that carries a force has slipped, and one of them far.
bool slipped_far(const Model& model, Row contact) {
    const auto& s = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[contact];
    double farthest = 0;
    for (Row row = span.first; row < span.end(); ++row) {
        if (s.normal_force[row] > 0 && !(s.frictional_work[row] > 0)) return false;
        farthest = std::max(farthest, Vec3(s.shear_displacement[row]).squaredNorm());
    }
    return farthest > sliding * sliding * model.contacts.area[contact];
}

/// Whether the places moved differently in the last step.
bool turns(const Model& model, Row contact) {
    const auto& s = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[contact];
    double greatest = 0, least = std::numeric_limits<double>::infinity();
    for (Row row = span.first; row < span.end(); ++row) {
        const double square = Vec3(s.shear_displacement_increment[row]).squaredNorm();
        greatest = std::max(greatest, square);
        least = std::min(least, square);
    }
    return least < turning * turning * greatest;
}

} // namespace

double slip_of(const Model& model, Row contact) {
    const auto& s = model.sub_contacts;
    const Vec3& n = model.contacts.normal[contact];
    double farthest = 0;
    const Span span = model.contacts.sub_contacts[contact];
    for (Row row = span.first; row < span.end(); ++row) {
        const Vec3 between = attached_position(model, s.side2[row]) - attached_position(model, s.side1[row]);
        farthest = std::max(farthest, (between - between.dot(n) * n).squaredNorm());
    }
    return std::sqrt(farthest);
}

bool turns_as_it_slides(const Model& model, Row contact) {
    return model.contacts.kind[contact] == ContactKind::joint && slipped_far(model, contact) && turns(model, contact);
}

} // namespace kaya
