#include "laws/lone_row.hpp"

#include "laws/trespass.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace kaya {

void LoneColumns::add_to(kaya_jbatch& batch, const JointModel& model) {
    for (std::size_t k = 0; k < model.fields.size(); ++k) {
        const auto& f = model.fields[k];
        field[k] = f.property ? batch.properties[*f.property] : f.initial;
        fields[k] = &field[k];
    }
    if (!model.fields.empty()) batch.field = fields.data();
    if (!model.needs_place()) return;
    for (std::size_t k = 0; k < 3; ++k) batch.position[k] = &position[k], batch.normal[k] = &normal[k];
    for (std::size_t k = 0; k < 2; ++k) batch.block[k] = &block[k];
}

kaya_jbatch LoneRow::batch(const JointModel& model, const std::vector<double>& values, double time_step,
                           LoneColumns& others) {
    for (std::size_t k = 0; k < history.size(); ++k) others.history[k] = &history[k];
    kaya_jbatch b{};
    b.n = 1;
    b.properties = values.data();
    b.time_step = time_step;
    b.area = &area;
    b.normal_disp = &normal_disp;
    b.normal_disp_inc = &normal_disp_inc;
    for (std::size_t k = 0; k < 3; ++k) {
        b.shear_disp[k] = &shear_disp[k];
        b.shear_disp_inc[k] = &shear_disp_inc[k];
        b.shear_force[k] = &shear_force[k];
    }
    b.pore_pressure = &pore_pressure;
    b.normal_force = &normal_force;
    b.normal_stiffness = &normal_stiffness;
    b.shear_stiffness = &shear_stiffness;
    b.frictional_work = &frictional_work;
    b.state = &state;
    b.history = others.history.data();
    b.object = model.keeps_objects() ? object.address() : nullptr;
    b.tables = model.tables;
    others.add_to(b, model);
    return b;
}

namespace {

/// The columns of one row, each between two fences. Reused to save allocations.
class FencedRow {
public:
    /// Points the batch at the fenced columns, which receive copies of its columns.
    void take(const JointModel& model, kaya_jbatch& batch) {
        fences_.clear();
        own_ = batch;
        // Inputs are copied, too: a model may write to them.
        add("area", batch.area);
        add("normal_disp", batch.normal_disp);
        add("normal_disp_inc", batch.normal_disp_inc);
        for (auto*& column : batch.shear_disp) add("shear_disp", column);
        for (auto*& column : batch.shear_disp_inc) add("shear_disp_inc", column);
        add("pore_pressure", batch.pore_pressure);
        add("normal_force", batch.normal_force);
        for (auto*& column : batch.shear_force) add("shear_force", column);
        add("normal_stiffness", batch.normal_stiffness);
        add("shear_stiffness", batch.shear_stiffness);
        add("frictional_work", batch.frictional_work);
        add("state", batch.state);
        for (std::size_t k = 0; k < model.history.size(); ++k) {
            history_[k] = batch.history[k];
            add(model.history[k].name.c_str(), history_[k]);
        }
        batch.history = history_.data();
        if (batch.object != nullptr) add("object", batch.object);
    }

    /// Copies the fenced columns to the columns of the batch, and points the batch at its columns again.
    void give(const JointModel& model, kaya_jbatch& batch) {
        const auto back = [](auto* to, const auto* from) { std::memcpy(to, from, sizeof *to); };
        back(own_.normal_force, batch.normal_force);
        for (int k = 0; k < 3; ++k) back(own_.shear_force[k], batch.shear_force[k]);
        back(own_.normal_stiffness, batch.normal_stiffness);
        back(own_.shear_stiffness, batch.shear_stiffness);
        back(own_.frictional_work, batch.frictional_work);
        back(own_.state, batch.state);
        for (std::size_t k = 0; k < model.history.size(); ++k) back(own_.history[k], history_[k]);
        if (own_.object != nullptr) *own_.object = *batch.object;
        own_.stiffness_changed = batch.stiffness_changed;
        own_.row = batch.row;
        std::memcpy(own_.message, batch.message, sizeof own_.message);
        batch = own_;
    }

    std::optional<std::string> breach() { return fences_.breach(); }

private:
    template <class T> void add(const char* name, T*& column) { fences_.add(name, column); }

    Fences<32 + KAYA_JMODEL_MAX_HISTORY> fences_;
    std::array<double*, KAYA_JMODEL_MAX_HISTORY> history_{};
    kaya_jbatch own_{};
};

template <class Call> std::optional<BatchFailure> call_fenced(const JointModel& model, kaya_jbatch& batch, Call call) {
    static thread_local FencedRow row; // threads call laws at the same time, each between its own fences
    row.take(model, batch);
    auto failure = call(model, batch);
    const auto breach = row.breach();
    row.give(model, batch);
    if (breach)
        return BatchFailure{
            0,
            fmt::format("joint model {} wrote {}, outside of its data: it takes more rows or more history "
                        "variables than there are",
                        model.name, *breach),
            true};
    return failure;
}

} // namespace

std::optional<BatchFailure> run_fenced(const JointModel& model, kaya_jbatch& batch) {
    return call_fenced(model, batch, [](const JointModel& joint, kaya_jbatch& b) { return run_batch(joint, b); });
}

std::optional<BatchFailure> initialise_fenced(const JointModel& model, kaya_jbatch& batch) {
    return call_fenced(model, batch,
                       [](const JointModel& joint, kaya_jbatch& b) { return initialise_batch(joint, b); });
}

} // namespace kaya
