// program ...: files, the log and the end; and lines that users write without the word program.
#include "lang/modern/language.hpp"
#include "lang/modern/leaf.hpp"

namespace kaya::lang {

namespace {

CommandSpec call() {
    Leaf<CallFile> leaf("program call", "call");
    leaf.arguments_of_meaning().calls(&CallFile::file);
    leaf.no_effect("suppress", "accepted, without effect");
    leaf.not_yet({"call"}, "several files in one line: write a line for each");
    leaf.not_yet({"line", "label"}, "calls that begin inside of a file");
    leaf.right("program call 'wall.dat'", "call wall.dat").right("prog call 'second part.3dd' suppress");
    leaf.wrong("program call", "a word is missing after 'call'");
    leaf.wrong("program call 'a' 'b'", "expected a keyword of program call, found the text 'b'");
    return leaf;
}

CommandSpec log(std::string_view words, std::string_view example, std::string_view emptied, std::string_view wrong,
                std::string_view message) {
    Leaf<Set> leaf(words, "set");
    leaf.means("set log").help("also writes the output to the log file");
    leaf.argument(on_off(), &Set::log);
    leaf.no_effect("append", "the file is continued, as without the word").word("truncate", "truncate");
    leaf.right(example, "set log on").right(emptied, "set log on truncate");
    leaf.wrong(wrong, message);
    return leaf;
}

CommandSpec log_file(std::string_view words, std::string_view example, std::string_view wrong) {
    Leaf<Set> leaf(words, "set");
    leaf.means("set logfile").help("name of the log file");
    leaf.argument(text("file"), &Set::log_file);
    leaf.word("truncate", "truncate");
    leaf.right(example, "set logfile run.log");
    leaf.wrong(wrong, "a word is missing after 'log-file'");
    return leaf;
}

CommandSpec threads() {
    Leaf<Set> leaf("program threads");
    leaf.means("set threads");
    leaf.help("number of threads; it has no influence on the result");
    leaf.argument(integer("n").at_least(1), &Set::threads);
    leaf.right("program threads 1", "set threads 1");
    leaf.wrong("program threads 0", "threads must be at least 1, not 0");
    return leaf;
}

CommandSpec automatic_save() {
    Leaf<Set> leaf("program automatic-model-save");
    leaf.help("saves the model at intervals while it cycles");
    const auto hours = real("h").unit("hours").at_least(0).at_most(24);
    leaf.keyword({"active"}, on_off(),
                 Through{[](Set& set, bool on) {
                             if (!on) set.autosave = 0;
                             else if (!set.autosave) set.autosave = 60;
                         },
                         [](const Set& set) { return set.autosave ? std::optional(*set.autosave > 0) : std::nullopt; }},
                 "off: none; on: each hour");
    leaf.keyword(
        {"interval"}, hours,
        Through{[](Set& set, double h) { set.autosave = 60 * h; },
                [](const Set& set) { return set.autosave ? std::optional(*set.autosave / 60) : std::nullopt; }},
        "hours between two saves");
    leaf.not_yet({"directory"}, "another folder for these saves");
    leaf.right("program automatic-model-save active off", "set autosave 0");
    leaf.right("program automatic-model-save interval 0.5", "set autosave 30");
    leaf.wrong("program automatic-model-save actve off", "'actve' is not a keyword of program automatic-model-save");
    return leaf;
}

CommandSpec automatic_threads() {
    return ignored_line("program threads automatic", "as many threads as the machine has",
                        "kaya does so when it starts", "program threads automatic");
}

template <class Command>
CommandSpec flow_line(std::string_view words, std::string_view classic, Flow flow, std::string_view help) {
    Leaf<Command> leaf(words, classic);
    leaf.help(help).flow(flow);
    leaf.right(words.substr(0, words.find('|')), classic);
    return leaf;
}

CommandSpec load_model(std::string_view words, std::string_view example, std::string_view classic) {
    Leaf<JointModelCommand> leaf(words, "jmodel load");
    leaf.arguments_of_meaning().checks_of_meaning();
    leaf.right(example, classic);
    leaf.wrong(words, "a word is missing after 'contactmodelmechanical'");
    return leaf;
}

CommandSpec load_zone_model() {
    Leaf<ZoneModelCommand> leaf("program load cmodel", "zone load");
    leaf.arguments_of_meaning().checks_of_meaning();
    leaf.right("program load cmodel 'hoek-brown'", "zone load hoek-brown");
    leaf.wrong("program load cmodel", "a word is missing after 'cmodel'");
    return leaf;
}

CommandSpec program_list() {
    Leaf<List> leaf("program list", "list");
    leaf.help("shows parts of the program");
    leaf.word("information", "information").word("memory", "memory").word("version", "version");
    leaf.word("named-range", "ranges");
    leaf.not_yet({"cycle-sequence", "directory", "fish", "module", "plugins", "principal"}, "other lists");
    leaf.finish([](const Reader& reader, List& command) {
        if (!command.what)
            incomplete_line(reader, "program list has no subject", "write for example: program list memory");
    });
    leaf.right("program list version", "list version").right("program list memory", "list memory");
    leaf.wrong("program list", "program list has no subject");
    leaf.wrong("program list vresion", "'vresion' is not a keyword of program list");
    return leaf;
}

} // namespace

Family program_family() {
    constexpr const char* screen = "kaya opens no screen";
    return {"program",
            "files, the log and the end",
            {
                call(),
                flow_line<Return>("program return", "return", Flow::leave_file, "ends the file"),
                flow_line<Quit>("program exit|quit|stop", "quit", Flow::leave_all, "ends the program"),
                log("program log", "program log on", "program log on truncate", "program log",
                    "a word is missing after 'log'"),
                log("log", "log on append", "log on truncate", "log onn", "expected on or off, found 'onn'"),
                log_file("program log-file", "program log-file 'run.log'", "program log-file"),
                log_file("log-file", "log-file 'run.log'", "log-file"),
                automatic_threads(),
                threads(),
                automatic_save(),
                load_zone_model(),
                load_model("program load contactmodelmechanical", "program load contactmodelmechanical 'barton-bandis'",
                           "jmodel load barton-bandis"),
                program_list(),
                ignored_line("program notice", "notices", "kaya shows warnings and notes", "program notice off"),
                ignored_line("program warning", "warnings", "kaya always shows them", "program warning off"),
                ignored_line("program echo", "shows the commands", "kaya --echo shows them", "program echo off"),
                ignored_line("program pagination", "pages of output", screen, "program pagination off"),
                ignored_line("program customer-title-1|customer-title-2", "titles of pictures", screen,
                             "program customer-title-1 'me'"),
                ignored_line("program floating-point-check", "checks of numbers", "kaya always checks them",
                             "program floating-point-check on"),
                ignored_line("python-reset-state", "the state of Python", "kaya has no Python inside",
                             "python-reset-state false"),
                flow_line<Pause>("program pause", "pause", Flow::next, "waits for a key if the input is a terminal"),
                unsupported_line("program system", "commands of the operating system"),
                unsupported_line("program directory", "another current folder"),
                unsupported_line("program playback", "records of commands"),
                unsupported_line("program undo", "taking commands back"),
                unsupported_line("program encrypt", "encrypted files"),
                unsupported_line("program echo-line", "lines of text in the output: write io.out in a FISH function"),
                unsupported_line("program mail", "mail"),
                unsupported_line("program license", "licenses"),
                unsupported_line("program continue", "files that continue after a pause"),
            }};
}

} // namespace kaya::lang
