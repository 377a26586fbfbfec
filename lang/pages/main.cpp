// command_pages FOLDER [--check]: one page for each first word of the language. Syntax, arguments, examples and errors come from the
// tables; the other sections of a page are written by hand and kept. With --check nothing is written, and the status is 1 when a page does
// not agree with the tables.
#include "lang/commands/language.hpp"
#include "lang/interp/help.hpp"
#include "lang/modern/language.hpp"
#include "system/generated_files.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>
#include <iostream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using namespace kaya::lang;

/// The commands that begin with one word: poly brick, poly prism, ...
struct Page {
    std::string file;
    std::vector<const CommandSpec*> commands;
};

std::vector<Page> pages(const Language& language) {
    std::vector<Page> all;
    for (const auto& family : language.families)
        for (const auto& command : family.commands) {
            if (command.support == Support::not_yet) continue;
            std::string file(command.words.front().word);
            if (file == "@") file = "call-of-a-function";
            file += ".md";
            auto page = std::find_if(all.begin(), all.end(), [&](const Page& p) { return p.file == file; });
            if (page == all.end()) page = all.insert(all.end(), {file, {}});
            page->commands.push_back(&command);
        }
    return all;
}

/// A line of a table must not be cut by the bars of its text.
std::string cell(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '|') out += '\\';
        if (c == '\n') out += "` <br> `";
        else out += c;
    }
    return out;
}

std::string values_of(const KeywordSpec& keyword) {
    std::string values;
    for (const auto& argument : keyword.arguments) {
        values += values.empty() ? "" : ", ";
        values += describe(argument);
    }
    return values;
}

void argument_rows(std::string& out, const std::vector<KeywordSpec>& keywords, const std::string& before) {
    for (const auto& keyword : keywords) {
        std::string words;
        for (const auto& spelling : keyword.words)
            words += fmt::format("{}`{}{}`", words.empty() ? "" : ", ", before, spelling.word);
        const char* support = keyword.support == Support::not_yet ? "not supported yet: " : "";
        out += fmt::format("| {} | {} | {}{} |\n", words, cell(values_of(keyword)), support, cell(keyword.help));
        argument_rows(out, keyword.keywords, fmt::format("{}{} ", before, keyword.words.front().word));
    }
}

std::string syntax(const Page& page) {
    std::string out;
    for (const auto* command : page.commands) out += fmt::format("    {}\n", usage(*command));
    out += "\n";
    for (const auto* command : page.commands) out += fmt::format("* `{}`: {}\n", command->name(), command->help);
    return out;
}

std::string arguments(const Page& page) {
    std::string out;
    for (const auto* command : page.commands) {
        std::string rows;
        for (const auto& positional : command->arguments)
            rows += fmt::format("| | {} | {} |\n", cell(describe(positional.argument)), cell(positional.argument.help));
        argument_rows(rows, command->keywords, "");
        if (command->range_elements)
            rows += "| `range` | [a range phrase](../range-phrase.md) | the objects; all visible ones if not given |\n";
        if (rows.empty()) continue;
        if (page.commands.size() > 1) out += fmt::format("`{}`\n\n", command->name());
        out += "| word | values | meaning |\n|---|---|---|\n" + rows + "\n";
    }
    if (out.empty()) return "None.\n";
    out.pop_back();
    return out;
}

std::string examples(const Page& page) {
    std::string out;
    for (const auto* command : page.commands)
        for (const auto& example : command->right) {
            std::string text(example.text);
            for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', end + 5))
                text.replace(end, 1, "\n    ");
            out += fmt::format("    {}\n", text);
        }
    return out.empty() ? "None.\n" : out;
}

std::string errors(const Page& page) {
    std::string rows;
    for (const auto* command : page.commands)
        for (const auto& example : command->wrong)
            rows += fmt::format("| `{}` | {} |\n", cell(example.text), cell(example.message));
    if (rows.empty()) return "None.\n";
    return "| line | message |\n|---|---|\n" + rows;
}

using Sections = std::map<std::string, std::string>;

/// Texts below the `## ` headings of an existing page.
Sections sections_of(const fs::path& file) {
    Sections sections;
    std::istringstream stream(kaya::text_of_file(file));
    std::string heading;
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with("## ")) heading = line.substr(3);
        else if (!heading.empty()) sections[heading] += line + "\n";
    }
    return sections;
}

std::string page_text(const Page& page, Sections sections) {
    sections["Syntax"] = "\n" + syntax(page) + "\n";
    sections["Arguments"] = "\n" + arguments(page) + "\n";
    sections["Examples"] = "\n" + examples(page) + "\n";
    sections["Errors"] = "\n" + errors(page) + "\n";
    std::string text = fmt::format("# {}\n\n", page.commands.front()->words.front().word);
    for (const char* heading : {"Syntax", "Arguments", "Examples", "What it does", "Restrictions", "Errors",
                                "Differences from 3DEC", "Related"}) {
        text += fmt::format("## {}\n", heading);
        text += sections.contains(heading) ? sections[heading] : "\nNone.\n\n";
    }
    text.erase(text.find_last_not_of('\n') + 1);
    return text + "\n";
}

std::string range_page(const Language& language) {
    std::string rows;
    argument_rows(rows, language.range_elements, "");
    return "# The range phrase\n\n"
           "The last words of many commands: `range` and elements that say which objects are meant. All elements must\n"
           "hold, or one of them when the word `union` stands among them; `not` after an element negates it.\n"
           "Limits are inclusive, with a small tolerance. Blocks and zones are tested by their centroid, gridpoints by\n"
           "their position, contacts and sub-contacts by theirs: `hide range z 0 0.1` hides the blocks whose centroid lies between 0 and\n"
           "0.1, not those that reach into it. `extent` asks for all corners. Hidden blocks and what belongs to them are never meant.\n"
           "The tolerance is a millionth of the model's size; for one value, `x 4`, a ten-thousandth, so that a face is still found\n"
           "when loads have moved it.\n\n"
           "| word | values | meaning |\n|---|---|---|\n" +
           rows;
}

std::string not_yet_page(const Language& language) {
    std::string text =
        "# Known, not supported yet\n\n"
        "A deck that uses one of these stops before its first command runs, with the line; `kaya check` lists\n"
        "the lines.\n\n| command | what it is about |\n|---|---|\n";
    for (const auto& family : language.families)
        for (const auto& command : family.commands) {
            if (command.support == Support::not_yet)
                text += fmt::format("| `{}` | {} |\n", command.name(), command.help);
            for (const auto& keyword : command.keywords)
                if (keyword.support == Support::not_yet)
                    text += fmt::format("| `{} ... {}` | {} |\n", command.name(), keyword.words.front().word,
                                        cell(keyword.help));
        }
    for (const auto& element : language.range_elements)
        if (element.support == Support::not_yet)
            text += fmt::format("| `range {}` | {} |\n", element.words.front().word, element.help);
    return text;
}

/// One command of the modern dialect: what it takes, and its lines with their classic forms.
std::string modern_command(const CommandSpec& command) {
    std::string text = fmt::format("### {}\n\n    {}\n\n{}.\n\n", command.name(), usage(command), command.help);
    std::string rows;
    for (const auto& positional : command.arguments)
        rows += fmt::format("| | {} | {} |\n", cell(describe(positional.argument)), cell(positional.argument.help));
    argument_rows(rows, command.keywords, "");
    if (!rows.empty()) text += "| word | values | meaning |\n|---|---|---|\n" + rows + "\n";
    text += "| line | classic form |\n|---|---|\n";
    for (const auto& example : command.right)
        text += fmt::format("| `{}` | {} |\n", cell(example.text),
                            example.classic.empty() ? "" : fmt::format("`{}`", cell(example.classic)));
    return text + "\n";
}

std::string modern_page(const Language& language) {
    std::string text =
        "# Commands of 3DEC 6, 7 and 9\n\n"
        "The first words of a line decide its dialect, so that lines of both may stand in one file. Words may be\n"
        "shortened in each of their parts: `bl cont gen-sub`. What runs is the same as for the classic form of a line;\n"
        "[Coming from 3DEC](from-3dec.md) says where the two differ from 3DEC.\n\n";
    std::string missing = "## Not supported yet\n\n| command | what it is about |\n|---|---|\n";
    for (const auto& family : language.families) {
        std::string commands;
        for (const auto& command : family.commands) {
            const bool classic_too = command.words.front().word == "@" || &family == &language.families.back();
            if (command.support == Support::not_yet)
                missing += fmt::format("| `{}` | {} |\n", command.name(), cell(command.help));
            else if (!classic_too) commands += modern_command(command);
        }
        if (!commands.empty()) text += fmt::format("## {}: {}\n\n", family.name, family.help) + commands;
    }
    std::string rows;
    argument_rows(rows, language.range_elements, "");
    return text + "## The range phrase\n\n| word | values | meaning |\n|---|---|---|\n" + rows + "\n" + missing;
}

} // namespace

int main(int argc, char** argv) {
    const bool check = argc == 3 && std::string_view(argv[2]) == "--check";
    if (argc != 2 && !check) {
        std::cerr << "usage: command_pages FOLDER [--check]\n";
        return 2;
    }
    const fs::path folder = argv[1];
    std::map<fs::path, std::string> wanted;
    std::string index = "# Commands\n\nWords may be shortened, those with hyphens in each of their parts "
                        "(`pos-x`). `range` at the end of a line is "
                        "[a range phrase](../range-phrase.md).\n\n";
    const Language& language = classic();
    for (const auto& page : pages(language)) {
        wanted[folder / page.file] = page_text(page, sections_of(folder / page.file));
        for (const auto* command : page.commands)
            index += fmt::format("* [{}]({}): {}\n", command->name(), page.file, command->help);
    }
    wanted[folder / ".." / "range-phrase.md"] = range_page(language);
    wanted[folder / ".." / "modern-commands.md"] = modern_page(modern());
    index += "\n[Commands of 3DEC 6, 7 and 9](../modern-commands.md)\n";
    index += "\n[Known, not supported yet](../not-supported-yet.md)\n";
    wanted[folder / ".." / "not-supported-yet.md"] = not_yet_page(language);
    wanted[folder / "README.md"] = index;
    return kaya::write_generated(wanted, check, "it does not agree with the tables: run command_pages docs/commands");
}
