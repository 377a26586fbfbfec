#include "lang/fish/doubts.hpp"

#include "lang/fish/syntax.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya::fish {

namespace {

bool is_number(const Node& node) {
    return node.kind == NodeKind::integer || node.kind == NodeKind::real ||
           (node.kind == NodeKind::minus && is_number(node.children.front()));
}

bool same_literal(const Node& a, const Node& b) {
    if (a.kind != b.kind) return false;
    if (a.kind == NodeKind::minus) return same_literal(a.children.front(), b.children.front());
    if (a.kind == NodeKind::text) return a.text == b.text;
    if (a.kind == NodeKind::integer) return a.integer == b.integer;
    return a.kind == NodeKind::real && a.real == b.real;
}

class Doubter {
public:
    explicit Doubter(Dialect dialect) : dialect_(dialect) {}
    std::vector<Diagnostic> found;

    void statements(const std::vector<Statement>& body) {
        for (const auto& s : body) statement(s);
    }

private:
    void add(std::string message, std::string hint, const Place& place) {
        Diagnostic d(std::move(message), std::move(hint));
        d.severity = Severity::warning;
        d.code = "implausible";
        found.push_back(d.at(place));
    }

    void node(const Node& node) {
        if (node.kind == NodeKind::binary && (node.text == "==" || node.text == "~=")) comparison(node);
        if (node.kind == NodeKind::binary && (node.text == "/" || node.text == "//")) division(node);
        constexpr std::size_t components = 3;
        if (node.kind == NodeKind::name && node.text == "vector" && node.parentheses && !node.children.empty() &&
            node.children.size() < components && !(node.children.size() == 1 && !is_number(node.children.front())))
            add(fmt::format("a vector of {} number{}: the others are 0", node.children.size(),
                            node.children.size() == 1 ? "" : "s"),
                "write all three: vector(x,y,z)", node.place);
        for (const auto& child : node.children) this->node(child);
    }

    /// Classic FISH divides whole numbers without a remainder.
    void division(const Node& node) {
        const Node &left = node.children[0], &right = node.children[1];
        if (dialect_ != Dialect::classic || left.kind != NodeKind::integer || right.kind != NodeKind::integer ||
            right.integer == 0 || left.integer % right.integer == 0)
            return;
        add(fmt::format("{}/{} is {}: whole numbers are divided without a remainder", left.integer, right.integer,
                        left.integer / right.integer),
            fmt::format("write {}.0/{}", left.integer, right.integer), node.place);
    }

    void comparison(const Node& node) {
        const Node &left = node.children[0], &right = node.children[1];
        const bool text_left = left.kind == NodeKind::text && is_number(right);
        const bool text_right = right.kind == NodeKind::text && is_number(left);
        if (text_left || text_right)
            add("a text is never equal to a number", "remove the quotes", (text_left ? left : right).place);
    }

    void statement(const Statement& s) {
        if (s.kind == StatementKind::structure) return;
        node(s.target);
        node(s.value);
        for (const auto& expression : s.expressions) node(expression);
        for (const auto* part : {&s.init, &s.body, &s.step}) statements(*part);
        if (s.kind == StatementKind::choice) cases(s.branches);
        for (const auto& branch : s.branches) {
            for (const auto& condition : branch.condition) node(condition);
            statements(branch.body);
        }
    }

    void cases(const std::vector<Branch>& branches) {
        for (auto later = branches.begin(); later != branches.end(); ++later) {
            if (later->condition.empty()) continue;
            const auto earlier = std::find_if(branches.begin(), later, [&](const Branch& branch) {
                return !branch.condition.empty() && same_literal(branch.condition.front(), later->condition.front());
            });
            if (earlier != later)
                add("this case is a duplicate and never runs",
                    fmt::format("the first is in line {}", earlier->place.line), later->condition.front().place);
        }
    }

    Dialect dialect_;
};

} // namespace

std::vector<Diagnostic> doubts(const Function& function) {
    Doubter doubter(function.tree->dialect);
    doubter.statements(function.tree->body);
    return std::move(doubter.found);
}

} // namespace kaya::fish
