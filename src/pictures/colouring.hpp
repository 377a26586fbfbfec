// From a quantity to numbers that have colours, and what the colours mean.
#pragma once

#include "pictures/model_picture.hpp"

#include <limits>

namespace kaya {

class Colouring {
public:
    explicit Colouring(ColourField field) : field_(std::move(field)) {}
    ObjectKind table() const { return field_.table; }
    /// A text is the number of its name. NaN for what has no number.
    float value(const Model& model, Row row);
    bool gives_names() const { return !bar_.names.empty(); }
    /// Of all values so far.
    ColourBar bar() const;

private:
    ColourField field_;
    ColourBar bar_;
    double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

} // namespace kaya
