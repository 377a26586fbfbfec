#include "mechanics/contact/batches.hpp"
#include "base/number_text.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <numeric>

namespace kaya {

std::vector<Batch> make_batches(Model& model, JointRegistry& joints, Row most) {
    const auto& spans = model.contacts.sub_contacts;
    std::vector<Row> order(spans.size());
    std::iota(order.begin(), order.end(), Row{0});
    std::stable_sort(order.begin(), order.end(), [&](Row a, Row b) { return spans[a].first < spans[b].first; });
    std::vector<Batch> batches;
    for (const Row c : order) {
        const Span span = spans[c];
        const Row properties = model.contacts.properties[c];
        const bool joins =
            !batches.empty() && batches.back().properties == properties && batches.back().count + span.count <= most;
        if (joins) {
            batches.back().count += span.count;
            batches.back().contacts.push_back(c);
            continue;
        }
        const JointModel& joint = joints.get(model.joint_properties[properties].model);
        model.sub_contacts.keep_history(joint.history.size());
        if (joint.keeps_objects()) model.sub_contacts.keep_objects();
        batches.push_back({&joint, properties, span.first, span.count, {c}});
    }
    return batches;
}

namespace {

/// A field mostly has the same value in consecutive batches and need not be filled again.
void fill_field(BatchColumns& made, std::size_t k, std::size_t rows, double value) {
    auto& alike = made.alike[k];
    const bool same = alike && std::memcmp(&*alike, &value, sizeof value) == 0;
    if (same && made.fields[k].size() >= rows) return;
    made.fields[k].assign(std::max(rows, made.fields[k].size()), value);
    alike = value;
}

void add_fields(kaya_jbatch& b, const Model& model, const Batch& batch, BatchColumns& made) {
    const auto& subs = model.sub_contacts;
    const auto& fields = batch.model->fields;
    for (std::size_t k = 0; k < fields.size(); ++k) {
        const double otherwise = fields[k].property ? b.properties[*fields[k].property] : fields[k].initial;
        fill_field(made, k, b.n, otherwise);
        made.field[k] = made.fields[k].data();
        if (static_cast<std::int32_t>(k) >= subs.field_columns) continue;
        for (std::size_t i = 0; i < b.n; ++i) {
            const Row row = batch.first + static_cast<Row>(i);
            if (!(subs.field_set[row] >> k & 1u)) continue;
            made.fields[k][i] = subs.field[k][row];
            made.alike[k].reset();
        }
    }
    b.field = made.field.data();
}

void add_places(kaya_jbatch& b, const Model& model, const Batch& batch, BatchColumns& made) {
    const auto& subs = model.sub_contacts;
    const auto& contacts = model.contacts;
    for (auto& column : made.normal) column.resize(b.n);
    for (auto& column : made.block) column.resize(b.n);
    for (std::size_t i = 0; i < b.n; ++i) {
        const Row c = subs.contact[batch.first + static_cast<Row>(i)];
        for (int k = 0; k < 3; ++k) made.normal[k][i] = contacts.normal[c][k];
        made.block[0][i] = model.blocks.number[contacts.block1[c]];
        made.block[1][i] = model.blocks.number[contacts.block2[c]];
    }
    for (int k = 0; k < 3; ++k) {
        b.position[k] = subs.position.component[k].data() + batch.first;
        b.normal[k] = made.normal[k].data();
    }
    for (int side = 0; side < 2; ++side) b.block[side] = made.block[side].data();
}

} // namespace

kaya_jbatch columns_of(Model& model, const Batch& batch, double time_step, BatchColumns& made) {
    auto& s = model.sub_contacts;
    const Row first = batch.first;
    kaya_jbatch b{};
    b.n = static_cast<std::size_t>(batch.count);
    b.properties = model.joint_properties[batch.properties].values.data();
    b.time_step = time_step;
    b.area = s.area.data() + first;
    b.normal_disp = s.normal_displacement.data() + first;
    b.normal_disp_inc = s.normal_displacement_increment.data() + first;
    for (int k = 0; k < 3; ++k) {
        b.shear_disp[k] = s.shear_displacement.component[k].data() + first;
        b.shear_disp_inc[k] = s.shear_displacement_increment.component[k].data() + first;
        b.shear_force[k] = s.shear_force.component[k].data() + first;
    }
    b.pore_pressure = s.pore_pressure.data() + first;
    b.normal_force = s.normal_force.data() + first;
    b.normal_stiffness = s.normal_stiffness.data() + first;
    b.shear_stiffness = s.shear_stiffness.data() + first;
    b.frictional_work = s.frictional_work.data() + first;
    b.state = s.state.data() + first;
    for (std::size_t k = 0; k < batch.model->history.size(); ++k) made.history[k] = s.history[k].data() + first;
    b.history = made.history.data();
    b.message[0] = 0;
    b.object = batch.model->keeps_objects() ? s.object[first].address() : nullptr;
    b.tables = batch.model->tables;
    if (!batch.model->fields.empty()) add_fields(b, model, batch, made);
    if (batch.model->needs_place()) add_places(b, model, batch, made);
    return b;
}

void initialise_rows(Model& model, const JointModel& joint, Row c, Row count, BatchColumns& made) {
    auto& subs = model.sub_contacts;
    const Batch rows{&joint, model.contacts.properties[c], model.contacts.sub_contacts[c].first, count, {c}};
    if (!joint.missing(model.joint_properties[static_cast<std::size_t>(rows.properties)].values).empty()) return;
    for (Row s = rows.first; s < rows.first + count; ++s) {
        subs.normal_displacement_increment[s] = 0;
        subs.shear_displacement_increment.set(s, Vec3::Zero());
    }
    auto columns = columns_of(model, rows, model.clock.time_step, made);
    if (const auto failure = initialise_batch(joint, columns, subs.number.data() + rows.first))
        throw joint_failure(model, rows, *failure);
}

Diagnostic joint_failure(const Model& model, const Batch& batch, const BatchFailure& failure) {
    const Row row = batch.first + static_cast<Row>(failure.row);
    const auto& s = model.sub_contacts;
    const Row contact = s.contact[row];
    const auto& properties = model.joint_properties[batch.properties];
    const Vec3 x = s.position[row];
    Diagnostic d(fmt::format("joint model '{}' failed: {}", batch.model->name, failure.message),
                 failure.trespass ? "results since the start of the run may be wrong; correct its source: " +
                                        batch.model->file.string()
                                  : "look at the model's properties and at how fast the joint is loaded",
                 Fault::run);
    d.code = failure.trespass ? "joint-model-trespass" : "joint-model-failed";
    d.add(fmt::format("sub-contact {} of contact {} between blocks {} and {}, at {}", s.number[row],
                      model.contacts.number[contact], model.blocks.number[model.contacts.block1[contact]],
                      model.blocks.number[model.contacts.block2[contact]], place_text(x)));
    d.add(fmt::format("area {:.6g}, normal force {:.6g}, normal displacement {:.6g} (this step {:.6g})", s.area[row],
                      s.normal_force[row], s.normal_displacement[row], s.normal_displacement_increment[row]));
    if (!properties.place.empty()) d.add("properties given at " + properties.place);
    return d;
}

} // namespace kaya
