// Runs of sub-contacts that one call of a joint model can take.
#pragma once

#include "base/diagnostic.hpp"
#include "laws/batch.hpp"
#include "model/model.hpp"

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

/// The columns of rows [first, first + count) as a joint model sees them.
/// `history` must have room for the model's history pointers and live as long as the batch is used.
kaya_jbatch columns_of(Model& model, const Batch& batch, double time_step, double** history);

/// What a joint model said about a row, with the contact's number, its blocks, place, cycle and the deck
/// line of its properties.
Diagnostic joint_failure(const Model& model, const Batch& batch, const BatchFailure& failure);

} // namespace kaya
