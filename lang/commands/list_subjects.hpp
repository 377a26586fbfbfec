// Words that choose the columns of a table of objects: `block list velocity`, `list blocks show velocity`. The columns of each stand in
// src/commands/list/subject_columns.cpp.
#pragma once

#include "lang/commands/commands.hpp"

#include <span>
#include <string_view>

namespace kaya::lang {

struct ListSubject {
    std::string_view word, help;
};

/// Empty for lists that have one table.
std::span<const ListSubject> list_subjects(List::What what);

} // namespace kaya::lang
