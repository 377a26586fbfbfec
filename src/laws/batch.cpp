#include "laws/batch.hpp"

#include "laws/arithmetic.hpp"
#include "laws/crash_report.hpp"
#include "laws/trespass.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <exception>
#include <fmt/format.h>
#include <iterator>
#include <utility>

namespace kaya {

namespace {

struct Output {
    const char* quantity;
    const double* column;
    bool may_be_negative;
};

/// All bits of the exponent set: infinite, and more: not a number. Integer arithmetic, so that the loop
/// becomes vector instructions without reordering floating-point sums.
constexpr std::uint64_t exponent = 0x7ff0'0000'0000'0000;
constexpr std::uint64_t sign = 0x8000'0000'0000'0000;

bool all_usable(const double* __restrict column, std::size_t n, bool may_be_negative) {
    // The strictest check without a branch: as integers without their sign, the bits of finite numbers are below the exponent. Where it
    // must not be negative the sign makes them larger than that (the exact test, which accepts -0, is made on a hit only).
    std::uint64_t largest = 0;
    if (may_be_negative)
        for (std::size_t i = 0; i < n; ++i)
            largest = std::max(largest, std::bit_cast<std::uint64_t>(column[i]) & ~sign);
    else
        for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::bit_cast<std::uint64_t>(column[i]));
    return largest < exponent;
}

std::optional<BatchFailure> unusable_row(const JointModel& model, const Output& output, std::size_t n) {
    if (all_usable(output.column, n, output.may_be_negative)) return std::nullopt;
    for (std::size_t i = 0; i < n; ++i) {
        const double value = output.column[i];
        if (std::isfinite(value) && (output.may_be_negative || value >= 0)) continue;
        return BatchFailure{i, fmt::format("joint model {} returned {} {}", model.name, output.quantity, value)};
    }
    return std::nullopt;
}

BatchFailure thrown_failure(const JointModel& model, const char* what) {
    return {
        0, fmt::format("joint model {} threw an exception in a batch that begins with this row: {}", model.name, what)};
}

/// Checksums of read-only inputs of a model. In a cycle only the properties are checked, which all batches share; the columns are checked
/// when the model is tried and when it initialises.
class ReadOnly {
public:
    ReadOnly(const JointModel& model, const kaya_jbatch& batch, Guard guard) : columns_(guard == Guard::all) {
        each(model, batch, [this](std::size_t k, const char*, std::uint64_t sum) {
            sums_[k] = sum;
            return false;
        });
    }
    /// The name of the first changed input, or NULL.
    const char* changed(const JointModel& model, const kaya_jbatch& batch) const {
        const char* name = nullptr;
        each(model, batch, [&](std::size_t k, const char* of, std::uint64_t sum) {
            if (sums_[k] != sum) name = of;
            return name != nullptr;
        });
        return name;
    }

private:
    /// Until visit() returns false.
    template <class Visit> void each(const JointModel& model, const kaya_jbatch& b, Visit visit) const {
        if (visit(0, "properties", sum_of_bits(b.properties, model.properties.size())) || !columns_) return;
        const std::pair<const char*, const double*> columns[] = {
            {"area", b.area},
            {"normal_disp", b.normal_disp},
            {"normal_disp_inc", b.normal_disp_inc},
            {"shear_disp", b.shear_disp[0]},
            {"shear_disp", b.shear_disp[1]},
            {"shear_disp", b.shear_disp[2]},
            {"shear_disp_inc", b.shear_disp_inc[0]},
            {"shear_disp_inc", b.shear_disp_inc[1]},
            {"shear_disp_inc", b.shear_disp_inc[2]},
            {"pore_pressure", b.pore_pressure},
        };
        static_assert(std::size(columns) + 1 == count);
        for (std::size_t k = 0; k < std::size(columns); ++k)
            if (visit(k + 1, columns[k].first, sum_of_bits(columns[k].second, b.n))) return;
    }

    static constexpr std::size_t count = 11;
    bool columns_;
    std::uint64_t sums_[count] = {};
};

std::optional<BatchFailure> call(const JointModel& model, const std::function<ptrdiff_t(kaya_jbatch*)>& function,
                                 kaya_jbatch& batch, const std::int32_t* numbers, const char* what, Guard guard) {
    batch.message[0] = '\0';
    if (model.keeps_objects() && batch.object == nullptr)
        return BatchFailure{
            0, fmt::format("joint model {} stores objects, and this batch has no column for them", model.name)};
    batch.row = batch.n; // a model that works row by row reports its row
    ptrdiff_t row = -1;
    const AtWork at_work(model.who(), what, {.rows = batch.n, .row = &batch.row, .numbers = numbers});
    ArithmeticGuard arithmetic; // also restores after an exception
    const ReadOnly read_only(model, batch, guard);
    try {
        row = function(&batch);
    } catch (const std::exception& thrown) { return thrown_failure(model, thrown.what()); } catch (...) {
        return thrown_failure(model, "not a std::exception");
    }
    model.note_arithmetic(arithmetic.put_back());
    if (const char* changed = read_only.changed(model, batch))
        return BatchFailure{0, fmt::format("joint model {} wrote to '{}', which it may only read", model.name, changed),
                            true};
    if (row == -1) return unusable_output(model, batch, guard);
    if (row < 0 || static_cast<std::size_t>(row) >= batch.n)
        return BatchFailure{0, fmt::format("joint model {} returned row {} of a batch of {} rows, which begins with "
                                           "this row",
                                           model.name, row, batch.n)};
    const std::string_view message(batch.message, strnlen(batch.message, KAYA_JMODEL_MESSAGE));
    return BatchFailure{static_cast<std::size_t>(row), fmt::format("joint model {} failed: {}", model.name,
                                                                   message.empty() ? "it gives no reason" : message)};
}

} // namespace

std::optional<BatchFailure> unusable_output(const JointModel& model, const kaya_jbatch& batch, Guard guard) {
    const Output forces[] = {
        {"normal force", batch.normal_force, true},       {"shear force x", batch.shear_force[0], true},
        {"shear force y", batch.shear_force[1], true},    {"shear force z", batch.shear_force[2], true},
        {"frictional work", batch.frictional_work, true},
    };
    const Output stiffnesses[] = {
        {"normal stiffness", batch.normal_stiffness, false},
        {"shear stiffness", batch.shear_stiffness, false},
    };
    if (guard == Guard::all)
        for (const auto& output : forces)
            if (auto failure = unusable_row(model, output, batch.n)) return failure;
    if (guard == Guard::all || batch.stiffness_changed)
        for (const auto& output : stiffnesses)
            if (auto failure = unusable_row(model, output, batch.n)) return failure;
    for (std::size_t k = 0; k < model.history.size(); ++k)
        if (auto failure = unusable_row(model, {model.history[k].name.c_str(), batch.history[k], true}, batch.n))
            return failure;
    return std::nullopt;
}

std::optional<BatchFailure> run_batch(const JointModel& model, kaya_jbatch& batch, const std::int32_t* numbers,
                                      Guard guard) {
    return call(model, model.functions().run, batch, numbers, "run", guard);
}

std::optional<BatchFailure> initialise_batch(const JointModel& model, kaya_jbatch& batch, const std::int32_t* numbers) {
    return call(model, model.functions().initialise, batch, numbers, "initialise", Guard::all);
}

} // namespace kaya
