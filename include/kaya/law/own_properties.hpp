// SPDX-License-Identifier: MIT
// Properties that differ from one sub-contact to the next, for a law that computes constants from its properties.
#pragma once

#include "kaya/jmodel.h"

#include <cstddef>
#include <cstdio>

namespace kaya::joints {

/// The rows [first, first + count) of a batch. The pointers to histories and fields are in `history` and `field`.
inline kaya_jbatch rows_of(const kaya_jbatch& all, std::size_t first, std::size_t count, std::size_t history_count,
                           double** history, std::size_t field_count, const double** field) {
    kaya_jbatch rows = all;
    const auto shift = [first](auto*& column) {
        if (column != nullptr) column += first;
    };
    rows.n = count;
    shift(rows.area), shift(rows.normal_disp), shift(rows.normal_disp_inc), shift(rows.pore_pressure),
        shift(rows.normal_force);
    shift(rows.normal_stiffness), shift(rows.shear_stiffness), shift(rows.frictional_work), shift(rows.state),
        shift(rows.object);
    for (int k = 0; k < 3; ++k) {
        shift(rows.shear_disp[k]), shift(rows.shear_disp_inc[k]), shift(rows.shear_force[k]);
        shift(rows.position[k]), shift(rows.normal[k]);
    }
    for (auto*& block : rows.block) shift(block);
    for (std::size_t k = 0; k < history_count; ++k) history[k] = all.history[k] + first;
    for (std::size_t k = 0; k < field_count; ++k) field[k] = all.field[k] + first;
    rows.history = history;
    rows.field = field;
    return rows;
}

/// Calls run(batch) with the rows that share the properties of the batch, and separately for each row with its own properties. Field k of
/// the law has the name of property `property_of_field[k]`. `check` is the check of the law: its message about the values of a row is the
/// failure of that row. Without columns of fields all rows share the properties.
template <std::size_t property_count, std::size_t history_count, std::size_t field_count, class Check, class Run>
ptrdiff_t by_properties(kaya_jbatch* batch, const std::size_t (&property_of_field)[field_count], Check check, Run run) {
    if (batch->field == nullptr) return run(batch);
    const auto is_own = [](double own, double common) { return own != common && (own == own || common == common); };
    bool any = false; // column by column without an early exit, so that these are vector loops
    for (std::size_t k = 0; k < field_count; ++k) {
        const double* column = batch->field[k];
        const double common = batch->properties[property_of_field[k]];
        for (std::size_t i = 0; i < batch->n; ++i) any |= is_own(column[i], common);
    }
    if (!any) return run(batch);
    const auto differs = [&](std::size_t i) {
        for (std::size_t k = 0; k < field_count; ++k)
            if (is_own(batch->field[k][i], batch->properties[property_of_field[k]])) return true;
        return false;
    };
    double values[property_count];
    double* history[history_count];
    const double* field[field_count];
    for (std::size_t first = 0, end = 0; first < batch->n; first = end) {
        const bool own = differs(first);
        end = first + 1;
        while (!own && end < batch->n && !differs(end)) ++end;
        kaya_jbatch rows = rows_of(*batch, first, end - first, history_count, history, field_count, field);
        if (own) {
            for (std::size_t p = 0; p < property_count; ++p) values[p] = batch->properties[p];
            for (std::size_t k = 0; k < field_count; ++k) values[property_of_field[k]] = batch->field[k][first];
            rows.properties = values;
            if (const char* complaint = check(values)) {
                std::snprintf(batch->message, sizeof batch->message, "%s", complaint);
                return static_cast<ptrdiff_t>(first);
            }
        }
        const ptrdiff_t failed = run(&rows);
        batch->stiffness_changed = batch->stiffness_changed || rows.stiffness_changed;
        if (failed < 0) continue;
        std::snprintf(batch->message, sizeof batch->message, "%s", rows.message);
        return static_cast<ptrdiff_t>(first) + failed;
    }
    return -1;
}

} // namespace kaya::joints
