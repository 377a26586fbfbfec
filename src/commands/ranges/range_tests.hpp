// Tests of single range elements; ranges.cpp puts them together. Private to src/commands.
#pragma once

#include "commands/ranges/ranges.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace kaya {

/// Context for turning an element into a test.
struct RangeContext {
    const Model& model;
    const NamedRanges& named;
    ObjectKind kind;
    double tolerance;
    RangeExtras extras;
    bool whole = false;            ///< all corners of an object must lie inside
    std::vector<std::string> open; ///< named ranges being expanded, to detect cycles
};

inline bool is_contact(ObjectKind kind) { return kind == ObjectKind::contact || kind == ObjectKind::sub_contact; }

inline Row contact_of(const Model& model, ObjectKind kind, Row row) {
    return kind == ObjectKind::sub_contact ? model.sub_contacts.contact[row] : row;
}

/// True when the block, or one of the two blocks of a contact, passes; or both of them.
template <class Passes> RangeTest on_blocks(Passes passes, bool both = false) {
    return [passes, both](const Model& model, ObjectKind kind, Row row) {
        if (!is_contact(kind)) {
            const Row block = block_of(model, kind, row);
            return block != no_row && passes(model, block);
        }
        const Row contact = contact_of(model, kind, row);
        const bool one = passes(model, model.contacts.block1[contact]);
        const bool two = passes(model, model.contacts.block2[contact]);
        return both ? one && two : one || two;
    };
}

/// Calls `passes` with the corners of an object until one does not pass. Objects without corners use their place.
template <class Passes> bool all_corners(const Model& model, ObjectKind kind, Row row, Passes passes) {
    const auto& position = model.gridpoints.position;
    const auto all = [&](const auto& rows) {
        return std::ranges::all_of(rows, [&](Row g) { return passes(position[g]); });
    };
    switch (kind) {
    case ObjectKind::block: {
        const Span span = model.blocks.gridpoints[row];
        return std::all_of(&position[span.first], &position[span.first] + span.count, passes);
    }
    case ObjectKind::zone: return all(model.zones.gridpoints[row]);
    case ObjectKind::triangle: return all(model.triangles.gridpoints[row]);
    case ObjectKind::face: {
        const Span span = model.faces.triangles[row];
        for (Row t = span.first; t < span.end(); ++t)
            if (!all(model.triangles.gridpoints[t])) return false;
        return true;
    }
    case ObjectKind::contact: {
        const Span span = model.contacts.sub_contacts[row];
        for (Row s = span.first; s < span.end(); ++s)
            if (!passes(model.sub_contacts.position[s])) return false;
        return true;
    }
    default: return passes(reference_point(model, kind, row));
    }
}

/// A test of the place of an object, or of all its corners.
template <class Passes> RangeTest on_place(const RangeContext& context, Passes passes) {
    if (context.whole)
        return [passes](const Model& model, ObjectKind kind, Row row) { return all_corners(model, kind, row, passes); };
    return [passes](const Model& model, ObjectKind kind, Row row) { return passes(reference_point(model, kind, row)); };
}

/// Throws when the command does not act on contacts or sub-contacts.
void needs_contacts(const lang::RangeElement& e, const RangeContext& context, const char* word, const char* hint = "");

/// The test of a kind of element. range_shapes.cpp has the spatial ones, range_blocks.cpp those of blocks, bodies and joints,
/// range_fractures.cpp those of fractures, ranges.cpp the others.
struct RangeEntry {
    lang::RangeElement::Kind kind;
    RangeTest (*test)(const lang::RangeElement& e, RangeContext& context);
};
std::span<const RangeEntry> tests_of_places(); ///< these need only a place
std::span<const RangeEntry> tests_of_faces();  ///< orientation
std::span<const RangeEntry> tests_of_blocks();
std::span<const RangeEntry> tests_of_fractures();

} // namespace kaya
