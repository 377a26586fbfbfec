#include "app/tool_commands.hpp"

#include "app/command_line.hpp"
#include "guide/explanations.hpp"
#include "guide/help_text.hpp"
#include "app/language_server.hpp"
#include "app/manual.hpp"
#include "app/permissions.hpp"
#include "app/run.hpp"
#include "app/scope.hpp"
#include "app/shell_completion.hpp"
#include "app/tools.hpp"
#include "commands/session/deck_report.hpp"
#include "io/difference.hpp"
#include "io/info.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>
#include <unistd.h>

namespace kaya {

namespace {

using Names = std::vector<std::string>;

/// The words of one command line; they live as long as its action.
struct Words {
    Names names;
    std::string name, folder;
    bool first = false, second = false; ///< its flags
};

using Action = std::function<int(const Words&)>;

/// A command, its words, and a function that makes its action the chosen one.
struct Tool {
    CLI::App* command;
    std::shared_ptr<Words> words = std::make_shared<Words>();

    Tool(CLI::App& app, std::function<int()>& chosen, const char* name, const char* help, Action action)
        : command(app.add_subcommand(name, help)) {
        command->callback([&chosen, words = words, action = std::move(action)] {
            chosen = [words, action] { return action(*words); };
        });
    }
};

/// Prints the outlook of each statement of the decks.
int check(const Names& decks, bool as_json) {
    Output output(stdout, stderr);
    int status = 0;
    for (const auto& deck : decks) {
        try {
            const DeckReport report = check_deck(deck_file(deck), {"."}, own_joint_folders(program_folder("")));
            const std::string text = as_json ? report.json_lines() : report.text(deck);
            if (!text.empty()) output.print(text);
            if (!report.can_run()) status = static_cast<int>(Fault::deck);
        } catch (const Diagnostic& error) {
            output.message(error);
            status = static_cast<int>(error.fault);
        }
    }
    output.flush();
    return status;
}

void add_format(CLI::App& app, std::function<int()>& chosen) {
    const Tool tool(app, chosen, "fmt", "show decks in their long form: whole words, single blanks",
                    [](const Words& words) {
                        Output output(stdout, stderr);
                        const Formatting what = words.second  ? Formatting::check
                                                : words.first ? Formatting::write
                                                              : Formatting::show;
                        const int status = format_decks(words.names, what, output);
                        output.flush();
                        return status;
                    });
    tool.command->add_option("deck", tool.words->names, "command files")->required();
    auto* writing = tool.command->add_flag("--write,-w", tool.words->first, "write it into the files");
    tool.command
        ->add_flag("--check", tool.words->second,
                   "write nothing; list the decks that are not in their long form, status 1 if there are any")
        ->excludes(writing);
}

void add_convert(CLI::App& app, std::function<int()>& chosen) {
    const Tool tool(app, chosen, "convert", "show decks in the words of the other dialect", [](const Words& words) {
        Output output(stdout, stderr);
        const int status = convert_decks(words.names, words.name, words.first, output);
        output.flush();
        return status;
    });
    tool.command->add_option("deck", tool.words->names, "command files")->required();
    tool.command->add_option("--to", tool.words->name, "modern (3DEC 6, 7 and 9) or classic (3DEC 4 and 5)")
        ->required()
        ->check(CLI::IsMember({"modern", "classic"}));
    tool.command->add_flag("--write,-w", tool.words->first, "write them into the files");
}

void add_explain(CLI::App& app, std::function<int()>& chosen) {
    const Tool tool(app, chosen, "explain", "explain a message by its code, or list the codes", [](const Words& words) {
        print_result(words.name.empty() ? code_list() : explanation(words.name));
        return 0;
    });
    tool.command->add_option("code", tool.words->name, "as shown in brackets after a message on a terminal");
}

void add_lsp(CLI::App& app, std::function<int()>& chosen) {
    const Tool tool(app, chosen, "lsp", "serve an editor: mistakes, words, help and names while a deck is typed",
                    [](const Words&) { return serve_editor(STDIN_FILENO, STDOUT_FILENO); });
}

void add_info(CLI::App& app, const RunOrder& order, const std::filesystem::path& program,
              std::function<int()>& chosen) {
    const Tool tool(app, chosen, "info", "describe a saved model", [&order, program](const Words& words) {
        if (words.first) {
            print_result(describe_sandbox(policy_of(order, program)));
            return 0;
        }
        if (words.second) {
            print_result(scope_table());
            return 0;
        }
        if (words.name.empty())
            throw Diagnostic("info needs the name of a file",
                             "such as: kaya info wall.kaya.h5, or kaya info --sandbox");
        try {
            print_result(describe_save_file(find_saved(words.name)));
        } catch (Diagnostic& problem) {
            problem.hint = "info reads a file that 'save' has written";
            problem.fault = Fault::deck;
            throw;
        }
        return 0;
    });
    tool.command->add_option("file", tool.words->name, "a file that 'save' has written");
    tool.command->add_flag("--sandbox", tool.words->first, "show what a run in this folder may do");
    tool.command->add_flag("--scopes", tool.words->second, "show which files each subcommand reads and writes");
}

void add_report(CLI::App& app, const RunOrder& order, const std::filesystem::path& program,
                std::function<int()>& chosen) {
    const Tool tool(app, chosen, "report",
                    "make a page of a saved model for a browser: numbers, curves, a view to rotate",
                    [&order, program](const Words& words) {
                        print_result(write_report(words.names, words.name, joint_folders(order, program)));
                        return 0;
                    });
    tool.command
        ->add_option(
            "file", tool.words->names,
            "files that 'save' has written; the last one is that of the tables, and all can be seen in their order")
        ->required();
    tool.command->add_option("--out", tool.words->name, "name of the page; the file's name with .html if not given");
}

void add_export(CLI::App& app, std::function<int()>& chosen) {
    const Tool tool(app, chosen, "export",
                    "write the tables of a saved model as CSV: blocks, zones, contacts, histories and all others",
                    [](const Words& words) {
                        for (const auto& name : export_saved(words.name, words.folder, words.first)) print_result(name);
                        return 0;
                    });
    tool.command->add_option("file", tool.words->name, "a file that 'save' has written")->required();
    tool.command->add_option("--into", tool.words->folder, "the folder; the file's name with -tables if not given");
    tool.command->add_flag("--vtk", tool.words->first, "also write the files for ParaView");
}

void add_diff(CLI::App& app, std::function<int()>& chosen) {
    const Tool tool(app, chosen, "diff", "list the differences of two saved models", [](const Words& words) {
        const std::string difference = difference_of(words.names);
        print_result(difference.empty() ? "the same" : difference);
        return difference.empty() ? 0 : 1;
    });
    tool.command->add_option("file", tool.words->names, "two files that 'save' has written")->required()->expected(2);
}

void add_allow(CLI::App& app, std::function<int()>& chosen) {
    const Tool tool(app, chosen, "allow",
                    "allow runs a folder or a joint model, permanently; without one, list the permissions",
                    [](const Words& words) {
                        for (const auto& path : words.names) words.first ? revoke(path) : allow(path);
                        print_result(describe(read_permissions()));
                        return 0;
                    });
    tool.command->add_option("path", tool.words->names, "folders, or libraries in their present state");
    tool.command->add_flag("--revoke", tool.words->first, "revoke the permission");
}

void add_check(CLI::App& app, std::function<int()>& chosen) {
    const Tool tool(app, chosen, "check", "check decks without running them",
                    [](const Words& words) { return check(words.names, words.first); });
    tool.command->add_option("deck", tool.words->names, "command files; - is the standard input")->required();
    tool.command->add_flag("--json", tool.words->first, "one object of JSON per line, for editors");
}

void add_help(CLI::App& app, std::function<int()>& chosen) {
    const Tool tool(app, chosen, "help", "list the commands of decks, or explain one of them", [](const Words& words) {
        print_result(help_text(fmt::format("{}", fmt::join(words.names, " "))));
        return 0;
    });
    tool.command->add_option("command", tool.words->names,
                             "a command, a keyword, or a name of FISH: poly brick, cx_nforce");
}

void add_completion(CLI::App& app, std::function<int()>& chosen) {
    const Tool tool(app, chosen, "completion", "print a script with which a shell completes kaya's command line",
                    [&app](const Words& words) {
                        print_result(completion_script(tool_tree(app), words.name));
                        return 0;
                    });
    tool.command->add_option("shell", tool.words->name, "bash, zsh or fish")->required();
}

void add_manual(CLI::App& app, std::function<int()>& chosen) {
    const Tool tool(app, chosen, "manual", "print the page of 'man kaya'", [&app](const Words&) {
        print_result(manual_page(tool_tree(app), program_version()));
        return 0;
    });
}

} // namespace

void add_tool_commands(CLI::App& app, const RunOrder& order, const std::filesystem::path& program,
                       std::function<int()>& chosen) {
    add_format(app, chosen);
    add_convert(app, chosen);
    add_explain(app, chosen);
    add_lsp(app, chosen);
    add_info(app, order, program, chosen);
    add_report(app, order, program, chosen);
    add_export(app, chosen);
    add_diff(app, chosen);
    add_allow(app, chosen);
    add_check(app, chosen);
    add_help(app, chosen);
    add_completion(app, chosen);
    add_manual(app, chosen);
}

} // namespace kaya
