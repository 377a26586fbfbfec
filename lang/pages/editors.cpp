// editor_files FOLDER [--check]: writes what editors and the fuzzer need of the command tables. With --check nothing
// is written, and the status is 1 when a file does not agree with the tables.
//
//   vscode/syntaxes/kaya.tmLanguage.json   grammar for Visual Studio Code
//   vscode/snippets/kaya.json              commands with what they take, for completion in Visual Studio Code
//   vscode/words.json                      words for completion: commands, their forms and keywords, with help
//   vim/syntax/kaya.vim                    syntax file for Vim
//   fuzz/kaya.dict                         words for a fuzzer that reads dictionaries of libFuzzer or AFL++
#include "lang/commands/language.hpp"
#include "lang/interp/help.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using namespace kaya::lang;

using Words = std::set<std::string>;

void add(Words& to, const std::vector<Spelling>& spellings) {
    for (const Spelling& s : spellings)
        if (s.word != "@") to.insert(std::string(s.word));
}

void add(Words& to, const std::vector<KeywordSpec>& keywords) {
    for (const auto& keyword : keywords) {
        add(to, keyword.words);
        add(to, keyword.keywords);
    }
}

/// Words that begin a line, and all others.
struct Vocabulary {
    Words commands, keywords, elements;
    std::map<std::string, std::size_t> shortest; ///< of commands: letters that are enough

    explicit Vocabulary(const Language& language) {
        for (const auto& family : language.families)
            for (const auto& command : family.commands) {
                add(commands, command.words);
                for (const Spelling& s : command.words)
                    if (s.word != "@") shortest[std::string(s.word)] = s.shortest;
                add(keywords, command.form);
                add(keywords, command.keywords);
            }
        add(elements, language.range_elements);
    }
};

const std::vector<std::string> fish_words = {
    "array",     "argument", "case",      "case_of",    "caseof",     "command",   "continue",   "def",
    "define",    "else",     "elseif",    "end",        "endcase",    "endcommand", "endif",     "endloop",
    "endsection", "end_case", "end_command", "end_if",  "end_loop",   "end_section", "exit",      "foreach",
    "for",       "global",   "if",        "local",      "loop",       "null",      "return",     "section",
    "then",      "while",    "whilestepping", "while_stepping"};

std::string json(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + "\"";
}

/// "brick" with two letters enough: "br(?:i(?:c(?:k)?)?)?".
std::string shortened(const std::string& word, std::size_t shortest) {
    std::string out = word.substr(0, shortest), close;
    for (std::size_t i = shortest; i < word.size(); ++i) {
        out += fmt::format("(?:{}", word[i]);
        close += ")?";
    }
    return out + close;
}

std::string alternatives(const Words& words) {
    // The longest first: the first that fits is taken.
    std::vector<std::string> sorted(words.begin(), words.end());
    std::ranges::stable_sort(sorted, [](const auto& a, const auto& b) { return a.size() > b.size(); });
    return fmt::format("{}", fmt::join(sorted, "|"));
}

std::string vscode_grammar(const Vocabulary& words) {
    std::vector<std::string> commands;
    for (const auto& [word, shortest] : words.shortest) commands.push_back(shortened(word, shortest));
    const auto pattern = [](std::string_view name, const std::string& match) {
        return fmt::format("    {{ \"name\": {}, \"match\": {} }}", json(name), json(match));
    };
    const std::vector<std::string> patterns = {
        pattern("comment.line.semicolon.kaya", ";.*$"),
        "    { \"name\": \"string.quoted.single.kaya\", \"begin\": \"'\", \"end\": \"'|$\" }",
        "    { \"name\": \"string.quoted.double.kaya\", \"begin\": \"\\\"\", \"end\": \"\\\"|$\" }",
        pattern("keyword.control.kaya", fmt::format("(?i)^\\s*(?:{})\\b", fmt::join(fish_words, "|"))),
        pattern("support.function.kaya", fmt::format("(?i)^\\s*(?:{})\\b", fmt::join(commands, "|"))),
        pattern("keyword.other.range.kaya", fmt::format("(?i)\\b(?:range|{})\\b", alternatives(words.elements))),
        pattern("support.type.property-name.kaya", fmt::format("(?i)\\b(?:{})\\b", alternatives(words.keywords))),
        pattern("variable.other.kaya", "@[A-Za-z_$][A-Za-z0-9_$]*"),
        pattern("constant.numeric.kaya", "[-+]?(?<![A-Za-z_])(?:[0-9]+\\.?[0-9]*|\\.[0-9]+)(?:[eE][-+]?[0-9]+)?"),
        pattern("keyword.operator.continuation.kaya", "(?:&|\\.\\.\\.)\\s*(?=;|$)"),
    };
    return fmt::format("{{\n  \"name\": \"kaya\",\n  \"scopeName\": \"source.kaya\",\n  \"fileTypes\": [\"3dd\", \"dat\", "
                       "\"3ddat\", \"fis\"],\n  \"patterns\": [\n{}\n  ]\n}}\n",
                       fmt::join(patterns, ",\n"));
}

std::string completion_words(const Language& language) {
    std::vector<std::string> entries;
    const auto entry = [&](std::string_view label, std::string_view of, std::string_view help) {
        entries.push_back(fmt::format("  {{ \"label\": {}, \"of\": {}, \"help\": {} }}", json(label), json(of),
                                      json(help)));
    };
    for (const auto& family : language.families)
        for (const auto& command : family.commands) {
            if (command.support == Support::not_yet || command.words.front().word == "@") continue;
            entry(command.name(), "", command.help);
            for (const auto& keyword : command.keywords)
                if (keyword.support != Support::not_yet)
                    entry(keyword.words.front().word, command.name(), keyword.help);
        }
    for (const auto& element : language.range_elements)
        if (element.support != Support::not_yet) entry(element.words.front().word, "range", element.help);
    return fmt::format("[\n{}\n]\n", fmt::join(entries, ",\n"));
}

/// What a snippet must not take as its own.
std::string literal(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '$' || c == '}' || c == '\\') out += '\\';
        out += c;
    }
    return out;
}

/// A command with its values as places to be filled in.
std::string snippets(const Language& language) {
    std::vector<std::string> entries;
    for (const auto& family : language.families)
        for (const auto& command : family.commands) {
            if (command.support == Support::not_yet || command.words.front().word == "@") continue;
            std::string body = command.name();
            int place = 0;
            for (const auto& positional : command.arguments)
                if (!positional.argument.optional)
                    body += fmt::format(" ${{{}:{}}}", ++place, literal(positional.argument.name));
            if (command.range_elements) body += " $0";
            entries.push_back(fmt::format("  {}: {{ \"prefix\": {}, \"body\": {}, \"description\": {} }}",
                                          json(command.name()), json(command.name()), json(body),
                                          json(command.help)));
        }
    // Two forms of one name (lua with and without a file) cannot both be keys.
    std::vector<std::string> kept;
    for (const auto& entry : entries) {
        const auto key = entry.substr(0, entry.find(": {"));
        if (std::ranges::none_of(kept, [&](const auto& other) { return other.starts_with(key + ":"); }))
            kept.push_back(entry);
    }
    return fmt::format("{{\n{}\n}}\n", fmt::join(kept, ",\n"));
}

std::string vim_syntax(const Vocabulary& words) {
    std::string text = "\" Vim syntax file of kaya decks, made from the command tables by editor_files.\n"
                       "if exists(\"b:current_syntax\")\n  finish\nendif\nsyntax case ignore\n"
                       "setlocal iskeyword=@,48-57,_,-\n";
    for (const auto& [word, shortest] : words.shortest) {
        // Vim's own way of saying how much of a word is enough; words with other signs stand in full.
        const std::string shape = shortest < word.size() && word.find('-') == std::string::npos
                                      ? fmt::format("{}[{}]", word.substr(0, shortest), word.substr(shortest))
                                      : word;
        text += fmt::format("syntax keyword kayaCommand {}\n", shape);
    }
    for (const auto& word : words.keywords) text += fmt::format("syntax keyword kayaKeyword {}\n", word);
    text += "syntax keyword kayaRange range\n";
    for (const auto& word : words.elements) text += fmt::format("syntax keyword kayaRange {}\n", word);
    text += fmt::format("syntax keyword kayaFish {}\n", fmt::join(fish_words, " "));
    return text + "syntax match kayaNumber /\\<[-+]\\?\\d\\+\\.\\?\\d*\\([eE][-+]\\?\\d\\+\\)\\?\\>/\n"
                  "syntax match kayaVariable /@\\h\\w*/\n"
                  "syntax match kayaContinued /\\(&\\|\\.\\.\\.\\)\\s*$/\n"
                  "syntax region kayaText start=/'/ end=/'\\|$/\n"
                  "syntax region kayaText start=/\"/ end=/\"\\|$/\n"
                  "syntax match kayaComment /;.*$/\n"
                  "highlight default link kayaCommand Statement\n"
                  "highlight default link kayaKeyword Identifier\n"
                  "highlight default link kayaRange Type\n"
                  "highlight default link kayaFish Keyword\n"
                  "highlight default link kayaNumber Number\n"
                  "highlight default link kayaVariable PreProc\n"
                  "highlight default link kayaContinued Special\n"
                  "highlight default link kayaText String\n"
                  "highlight default link kayaComment Comment\n"
                  "let b:current_syntax = \"kaya\"\n";
}

std::string fuzz_dictionary(const Vocabulary& words) {
    Words all = words.commands;
    all.insert(words.keywords.begin(), words.keywords.end());
    all.insert(words.elements.begin(), words.elements.end());
    all.insert(fish_words.begin(), fish_words.end());
    all.insert({"range", "not", "&\n", "...\n", "@a", "[a]", "1e-6", "-1", "\n", "'a b'", "on", "off"});
    std::string text = "# Words of decks, made from the command tables by editor_files.\n";
    for (const auto& word : all) {
        std::string escaped;
        for (const char c : word) escaped += c == '\n' ? std::string("\\x0a") : std::string(1, c);
        text += fmt::format("\"{}\"\n", escaped);
    }
    return text;
}

std::string contents(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace

int main(int argc, char** argv) {
    const bool check = argc == 3 && std::string_view(argv[2]) == "--check";
    if (argc != 2 && !check) {
        std::cerr << "usage: editor_files FOLDER [--check]\n";
        return 2;
    }
    const fs::path folder = argv[1];
    const Language& language = classic();
    const Vocabulary words(language);
    const std::map<std::string, std::string> wanted = {
        {"vscode/syntaxes/kaya.tmLanguage.json", vscode_grammar(words)},
        {"vscode/snippets/kaya.json", snippets(language)},
        {"vscode/words.json", completion_words(language)},
        {"vim/syntax/kaya.vim", vim_syntax(words)},
        {"fuzz/kaya.dict", fuzz_dictionary(words)},
    };
    int status = 0;
    for (const auto& [name, text] : wanted) {
        const fs::path file = folder / name;
        if (contents(file) == text) continue;
        if (check) {
            std::cout << name << " does not agree with the tables: run editor_files editors\n";
            status = 1;
            continue;
        }
        fs::create_directories(file.parent_path());
        if (!(std::ofstream(file) << text)) {
            std::cerr << "cannot write " << file << '\n';
            return 2;
        }
    }
    return status;
}
