#include "laws/lone_row.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <vector>

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

namespace {

/// A number that no model computes.
constexpr std::uint64_t fence = 0x7ff4'6b61'7961'2121;
constexpr std::size_t width = 64; ///< of a fence, in numbers: beyond what a loop that is off by a lane writes

/// The columns of one row, each between two fences. It is kept for its memory.
class FencedRow {
public:
    FencedRow() : cells_((most + 1) * (width + 1), fence) {}

    /// Points the batch at the fenced columns, which get what its own hold.
    void take(const JointModel& model, kaya_jbatch& batch) {
        count_ = 0;
        own_ = batch;
        // What is read is copied, too: a model may write to that.
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

    /// Gives the columns of the batch what the fenced ones hold, and the batch its columns.
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

    /// The first column next to which something was written; the fences are whole again then.
    std::optional<std::string> breach() {
        std::optional<std::string> found;
        for (std::size_t k = 0; k < count_ && !found; ++k) {
            const std::uint64_t* cell = cells_.data() + cell_of(k);
            std::uint64_t tail = 0; // of a column whose numbers are shorter
            std::memcpy(&tail, cell, sizeof tail);
            const bool short_one = sizes_[k] < sizeof tail;
            if (short_one && tail >> 32 != fence >> 32) found = fmt::format("after the column '{}'", names_[k]);
            if (!is_whole(cell + 1)) found = fmt::format("after the column '{}'", names_[k]);
            if (k == 0 && !is_whole(cell - width)) found = fmt::format("before the column '{}'", names_[k]);
        }
        if (found) std::fill(cells_.begin(), cells_.end(), fence);
        return found;
    }

private:
    static constexpr std::size_t most = 32 + KAYA_JMODEL_MAX_HISTORY;
    static std::size_t cell_of(std::size_t k) { return width + k * (width + 1); }
    static bool is_whole(const std::uint64_t* first) {
        std::uint64_t others = 0; // all of them, so that it is a vector loop
        for (std::size_t i = 0; i < width; ++i) others |= first[i] ^ fence;
        return others == 0;
    }

    template <class T> void add(const char* name, T*& column) {
        std::uint64_t* cell = cells_.data() + cell_of(count_);
        *cell = fence;
        std::memcpy(cell, column, sizeof(T));
        column = reinterpret_cast<T*>(cell);
        names_[count_] = name;
        sizes_[count_++] = sizeof(T);
    }

    std::vector<std::uint64_t> cells_;
    std::array<double*, KAYA_JMODEL_MAX_HISTORY> history_{};
    std::array<const char*, most> names_{};
    std::array<std::size_t, most> sizes_{};
    std::size_t count_ = 0;
    kaya_jbatch own_{};
};

template <class Call> std::optional<BatchFailure> call_fenced(const JointModel& model, kaya_jbatch& batch, Call call) {
    static thread_local FencedRow row;
    row.take(model, batch);
    auto failure = call(model, batch);
    const auto breach = row.breach();
    row.give(model, batch);
    if (breach)
        return BatchFailure{
            0,
            fmt::format("joint model {} wrote {}, where nothing of its own is: it takes more rows or more history "
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
