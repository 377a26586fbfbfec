// The rows that a range phrase picks.
#pragma once

#include "model/model.hpp"

#include <functional>
#include <vector>

namespace kaya {

/// What kind of object a command acts on; it decides which point of the object is tested:
/// centroid of blocks, zones and faces, position of gridpoints and contacts.
enum class ObjectKind { block, gridpoint, face, triangle, zone, contact, sub_contact, cable_node };

/// One test of a range, made by src/commands from the phrase in the deck. Ands and ors are folded in.
using RangeTest = std::function<bool(const Model&, ObjectKind, Row)>;

/// Rows of that kind on visible blocks (contacts: of which both blocks are visible) that pass.
/// An empty test passes all. Ascending rows.
std::vector<Row> select(const Model& model, ObjectKind kind, const RangeTest& test, bool hidden_too = false);

/// How many objects of that kind there are.
std::size_t count_of(const Model& model, ObjectKind kind);

/// The point that is tested.
Vec3 reference_point(const Model& model, ObjectKind kind, Row row);

/// The block that the object belongs to; of a contact its block1; no_row of a cable node outside of the rock.
Row block_of(const Model& model, ObjectKind kind, Row row);

/// Diagonal of the box around all gridpoints, at least 1e-30; tolerances are fractions of it.
double model_size(const Model& model);

} // namespace kaya
