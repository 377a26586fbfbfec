// Samples of histories.
#pragma once

#include "model/tables/history.hpp"
#include "model/tables/model.hpp"

#include <functional>
#include <optional>
#include <string>

namespace kaya {

struct Field;

/// The field that a history samples; null for a function of the deck. Throws Diagnostic when the
/// quantity is not one of that kind of object.
const Field* sampled_field(const HistorySource& source);
/// The unit of its values, in words; "-" of functions and of values of a joint model, which have that of its table.
std::string unit_of(const HistorySource& source);

/// Finds the row nearest to the source's place: gridpoint or vertex, zone by its centroid, sub-contact
/// by its position, block by its centroid; on hidden blocks too. Of two at the same distance the one
/// with the lower row. Throws Diagnostic when the model has none of that kind.
void locate(const Model& model, HistorySource& source);

/// Adds a history with the next number and locates it. Its first sample is the next one taken. An empty label becomes the name of the
/// quantity.
History& add_history(Model& model, HistorySource source, std::string label = {});

/// The recorded object, for lists and messages; none for the whole model, a function, and a deleted object.
struct SampledObject {
    std::string name;    ///< "gridpoint 5"
    Vec3 place;          ///< where it is now
    double distance = 0; ///< from there to the place that the history names
    bool far = false;    ///< the place is outside of its block by more than the size of the block
};
std::optional<SampledObject> sampled_object(const Model& model, const HistorySource& source);

/// Whether the next call of sample_histories reads zones.
bool samples_zones(const Model& model);

/// Takes one sample of every history, with its time and cycle, in each `interval`-th cycle; does nothing without histories. `kick`: the time from the velocities
/// of the cycle before to those of this one, over which a rate is taken. `script_value` returns the value of a function or variable of the deck. If the object was deleted, the nearest one is used; NaN when none of its kind
/// is left. When anything throws, no history gets a sample.
void sample_histories(Model& model, double kick, const std::function<double(const std::string&)>& script_value);

/// Removes all samples; the histories stay.
void reset_histories(Histories& histories);

} // namespace kaya
