#include "io/history_csv.hpp"

#include "base/csv.hpp"
#include "base/diagnostic.hpp"
#include "model/fields/field.hpp"
#include "model/fields/sampling.hpp"
#include "system/whole_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace kaya {

namespace {

using Kind = HistorySource::Kind;

const History& find_history(const Histories& histories, std::int64_t number) {
    for (const auto& history : histories.all)
        if (history.number == number) return history;
    const auto count = histories.all.size();
    std::string known;
    for (const auto& history : histories.all) known += fmt::format("{}{}", known.empty() ? "" : ", ", history.number);
    const bool all_there = count > 0 && histories.all.back().number == static_cast<std::int32_t>(count);
    throw Diagnostic(fmt::format("there is no history {}", number),
                     count == 0  ? std::string("no history is defined")
                     : all_there ? fmt::format("histories 1 to {} are defined", count)
                                 : fmt::format("these histories are defined: {}", known));
}

/// The sample of a history in that row of the table, NaN where it has none.
double sample_at(const History& history, std::size_t row) {
    const bool there = row >= history.first_sample && row - history.first_sample < history.values.size();
    return there ? history.values[row - history.first_sample] : std::nan("");
}

} // namespace

std::string column_title(const History& history) {
    const auto& source = history.source;
    const std::string head = fmt::format("{}:{}", history.number, history.label);
    if (source.kind == Kind::function) return fmt::format("{} [script {}]", head, source.quantity);
    const std::string unit = unit_of(source);
    const std::string name = history.label == source.quantity ? "" : ", " + source.quantity;
    if (source.kind == Kind::global) return fmt::format("{} [{}{}]", head, unit, name);
    return fmt::format("{} [{}{}, {} nearest to {} {} {}]", head, unit, name, info_of(source.kind).noun,
                       source.place.x(), source.place.y(), source.place.z());
}

std::string history_csv(const Histories& histories, const std::vector<std::int64_t>& numbers,
                        std::optional<std::int64_t> versus, const Units& units) {
    std::vector<const History*> columns;
    if (versus) columns.push_back(&find_history(histories, *versus));
    if (numbers.empty()) {
        for (const auto& history : histories.all)
            if (!versus || history.number != *versus) columns.push_back(&history);
    }
    for (const auto number : numbers) columns.push_back(&find_history(histories, number));

    std::string text = versus ? "" : "cycle,time";
    for (const auto* history : columns) {
        if (!text.empty()) text += ',';
        text += csv_cell(units.in_brackets(column_title(*history)));
    }
    text += '\n';
    for (std::size_t row = 0; row < histories.time.size(); ++row) {
        if (!versus) fmt::format_to(std::back_inserter(text), "{},{}", histories.cycle[row], histories.time[row]);
        for (std::size_t k = 0; k < columns.size(); ++k) {
            if (!versus || k > 0) text += ',';
            text += csv_cell(sample_at(*columns[k], row));
        }
        text += '\n';
    }
    return text;
}

void write_history_csv(const Histories& histories, const std::string& path, const std::vector<std::int64_t>& numbers,
                       std::optional<std::int64_t> versus, const Units& units) {
    write_whole_file(path, history_csv(histories, numbers, versus, units));
}

} // namespace kaya
