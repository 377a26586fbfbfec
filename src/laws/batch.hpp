// Calls a joint model over a batch, with a guard around it.
#pragma once

#include "laws/guard.hpp"
#include "laws/joint_model.hpp"

#include <optional>
#include <string>

namespace kaya {

/// A row that failed, counted from the start of the batch, and the model's own sentence.
struct BatchFailure {
    std::size_t row;
    std::string message;
    bool trespass = false; ///< it wrote where it must not
};

/// Runs one step. Catches exceptions of the model, and checks for forces, stiffnesses and history values that are not finite and for
/// stiffnesses below 0; nullopt when none is found. Allocates memory only on failure. The columns of a failed batch hold what the model
/// wrote. `numbers` are those of the rows that users see, for the report of a crash; NULL: the report has rows.
std::optional<BatchFailure> run_batch(const JointModel& model, kaya_jbatch& batch,
                                      const std::int32_t* numbers = nullptr, Guard guard = Guard::all);

/// The first row with a value that is not finite or must not be negative.
std::optional<BatchFailure> unusable_output(const JointModel& model, const kaya_jbatch& batch,
                                            Guard guard = Guard::all);

/// The same for `initialise`, fenced.
std::optional<BatchFailure> initialise_batch(const JointModel& model, kaya_jbatch& batch,
                                             const std::int32_t* numbers = nullptr);

} // namespace kaya
