// Runs of sub-contacts that one call of a joint model can take.
#pragma once

#include "base/diagnostic.hpp"
#include "laws/batch.hpp"
#include "model/tables/model.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace kaya {

/// Consecutive sub-contacts that share a property set.
struct Batch {
    const JointModel* model;
    Row properties;
    Row first, count;          ///< rows of sub-contacts
    std::vector<Row> contacts; ///< in the order of their rows
    bool curved = false;       ///< a stiffness of its joint model depends on the closure
};

/// All batches, in row order; columns for the history of their models are allocated. A batch holds whole contacts and, if it holds several,
/// at most `most` rows, so that its data stays in the cache during a cycle.
std::vector<Batch> make_batches(Model& model, JointRegistry& joints, Row most = 1024);

/// Columns of a batch beyond those of the model; the memory is reused for the next batch.
struct BatchColumns {
    std::array<double*, KAYA_JMODEL_MAX_HISTORY> history;
    std::array<std::vector<double>, KAYA_JMODEL_MAX_FIELDS> fields;
    std::array<const double*, KAYA_JMODEL_MAX_FIELDS> field;
    std::array<std::optional<double>, KAYA_JMODEL_MAX_FIELDS> alike; ///< set when all rows of the field have this value
    std::array<std::vector<double>, 3> normal;
    std::array<std::vector<std::int32_t>, 2> block;
};

/// The columns of rows [first, first + count) as a joint model sees them; valid until `made` is reused or destroyed.
kaya_jbatch columns_of(Model& model, const Batch& batch, double time_step, BatchColumns& made);

/// Lets the joint model of a contact make the history of its first rows agree with their forces and gaps, if it has all its properties.
/// `made` is memory. Throws Diagnostic when it fails.
void initialise_rows(Model& model, const JointModel& joint, Row contact, Row count, BatchColumns& made);

/// Reports a joint model's error at a row, with the contact's number, its blocks, place, cycle and the deck line of its properties.
Diagnostic joint_failure(const Model& model, const Batch& batch, const BatchFailure& failure);

} // namespace kaya
