#include "app/shell_completion.hpp"

#include "guide/explanations.hpp"
#include "base/diagnostic.hpp"
#include "lang/modern/language.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>

namespace kaya {

namespace {

/// Text in single quotes, as each of the shells reads it.
std::string quoted(std::string_view text, std::string_view quote) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string(quote) : std::string(1, c);
    return result + "'";
}
std::string for_sh(std::string_view text) { return quoted(text, "'\\''"); }
std::string for_fish(std::string_view text) { return quoted(text, "\\'"); }

std::vector<std::string> command_words() {
    std::vector<std::string> words;
    for (const auto& family : lang::language().families)
        for (const auto& command : family.commands) words.emplace_back(command.words.front().word);
    std::sort(words.begin(), words.end());
    words.erase(std::unique(words.begin(), words.end()), words.end());
    return words;
}

/// The first word of each line.
std::vector<std::string> message_codes() {
    std::istringstream lines(code_list());
    std::vector<std::string> words;
    for (std::string line; std::getline(lines, line);)
        if (!line.empty() && line.front() != ' ') words.push_back(line.substr(0, line.find(' ')));
    return words;
}

/// Words other than subcommands and options that an argument takes; where there are none it takes files.
std::vector<std::string> values_of(const ToolNode& node) {
    if (node.words == "help") return command_words();
    if (node.words == "explain") return message_codes();
    if (node.words == "completion") return completed_shells();
    return {};
}

std::vector<std::string> option_words(const ToolNode& node) {
    std::vector<std::string> words;
    for (const auto& option : node.options)
        if (!option.argument) words.insert(words.end(), option.names.begin(), option.names.end());
    return words;
}

/// "''|check|'study show'": the patterns of all subcommands, each behind the words before it.
std::string subcommand_patterns(const std::vector<ToolNode>& tree) {
    std::vector<std::string> patterns;
    for (const auto& node : tree)
        for (const auto& name : node.subcommands) patterns.push_back(for_sh(node.words + "/" + name));
    return fmt::format("{}", fmt::join(patterns, "|"));
}

std::string for_bash(const std::vector<ToolNode>& tree) {
    std::string text =
        fmt::format(R"(# Completion of kaya's command line for bash. In ~/.bashrc: source <(kaya completion bash)
_kaya() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} at= words= options= i
    for ((i = 1; i < COMP_CWORD; ++i)); do
        case "$at/${{COMP_WORDS[i]}}" in
            {}) at+="${{at:+ }}${{COMP_WORDS[i]}}" ;;
        esac
    done
    case $at in
)",
                    subcommand_patterns(tree));
    for (const auto& node : tree) {
        auto words = node.subcommands;
        for (auto& value : values_of(node)) words.push_back(std::move(value));
        text += fmt::format("        {}) words={} options={} ;;\n", for_sh(node.words),
                            for_sh(fmt::format("{}", fmt::join(words, " "))),
                            for_sh(fmt::format("{}", fmt::join(option_words(node), " "))));
    }
    return text + R"(    esac
    if [[ $word == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
    else
        mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word"; compgen -f -- "$word")
    fi
}
complete -o filenames -F _kaya kaya
)";
}

std::string for_zsh(const std::vector<ToolNode>& tree) {
    std::string text = fmt::format(R"(#compdef kaya
# Completion of kaya's command line for zsh. In ~/.zshrc, after compinit: source <(kaya completion zsh)
_kaya() {{
    local at= i
    local -a names flags
    for ((i = 2; i < CURRENT; ++i)); do
        case "$at/$words[i]" in
            {}) at+="${{at:+ }}$words[i]" ;;
        esac
    done
    case $at in
)",
                                   subcommand_patterns(tree));
    for (const auto& node : tree) {
        text += fmt::format("        {})", for_sh(node.words));
        for (const auto& name : node.subcommands) {
            const std::string whole = node.words.empty() ? name : node.words + " " + name;
            const auto sub = std::find_if(tree.begin(), tree.end(), [&](const auto& n) { return n.words == whole; });
            text += fmt::format(" names+={}", "(" + for_sh(name + ":" + sub->help) + ")");
        }
        for (const auto& value : values_of(node)) text += fmt::format(" names+=({})", for_sh(value));
        for (const auto& option : node.options)
            for (const auto& name : option.names)
                if (!option.argument) text += fmt::format(" flags+=({})", for_sh(name + ":" + option.help));
        text += " ;;\n";
    }
    return text + R"(    esac
    if [[ $words[CURRENT] == -* ]]; then
        _describe -o option flags
    else
        _describe word names
        _files
    fi
}
if [[ $funcstack[1] == _kaya ]]; then _kaya "$@"; else compdef _kaya kaya; fi
)";
}

/// True in fish when the words of the node, and none of its subcommands, have been typed.
std::string typed(const ToolNode& node) {
    std::vector<std::string> parts;
    std::istringstream words(node.words);
    for (std::string word; words >> word;) parts.push_back("__fish_seen_subcommand_from " + word);
    if (!node.subcommands.empty())
        parts.push_back(fmt::format("not __fish_seen_subcommand_from {}", fmt::join(node.subcommands, " ")));
    return fmt::format("{}", fmt::join(parts, "; and "));
}

std::string for_fish_shell(const std::vector<ToolNode>& tree) {
    std::string text = "# Completion of kaya's command line for fish. In ~/.config/fish/config.fish: kaya completion "
                       "fish | source\n";
    for (const auto& node : tree) {
        const std::string where = fmt::format("complete -c kaya -n {}", for_fish(typed(node)));
        for (const auto& name : node.subcommands) {
            const std::string whole = node.words.empty() ? name : node.words + " " + name;
            const auto sub = std::find_if(tree.begin(), tree.end(), [&](const auto& n) { return n.words == whole; });
            text += fmt::format("{} -a {} -d {}\n", where, name, for_fish(sub->help));
        }
        for (const auto& value : values_of(node)) text += fmt::format("{} -a {}\n", where, for_fish(value));
        for (const auto& option : node.options) {
            if (option.argument) continue;
            text += where;
            for (const auto& name : option.names)
                text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            text += fmt::format("{} -d {}\n", option.takes_value ? " -r" : "", for_fish(option.help));
        }
    }
    return text;
}

struct Shell {
    const char* name;
    std::string (*script)(const std::vector<ToolNode>&);
};

constexpr Shell shells[] = {{"bash", for_bash}, {"zsh", for_zsh}, {"fish", for_fish_shell}};

} // namespace

std::vector<std::string> completed_shells() {
    std::vector<std::string> names;
    for (const auto& shell : shells) names.emplace_back(shell.name);
    return names;
}

std::string completion_script(const std::vector<ToolNode>& tree, std::string_view name) {
    for (const auto& shell : shells)
        if (shell.name == name) return shell.script(tree);
    throw Diagnostic(fmt::format("there is no completion for the shell '{}'", name),
                     fmt::format("one of: {}", fmt::join(completed_shells(), ", ")));
}

} // namespace kaya
