#include "study/study_table.hpp"

#include "base/csv.hpp"
#include "io/hdf5_tree.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>

namespace kaya {

namespace {

struct Column {
    std::string name;
    std::function<std::string(std::size_t row)> text;
};

std::vector<Column> columns_of(const std::vector<Case>& cases, const std::vector<Outcome>& outcomes,
                               const std::vector<Asked>& asked) {
    std::vector<Column> columns;
    columns.push_back({"run", [&](std::size_t i) { return fmt::format("{}", cases[i].number); }});
    if (!cases.empty())
        for (std::size_t j = 0; j < cases[0].values.size(); ++j)
            columns.push_back(
                {cases[0].values[j].first, [&, j](std::size_t i) { return text_of(cases[i].values[j].second); }});
    if (std::ranges::any_of(cases, [](const Case& one) { return one.weight != 1; }))
        columns.push_back({"weight", [&](std::size_t i) { return text_of(cases[i].weight); }});
    for (const auto& one : asked)
        columns.push_back({one.name, [&](std::size_t i) { return text_of(result_of(outcomes[i], one.name)); }});
    columns.push_back({"end", [&](std::size_t i) { return std::string(name_of(outcomes[i].end)); }});
    columns.push_back({"cycles", [&](std::size_t i) { return fmt::format("{}", outcomes[i].cycles); }});
    columns.push_back({"seconds", [&](std::size_t i) { return fmt::format("{:.3f}", outcomes[i].seconds); }});
    columns.push_back({"warnings", [&](std::size_t i) { return fmt::format("{}", outcomes[i].warnings); }});
    columns.push_back({"hash", [&](std::size_t i) { return outcomes[i].hash; }});
    columns.push_back({"message", [&](std::size_t i) { return outcomes[i].message; }});
    return columns;
}

/// Numbers as a column of numbers, anything else as lines.
void write_values(TreeWriter& tree, const std::string& name, const std::vector<StudyValue>& values) {
    const bool texts =
        std::ranges::any_of(values, [](const StudyValue& v) { return std::holds_alternative<std::string>(v); });
    if (!texts) {
        std::vector<double> numbers;
        for (const auto& value : values) numbers.push_back(number_of(value));
        tree.data(name, numbers.data(), numbers.size(), 1);
        return;
    }
    std::string lines;
    for (const auto& value : values) {
        std::string line = text_of(value);
        std::ranges::replace(line, '\n', ' ');
        lines += line + '\n';
    }
    tree.text(name, lines);
}

template <class Take> void write_column(TreeWriter& tree, const char* name, std::size_t rows, Take&& take) {
    using Number = decltype(take(std::size_t{0}));
    std::vector<Number> numbers(rows);
    for (std::size_t i = 0; i < rows; ++i) numbers[i] = take(i);
    tree.data(name, numbers.data(), rows, 1);
}

} // namespace

std::string csv_of(const std::vector<Case>& cases, const std::vector<Outcome>& outcomes,
                   const std::vector<Asked>& asked) {
    const auto columns = columns_of(cases, outcomes, asked);
    std::string text;
    std::vector<std::string> cells;
    for (const auto& column : columns) cells.push_back(csv_cell(column.name));
    text += fmt::format("{}\n", fmt::join(cells, ","));
    for (std::size_t i = 0; i < cases.size(); ++i) {
        cells.clear();
        for (const auto& column : columns) cells.push_back(csv_cell(column.text(i)));
        text += fmt::format("{}\n", fmt::join(cells, ","));
    }
    return text;
}

std::string hdf5_of(const std::vector<Case>& cases, const std::vector<Outcome>& outcomes,
                    const std::vector<Asked>& asked) {
    TreeWriter tree;
    const std::size_t rows = cases.size();
    tree.open_group("parameters");
    for (std::size_t j = 0; rows > 0 && j < cases[0].values.size(); ++j) {
        std::vector<StudyValue> values;
        for (const auto& one : cases) values.push_back(one.values[j].second);
        write_values(tree, cases[0].values[j].first, values);
    }
    tree.close_group();
    tree.open_group("results");
    for (const auto& one : asked) {
        std::vector<StudyValue> values;
        for (const auto& outcome : outcomes) values.push_back(result_of(outcome, one.name));
        write_values(tree, one.name, values);
    }
    tree.close_group();
    write_column(tree, "run", rows, [&](std::size_t i) { return static_cast<std::int64_t>(cases[i].number); });
    write_column(tree, "weight", rows, [&](std::size_t i) { return cases[i].weight; });
    write_column(tree, "cycles", rows, [&](std::size_t i) { return outcomes[i].cycles; });
    write_column(tree, "seconds", rows, [&](std::size_t i) { return outcomes[i].seconds; });
    write_column(tree, "warnings", rows, [&](std::size_t i) { return outcomes[i].warnings; });
    const auto lines = [&](const char* name, auto&& take) {
        std::vector<StudyValue> values;
        for (const auto& outcome : outcomes) values.emplace_back(std::string(take(outcome)));
        write_values(tree, name, values);
    };
    lines("end", [](const Outcome& o) { return name_of(o.end); });
    lines("hash", [](const Outcome& o) { return o.hash; });
    lines("message", [](const Outcome& o) { return o.message; });
    return tree.image();
}

std::string table_text(const std::vector<Case>& cases, const std::vector<Outcome>& outcomes,
                       const std::vector<Asked>& asked, std::size_t most) {
    const auto columns = columns_of(cases, outcomes, asked);
    const std::size_t rows = std::min(most, cases.size());
    std::vector<std::vector<std::string>> cells(columns.size());
    for (std::size_t j = 0; j < columns.size(); ++j) {
        cells[j].push_back(columns[j].name);
        for (std::size_t i = 0; i < rows; ++i) cells[j].push_back(columns[j].text(i));
    }
    std::string text;
    for (std::size_t i = 0; i <= rows; ++i) {
        std::string line;
        for (std::size_t j = 0; j < columns.size(); ++j) {
            std::size_t width = 0;
            for (const auto& cell : cells[j]) width = std::max(width, cell.size());
            line += fmt::format("{:>{}}  ", cells[j][i], j + 1 < columns.size() ? width : 0);
        }
        while (!line.empty() && line.back() == ' ') line.pop_back();
        text += line + '\n';
    }
    if (rows < cases.size()) text += fmt::format("... {} more runs: see results.csv\n", cases.size() - rows);
    return text;
}

} // namespace kaya
