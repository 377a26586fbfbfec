// Sub-contacts that an update of the contact tables has changed, and that their joint models do not know of yet.
#pragma once

#include <cstddef>
#include <vector>

namespace kaya {

/// Marks by row.
struct ChangedRows {
    std::vector<char> fresh; ///< that were not there before
    std::vector<char> given; ///< whose forces the update has set: their history is that of another place
    std::vector<char> moved; ///< with a normal displacement increment that they have not seen

    explicit ChangedRows(std::size_t rows) : fresh(rows, 0), given(rows, 0), moved(rows, 0) {}
};

} // namespace kaya
