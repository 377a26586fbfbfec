// Converts a quantity to numbers with colours, and describes the colours.
#pragma once

#include "pictures/model_picture.hpp"

#include <limits>

namespace kaya {

class Colouring {
public:
    explicit Colouring(ColourField field) : field_(std::move(field)) {}
    ObjectKind table() const { return field_.table; }
    /// A text is converted to the index of its name. NaN for objects without a value.
    float value(const Model& model, Row row);
    bool gives_names() const { return !bar_.names.empty(); }
    /// The range of all values so far.
    ColourBar bar() const;

private:
    ColourField field_;
    ColourBar bar_;
    double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

} // namespace kaya
