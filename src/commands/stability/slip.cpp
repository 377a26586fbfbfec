#include "commands/stability/slip.hpp"

#include "mechanics/contact/contact_table.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// Part of the shear across the direction of slip that may be left.
constexpr double left_over = 1e-3;
/// Joints belong to the sliding surface when they have slipped at least this part of the mean.
constexpr double sliding_part = 0.5;

} // namespace

/// Slip of a sub-contact: frictional work over its present shear force.
double Slip::path(const SubContacts& subs, std::size_t row) const {
    const double force = subs.shear_force[row].norm(), lost = subs.frictional_work[row] - work_[row];
    return force > 0 && lost > 0 ? lost / force : 0;
}

bool Slip::follows(const Model& model) const { return std::ranges::equal(model.sub_contacts.id, ids_); }

std::vector<Row> Slip::rows(const Model& model) const {
    if (!follows(model)) return {};
    const auto& subs = model.sub_contacts;
    double works = 0, paths = 0; // their quotient is the mean slip, weighed by the work
    for (std::size_t i = 0; i < work_.size(); ++i) {
        const double lost = subs.frictional_work[i] - work_[i];
        works += lost, paths += lost * path(subs, i);
    }
    std::vector<Row> rows;
    for (std::size_t i = 0; i < work_.size(); ++i)
        if (const double gone = path(subs, i); gone > 0 && gone * works >= sliding_part * paths)
            rows.push_back(static_cast<Row>(i));
    return rows;
}

bool Slip::has_turned_shear(const Model& model) const {
    const auto& subs = model.sub_contacts;
    double all = 0, left = 0;
    for (const Row row : rows(model)) {
        const auto i = static_cast<std::size_t>(row);
        const double force = subs.shear_force[i].norm();
        all += force;
        left += force * std::exp(-path(subs, i) * subs.shear_stiffness[i] * subs.area[i] / force);
    }
    return all > 0 && left <= left_over * all;
}

namespace {

/// Resets the history of zones to that of `start`.
void forget_flow(Zones& zones, const Zones& start) {
    zones.state = start.state;
    for (std::int32_t k = 0; k < zones.history_columns; ++k) {
        if (k < start.history_columns) zones.history[k] = start.history[k];
        else std::ranges::fill(zones.history[k], 0.0);
    }
}

} // namespace

void forget_slip(Model& model, const Model& start, JointRegistry& joints) {
    auto& subs = model.sub_contacts;
    std::vector<char> loaded(subs.size(), 0);
    for (std::size_t i = 0; i < subs.size(); ++i) {
        loaded[i] = subs.normal_force[i] != 0;
        if (!loaded[i]) continue;
        subs.state[i] = 0;
        for (std::int32_t k = 0; k < subs.history_columns; ++k) subs.history[k][i] = 0;
        if (subs.keeps_objects) subs.object[i].reset();
    }
    initialise_sub_contacts(model, joints, loaded);
    if (start.zones.size() == model.zones.size()) forget_flow(model.zones, start.zones);
}

} // namespace kaya
