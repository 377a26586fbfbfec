#include "model/measure/held.hpp"

namespace kaya {

bool is_held(const Model& model, Row b) {
    if (!model.blocks.deformable[b]) return (model.blocks.fixed[b] & 7) == 7;
    const Span span = model.blocks.gridpoints[b];
    for (Row g = span.first; g < span.end(); ++g)
        if ((model.gridpoints.fixed[g] & 7) != 7) return false;
    return true;
}

} // namespace kaya
