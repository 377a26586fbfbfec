#include "study/outcome.hpp"

#include "study/toml_section.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <sstream>

namespace kaya {

namespace {

constexpr std::array<const char*, 5> end_names{"done", "failed", "limit", "crashed", "lost"};

/// Values are stored as lists of name and value: a table would sort them by name.
toml::array array_of(const std::vector<std::pair<std::string, StudyValue>>& values) {
    toml::array all;
    for (const auto& [name, value] : values) {
        toml::array pair{name};
        std::visit(
            [&]<class T>(const T& v) {
                if constexpr (!std::is_same_v<T, std::monostate>) pair.push_back(v);
            },
            value);
        all.push_back(std::move(pair));
    }
    return all;
}

Diagnostic damaged(const std::filesystem::path& file) {
    return Diagnostic(fmt::format("{} is damaged", file.string()), "remove its folder: the run is done again",
                      Fault::run);
}

std::vector<std::pair<std::string, StudyValue>> values_of(const toml::node_view<const toml::node>& node,
                                                          const std::filesystem::path& file) {
    const auto* all = node.as_array();
    if (all == nullptr) throw damaged(file);
    std::vector<std::pair<std::string, StudyValue>> values;
    for (const auto& one : *all) {
        const auto* pair = one.as_array();
        if (pair == nullptr || pair->empty() || pair->size() > 2 || !(*pair)[0].is_string()) throw damaged(file);
        StudyValue value;
        if (pair->size() == 2) {
            const auto& held = (*pair)[1];
            if (held.is_boolean()) value = *held.value<bool>();
            else if (held.is_integer()) value = *held.value<std::int64_t>();
            else if (held.is_floating_point()) value = *held.value<double>();
            else if (held.is_string()) value = *held.value<std::string>();
            else throw damaged(file);
        }
        values.emplace_back(*(*pair)[0].value<std::string>(), std::move(value));
    }
    return values;
}

toml::table read_table(const std::filesystem::path& file) {
    const std::string text = read_whole_file(file.string());
    try {
        return parse_toml(source_of(file.string(), text), text);
    } catch (const Diagnostic&) { throw damaged(file); }
}

std::string text_of_table(const toml::table& table) {
    std::ostringstream text;
    text << table << '\n';
    return text.str();
}

} // namespace

const char* name_of(Outcome::End end) { return end_names[static_cast<std::size_t>(end)]; }

StudyValue result_of(const Outcome& outcome, const std::string& name) {
    for (const auto& [own, value] : outcome.results)
        if (own == name) return value;
    return {};
}

double known_number(const Outcome& outcome, const std::string& name) {
    return outcome.end == Outcome::End::done ? number_of(result_of(outcome, name)) : std::nan("");
}

void write_outcome(const std::filesystem::path& file, const Case& one, const Outcome& outcome) {
    const toml::table table{{"run", static_cast<std::int64_t>(one.number)},
                            {"end", name_of(outcome.end)},
                            {"message", outcome.message},
                            {"seconds", outcome.seconds},
                            {"cycles", outcome.cycles},
                            {"warnings", outcome.warnings},
                            {"hash", outcome.hash},
                            {"values", array_of(one.values)},
                            {"results", array_of(outcome.results)}};
    write_whole_file(file.string(), text_of_table(table));
}

std::optional<Outcome> read_outcome(const std::filesystem::path& file, const Case& one) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return std::nullopt;
    const toml::table table = read_table(file);
    Outcome outcome;
    const auto end = std::ranges::find(end_names, table["end"].value_or(std::string_view()));
    if (end == end_names.end()) throw damaged(file);
    outcome.end = static_cast<Outcome::End>(end - end_names.begin());
    outcome.message = table["message"].value_or(std::string());
    outcome.seconds = table["seconds"].value_or(0.0);
    outcome.cycles = table["cycles"].value_or(std::int64_t{0});
    outcome.warnings = table["warnings"].value_or(std::int64_t{0});
    outcome.hash = table["hash"].value_or(std::string());
    outcome.results = values_of(table["results"], file);
    if (values_of(table["values"], file) != one.values)
        throw Diagnostic(fmt::format("{} is of a run with other values", file.string()),
                         "continue in another folder: --into", Fault::run);
    return outcome;
}

std::optional<Case> read_case(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return std::nullopt;
    const toml::table table = read_table(file);
    Case one;
    one.number = static_cast<std::size_t>(table["run"].value_or(std::int64_t{0}));
    one.values = values_of(table["values"], file);
    return one;
}

void write_cases(const std::filesystem::path& file, const std::vector<Case>& cases) {
    toml::array all;
    for (const auto& one : cases)
        all.push_back(toml::table{
            {"run", static_cast<std::int64_t>(one.number)}, {"weight", one.weight}, {"values", array_of(one.values)}});
    write_whole_file(file.string(), text_of_table(toml::table{{"cases", std::move(all)}}));
}

std::vector<Case> read_cases(const std::filesystem::path& file) {
    const toml::table table = read_table(file);
    const auto* all = table["cases"].as_array();
    if (all == nullptr) throw damaged(file);
    std::vector<Case> cases;
    for (const auto& node : *all) {
        const auto* held = node.as_table();
        if (held == nullptr) throw damaged(file);
        Case one;
        one.number = static_cast<std::size_t>((*held)["run"].value_or(std::int64_t{0}));
        one.weight = (*held)["weight"].value_or(1.0);
        one.values = values_of((*held)["values"], file);
        cases.push_back(std::move(one));
    }
    return cases;
}

} // namespace kaya
