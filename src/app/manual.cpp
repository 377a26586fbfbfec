#include "app/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace kaya {

namespace {

/// The text with escapes for the letters that man pages interpret.
std::string escaped(std::string_view text) {
    std::string result;
    bool at_start = true;
    for (const char c : text) {
        if (at_start && (c == '.' || c == '\'')) result += "\\&";
        if (c == '\\') result += "\\e";
        else if (c == '-') result += "\\-";
        else result += c;
        at_start = c == '\n';
    }
    return result;
}

std::string item(const std::string& head, const std::string& text) {
    return fmt::format(".TP\n{}\n{}\n", head, escaped(text));
}

std::string bold(std::string_view text) { return "\\fB" + escaped(text) + "\\fR"; }

/// "kaya study [options] STUDY".
std::string synopsis(const ToolNode& node) {
    std::string line = bold(node.words.empty() ? "kaya" : "kaya " + node.words) + " [options]";
    if (!node.subcommands.empty() && !node.words.empty()) line += " [command]";
    for (const auto& option : node.options)
        if (option.argument)
            line += (option.required ? " \\fI" : " [\\fI") + escaped(option.names.front()) +
                    (option.required ? "\\fR" : "\\fR]");
    return line;
}

std::string options_of(const ToolNode& node) {
    std::string text;
    for (const auto& option : node.options) {
        std::vector<std::string> names;
        for (const auto& name : option.names)
            names.push_back(option.argument ? "\\fI" + escaped(name) + "\\fR"
                                            : bold(name) + (option.takes_value ? " \\fIvalue\\fR" : ""));
        text += item(fmt::format("{}", fmt::join(names, ", ")), option.help);
    }
    return text;
}

struct Line {
    const char* head;
    const char* text;
};

constexpr Line statuses[] = {
    {"0", "done"},
    {"1", "the deck or the command line is wrong; nothing has run when it is a word of the deck"},
    {"2", "the deck could be read, and the run failed or was stopped"},
    {"3", "a fault of kaya itself: please report it with the deck"},
    {"141", "the reader of the results has closed them"},
};

constexpr Line variables[] = {
    {"KAYA_JOINTS", "folders with joint and zone models, with colons between them"},
    {"KAYA_INCLUDE",
     "the folder with the headers kaya/... for 'jmodel build' and 'zmodel build', in place of the installed ones"},
    {"KAYA_HISTORY", "the file in which the prompt keeps its lines"},
    {"CXX", "the compiler of 'jmodel build' and 'zmodel build'"},
    {"NO_COLOR", "if set, messages have no colours"},
    {"XDG_CONFIG_HOME, XDG_CACHE_HOME, XDG_STATE_HOME",
     "where what is allowed, compiled headers and the lines of the prompt are kept"},
};

template <std::size_t n> std::string items(const Line (&lines)[n]) {
    std::string text;
    for (const auto& line : lines) text += item(bold(line.head), line.text);
    return text;
}

} // namespace

std::string manual_page(const std::vector<ToolNode>& tree, const std::string& version) {
    std::string text = fmt::format(".TH KAYA 1 \"\" \"kaya {}\" \"kaya\"\n.SH NAME\nkaya \\- three\\-dimensional "
                                   "distinct element program for jointed rock and masonry\n.SH SYNOPSIS\n",
                                   escaped(version));
    for (const auto& node : tree) text += synopsis(node) + "\n.br\n";
    text += ".SH DESCRIPTION\n" + escaped(tree.front().help) + "\n.SH OPTIONS OF A RUN\n" + options_of(tree.front());
    text += ".SH COMMANDS\n";
    for (const auto& node : tree)
        if (!node.words.empty())
            text += fmt::format(".SS kaya {}\n{}.\n{}", escaped(node.words), escaped(node.help), options_of(node));
    text += ".SH EXIT STATUS\n" + items(statuses);
    text += ".SH ENVIRONMENT\n" + items(variables);
    text += ".SH SEE ALSO\n" + bold("kaya help") + " explains the commands of decks, " + bold("kaya explain") +
            " the codes of messages.\n";
    return text;
}

} // namespace kaya
