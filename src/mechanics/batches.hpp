// Runs of sub-contacts that one call of a joint model can take.
#pragma once

#include "base/diagnostic.hpp"
#include "laws/batch.hpp"
#include "model/model.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace kaya {

/// Sub-contacts one after the other that share a property set.
struct Batch {
    const JointModel* model;
    Row properties;
    Row first, count;          ///< rows of sub-contacts
    std::vector<Row> contacts; ///< in the order of their rows
};

/// All batches, in row order; what their models keep of each sub-contact gets its columns. One has whole contacts
/// and, if it has several, at most `most` rows: few
/// enough that what a cycle reads and writes of them stays near the processor.
std::vector<Batch> make_batches(Model& model, JointRegistry& joints, Row most = 1024);

/// What the columns of a batch need besides those of the model. It keeps its memory for the next batch.
struct BatchColumns {
    std::array<double*, KAYA_JMODEL_MAX_HISTORY> history;
    std::array<std::vector<double>, KAYA_JMODEL_MAX_FIELDS> fields;
    std::array<const double*, KAYA_JMODEL_MAX_FIELDS> field;
    std::array<std::optional<double>, KAYA_JMODEL_MAX_FIELDS> alike; ///< the value of all rows of a field
    std::array<std::vector<double>, 3> normal;
    std::array<std::vector<std::int32_t>, 2> block;
};

/// The columns of rows [first, first + count) as a joint model sees them, until `made` serves another batch or goes.
kaya_jbatch columns_of(Model& model, const Batch& batch, double time_step, BatchColumns& made);

/// What a joint model said about a row, with the contact's number, its blocks, place, cycle and the deck
/// line of its properties.
Diagnostic joint_failure(const Model& model, const Batch& batch, const BatchFailure& failure);

} // namespace kaya
