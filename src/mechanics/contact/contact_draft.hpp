// What a search plans for the contact tables.
#pragma once

#include "mechanics/contact/contact_plane.hpp"

#include <cstdint>
#include <span>

namespace kaya {

enum class DraftKind : std::uint8_t {
    as_it_was,
    new_geometry,
    overlap ///< of rigid blocks: new, or a former joint between them
};

/// A future row of the contact table.
struct ContactDraft {
    Row block1, block2;
    Row old = no_row; ///< the present contact of the same blocks
    DraftKind kind = DraftKind::as_it_was;
    ContactPlane plane;                     ///< when it is new
    std::span<const ContactPoint> points{}; ///< in this case too; owned by the caller
};

/// How the contact tables have changed.
enum class ContactChange { none, refreshed, replaced };

} // namespace kaya
