// Words that choose the columns of a table of objects: `block list velocity`, `list blocks show velocity`.
#pragma once

#include "lang/commands/commands.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace kaya::lang {

/// A field of the objects under its heading, or without a field the column of that heading which the list computes.
struct ListedColumn {
    std::string_view heading, field;
};

struct ListSubject {
    std::string_view word, help;
    std::array<ListedColumn, 6> columns; ///< up to the first without heading
};

/// A list of objects whose columns can be chosen.
struct ListedObjects {
    List::What what;
    std::size_t names; ///< how many of its usual columns say which object a line is about
    std::span<const ListSubject> subjects;
};

/// Null for lists that have one table.
const ListedObjects* listed_objects(List::What what);
/// Empty for those.
std::span<const ListSubject> list_subjects(List::What what);

} // namespace kaya::lang
