#include "mechanics/contact/take_over.hpp"

#include "base/number_text.hpp"
#include "mechanics/contact/batches.hpp"
#include "mechanics/contact/contact_table.hpp"
#include "mechanics/contact/contact_work.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace kaya {

namespace {

/// Rounding, in parts of the force.
constexpr double force_rounding = 1e-6;

struct Force {
    double normal;
    Vec3 shear;
    double size() const { return std::hypot(normal, shear.norm()); }
};

/// A copy of the data of some rows that a joint model may change, to restore them.
class RowsBefore {
public:
    RowsBefore(SubContacts& subs, Row first, Row count) : subs_(subs), first_(first) {
        for_columns([&](auto& column) {
            const auto begin = column.begin() + first;
            numbers_.emplace_back(begin, begin + count);
        });
        states_.assign(subs.state.begin() + first, subs.state.begin() + first + count);
        if (subs.keeps_objects) objects_.assign(subs.object.begin() + first, subs.object.begin() + first + count);
    }

    Force force(Row row) const {
        const auto i = static_cast<std::size_t>(row - first_);
        return {numbers_[0][i], Vec3(numbers_[1][i], numbers_[2][i], numbers_[3][i])};
    }
    double frictional_work(Row row) const { return numbers_[4][static_cast<std::size_t>(row - first_)]; }

    void put_back(Row row) {
        const auto i = static_cast<std::size_t>(row - first_);
        std::size_t k = 0;
        for_columns([&](auto& column) { column[row] = numbers_[k++][i]; });
        subs_.state[row] = states_[i];
        if (subs_.keeps_objects) std::swap(subs_.object[row], objects_[i]);
    }

private:
    /// Force and work come first.
    template <class Visit> void for_columns(Visit visit) {
        visit(subs_.normal_force);
        for (auto& column : subs_.shear_force.component) visit(column);
        visit(subs_.frictional_work);
        visit(subs_.normal_stiffness);
        visit(subs_.shear_stiffness);
        for (std::int32_t k = 0; k < subs_.history_columns; ++k) visit(subs_.history[static_cast<std::size_t>(k)]);
    }

    SubContacts& subs_;
    Row first_;
    std::vector<std::vector<double>> numbers_;
    std::vector<std::uint32_t> states_;
    std::vector<JointObject> objects_;
};

/// Forces that one joint model did not carry.
struct Reduction {
    std::size_t rows = 0;
    Row worst = no_row;
    double most = -1; ///< lost
    Force before{}, after{};
};

void still(SubContacts& subs, Row first, Row end) {
    for (Row s = first; s < end; ++s) {
        subs.normal_displacement_increment[s] = 0;
        subs.shear_displacement_increment.set(s, Vec3::Zero());
    }
}

/// A step without motion of some rows of a batch.
void try_rows(Model& model, const Batch& part, Reduction& reduction) {
    auto& subs = model.sub_contacts;
    const Row end = part.first + part.count;
    RowsBefore before(subs, part.first, part.count);
    still(subs, part.first, end);
    // So short that nothing creeps in it.
    const double step = model.clock.time_step > 0 ? 1e-6 * model.clock.time_step : 1e-12;
    BatchColumns made;
    auto columns = columns_of(model, part, step, made);
    if (const auto failure = run_batch(*part.model, columns, subs.number.data() + part.first, Guard::fenced))
        throw joint_failure(model, part, *failure);
    for (Row s = part.first; s < end; ++s) {
        const Force was = before.force(s), is{subs.normal_force[s], subs.shear_force[s]};
        const double lost = std::hypot(is.normal - was.normal, (is.shear - was.shear).norm());
        if (!(lost > force_rounding * was.size())) {
            before.put_back(s);
            continue;
        }
        if (model.settings.energy) model.energy.joint_friction += subs.frictional_work[s] - before.frictional_work(s);
        ++reduction.rows;
        if (lost <= reduction.most) continue;
        reduction.most = lost;
        reduction.worst = s;
        reduction.before = was;
        reduction.after = is;
    }
}

Diagnostic warning_of(const Model& model, const std::string& name, const Reduction& r) {
    const auto& subs = model.sub_contacts;
    const Row c = subs.contact[r.worst];
    const Vec3 x = subs.position[r.worst];
    Diagnostic d(
        fmt::format("joint model '{}' cannot carry the forces that {} sub-contact{} {}: they are cut to its strength",
                    name, r.rows, r.rows == 1 ? "" : "s", r.rows == 1 ? "has" : "have"),
        "the rest is lost; check the strength, or bring the model to rest before the change");
    d.add(fmt::format("most of all sub-contact {} of contact {} between blocks {} and {}, at {}: normal force "
                      "{:.6g} becomes {:.6g}, shear force {:.6g} becomes {:.6g}",
                      subs.number[r.worst], model.contacts.number[c], model.blocks.number[model.contacts.block1[c]],
                      model.blocks.number[model.contacts.block2[c]], place_text(x), r.before.normal, r.after.normal,
                      r.before.shear.norm(), r.after.shear.norm()));
    const auto& place = model.joint_properties[static_cast<std::size_t>(model.contacts.properties[c])].place;
    if (!place.empty()) d.add("properties given at " + place);
    d.code = "forces-not-carried";
    return d;
}

std::vector<char> marks_of(const Model& model, std::vector<SubContactId>& ids) {
    std::vector<char> marked(model.sub_contacts.size(), 0);
    for (const auto& id : ids)
        if (const Row row = model.sub_contacts.ids.row(id); row != no_row) marked[static_cast<std::size_t>(row)] = 1;
    ids = {};
    return marked;
}

} // namespace

void note_taken_over(Model& model, const std::vector<char>& marked) {
    for (std::size_t s = 0; s < marked.size(); ++s)
        if (marked[s]) model.taken_over.push_back(model.sub_contacts.id[s]);
}

void tell_of_forces(Model& model, JointRegistry& joints) {
    if (model.forces_set.empty()) return;
    initialise_sub_contacts(model, joints, marks_of(model, model.forces_set));
}

std::vector<Diagnostic> take_over_forces(Model& model, JointRegistry& joints) {
    if (model.taken_over.empty()) return {};
    const std::vector<char> marked = marks_of(model, model.taken_over);
    std::map<std::string, Reduction> reductions; // by joint model
    for (const Batch& batch : make_batches(model, joints)) {
        const Row last = batch.first + batch.count;
        const auto& set = model.joint_properties[static_cast<std::size_t>(batch.properties)];
        const bool complete = batch.model->missing(set.values).empty();
        for (Row row = batch.first; row < last;) {
            Row end = row;
            while (end < last && marked[static_cast<std::size_t>(end)]) ++end;
            if (end == row) {
                ++row;
                continue;
            }
            if (complete) {
                Batch part = batch;
                part.first = row;
                part.count = end - row;
                try_rows(model, part, reductions[batch.model->name]);
            } else {
                for (Row s = row; s < end; ++s) model.taken_over.push_back(model.sub_contacts.id[s]);
            }
            row = end;
        }
    }
    std::vector<Diagnostic> warnings;
    for (const auto& [name, reduction] : reductions) {
        if (reduction.rows == 0) continue;
        warnings.push_back(warning_of(model, name, reduction));
        ModelEdit(model, Change::properties); // forces are gathered again
    }
    return warnings;
}

} // namespace kaya
