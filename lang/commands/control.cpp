// Commands that steer the program: files, settings, the end.
#include "base/lower_case.hpp"
#include "base/units.hpp"
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"

#include <fmt/format.h>

namespace kaya::lang {

Parts<std::pair<std::string, Value>> fish_variable(bool needs_mark) {
    using Variable = std::pair<std::string, Value>;
    return Parts<Variable>().by(
        [](Reader& reader, Variable& variable) {
            variable.first = name_at(reader, text("@name").spec);
            variable.second = reader.any(real("value").spec);
        },
        [needs_mark](Parts<Variable>::Form form, const Variable& wanted) {
            form.words.push_back({(needs_mark ? "@" : "") + wanted.first, !needs_mark});
            form.after = wanted;
            return print_any(form.words, wanted.second) ? Parts<Variable>::Forms{form} : Parts<Variable>::Forms{};
        });
}

namespace {

/// `3dec`, or `none`.
void read_compatibility(Set& set, const std::string& with) {
    const std::string word = lower_case(with);
    if (word != "3dec" && word != "none")
        throw Diagnostic(fmt::format("there are no conventions of '{}'", with), "expected: 3dec or none");
    set.as_3dec = word == "3dec";
}

CommandSpec set() {
    Entry<Set> entry({"set"});
    entry.help("changes settings; a line may have several");
    entry.keyword({"dynamic"}, on_off(), &Set::dynamic,
                  "on: no damping unless damp asks for it; off: static, local damping of 0.8");
    entry.keyword({"small"}, on_off(), &Set::small,
                  "on: small strain, the geometry is not updated; off: large strain, the default");
    entry.keyword({"log"}, on_off(), &Set::log, "also writes the output to the log file");
    entry.keyword({"logfile"}, text("file"), &Set::log_file, "name of the log file");
    entry.action(
        {"truncate"}, [](Set& set) { set.empty_log = true; },
        "with log or logfile: the log file begins empty; without it, it is continued");
    entry.keyword({"jcondf"}, integer("n").at_least(1), &Set::default_joint_constitutive,
                  "constitutive number of new contacts");
    entry.keyword({"jmatdf"}, integer("n").at_least(1), &Set::default_joint_material,
                  "joint material number of new contacts");
    entry.keyword({"fraction"}, real("f").above(0).at_most(1), &Set::time_step_fraction,
                  "time step as a fraction of the largest stable one");
    entry.keyword({"dt", "timestep"}, real("t").unit("time").at_least(0), &Set::time_step,
                  "time step; 0: a fraction of the largest stable one again");
    entry.keyword({Spelling{"compatibility", 4}}, text("program"),
                  Through{read_compatibility,
                          [](const Set& set) {
                              return set.as_3dec ? std::optional<std::string>(*set.as_3dec ? "3dec" : "none")
                                                 : std::nullopt;
                          }},
                  "3dec: joints of rigid blocks stand on their corners, and the time step is that of 3DEC where it is "
                  "shorter; none: the default");
    entry.keyword({"threads"}, integer("n").at_least(1), &Set::threads, "number of threads");
    entry.keyword({"echo"}, on_off(), &Set::echo, "shows the commands while they run");
    entry.keyword({"autosave"}, real("m").unit("minutes").at_least(0), &Set::autosave,
                  "minutes of cycling between two autosaves; 0: none");
    entry.keyword({"report"}, on_off(), &Set::report,
                  "on: writes a page for a browser at the end of the run, with the model over time");
    entry.keyword({"gravity"}, vector("gx gy gz").unit("acceleration"), &Set::gravity, "the same as gravity");
    const auto units = text("system");
    entry.keyword(
        {"units"}, Parts<Set>().then(units, &Set::units).check([units](Reader& reader, Set& set) {
            // The units one by one, in any order: m kg s Pa.
            const Word* next = reader.peek();
            if (next == nullptr || !Units::fit(*set.units + "-" + next->folded)) return;
            for (int i = 1; i < 4; ++i) *set.units += "-" + reader.text(units.spec);
        }),
        "names the units of lists, pictures, histories and reports and checks values against them; converts nothing");
    entry.keyword({Spelling{"random", 3}},
                  Parts<Set>().set(&Set::seed, 1).maybe(integer("n").at_least(0).optional(), &Set::seed),
                  "restarts the random numbers of FISH and Lua from this seed; 1 if not given");
    for (const char* word : {"pagination", "atol", "btol", "ctol", "dtol", "etol", "nmech", "ncyc", "cust1", "cust2",
                             "messages", "warnings", "overwrite", "delcontact"})
        entry
            .special(
                {word}, {},
                [](Reader& reader, Set&) {
                    const auto value = text("value").spec;
                    while (const Word* next = reader.peek()) {
                        const bool its_own =
                            next->kind == WordKind::number || next->folded == "on" || next->folded == "off";
                        if (!its_own) break;
                        (void)reader.any(value);
                    }
                },
                "accepted, without effect")
            .ignored();
    // Commands that show a model on a screen take the rest of the line.
    for (const char* word : {"plot", "background", "directory", "output"})
        entry
            .special(
                {word}, {text("...").optional().spec}, [](Reader& reader, Set&) { (void)reader.take_raw(); },
                "accepted with the rest of the line, without effect")
            .ignored();
    entry.values(Parts<Set>().in(next_of(&Set::fish), fish_variable(true)),
                 [](Reader& reader, Set&) { return reader.peek()->kind == WordKind::symbol; },
                 {text("@name value").optional().spec});
    entry.finish([](const Reader& reader, Set& set) {
        if (set.empty_log && !set.log && !set.log_file)
            incomplete_line(reader, "truncate belongs to log and logfile", "write for example: set log on truncate");
        if (reader.statement().words.size() == 1)
            incomplete_line(reader, "set has no setting", "write for example: set dyn on");
    });
    entry.right("set dyn on")
        .right("set jcondf 1 jmatdf 2")
        .right("set log on logfile run.log truncate")
        .right("set @load = 5e6");
    entry.right("set dt 1e-5").right("set autosave 30").right("set report on");
    entry.right("set gravity 0 0 -9.81 random 7")
        .right("set random")
        .right("set units si")
        .right("set units m kg s Pa");
    entry.right("set pagination off").right("set atol 1e-4 echo off").right("set compatibility 3dec");
    entry.wrong("set", "set has no setting");
    entry.wrong("set dyn maybe", "expected on or off, found 'maybe'");
    entry.wrong("set jmatdf 1.5", "jmatdf takes a whole number, not 1.5");
    entry.wrong("set fraction 0", "fraction must be greater than 0, not 0");
    entry.wrong("set compatibility 3dce", "there are no conventions of '3dce'");
    entry.wrong("set thraeds 2", "'thraeds' is not a keyword of set");
    return entry;
}

CommandSpec config() {
    Entry<Config> entry({"config"});
    entry.help("requests options of the program");
    entry.action(
        {"dynamic"}, [](Config& c) { c.dynamic = true; }, "the same as set dyn on");
    for (const char* word : {"cppudm", "rhs"})
        entry
            .action(
                {word}, [](Config&) {}, "always available")
            .ignored();
    static constexpr std::pair<const char*, const char*> missing[] = {{"lhs", "axes that are left-handed"},
                                                                      {"thermal", "heat"},
                                                                      {"gw", "flow of water"},
                                                                      {"fluid", "flow of water"},
                                                                      {"feblock", "blocks of finite elements"},
                                                                      {"highorder", "zones of higher order"},
                                                                      {"creep", "creep"}};
    for (const auto& [word, about] : missing) entry.not_yet({word}, about);
    entry.right("config dyn").right("CONFIG CPPUDM").right("config");
    entry.wrong("config dny", "'dny' is not a keyword of config");
    entry.wrong("config thermal", "'config thermal' is known, but kaya does not support it yet");
    return entry;
}

CommandSpec title() {
    Entry<Title> entry({"title"});
    entry.raw(&Title::text);
    entry.start([](const Statement& statement, Title& title) {
        const auto& words = statement.words;
        title.text = words.size() == 2 && words[1].kind == WordKind::text ? words[1].text : statement.raw(1);
        if (words.size() == 1) title.text = statement.body; // on the line below
    });
    entry.whole_line([](const Title& title) {
        return title.text.empty() ? "title" : "title " + joined({{title.text, true}}, true);
    });
    entry.help("names the model; the text is the rest of the line, or the next line if that is not a command");
    entry.right("title Direct shear test").right("title 'A wall, second try'").right("title").right("title It's late");
    return entry;
}

} // namespace

Family control() {
    return {
        "control",
        "files, settings and the end",
        {
            Entry<New>({"new"})
                .help("deletes the model and starts with an empty one")
                .right("new")
                .wrong("new model", "unexpected 'model' after the end of the command"),
            Entry<CallFile>({"call"})
                .help("reads commands from another file, then continues here")
                .argument(text("file").help("name of the file; .3dd, .dat and so on may be left out"), &CallFile::file)
                .calls(&CallFile::file)
                .right("call wall.dat")
                .right("call 'second part.3dd'")
                .right("call @name")
                .wrong("call", "a word is missing after 'call'")
                .wrong("call a.dat b.dat", "unexpected 'b.dat' after the end of the command"),
            config(),
            set(),
            Entry<Save>({"save"})
                .help("writes the whole model to a file")
                .argument(text("file").help("name of the file; .kaya.h5 may be left out"), &Save::file)
                .right("save settled")
                .right("save 'two words'")
                .wrong("save", "a word is missing after 'save'")
                .wrong("save ''", "file is an empty text"),
            Entry<Reset>({"reset"})
                .help("sets quantities to zero; a line may have several")
                .action(
                    {"time"}, [](Reset& r) { r.what.push_back(Reset::What::time); }, "the time")
                .action(
                    {"hist", "history", "histories"}, [](Reset& r) { r.what.push_back(Reset::What::histories); },
                    "all histories")
                .action(
                    {"disp", "displacements"}, [](Reset& r) { r.what.push_back(Reset::What::displacements); },
                    "displacements of gridpoints and blocks")
                .action(
                    {"vel", "velocity", "velocities"}, [](Reset& r) { r.what.push_back(Reset::What::velocities); },
                    "velocities and spins")
                .action(
                    {"jdisp", "jdisplacements"}, [](Reset& r) { r.what.push_back(Reset::What::joint_displacements); },
                    "displacements of joints")
                .action(
                    {"energy"}, [](Reset& r) { r.what.push_back(Reset::What::energy); }, "sums of energy and work")
                .action(
                    {"damp", "damping"}, [](Reset& r) { r.what.push_back(Reset::What::damping); },
                    "the state of adaptive damping")
                .finish([](const Reader& reader, Reset& reset) {
                    if (reset.what.empty())
                        incomplete_line(reader, "reset does not say what to reset",
                                        "expected: time, hist, disp, vel, jdisp, energy, damp");
                })
                .right("reset disp jdisp")
                .right("reset time hist")
                .right("RESET displacements velocities jdisplacements")
                .wrong("reset", "reset does not say what to reset")
                .wrong("reset dsip", "'dsip' is not a keyword of reset")
                .wrong("reset 5", "expected a keyword of reset, found '5'"),
            Entry<Restore>({"restore"})
                .help("replaces the model by a saved one")
                .argument(text("file").help("name of the file that save wrote"), &Restore::file)
                .right("restore settled")
                .right("rest settled")
                .wrong("restore", "a word is missing after 'restore'"),
            Entry<Return>({"return"})
                .help("ends the file; the lines below are not read")
                .flow(Flow::leave_file)
                .right("return")
                .right("ret")
                .wrong("return 1", "unexpected '1' after the end of the command"),
            Entry<Quit>({"quit", Spelling{"stop", 3}, "exit"}) // st is step
                .help("ends the program")
                .flow(Flow::leave_all)
                .right("quit")
                .right("stop")
                .right("exit")
                .wrong("quit now", "unexpected 'now' after the end of the command"),
            title(),
            Entry<ReadDialect>({Spelling{"dialect", 7}})
                .help("reads lines of one dialect only from here to the end of the file, or of both again")
                .action(
                    {Spelling{"both", 4}}, [](ReadDialect&) {},
                    "the first words of a line decide, as without the command")
                .action(
                    {Spelling{"classic", 7}}, [](ReadDialect&) {}, "lines as in 3DEC 5: poly brick")
                .action(
                    {Spelling{"modern", 6}}, [](ReadDialect&) {}, "lines as in 3DEC 6, 7 and 9: block create brick")
                .finish([](const Reader& reader, ReadDialect&) {
                    if (reader.statement().words.size() != 2)
                        incomplete_line(reader, "dialect takes one word", "write: dialect modern");
                })
                .right("dialect modern")
                .right("dialect both")
                .wrong("dialect", "dialect takes one word")
                .wrong("dialect modrn", "'modrn' is not a keyword of dialect"),
            Entry<Pause>({"pause"})
                .help("waits for a key if the input is a terminal")
                .right("pause")
                .wrong("pause 5", "unexpected '5' after the end of the command"),
        }};
}

} // namespace kaya::lang
