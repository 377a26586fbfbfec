// Values for the colours of the page as JSON: {"name":, "unit":, "of":, "names":, "values":}.
#pragma once

#include "model/fields/field.hpp"
#include "model/tables/model.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// The number that a colour shows: of a vector its length, of a block its number.
double length_of(const Model& model, const FieldValue& value);

/// A field of texts, one for each block or joint.
std::string names_json(std::string_view title, const std::vector<std::string>& texts);

/// One value for each row. `of`: "block" or "corner".
std::string field_json(const Model& model, const Field& field, const char* of, std::span<const Row> rows);

/// One number for each object. `of`: "block", which stands for joints too, or "corner".
std::string numbers_json(std::string_view title, std::string_view unit, std::string_view of,
                         const std::vector<float>& values);

/// All that gridpoints have: motion, and where there are zones the mean stresses of the zones around them, weighted with their volumes.
std::vector<std::string> corner_fields_json(const Model& model, std::span<const Row> gridpoints);

} // namespace kaya
