#include "lang/fish/inner_commands.hpp"

#include "lang/fish/syntax.hpp"

#include <string_view>

namespace kaya::fish {

namespace {

bool joined(const CommandLine& line) {
    constexpr std::string_view separators = " \t(),=\n";
    for (std::size_t i = 0; i < line.pieces.size(); ++i) {
        if (line.pieces[i].expression.empty() || !line.pieces[i].text.empty()) continue; // text, or @name
        const auto* before = i > 0 ? &line.pieces[i - 1].text : nullptr;
        const auto* rest = i + 1 < line.pieces.size() ? &line.pieces[i + 1].text : nullptr;
        if (before && !before->empty() && separators.find(before->back()) == separators.npos) return true;
        if (rest && !rest->empty() && separators.find(rest->front()) == separators.npos) return true;
    }
    return false;
}

void gather(const std::vector<Statement>& statements, std::vector<InnerCommand>& to) {
    for (const auto& statement : statements) {
        for (const auto& line : statement.commands) to.push_back({line.line, joined(line)});
        gather(statement.body, to);
        for (const auto& branch : statement.branches) gather(branch.body, to);
    }
}

} // namespace

std::vector<InnerCommand> inner_commands(const Function& function) {
    std::vector<InnerCommand> all;
    gather(function.tree->body, all);
    return all;
}

} // namespace kaya::fish
