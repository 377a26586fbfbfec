// Converts a quantity to numbers with colours, and describes the colours.
#pragma once

#include "pictures/model_picture.hpp"

#include <limits>

namespace kaya {

/// The legend of values from `least` to `greatest` (none: least above greatest). With numbers on both sides of zero, and neither side a
/// trifle, zero is in the middle.
ColourBar colour_bar(const std::string& title, double least, double greatest);

class Colouring {
public:
    explicit Colouring(ColourField field) : field_(std::move(field)) {}
    ObjectKind table() const { return field_.table; }
    /// Whether it is a displacement or a velocity, which held blocks do not have.
    bool of_motion() const { return field_.motion; }
    /// A text is converted to the index of its name. NaN for objects without a value.
    float value(const Model& model, Row row);
    /// The value of what is drawn in grey, and why: "held".
    float grey(const std::string& why);
    bool gives_names() const { return !bar_.names.empty(); }
    /// The range of all values so far.
    ColourBar bar() const;

private:
    ColourField field_;
    ColourBar bar_;
    double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

} // namespace kaya
