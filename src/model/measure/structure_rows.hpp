// Which rows of structures, and which blocks, belong together.
#pragma once

#include "model/tables/model.hpp"

#include <cstdint>

namespace kaya {

/// The row of the containing block; no_row outside the rock.
Row rock_block(const Model& model, const RockPoints& points, Row row);

/// The number of rows inside the rock.
std::int32_t nodes_in_rock(const Model& model, const RockPoints& points, const Span& nodes);

/// Whether the block that it was placed in is still there, with the shape that it had then.
bool is_placed(const Model& model, const RockPoints& points, Row row);

/// The row of the block that contains a node; no_row outside the rock.
Row block_of_node(const Model& model, Row node);

/// The row of a cable's node, counted from its first; no_row when there is none.
Row node_of_cable(const Model& model, std::int32_t number, Row offset);

/// Whether it has a bar to the next node; the last one of a cable has none.
bool has_bar(const CableNodes& nodes, Row node);

/// The row of a member by its number; no_row when there is none.
Row member_of_number(const Model& model, std::int32_t number);

} // namespace kaya
