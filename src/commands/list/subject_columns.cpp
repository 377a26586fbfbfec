#include "commands/list/subject_columns.hpp"

#include "lang/commands/list_subjects.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace kaya {

namespace {

using Columns = std::vector<ListColumn>;

const ListColumn& computed_column(const Columns& usual, const Columns& others, std::string_view heading) {
    for (const Columns* columns : {&usual, &others})
        if (const auto found = std::ranges::find(*columns, heading, &ListColumn::heading); found != columns->end())
            return *found;
    throw std::logic_error(fmt::format("the list has no column {}", heading));
}

} // namespace

Columns subject_columns(const lang::List& command, const Columns& usual, const Columns& others) {
    if (command.subjects.empty()) return usual;
    const lang::ListedObjects& objects = *lang::listed_objects(*command.what);
    Columns columns(usual.begin(), usual.begin() + static_cast<std::ptrdiff_t>(objects.names));
    for (const std::string& word : command.subjects) {
        const auto subject = std::ranges::find(objects.subjects, word, &lang::ListSubject::word);
        for (const auto& [heading, field] : subject->columns) {
            if (heading.empty() || std::ranges::count(columns, heading, &ListColumn::heading) > 0) continue;
            columns.push_back(field.empty() ? computed_column(usual, others, heading) : ListColumn(heading, field));
        }
    }
    return columns;
}

} // namespace kaya
