#include "lang/fish/name_uses.hpp"

#include "lang/fish/syntax.hpp"

#include <algorithm>

namespace kaya::fish {

namespace {

class UseCollector {
public:
    explicit UseCollector(Dialect dialect) : dialect_(dialect) {}
    explicit UseCollector(const FunctionTree& tree)
        : function_(tree.name), dialect_(tree.dialect), own_(tree.arguments) {
        own_.insert(own_.end(), tree.locals.begin(), tree.locals.end());
    }

    void statements(const std::vector<Statement>& body) {
        for (const auto& s : body) statement(s);
    }

    void node(const Node& node) {
        if (node.kind == NodeKind::name) add(node, node.parentheses ? Use::call : Use::read);
        for (const auto& child : node.children) this->node(child);
    }

    std::vector<NameUse> uses;
    bool gives_back = false; ///< by `return`

private:
    void add(const Node& name, Use use) {
        const bool value_of_function = name.text == function_ && !name.parentheses;
        if (value_of_function || std::ranges::find(own_, name.text) != own_.end()) return;
        if (dialect_ == Dialect::modern && makes_value(name.text) && (use == Use::read || use == Use::call)) return;
        uses.push_back({name.text, use, static_cast<int>(name.children.size()), name.place, dialect_});
    }

    void target(const Node& target, bool makes_array) {
        if (target.kind == NodeKind::member) return node(target);
        add(target, target.parentheses && !makes_array ? Use::element : Use::set);
        for (const auto& child : target.children) node(child);
    }

    void statement(const Statement& s) {
        if (s.kind == StatementKind::evaluate) return line(s);
        if (s.kind == StatementKind::structure) return;
        if (s.kind == StatementKind::give_back) gives_back = true;
        if (!s.target.text.empty() && s.kind != StatementKind::nothing)
            target(s.target, s.kind == StatementKind::array);
        if (s.declares) add(s.target, Use::declare);
        node(s.value);
        for (const auto& expression : s.expressions) node(expression);
        for (const auto* part : {&s.init, &s.body, &s.step}) statements(*part);
        for (const auto& branch : s.branches) {
            for (const auto& condition : branch.condition) node(condition);
            statements(branch.body);
        }
        for (const auto& command : s.commands) {
            for (const auto& target : command.target) this->target(target, false);
            for (const auto& piece : command.pieces) this->piece(piece);
        }
    }

    /// `global a` has the name as its target too.
    void line(const Statement& s) {
        if (s.value.kind != NodeKind::name) return node(s.value);
        add(s.value, s.target.text.empty() ? Use::line : Use::declare);
        for (const auto& child : s.value.children) node(child);
    }

    void piece(const CommandPiece& piece) {
        if (piece.expression.empty()) return;
        if (piece.text.empty()) node(piece.expression.front());
        else add(piece.expression.front(), Use::command);
    }

    std::string function_;
    Dialect dialect_ = Dialect::classic;
    std::vector<std::string> own_;
};

} // namespace

std::vector<NameUse> name_uses(const Function& function) {
    UseCollector collector(*function.tree);
    for (const auto& value : function.tree->defaults) collector.node(value);
    collector.statements(function.tree->body);
    return std::move(collector.uses);
}

bool gives_value(const Function& function) {
    UseCollector collector(function.dialect); // which does not know the function: its name is one as others
    collector.statements(function.tree->body);
    return collector.gives_back || std::ranges::any_of(collector.uses, [&function](const NameUse& use) {
               return use.name == function.name && (use.use == Use::set || use.use == Use::element);
           });
}

std::vector<NameUse> name_uses(const Expression& expression) {
    UseCollector collector(expression.dialect);
    collector.statements(expression.tree->assignment);
    collector.node(expression.tree->value);
    return std::move(collector.uses);
}

} // namespace kaya::fish
