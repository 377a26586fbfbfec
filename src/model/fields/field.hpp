// Every quantity that a user can name: for histories, Lua and FISH, lists and VTK. One table.
#pragma once

#include "model/kinds/kinds.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

namespace kaya {

/// A link to a row of another table.
struct Link {
    ObjectKind kind;
    Row row;
};

using FieldValue = std::variant<double, std::int64_t, Vec3, std::string, Link>;

/// One quantity: `gridpoint.velocity` and the classic FISH names that read it.
struct Field {
    ObjectKind kind;
    std::string_view name;    ///< "normal_force"
    std::string_view classic; ///< "cx_nforce"; "" when there is none. A vector has its components as
                              ///< own fields: "x_velocity", classic "gp_xvel".
    std::string_view modern;  ///< "block.subcontact.force.norm": FISH of newer versions; "" when there is none
    std::string_view unit;    ///< quantity: "length", "stress", "force", "-"
    std::string_view help;
    FieldValue (*get)(const Model&, Row);
    void (*set)(Model&, Row, const FieldValue&); ///< null: read only
};

/// All fields, grouped by kinds of objects.
std::span<const Field> fields();
const Field* find_field(ObjectKind kind, std::string_view name);
const Field* find_classic_field(std::string_view classic);
/// By any of its names.
const Field* find_any_field(ObjectKind kind, std::string_view name);
/// The kind that is called so, also in the plural: "block", "blocks"; "model" for fields of the whole model. Of scripts' kinds only.
std::optional<ObjectKind> find_kind(std::string_view name);

/// The number of an object for users; none for no object and for kinds without numbers, such as a corner.
std::optional<std::int64_t> object_number(const Model& model, const Link& link);

} // namespace kaya
