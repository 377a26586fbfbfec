#include "lang/fish/compiler.hpp"

#include "lang/fish/generator.hpp"
#include "lang/fish/parser.hpp"
#include "lang/fish/syntax.hpp"

#include <algorithm>

namespace kaya::fish {

Function read_function(const std::string& text, const Place& first) {
    ParsedFunction parsed = parse_function(text, first);
    Function function;
    function.name = parsed.tree.name;
    function.arguments = parsed.tree.arguments;
    function.least = static_cast<int>(parsed.tree.arguments.size() - parsed.tree.defaults.size());
    function.dialect = parsed.tree.dialect;
    function.whilestepping = parsed.whilestepping;
    function.mentions = outside_names(parsed.tree);
    function.place = parsed.tree.place;
    function.tree = std::make_shared<const FunctionTree>(std::move(parsed.tree));
    return function;
}

std::string generate(const Function& function, const Dictionary& dictionary) {
    return generate_function(*function.tree, dictionary);
}

namespace {

/// Commands have @ in front of names, and so may their expressions: @f(@x) is f(x). Columns are kept.
std::string without_marks(std::string text) {
    char quote = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quote) quote = c == quote ? 0 : quote;
        else if (c == '\'' || c == '"') quote = c;
        else if (c == '@' && i + 1 < text.size() && text[i + 1] != ' ' && text[i + 1] != '@') text[i] = ' ';
    }
    return text;
}

} // namespace

Dialect dialect_at(const Place& place) {
    if (!place.source || place.line < 1 || place.line > static_cast<int>(place.source->lines.size()))
        return Dialect::classic;
    const std::string& line = place.source->lines[static_cast<std::size_t>(place.line - 1)];
    const auto column = static_cast<std::size_t>(std::max(place.column, 1) - 1);
    return column < line.size() && line[column] == '[' ? Dialect::modern : Dialect::classic;
}

Expression read_expression(const std::string& text, const Place& place, Dialect dialect) {
    ExpressionTree tree = parse_expression_line(without_marks(text), place, dialect);
    Expression expression;
    expression.dialect = dialect;
    expression.mentions = outside_names(tree);
    expression.place = place;
    if (!tree.assignment.empty()) {
        const Node& target = tree.assignment.front().target;
        if (target.kind == NodeKind::name && !target.parentheses) expression.assigned = target.text;
    }
    expression.tree = std::make_shared<const ExpressionTree>(std::move(tree));
    return expression;
}

std::string generate(const Expression& expression, const Dictionary& dictionary) {
    return generate_expression(*expression.tree, dictionary);
}

} // namespace kaya::fish
