// editor_files FOLDER [--check]: writes what editors and the fuzzer need of the command tables. With --check nothing
// is written, and the status is 1 when a file does not agree with the tables.
//
//   vscode/syntaxes/kaya.tmLanguage.json   grammar for Visual Studio Code
//   vscode/snippets/kaya.json              commands with what they take, for completion in Visual Studio Code
//   vscode/words.json                      words for completion: commands, their forms and keywords, with help
//   vim/syntax/kaya.vim                    syntax file for Vim
//   fuzz/kaya.dict                         words for a fuzzer that reads dictionaries of libFuzzer or AFL++
#include "lang/commands/language.hpp"
#include "lang/interp/binder.hpp"
#include "lang/interp/help.hpp"
#include "lang/modern/language.hpp"
#include "system/generated_files.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iostream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using namespace kaya::lang;

using Json = nlohmann::ordered_json;
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

    explicit Vocabulary(const std::vector<const Language*>& dialects) {
        for (const Language* dialect : dialects) learn(*dialect);
    }

private:
    void learn(const Language& language) {
        for (const auto& family : language.families)
            for (const auto& command : family.commands) {
                add(commands, command.words);
                for (const Spelling& s : command.words)
                    if (s.word != "@") shortest.emplace(s.word, s.shortest);
                for (const auto& words : command.form) add(keywords, words);
                add(keywords, command.keywords);
            }
        add(elements, language.range_elements);
    }
};

const std::vector<std::string> fish_words = {
    "array",       "argument",   "case",     "case_of",     "caseof",        "command",
    "continue",    "def",        "define",   "else",        "elseif",        "end",
    "endcase",     "endcommand", "endif",    "endloop",     "endsection",    "end_case",
    "end_command", "end_if",     "end_loop", "end_section", "exit",          "foreach",
    "for",         "global",     "if",       "local",       "loop",          "null",
    "return",      "section",    "then",     "while",       "whilestepping", "while_stepping"};

/// The names that FISH knows without a definition. A test compares their list in docs/fish.md with the program.
Words fish_names() {
    std::istringstream page(kaya::text_of_file(KAYA_FISH_PAGE));
    Words names;
    bool listed = false;
    for (std::string line; std::getline(page, line) && !line.starts_with("Not supported yet");) {
        if (line == "## Every name") listed = true;
        if (!listed || line.empty() || line.front() < 'a' || line.front() > 'z') continue;
        std::istringstream words(line);
        for (std::string word; words >> word;)
            names.insert(word.ends_with('*') ? word.substr(0, word.size() - 1) : word);
    }
    return names;
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
    // The longest first: the first match is taken.
    std::vector<std::string> sorted(words.begin(), words.end());
    std::ranges::stable_sort(sorted, [](const auto& a, const auto& b) { return a.size() > b.size(); });
    return fmt::format("{}", fmt::join(sorted, "|"));
}

/// A rule of a grammar: matches of the expression get the scope `name`.
Json pattern(std::string_view name, const std::string& match) { return {{"name", name}, {"match", match}}; }
Json text_between(std::string_view name, const std::string& quote) {
    return {{"name", name}, {"begin", quote}, {"end", quote + "|$"}};
}
/// Names for the groups of an expression, from the first on.
Json captures(const std::vector<std::string_view>& names) {
    Json groups = Json::object();
    for (std::size_t i = 0; i < names.size(); ++i) groups[std::to_string(i + 1)] = {{"name", names[i]}};
    return groups;
}
Json include(std::string_view rules) { return Json::array({{{"include", rules}}}); }

/// The rules, with those that commands and functions share.
Json with_common_rules(const std::vector<Json>& rules) {
    Json list = Json::array(
        {pattern("comment.line.semicolon.kaya", ";.*$"), text_between("string.quoted.single.kaya", "'"),
         text_between("string.quoted.double.kaya", "\""), pattern("variable.other.kaya", "@[A-Za-z_$][A-Za-z0-9_$]*")});
    for (const auto& rule : rules) list.push_back(rule);
    list.push_back(
        pattern("constant.numeric.kaya", "[-+]?(?<![A-Za-z_0-9])(?:[0-9]+\\.?[0-9]*|\\.[0-9]+)(?:[eE][-+]?[0-9]+)?"));
    list.push_back(pattern("keyword.operator.continuation.kaya", "(?:&|\\.\\.\\.)\\s*(?=;|$)"));
    return list;
}

Json rules_of_commands(const Vocabulary& words) {
    std::vector<std::string> commands;
    for (const auto& [word, shortest] : words.shortest) commands.push_back(shortened(word, shortest));
    constexpr std::string_view range = "keyword.other.range.kaya";
    // Many a range element is a keyword elsewhere: mat, block, plane.
    const Json elements = pattern(range, fmt::format("(?i)\\b(?:{})\\b", alternatives(words.elements)));
    return with_common_rules(
        {pattern("support.function.kaya", fmt::format("(?i)^\\s*(?:{})\\b", fmt::join(commands, "|"))),
         {{"begin", "(?i)\\b(range)\\b"},
          {"end", "(?=;|$)"},
          {"beginCaptures", captures({range})},
          {"patterns", with_common_rules({elements})}},
         pattern("support.type.property-name.kaya", fmt::format("(?i)\\b(?:{})\\b", alternatives(words.keywords)))});
}

Json rules_of_functions() {
    std::string intrinsics;
    for (const char c : alternatives(fish_names())) {
        if (c == '.') intrinsics += '\\';
        intrinsics += c;
    }
    return with_common_rules(
        {{{"begin", "(?i)^\\s*(command)\\b"},
          {"end", "(?i)^\\s*(end_?command)\\b"},
          {"beginCaptures", captures({"keyword.control.kaya"})},
          {"endCaptures", captures({"keyword.control.kaya"})},
          {"patterns", include("#commands")}},
         pattern("keyword.control.kaya", fmt::format("(?i)(?<![.@])\\b(?:{})\\b", fmt::join(fish_words, "|"))),
         pattern("support.function.intrinsic.kaya", fmt::format("(?i)(?<![.@\\w])(?:{})(?![.\\w])", intrinsics))});
}

/// Commands, functions of FISH and chunks of Lua each have their own rules.
Json vscode_grammar(const Vocabulary& words) {
    const Json lua = {{"begin", "(?i)^\\s*(lua)\\s*(?:;.*)?$"},
                      {"while", "(?i)^(?!\\s*endlua\\b)"},
                      {"beginCaptures", captures({"support.function.kaya"})},
                      {"contentName", "meta.embedded.block.lua"},
                      {"patterns", include("source.lua")}};
    const Json function = {{"begin", "(?i)^\\s*((?:fish\\s+)?def(?:ine)?)\\s+([A-Za-z_$][A-Za-z0-9_$]*)"},
                           {"end", "(?i)^\\s*(end)\\s*(?=;|$)"},
                           {"beginCaptures", captures({"keyword.control.kaya", "entity.name.function.kaya"})},
                           {"endCaptures", captures({"keyword.control.kaya"})},
                           {"patterns", include("#fish")}};
    return {{"name", "kaya"},
            {"scopeName", "source.kaya"},
            {"fileTypes", {"3dd", "3ddat", "fis"}},
            {"patterns", {lua, function, {{"include", "#commands"}}}},
            {"repository",
             {{"commands", {{"patterns", rules_of_commands(words)}}}, {"fish", {{"patterns", rules_of_functions()}}}}}};
}

Json completion_words(const std::vector<const Language*>& dialects) {
    Json entries = Json::array();
    const auto entry = [&](std::string_view label, std::string_view of, std::string_view help) {
        entries.push_back({{"label", label}, {"of", of}, {"help", help}});
    };
    const auto keywords = [&](const auto& self, const std::vector<KeywordSpec>& list, const std::string& of) -> void {
        for (const auto& keyword : list) {
            if (keyword.support == Support::not_yet) continue;
            entry(keyword.words.front().word, of, keyword.help);
            self(self, keyword.keywords, fmt::format("{} {}", of, keyword.words.front().word));
        }
    };
    for (const Language* dialect : dialects) {
        for_each_command(*dialect, [&](const CommandSpec& command) {
            if (command.support == Support::not_yet || command.words.front().word == "@") return;
            entry(command.name(), "", command.help);
            keywords(keywords, command.keywords, command.name());
        });
        keywords(keywords, dialect->range_elements, "range");
    }
    return entries;
}

/// Escapes the characters that have a meaning in a snippet.
std::string literal(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '$' || c == '}' || c == '\\') out += '\\';
        out += c;
    }
    return out;
}

/// A command with its values as places to be filled in. Of two forms of one name (lua with and without a file) the first.
Json snippets(const std::vector<const Language*>& dialects) {
    Json entries = Json::object();
    for (const Language* dialect : dialects)
        for_each_command(*dialect, [&](const CommandSpec& command) {
            if (command.support == Support::not_yet || command.words.front().word == "@") return;
            std::string body = command.name();
            int place = 0;
            for (const auto& positional : command.arguments)
                if (!positional.argument.optional)
                    body += fmt::format(" ${{{}:{}}}", ++place, literal(positional.argument.name));
            if (command.range_elements) body += " $0";
            if (!entries.contains(command.name()))
                entries[command.name()] = {{"prefix", command.name()}, {"body", body}, {"description", command.help}};
        });
    return entries;
}

/// As a file.
std::string text_of(const Json& value) { return value.dump(1) + "\n"; }

/// Words as one expression: later definitions take precedence at one place, and commands come last.
std::string vim_match(std::string_view group, std::string_view before, const std::vector<std::string>& words,
                      std::string_view more = "") {
    return fmt::format("syntax match {} /{}\\%({}\\)\\>/{}\n", group, before, fmt::join(words, "\\|"), more);
}

std::string vim_syntax(const Vocabulary& words) {
    std::string text = "\" Vim syntax file of kaya decks, made from the command tables by editor_files.\n"
                       "if exists(\"b:current_syntax\")\n  finish\nendif\n"
                       "syntax include @kayaLuaWords syntax/lua.vim\nunlet! b:current_syntax\n"
                       "syntax case ignore\nsetlocal iskeyword=@,48-57,_,-\n";
    std::vector<std::string> commands, classic;
    for (const auto& [word, shortest] : words.shortest) // Vim's notation for the shortest abbreviation of a word
        commands.push_back(
            shortest < word.size() ? fmt::format("{}\\%[{}]", word.substr(0, shortest), word.substr(shortest)) : word);
    for (const auto& name : fish_names())
        if (name.find('.') == std::string::npos) classic.push_back(name);
    text += vim_match("kayaKeyword", "\\<", {words.keywords.begin(), words.keywords.end()});
    // Many a range element is a keyword elsewhere: mat, block, plane.
    text += "syntax match kayaRange /\\<range\\>/\n";
    text += vim_match("kayaRange", "\\%(\\<range\\>.*\\)\\@<=\\<", {words.elements.begin(), words.elements.end()});
    text += vim_match("kayaCommand", "^\\s*\\zs", commands);
    text += fmt::format("syntax keyword kayaFish contained {}\n", fmt::join(fish_words, " "));
    text += fmt::format("syntax keyword kayaIntrinsic contained {}\n", fmt::join(classic, " "));
    return text +
           "syntax match kayaIntrinsic contained /\\<\\%(block\\|global\\|math\\|mech\\|table\\|string\\|array\\|list\\)\\%(\\.\\h\\w*\\)\\+/\n"
           "syntax match kayaNumber /\\k\\@1<![-+]\\=\\%(\\d\\+\\.\\=\\d*\\|\\.\\d\\+\\)\\%([eE][-+]\\=\\d\\+\\)\\=/\n"
           "syntax match kayaVariable /@\\h\\w*/\n"
           "syntax match kayaContinued /\\(&\\|\\.\\.\\.\\)\\s*$/\n"
           "syntax region kayaText start=/'/ end=/'\\|$/\n"
           "syntax region kayaText start=/\"/ end=/\"\\|$/\n"
           "syntax match kayaComment /;.*$/\n"
           "syntax region kayaInner contained matchgroup=kayaFish start=/^\\s*command\\>/ end=/^\\s*end_\\=command\\>/ "
           "contains=kayaKeyword,kayaRange,kayaCommand,kayaNumber,kayaVariable,kayaContinued,kayaText,kayaComment\n"
           "syntax region kayaFunction transparent matchgroup=kayaFish start=/^\\s*\\%(fish\\s\\+\\)\\=def\\%(ine\\)\\=\\>/ "
           "end=/^\\s*end\\s*\\%(;.*\\)\\=$/ "
           "contains=kayaFish,kayaIntrinsic,kayaInner,kayaNumber,kayaVariable,kayaContinued,kayaText,kayaComment\n"
           "syntax region kayaLua matchgroup=kayaCommand start=/^\\s*lua\\s*\\%(;.*\\)\\=$/ end=/^\\s*endlua\\>/ keepend "
           "contains=@kayaLuaWords\n"
           "highlight default link kayaCommand Statement\n"
           "highlight default link kayaKeyword Identifier\n"
           "highlight default link kayaRange Type\n"
           "highlight default link kayaFish Keyword\n"
           "highlight default link kayaIntrinsic Function\n"
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

} // namespace

int main(int argc, char** argv) {
    const bool check = argc == 3 && std::string_view(argv[2]) == "--check";
    if (argc != 2 && !check) {
        std::cerr << "usage: editor_files FOLDER [--check]\n";
        return 2;
    }
    const fs::path folder = argv[1];
    const Vocabulary words({&classic(), &modern()});
    std::map<fs::path, std::string> wanted;
    for (const auto& [name, text] : std::map<std::string, std::string>{
             {"vscode/syntaxes/kaya.tmLanguage.json", text_of(vscode_grammar(words))},
             {"vscode/snippets/kaya.json", text_of(snippets({&classic(), &modern()}))},
             {"vscode/words.json", text_of(completion_words({&classic(), &modern()}))},
             {"vim/syntax/kaya.vim", vim_syntax(words)},
             {"fuzz/kaya.dict", fuzz_dictionary(words)},
         })
        wanted[folder / name] = text;
    return kaya::write_generated(wanted, check, "it does not agree with the tables: run editor_files editors");
}
