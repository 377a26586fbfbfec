// Recorded quantities.
#pragma once

#include "base/id.hpp"
#include "base/object_kind.hpp"
#include "model/tables/column.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace kaya {

/// The source of a history: a named quantity of the row nearest to a place, of the whole model, or a function of the deck.
struct HistorySource {
    using Kind = ObjectKind;
    Kind kind = Kind::global; ///< one that KindInfo::history numbers
    std::string quantity;     ///< field name ("shear_stress", "unbalanced_force") or function name
    Vec3 place = Vec3::Zero();
    Row row = no_row; ///< set when the history is created, and again when that row was deleted

    // How the row is found again after tables were compacted (model/fields/sampling.hpp).
    std::uint32_t slot = 0;       ///< id of the sub-contact or block, or of the block that the row belongs to
    std::uint32_t generation = 0; ///< 0: not located yet
    Row offset = 0;               ///< of a gridpoint or zone from the first one of its block
    Row rows_of_block = 0;        ///< gridpoints or zones of that block then; other when it was zoned since

    bool rate = false; ///< records the change of the quantity in the last step, over the step
    double last = 0;   ///< of a rate: the quantity one step ago
};

struct History {
    std::int32_t number = 0; ///< counts from 1
    std::string label;       ///< `hist label`, or a name made from the source
    HistorySource source;
    std::vector<double> values;   ///< one per sample, in step with Histories::time of the same rows
    std::size_t first_sample = 0; ///< samples taken before this history was created
};

struct Histories {
    std::vector<History> all;
    std::vector<double> time;        ///< model time of each sample
    std::vector<std::int64_t> cycle; ///< cycle of each sample
    std::int32_t interval = 10;      ///< cycles between samples (`hist ncyc`)
};

} // namespace kaya
