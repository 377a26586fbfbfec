#include "app/tool_tree.hpp"

namespace kaya {

namespace {

ToolOption row_of(const CLI::Option& option) {
    ToolOption row;
    row.argument = option.get_positional();
    if (row.argument) row.names.push_back(option.get_name());
    else {
        for (const auto& name : option.get_lnames()) row.names.push_back("--" + name);
        for (const auto& name : option.get_snames()) row.names.push_back("-" + name);
    }
    row.help = option.get_description();
    row.takes_value = option.get_items_expected_max() > 0;
    row.required = option.get_required();
    return row;
}

void add(const CLI::App& app, const std::string& words, std::vector<ToolNode>& tree) {
    ToolNode node{words, app.get_description(), {}, {}};
    const auto subcommands = app.get_subcommands([](const CLI::App*) { return true; });
    for (const auto* command : subcommands) node.subcommands.push_back(command->get_name());
    for (const auto* option : app.get_options()) node.options.push_back(row_of(*option));
    tree.push_back(std::move(node));
    for (const auto* command : subcommands)
        add(*command, words.empty() ? command->get_name() : words + " " + command->get_name(), tree);
}

} // namespace

std::vector<ToolNode> tool_tree(const CLI::App& app) {
    std::vector<ToolNode> tree;
    add(app, "", tree);
    return tree;
}

} // namespace kaya
