#include "lang/fish/generator.hpp"

#include "lang/fish/expression_generator.hpp"

#include <fmt/format.h>

namespace kaya::fish {

namespace {

/// Lua allows 200 locals in a function; loops need some of them.
constexpr std::size_t most_locals = 100;

class FunctionGenerator {
public:
    FunctionGenerator(const FunctionTree& tree, const Dictionary& dictionary)
        : tree_(tree), scope_(scope_of(tree)), expressions_(scope_, dictionary), line_(tree.place.line) {
        if (tree.dialect == Dialect::modern) note_changed(tree.body);
    }

    std::string generate() {
        text_ = "return function(";
        bool first = true;
        for (const auto& argument : tree_.arguments) {
            text_ += (first ? "" : ", ") + parameter(argument);
            first = false;
        }
        text_ += ") local v_return = 0; ";
        if (!tree_.defaults.empty()) text_ += default_values();
        if (!scope_.spilled.empty()) {
            text_ += "local S = {";
            for (const auto& name : scope_.spilled) text_ += fmt::format("[{}] = 0, ", lua_string(name));
            text_ += "}; ";
        }
        for (std::size_t i = 0; i < tree_.arguments.size(); ++i)
            if (scope_.spilled.contains(tree_.arguments[i]))
                text_ += fmt::format("S[{}] = {}; ", lua_string(tree_.arguments[i]), parameter(tree_.arguments[i]));
        for (const auto& argument : tree_.arguments) // a list that it changes is not that of the caller
            if (changed_.contains(argument) && scope_.locals.contains(argument))
                text_ += fmt::format("v_{0} = R.own(v_{0}); ", argument);
        for (const auto& local : tree_.locals)
            if (scope_.locals.contains(local)) text_ += fmt::format("local v_{} = 0; ", local);
        block(tree_.body);
        at_line(tree_.last_line);
        text_ += "return v_return end";
        return fmt::format("local G, F, A, W, R = ...; {}{}", expressions_.shared_built_ins(), text_);
    }

private:
    /// Names that Lua cannot spell live in the table of spilled locals.
    static bool is_lua_name(const std::string& name) { return member("v_" + name)[0] == '.'; }

    /// Values of arguments that a call leaves out.
    std::string default_values() const {
        std::string text;
        const std::size_t first = tree_.arguments.size() - tree_.defaults.size();
        for (std::size_t i = 0; i < tree_.defaults.size(); ++i)
            text += fmt::format("if {0} == nil then {0} = {1} end ", parameter(tree_.arguments[first + i]),
                                expressions_.value(tree_.defaults[i]));
        return text;
    }

    /// Names whose elements or members a statement sets.
    void note_changed(const std::vector<Statement>& body) {
        for (const auto& s : body) {
            const Node* root = &s.target;
            while (root->kind == NodeKind::member) root = &root->children[0];
            if (root != &s.target || root->parentheses) changed_.insert(root->text);
            note_changed(s.body);
            for (const auto& branch : s.branches) note_changed(branch.body);
        }
    }

    static Scope scope_of(const FunctionTree& tree) {
        Scope scope;
        scope.dialect = tree.dialect;
        scope.function = tree.name;
        for (const auto* names : {&tree.arguments, &tree.locals})
            for (const auto& name : *names) {
                const bool fits = is_lua_name(name) && scope.locals.size() < most_locals;
                (fits ? scope.locals : scope.spilled).insert(name);
            }
        return scope;
    }

    std::string parameter(const std::string& name) const {
        if (is_lua_name(name)) return "v_" + name;
        for (std::size_t i = 0; i < tree_.arguments.size(); ++i)
            if (tree_.arguments[i] == name) return fmt::format("p_{}", i);
        return "p_";
    }

    /// Lua line k is deck line k + first - 1: that is how run-time errors find their line.
    void at_line(int line) {
        while (line_ < line) {
            text_ += '\n';
            ++line_;
        }
    }

    void block(const std::vector<Statement>& body) {
        for (const auto& statement : body) {
            at_line(statement.place.line);
            this->statement(statement);
        }
    }

    void statement(const Statement& s) {
        switch (s.kind) {
        case StatementKind::nothing: break;
        case StatementKind::assign:
            text_ += expressions_.assignment(s.target, expressions_.owned(s.value), s.one_each) + "; ";
            break;
        case StatementKind::evaluate: text_ += fmt::format("do local _ = {} end ", expressions_.value(s.value)); break;
        case StatementKind::array: array(s); break;
        case StatementKind::loop_range: loop_range(s); break;
        case StatementKind::loop_while: loop_while(s); break;
        case StatementKind::loop_each: loop_each(s); break;
        case StatementKind::loop_for: loop_for(s); break;
        case StatementKind::branches: branches(s); break;
        case StatementKind::choice: choice(s); break;
        case StatementKind::section: section(s); break;
        case StatementKind::exit_function: text_ += "do return v_return end "; break;
        case StatementKind::exit_loop: text_ += "break "; break;
        case StatementKind::exit_section: text_ += fmt::format("goto section_{} ", sections_.back()); break;
        case StatementKind::next_round: text_ += fmt::format("goto round_{} ", rounds_.back()); break;
        case StatementKind::give_back: text_ += fmt::format("do return {} end ", expressions_.value(s.value)); break;
        case StatementKind::command: commands(s); break;
        case StatementKind::structure: structure(s); break;
        }
    }

    void array(const Statement& s) {
        Node whole = s.target;
        whole.children.clear();
        whole.parentheses = false;
        const std::string made = fmt::format("R.array({}, {}, {})", lua_string(s.target.text),
                                             expressions_.value(whole), expressions_.list(s.target.children));
        text_ += expressions_.assignment(whole, made) + "; ";
    }

    /// The body, and after it the label to which `continue` jumps.
    void round(const Statement& s) {
        rounds_.push_back(++labels_);
        const int label = labels_;
        text_ += "do ";
        block(s.body);
        text_ += fmt::format("end ::round_{}:: ", label);
        rounds_.pop_back();
        at_line(s.last_line);
    }

    void loop_range(const Statement& s) {
        // The limits are evaluated once; the body may change the loop variable, as it may in FISH.
        text_ += fmt::format("do local last = {}; ", expressions_.value(s.expressions[1]));
        text_ += s.expressions.size() == 3
                     ? fmt::format("local step = R.step({}); ", expressions_.value(s.expressions[2]))
                     : "local step = 1; ";
        text_ += expressions_.assignment(s.target, expressions_.value(s.expressions[0])) + "; ";
        const std::string variable = expressions_.value(s.target);
        const std::string test = s.expressions.size() == 3
                                     ? fmt::format("(step > 0 and {0} <= last) or (step < 0 and {0} >= last)", variable)
                                     : fmt::format("{} <= last", variable);
        text_ += fmt::format("while {} do ", test);
        round(s);
        text_ += expressions_.assignment(s.target, variable + " + step") + " end end ";
    }

    void loop_while(const Statement& s) {
        text_ += fmt::format("while {} do ", expressions_.condition(s.value));
        round(s);
        text_ += "end ";
    }

    void loop_each(const Statement& s) {
        text_ += fmt::format("do local members = R.{}({}); for at = 1, #members do local member = members[at] ",
                             expressions_.is_fresh(s.value) ? "fresh_members" : "members", expressions_.value(s.value));
        const bool changed = changed_.contains(s.target.text);
        text_ += expressions_.assignment(s.target, changed ? "R.own(member)" : "member") + "; ";
        round(s);
        text_ += "end end ";
    }

    void loop_for(const Statement& s) {
        statement(s.init.front());
        text_ += fmt::format("while {} do ", expressions_.condition(s.value));
        round(s);
        statement(s.step.front());
        text_ += "end ";
    }

    void branches(const Statement& s) {
        bool first = true;
        for (const auto& branch : s.branches) {
            at_line(branch.place.line);
            if (branch.condition.empty()) text_ += "else ";
            else
                text_ += fmt::format("{} {} then ", first ? "if" : "elseif",
                                     expressions_.condition(branch.condition.front()));
            block(branch.body);
            first = false;
        }
        at_line(s.last_line);
        text_ += "end ";
    }

    void choice(const Statement& s) {
        text_ += fmt::format("do local chosen = {}; ", expressions_.value(s.value));
        if (s.branches.empty()) {
            block(s.body);
            text_ += "end ";
            return;
        }
        // The statements before the first `case` run when no case fits. Their lines come first in the deck, and so in the Lua text: the
        // test whether any case fits is made before them.
        const bool has_default = !s.body.empty();
        if (has_default) {
            text_ += "local fits = ";
            for (const auto& branch : s.branches)
                text_ += fmt::format("{}chosen == {}", &branch == &s.branches.front() ? "" : " or ",
                                     expressions_.value(branch.condition.front()));
            text_ += "; if not fits then ";
            block(s.body);
        }
        bool first = !has_default;
        for (const auto& branch : s.branches) {
            at_line(branch.place.line);
            text_ += fmt::format("{} chosen == {} then ", first ? "if" : "elseif",
                                 expressions_.value(branch.condition.front()));
            block(branch.body);
            first = false;
        }
        at_line(s.last_line);
        text_ += "end end ";
    }

    void section(const Statement& s) {
        sections_.push_back(++labels_);
        const int label = labels_;
        text_ += "do do ";
        block(s.body);
        text_ += fmt::format("end ::section_{}:: end ", label);
        sections_.pop_back();
        at_line(s.last_line);
    }

    void commands(const Statement& s) {
        for (const auto& line : s.commands) {
            at_line(line.line);
            if (line.evaluated) {
                const Node& value = line.pieces.front().expression.front();
                text_ +=
                    line.target.empty()
                        ? fmt::format("do local _ = {} end ", expressions_.value(value))
                        : expressions_.assignment(line.target.front(), expressions_.owned(value), line.one_each) + "; ";
                continue;
            }
            std::string joined;
            for (const auto& piece : line.pieces) {
                const bool put_in =
                    !piece.expression.empty() && (piece.text.empty() || scope_.is_local(piece.expression.front().text));
                joined += (joined.empty() ? "" : " .. ") +
                          (put_in ? fmt::format("R.word({})", expressions_.value(piece.expression.front()))
                                  : lua_string(piece.text));
            }
            text_ += fmt::format("R.command({}, {}); ", joined, line.line);
        }
        at_line(s.last_line);
    }

    void structure(const Statement& s) {
        text_ += fmt::format("R.define_structure({}", lua_string(s.target.text));
        for (const auto& member : s.target.children) text_ += ", " + lua_string(member.text);
        text_ += "); ";
    }

    const FunctionTree& tree_;
    std::set<std::string> changed_; ///< names whose elements or members the function sets
    Scope scope_;
    ExpressionGenerator expressions_;
    std::string text_;
    int line_;
    int labels_ = 0;
    std::vector<int> rounds_, sections_;
};

/// Collects the names of a tree.
class NameCollector {
public:
    explicit NameCollector(Dialect dialect) : dialect_(dialect) {}

    void node(const Node& node) {
        if (node.kind == NodeKind::name && !(dialect_ == Dialect::modern && makes_value(node.text)))
            names.insert(node.text);
        for (const auto& child : node.children) this->node(child);
    }

    void statements(const std::vector<Statement>& body) {
        for (const auto& s : body) statement(s);
    }

    void statement(const Statement& s) {
        if (s.kind == StatementKind::structure) return;
        if (!s.target.text.empty()) node(s.target);
        node(s.value);
        for (const auto& expression : s.expressions) node(expression);
        for (const auto* part : {&s.body, &s.init, &s.step}) statements(*part);
        for (const auto& branch : s.branches) {
            for (const auto& condition : branch.condition) node(condition);
            statements(branch.body);
        }
        for (const auto& line : s.commands) {
            for (const auto& target : line.target) node(target);
            for (const auto& piece : line.pieces)
                // A name that the command reads itself is not a variable of this function.
                if (!piece.expression.empty() && piece.text.empty()) node(piece.expression.front());
        }
    }

    std::set<std::string> names;

private:
    Dialect dialect_;
};

} // namespace

std::string generate_function(const FunctionTree& tree, const Dictionary& dictionary) {
    return FunctionGenerator(tree, dictionary).generate();
}

std::string generate_expression(const ExpressionTree& tree, const Dictionary& dictionary) {
    Scope scope;
    scope.dialect = tree.dialect;
    const ExpressionGenerator expressions(scope, dictionary);
    std::string body;
    if (tree.assignment.empty()) {
        body = fmt::format("return {}", expressions.value(tree.value));
    } else {
        const Statement& s = tree.assignment.front();
        body = fmt::format("local given = {}; {}; return given", expressions.owned(s.value),
                           expressions.assignment(s.target, "given", s.one_each));
    }
    return fmt::format("local G, F, A, W, R = ...; {}return function() {} end", expressions.shared_built_ins(), body);
}

std::vector<std::string> outside_names(const FunctionTree& tree) {
    NameCollector collector(tree.dialect);
    collector.statements(tree.body);
    for (const auto& value : tree.defaults) collector.node(value);
    for (const auto& name : tree.arguments) collector.names.erase(name);
    for (const auto& name : tree.locals) collector.names.erase(name);
    return {collector.names.begin(), collector.names.end()};
}

std::vector<std::string> outside_names(const ExpressionTree& tree) {
    NameCollector collector(tree.dialect);
    collector.node(tree.value);
    collector.statements(tree.assignment);
    return {collector.names.begin(), collector.names.end()};
}

} // namespace kaya::fish
