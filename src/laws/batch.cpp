#include "laws/batch.hpp"

#include "laws/arithmetic.hpp"
#include "laws/trespass.hpp"
#include "system/crash_report.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <exception>
#include <fmt/format.h>

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

std::optional<BatchFailure> call(const JointModel& model, const std::function<ptrdiff_t(kaya_jbatch*)>& function,
                                 kaya_jbatch& batch, const std::int32_t* numbers, const char* what, Guard guard) {
    batch.message[0] = '\0';
    if (model.keeps_objects() && batch.object == nullptr)
        return BatchFailure{
            0, fmt::format("joint model {} stores objects, and this batch has no column for them", model.name)};
    const bool fenced = guard == Guard::fenced && model.who()->foreign;
    static thread_local FencedBatch<kaya_jbatch> fences; // threads call laws at the same time
    if (fenced) fences.take(model, batch);
    batch.row = batch.n; // a model that works row by row reports its row
    const kaya_jbatch before = batch;
    const std::uint64_t values = sum_of_bits(batch.properties, model.properties.size());
    ptrdiff_t row = -1;
    std::optional<BatchFailure> failure;
    std::optional<Trespass> trespass;
    {
        const AtWork at_work(model.who(), what, {.rows = batch.n, .row = &batch.row, .numbers = numbers});
        ArithmeticGuard arithmetic; // also restores after an exception
        try {
            row = function(&batch);
        } catch (const std::exception& thrown) { failure = thrown_failure(model, thrown.what()); } catch (...) {
            failure = thrown_failure(model, "not a std::exception");
        }
        model.note_arithmetic(arithmetic.put_back());
    }
    if (is_other_batch(before, batch)) {
        trespass = {"wrote to the table of its columns", 0};
        batch = before;
    }
    if (sum_of_bits(batch.properties, model.properties.size()) != values)
        trespass = {"wrote to 'properties', which it may only read", 0};
    if (fenced) {
        if (!trespass) trespass = fences.trespass();
        fences.give(batch);
    }
    if (trespass)
        return BatchFailure{trespass->row, fmt::format("joint model {} {}", model.name, trespass->what), true};
    if (failure) return failure;
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
    if (guard != Guard::in_cycle)
        for (const auto& output : forces)
            if (auto failure = unusable_row(model, output, batch.n)) return failure;
    if (guard != Guard::in_cycle || batch.stiffness_changed)
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
    return call(model, model.functions().initialise, batch, numbers, "initialise", Guard::fenced);
}

} // namespace kaya
