#include "lang/modern/line_shapes.hpp"

#include <algorithm>
#include <vector>

namespace kaya::lang {

namespace {

// clang-format off
constexpr LineShape shapes[] = {
    {"title {rest}", "model title '{rest}'"},
    {"gravity 0 0 -{g}", "model gravity {g}"},
    {"hide", "block hide on"},
    {"table {n} clear", "table '{n}' clear"},
    {"table {n} read {f}", "table '{n}' import {f}"},
    {"table {n}", "table '{n}' add"},
    {"damp {f} {w}", "block mechanical damping rayleigh {f} {w}"},
    {"copy offset {x} {y} {z} range id {n}", "block copy id {n} translate {x} {y} {z}"},
    {"densify {x} {y} {z}", "block densify segments {x} {y} {z}"},
    {"import {f}", "block generate from-vrml filename {f}"},
    {"import {f}", "block import filename {f}"},
    {"export {f}", "block export filename {f}"},
    {"vtk write {f}", "block vtk filename {f}"},
    {"list frequencies {n}", "block dynamic eigen modes {n}"},
    {"list {rest}", "fish list {rest}"},
    {"set {rest}", "fish set {rest}"},
    {"history write {f}", "history export file {f}"},
    {"initialize pp {p} zgradient {g}", "block gridpoint initialize pore-pressure {p} gradient 0 0 {g}"},
    {"initialize pp {p}", "block gridpoint initialize pore-pressure {p}"},
    {"boundary stress {s} 0 0 0 0 0", "block face apply stress-xx {s}"},
    {"boundary stress 0 {s} 0 0 0 0", "block face apply stress-yy {s}"},
    {"boundary stress 0 0 {s} 0 0 0", "block face apply stress-zz {s}"},
    {"boundary stress {s} {s} {s} 0 0 0", "block face apply stress-normal {s}"},
    {"water table {x} {y} {z}", "block water plane normal 0 0 -1 origin {x} {y} {z}"},
    {"structure property 1", "structure cable property"},
    {"structure property 2", "structure beam property"},
    {"structure property 3", "structure liner property"},
};
// clang-format on

std::vector<std::string_view> tokens_of(std::string_view pattern) {
    std::vector<std::string_view> tokens;
    while (!pattern.empty()) {
        const auto end = std::min(pattern.find(' '), pattern.size());
        tokens.push_back(pattern.substr(0, end));
        pattern.remove_prefix(std::min(end + 1, pattern.size()));
    }
    return tokens;
}

/// The name in {name}; "" when the token is another one.
std::string_view name_in(std::string_view token) {
    const bool slot = token.size() > 2 && token.front() == '{' && token.back() == '}';
    return slot ? token.substr(1, token.size() - 2) : std::string_view{};
}

std::string_view name_in_quotes(std::string_view token) {
    const bool quoted = token.size() > 2 && token.front() == '\'' && token.back() == '\'';
    return quoted ? name_in(token.substr(1, token.size() - 2)) : std::string_view{};
}

std::string whole_word(const Statement& statement, const CommandSpec& spec, const Spelled& whole, std::size_t at) {
    if (at == 0) return std::string(spec.words.front().word);
    if (at <= spec.form.size()) return std::string(spec.form[at - 1].front().word);
    const auto found = whole.find(at);
    return found != whole.end() ? std::string(found->second) : statement.words[at].raw_text();
}

} // namespace

std::optional<TakenWords> take_beginning(std::string_view pattern, const Statement& statement, const CommandSpec& spec,
                                         const Spelled& whole) {
    TakenWords taken;
    const auto keep = [&](std::string_view name, std::string value) {
        return taken.values.emplace(name, value).first->second == value;
    };
    for (const std::string_view token : tokens_of(pattern)) {
        if (taken.count >= statement.words.size()) return std::nullopt;
        const Word& word = statement.words[taken.count];
        if (name_in(token) == "rest") {
            taken.values.emplace("rest", statement.raw(taken.count));
            taken.count = statement.words.size();
            return taken;
        }
        bool fits = false;
        if (const auto name = name_in(token); !name.empty()) fits = keep(name, word.raw_text());
        else if (const auto quoted = name_in_quotes(token); !quoted.empty())
            fits = word.kind == WordKind::text && keep(quoted, word.text);
        else fits = whole_word(statement, spec, whole, taken.count) == token;
        if (!fits) return std::nullopt;
        ++taken.count;
    }
    return taken;
}

std::string write_beginning(std::string_view pattern, const TakenWords& taken) {
    std::string line;
    while (!pattern.empty()) {
        const auto open = std::min(pattern.find('{'), pattern.size());
        line += pattern.substr(0, open);
        pattern.remove_prefix(open);
        if (pattern.empty()) break;
        const auto close = pattern.find('}');
        if (const auto value = taken.values.find(pattern.substr(1, close - 1)); value != taken.values.end())
            line += value->second;
        pattern.remove_prefix(close + 1);
    }
    return line;
}

void for_each_shape(const std::function<bool(const LineShape&)>& visit) {
    for (const LineShape& shape : shapes)
        if (visit(shape)) return;
}

} // namespace kaya::lang
