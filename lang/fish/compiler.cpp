#include "lang/fish/compiler.hpp"

#include "lang/fish/generator.hpp"
#include "lang/fish/parser.hpp"

namespace kaya::fish {

Function read_function(const std::string& text, const Place& first) {
    ParsedFunction parsed = parse_function(text, first);
    Function function;
    function.name = parsed.tree.name;
    function.arguments = parsed.tree.arguments;
    function.whilestepping = parsed.whilestepping;
    function.mentions = outside_names(parsed.tree);
    function.place = parsed.tree.place;
    function.tree = std::make_shared<const FunctionTree>(std::move(parsed.tree));
    return function;
}

std::string generate(const Function& function, const Dictionary& dictionary) {
    return generate_function(*function.tree, dictionary);
}

Expression read_expression(const std::string& text, const Place& place) {
    ExpressionTree tree = parse_expression_line(text, place);
    Expression expression;
    expression.mentions = outside_names(tree);
    expression.place = place;
    if (!tree.assignment.empty() && !tree.assignment.front().target.parentheses)
        expression.assigned = tree.assignment.front().target.text;
    expression.tree = std::make_shared<const ExpressionTree>(std::move(tree));
    return expression;
}

std::string generate(const Expression& expression, const Dictionary& dictionary) {
    return generate_expression(*expression.tree, dictionary);
}

} // namespace kaya::fish
