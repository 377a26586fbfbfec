#include "lang/fish/expression_generator.hpp"

#include "lang/fish/reserved.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace kaya::fish {

namespace {

constexpr std::array<std::string_view, 22> lua_words{
    "and", "break", "do",  "else", "elseif", "end",    "false",  "for",  "function", "goto",  "if",
    "in",  "local", "nil", "not",  "or",     "repeat", "return", "then", "true",     "until", "while"};

/// Lua allows 255 values from outside in a function, and 200 locals around it.
constexpr std::size_t most_shared = 150;

/// How tightly Lua binds: an operand that binds less needs parentheses.
enum Strength { weakest = 0, truth = 1, compare = 3, sum = 6, product = 7, sign = 8 };

bool is_plain_name(std::string_view name) {
    return std::all_of(name.begin(), name.end(),
                       [](char c) {
                           return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' ||
                                  (c >= 'A' && c <= 'Z');
                       }) &&
           std::find(lua_words.begin(), lua_words.end(), name) == lua_words.end();
}

bool is_comparison(const Node& node) {
    static constexpr std::array<std::string_view, 6> signs{"==", "~=", "<", ">", "<=", ">="};
    return node.kind == NodeKind::binary && std::find(signs.begin(), signs.end(), node.text) != signs.end();
}

bool is_logical(const Node& node) {
    return node.kind == NodeKind::logical_not ||
           (node.kind == NodeKind::binary && (node.text == "&" || node.text == "|"));
}

/// `not(x)` in a condition means "is zero".
bool is_not_call(const Node& node) {
    return node.kind == NodeKind::name && node.text == "not" && node.children.size() == 1;
}

std::string real_text(double value) {
    std::string text = fmt::format("{}", value); // the shortest text that gives the same bits
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    return text;
}

std::string in_parentheses(const std::string& text, bool wanted) { return wanted ? fmt::format("({})", text) : text; }

} // namespace

std::string member(std::string_view name) {
    return is_plain_name(name) ? fmt::format(".{}", name) : fmt::format("[{}]", lua_string(name));
}

std::string lua_string(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        if (c == '\n') result += "\\n";
        else if (static_cast<unsigned char>(c) < 0x20) result += fmt::format("\\{:03}", static_cast<int>(c));
        else result += c;
    }
    result += '"';
    return result;
}

std::string ExpressionGenerator::variable(const Node& name) const {
    if (name.text == scope_.function) return "v_return";
    if (scope_.locals.contains(name.text)) return fmt::format("v_{}", name.text);
    return fmt::format("{}{}", scope_.spilled.contains(name.text) ? "S" : "G", member(name.text));
}

std::string ExpressionGenerator::list(const std::vector<Node>& nodes) const {
    std::string text;
    for (const auto& node : nodes) {
        if (!text.empty()) text += ", ";
        text += value(node);
    }
    return text;
}

std::string ExpressionGenerator::condition(const Node& node) const {
    if (node.kind == NodeKind::logical_not || is_not_call(node))
        return fmt::format("not ({})", condition(node.children[0]));
    if (is_comparison(node)) return generated(node, truth);
    if (is_logical(node))
        return fmt::format("({}) {} ({})", condition(node.children[0]), node.text == "&" ? "and" : "or",
                           condition(node.children[1]));
    return fmt::format("{} ~= 0", generated(node, compare + 1));
}

std::string ExpressionGenerator::generated(const Node& node, int strength) const {
    switch (node.kind) {
    case NodeKind::integer: return fmt::format("{}", node.integer);
    case NodeKind::real: return real_text(node.real);
    case NodeKind::text: return lua_string(node.text);
    case NodeKind::name: return name(node);
    case NodeKind::member: return member_value(node);
    case NodeKind::structure:
        return fmt::format("R.new_structure({}{}{})", lua_string(node.text), node.children.empty() ? "" : ", ",
                           list(node.children));
    case NodeKind::minus:
        // The blank keeps two signs from becoming a Lua comment.
        return in_parentheses(fmt::format("- {}", generated(node.children[0], sign)), strength > sign);
    case NodeKind::logical_not: return fmt::format("(({}) and 1 or 0)", condition(node));
    case NodeKind::binary: return binary(node, strength);
    case NodeKind::element: return node.text;
    case NodeKind::split:
        throw Diagnostic("'::' has no meaning here", "it splits an argument of a function: block.vol(::blocks)")
            .at(node.place);
    }
    return "0";
}

std::string ExpressionGenerator::binary(const Node& node, int strength) const {
    const Node& left = node.children[0];
    const Node& right = node.children[1];
    if (is_logical(node)) return fmt::format("(({}) and 1 or 0)", condition(node));
    if (is_comparison(node)) {
        const std::string text =
            fmt::format("{} {} {}", generated(left, compare + 1), node.text, generated(right, compare + 1));
        return strength == truth ? text : fmt::format("({} and 1 or 0)", text);
    }
    if (node.text == "^") return fmt::format("R.power({}, {})", value(left), value(right));
    if (node.text == "//" || node.text == "%")
        return fmt::format("R.{}({}, {})", node.text == "%" ? "remainder" : "floor_divide", value(left), value(right));
    // A whole number divided by a whole number is cut to a whole number, in the classic dialect; a divisor with a point cannot be one.
    if (node.text == "/" && !(right.kind == NodeKind::real && right.real != 0))
        return fmt::format("R.{}({}, {})", modern() ? "ratio" : "divide", value(left), value(right));
    const int own = node.text == "+" || node.text == "-" ? sum : product;
    const std::string text = fmt::format("{} {} {}", generated(left, own), node.text, generated(right, own + 1));
    return in_parentheses(text, strength > own);
}

void ExpressionGenerator::check_arguments(const Node& node, const Meaning& meaning) const {
    fish::check_arguments(node.text, static_cast<int>(node.children.size()), meaning, node.place);
}

Meaning ExpressionGenerator::meaning_of(const Node& name) const {
    Meaning meaning = dictionary_(name.text);
    if (meaning.kind == NameKind::variable)
        if (const auto* reserved = find_reserved(name.text))
            throw reserved_message(name.text, *reserved).at(name.place);
    return meaning;
}

std::string ExpressionGenerator::built_in(char table, const std::string& name) const {
    const bool shared = is_plain_name(name) && (shared_.contains({table, name}) || shared_.size() < most_shared);
    if (!shared) return fmt::format("{}{}", table, member(name));
    shared_.emplace(table, name);
    return fmt::format("{}_{}", table, name);
}

std::string ExpressionGenerator::shared_built_ins() const {
    std::string text;
    for (const auto& [table, name] : shared_) text += fmt::format("local {0}_{1} = {0}.{1}; ", table, name);
    return text;
}

bool ExpressionGenerator::makes_value(const Node& node) const {
    return modern() && fish::makes_value(node.text) && !scope_.is_local(node.text) && !dictionary_(node.text).exists;
}

std::string ExpressionGenerator::owned(const Node& node) const {
    const std::string text = value(node);
    if (!modern()) return text;
    bool shared = node.kind == NodeKind::member;
    if (node.kind == NodeKind::name && !makes_value(node)) {
        const bool local = scope_.is_local(node.text) && node.text != scope_.function;
        const Meaning meaning = local ? Meaning{} : dictionary_(node.text);
        const std::string& whole = meaning.whole.empty() ? node.text : meaning.whole;
        shared = !is_constant(node.text) && (meaning.kind == NameKind::variable || whole.ends_with(".extra"));
    }
    return shared ? fmt::format("R.own({})", text) : text;
}

bool ExpressionGenerator::is_fresh(const Node& node) const {
    if (node.kind != NodeKind::name || scope_.is_local(node.text)) return false;
    const Meaning meaning = dictionary_(node.text);
    return makes_value(node) || (meaning.kind == NameKind::built_in && !meaning.writable);
}

bool ExpressionGenerator::is_place(const Node& node) const {
    if (node.kind == NodeKind::member) return true;
    if (node.kind != NodeKind::name || makes_value(node)) return false;
    if (scope_.is_local(node.text)) return node.text != scope_.function || !node.parentheses;
    const Meaning meaning = meaning_of(node);
    return meaning.kind == NameKind::variable || (meaning.kind == NameKind::built_in && meaning.writable);
}

std::string ExpressionGenerator::member_value(const Node& node) const {
    std::string arguments;
    for (std::size_t i = 1; i < node.children.size(); ++i) arguments += ", " + value(node.children[i]);
    return fmt::format("R.member({}, {}{})", value(node.children[0]), lua_string(node.text), arguments);
}

std::string ExpressionGenerator::member_assignment(const Node& target, const std::string& value) const {
    const Node& whole = target.children[0];
    std::string arguments;
    for (std::size_t i = 1; i < target.children.size(); ++i) arguments += ", " + this->value(target.children[i]);
    const bool stored = is_place(whole);
    // Vectors and tensors are values: a new one replaces the old one.
    const std::string changed = fmt::format("R.{}({}, {}, {}{})", stored ? "with_member" : "set_member",
                                            this->value(whole), lua_string(target.text), value, arguments);
    return stored ? assignment(whole, changed) : changed;
}

namespace {
bool is_split(const Node& node) { return node.kind == NodeKind::split; }
} // namespace

ExpressionGenerator::Split ExpressionGenerator::split(const Node& node) const {
    Split parts{node, {}, {}};
    int count = 0;
    for (Node& child : parts.one.children) {
        if (!is_split(child)) continue;
        parts.lists += ", " + value(child.children[0]);
        child.kind = NodeKind::element;
        child.text = fmt::format("part_{}", ++count);
        child.children.clear();
        parts.names += (parts.names.empty() ? "" : ", ") + child.text;
    }
    return parts;
}

std::string ExpressionGenerator::name(const Node& node) const {
    if (std::ranges::any_of(node.children, is_split)) {
        const Split parts = split(node);
        return fmt::format("R.split(function({}) return {} end{})", parts.names, name(parts.one), parts.lists);
    }
    if (makes_value(node)) return fmt::format("A.{}({})", node.text, list(node.children));
    if (modern() && node.text == scope_.function && !node.parentheses) { // it calls itself
        const Meaning own = dictionary_(node.text);
        if (own.kind == NameKind::function) check_arguments(node, own);
        return fmt::format("F{}()", member(node.text));
    }
    if (scope_.is_local(node.text)) {
        if (!node.parentheses) return variable(node);
        if (node.text != scope_.function) return indexed(node);
    }
    const Meaning meaning = meaning_of(node);
    if (meaning.kind == NameKind::function) {
        check_arguments(node, meaning);
        return fmt::format("F{}({})", member(node.text), list(node.children));
    }
    if (meaning.kind == NameKind::built_in) {
        check_arguments(node, meaning);
        return fmt::format("{}({})", built_in('A', meaning.whole.empty() ? node.text : meaning.whole),
                           list(node.children));
    }
    if (!node.parentheses)
        for (const auto& constant : classic_constants)
            if (node.text == constant.name) return std::string(constant.lua);
    return node.parentheses ? indexed(node) : variable(node);
}

std::string ExpressionGenerator::indexed(const Node& node) const {
    const std::string array = variable(node);
    if (node.children.empty()) return fmt::format("R.not_function({}, {})", array, lua_string(node.text));
    if (node.children.size() == 1)
        return fmt::format("R.element({}, {}, {})", array, lua_string(node.text), value(node.children[0]));
    return fmt::format("R.element_of({}, {}, {})", array, lua_string(node.text), list(node.children));
}

std::string ExpressionGenerator::assignment(const Node& target, const std::string& value, bool one_each) const {
    if (target.kind == NodeKind::name && std::ranges::any_of(target.children, is_split)) {
        const Split parts = split(target);
        return fmt::format("R.set_split(function(given_part, {}) {} end, {}, {}{})", parts.names,
                           assignment(parts.one, "given_part"), value, one_each, parts.lists);
    }
    if (target.kind == NodeKind::member) return member_assignment(target, value);
    if (target.kind == NodeKind::structure)
        throw Diagnostic("a new structure cannot be assigned", "write: a = struct NAME(1, 2)").at(target.place);
    const bool local = scope_.is_local(target.text);
    const Meaning meaning = local ? Meaning{} : meaning_of(target);
    if (meaning.kind == NameKind::function)
        throw Diagnostic(fmt::format("'{}' is a function: it cannot be assigned here", target.text),
                         "use another name for the variable")
            .at(target.place);
    if (meaning.kind == NameKind::built_in) {
        if (!meaning.writable)
            throw Diagnostic(fmt::format("'{}' can be read, not set", target.text),
                             meaning.most == 0 ? "use another name for the variable" : "")
                .at(target.place);
        check_arguments(target, meaning);
        constexpr std::array<std::string_view, 6> components{"xcomp", "ycomp", "zcomp", "comp.x", "comp.y", "comp.z"};
        const std::string& name = meaning.whole.empty() ? target.text : meaning.whole;
        const bool component = std::ranges::find(components, name) != components.end();
        if (component) { // vectors are values: a new one replaces the old one
            const std::string whole =
                fmt::format("{}({}, {})", built_in('W', name), this->value(target.children[0]), value);
            return assignment(target.children[0], whole);
        }
        const std::string arguments = list(target.children);
        return fmt::format("{}({}{}{})", built_in('W', name), arguments, arguments.empty() ? "" : ", ", value);
    }
    if (target.parentheses && target.text == scope_.function)
        throw Diagnostic(fmt::format("'{}' is this function: a call of it cannot be assigned", target.text))
            .at(target.place);
    if (!target.parentheses) return fmt::format("{} = {}", variable(target), value);
    const std::string array = variable(target);
    if (target.children.empty())
        throw Diagnostic(fmt::format("'{}()' names no element of an array", target.text)).at(target.place);
    if (target.children.size() == 1)
        return fmt::format("R.set_element({}, {}, {}, {})", array, lua_string(target.text),
                           this->value(target.children[0]), value);
    return fmt::format("R.set_element_of({}, {}, {}, {})", array, lua_string(target.text), value,
                       list(target.children));
}

} // namespace kaya::fish
