// Decks in files: binding before running, calls, ends, errors and their positions.
#include "lang/interp/interpreter.hpp"

#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"

#include <chrono>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace kaya::lang {
namespace {

namespace fs = std::filesystem;

class Decks : public testing::Test, protected InterpreterHost {
protected:
    Decks() : interpreter(classic(), *this) {}

    void SetUp() override {
        folder = fs::temp_directory_path() / ("kaya_decks_" + std::to_string(::getpid()));
        fs::create_directories(folder);
        interpreter.folders = {folder};
    }
    void TearDown() override { fs::remove_all(folder); }

    void run(const BoundCommand& bound) override {
        const std::any& command = bound.command;
        if (const auto* title = std::any_cast<Title>(&command)) done.push_back(title->text);
        else if (const auto* cycle = std::any_cast<CycleCommand>(&command))
            done.push_back(fmt::format("cycle {}", *cycle->cycles));
        else if (std::any_cast<PolyBrick>(&command)) done.emplace_back("brick");
        else if (const auto* call = std::any_cast<FishCall>(&command)) on_call(call->expression);
        else if (std::any_cast<Pause>(&command)) throw Diagnostic("no key is there");
    }

    Value value(const std::string&, const Place&) override { return value_of_names; }
    void warning(const Diagnostic& warning) override { warnings.push_back(warning); }
    void before(const BoundCommand& command) override { begun.push_back(command.text()); }
    void after(const BoundCommand& command) override { ended.push_back(command.spec->name()); }

    void write(const std::string& name, const std::string& text) {
        fs::create_directories((folder / name).parent_path());
        std::ofstream(folder / name, std::ios::binary) << text;
    }

    Diagnostic failure(const std::string& name) {
        try {
            interpreter.run_file(name);
        } catch (const Diagnostic& d) { return d; }
        ADD_FAILURE() << name << " ran to its end";
        return Diagnostic("");
    }

    std::vector<Diagnostic> mistakes(const std::string& text) {
        try {
            interpreter.run_text(text, "text");
        } catch (const DeckErrors& errors) { return errors.all; }
        return {};
    }

    fs::path folder;
    Interpreter interpreter;
    std::vector<std::string> done, begun, ended;
    std::vector<Diagnostic> warnings;
    Value value_of_names;
    std::function<void(const std::string&)> on_call = [](const std::string&) {};
};

using Done = std::vector<std::string>;

TEST_F(Decks, RunsInOrder) {
    write("a.3dd", "title one\npoly brick 0 1\ncycle 5\n");
    EXPECT_EQ(interpreter.run_file("a.3dd"), Ended::end_of_deck);
    EXPECT_EQ(done, (Done{"one", "brick", "cycle 5"}));
    EXPECT_FALSE(interpreter.current_place());
}

TEST_F(Decks, NothingRunsWhenAnyLineIsWrong) {
    write("a.3dd", "title one\npoly brick 0 1\npolly brick\ncycle x\ntitle two\ngen edge 0\n");
    EXPECT_EQ(failure("a.3dd").message, "'polly' is not a command");
    EXPECT_TRUE(done.empty());
    const auto all = mistakes("polly brick\ncycle x\ntitle two\ngen edge 0\n");
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].place.line, 1);
    EXPECT_EQ(all[1].place.line, 2);
    EXPECT_EQ(all[2].place.line, 4);
}

TEST_F(Decks, AtMostTwentyMistakes) {
    std::string text;
    for (int i = 0; i < 50; ++i) text += "wrong line\n";
    EXPECT_EQ(mistakes(text).size(), 20u);
}

TEST_F(Decks, EmptyDecks) {
    for (const char* text : {"", "\n\n", "; only a comment", "   \t \r\n;x\r\n"}) {
        write("empty.3dd", text);
        EXPECT_EQ(interpreter.run_file("empty.3dd"), Ended::end_of_deck);
    }
    EXPECT_TRUE(done.empty());
}

TEST_F(Decks, ReturnEndsTheFileAndQuitEndsAll) {
    write("inner.dat", "title inner\nreturn\nthis is never read 'at all\n");
    write("a.3dd", "call inner\ntitle after\nquit\ntitle never\n");
    EXPECT_EQ(interpreter.run_file("a.3dd"), Ended::quit);
    EXPECT_EQ(done, (Done{"inner", "after"}));
    write("ends.dat", "stop\n");
    write("b.3dd", "call ends.dat\ntitle never\n");
    done.clear();
    EXPECT_EQ(interpreter.run_file("b.3dd"), Ended::quit) << "quit in a called file ends all";
    EXPECT_TRUE(done.empty());
}

TEST_F(Decks, CalledFilesAreBoundFirst) {
    write("inner.dat", "title inner\ncycle x\n");
    write("a.3dd", "title one\ncall inner.dat\n");
    const Diagnostic d = failure("a.3dd");
    EXPECT_EQ(d.message, "'x' is not a keyword of cycle");
    EXPECT_EQ(d.place.source->name, "inner.dat");
    EXPECT_EQ(d.place.line, 2);
    EXPECT_TRUE(done.empty()) << "the mistake shows before the first command runs";
}

TEST_F(Decks, MissingCalledFile) {
    write("part.dat", "title part\n");
    write("a.3dd", "title one\ncall prat.dat\n");
    const Diagnostic d = failure("a.3dd");
    EXPECT_EQ(d.message, "there is no file 'prat.dat'");
    EXPECT_EQ(d.hint, "did you mean 'part.dat'?");
    EXPECT_EQ(d.place.line, 2);
    EXPECT_TRUE(done.empty());
}

TEST_F(Decks, ScriptMayWriteTheFileThatIsCalled) {
    on_call = [&](const std::string&) { write("made.dat", "title made\n"); };
    write("a.3dd", "def make\n status = open('made.dat', 1, 1)\nend\n@make\ncall made.dat\n");
    interpreter.run_file("a.3dd");
    EXPECT_EQ(done, Done{"made"});

    on_call = [&](const std::string&) { write("made.dat", "title changed\n"); };
    done.clear();
    interpreter.run_file("a.3dd");
    EXPECT_EQ(done, Done{"changed"}) << "not the text that was there when the deck was bound";

    on_call = [](const std::string&) {};
    fs::remove(folder / "made.dat");
    const Diagnostic d = failure("a.3dd");
    EXPECT_EQ(d.message, "there is no file 'made.dat'");
    EXPECT_EQ(d.place.line, 5);
}

TEST_F(Decks, FilesAreSearchedNextToTheCaller) {
    write("sub/inner.dat", "call beside.dat\ncall above.dat\n");
    write("sub/beside.dat", "title beside\n");
    write("above.dat", "title above\n");
    write("a.3dd", "call sub/inner.dat\n");
    interpreter.run_file("a.3dd");
    EXPECT_EQ(done, (Done{"beside", "above"}));
}

TEST_F(Decks, CircleOfCalls) {
    write("a.3dd", "title one\ncall b.3dd\n");
    write("b.3dd", "call a.3dd\n");
    const Diagnostic d = failure("a.3dd");
    EXPECT_EQ(d.message, "endless calls of files: a.3dd calls b.3dd calls a.3dd");
    EXPECT_EQ(d.place.source->name, "b.3dd");
    EXPECT_TRUE(done.empty());
    write("self.3dd", "call self\n");
    EXPECT_EQ(failure("self.3dd").message, "endless calls of files: self.3dd calls self.3dd");
}

TEST_F(Decks, TwiceTheSameFileIsNoCircle) {
    write("part.dat", "title part\n");
    write("a.3dd", "call part.dat\ncall part.dat\n");
    interpreter.run_file("a.3dd");
    EXPECT_EQ(done, (Done{"part", "part"}));
}

TEST_F(Decks, CallsMayBeDeepButNotEndless) {
    for (int i = 0; i < 90; ++i) write(fmt::format("f{}.dat", i), fmt::format("call f{}.dat\n", i + 1));
    write("f90.dat", "title bottom\n");
    interpreter.run_file("f0.dat");
    EXPECT_EQ(done, Done{"bottom"});
    for (int i = 90; i < 120; ++i) write(fmt::format("f{}.dat", i), fmt::format("call f{}.dat\n", i + 1));
    write("f120.dat", "title bottom\n");
    EXPECT_EQ(failure("f0.dat").message, "more than 100 files call each other");
}

TEST_F(Decks, ScriptThatCallsItselfEndlessly) {
    on_call = [&](const std::string&) { interpreter.run_text("@again\n", "script"); };
    write("a.3dd", "@again\n");
    EXPECT_EQ(failure("a.3dd").message, "more than 100 files and scripts call each other");
}

TEST_F(Decks, FailureGetsItsPlaceAndItsCallers) {
    write("inner.dat", "title inner\n\npause\n");
    write("middle.dat", "call inner.dat\n");
    write("a.3dd", "title one\ncall middle.dat\ntitle never\n");
    const Diagnostic d = failure("a.3dd");
    EXPECT_EQ(d.message, "no key is there");
    EXPECT_EQ(d.place.source->name, "inner.dat");
    EXPECT_EQ(d.place.line, 3);
    EXPECT_EQ(d.context, (Done{"called from middle.dat:1", "called from a.3dd:2"}));
    EXPECT_EQ(done, (Done{"one", "inner"}));
    EXPECT_FALSE(interpreter.current_place()) << "the interpreter is ready for the next deck";
}

TEST_F(Decks, NamesGetTheirValuesWhenReached) {
    on_call = [&](const std::string& expression) { value_of_names = std::int64_t{std::stoi(expression)}; };
    write("one.dat", "title one\n");
    write("a.3dd", "@10\ncycle @n\n@20\ncycle &\n @n\n");
    interpreter.run_file("a.3dd");
    EXPECT_EQ(done, (Done{"cycle 10", "cycle 20"}));

    value_of_names = std::string("one");
    write("b.3dd", "call @name\n");
    done.clear();
    interpreter.run_file("b.3dd");
    EXPECT_EQ(done, Done{"one"});
    write("c.3dd", "title first\ncycle @name\n");
    const Diagnostic d = failure("c.3dd");
    EXPECT_EQ(d.message, "'@name' is a text, and must be a whole number");
    EXPECT_EQ(d.place.line, 2);
}

TEST_F(Decks, ObserversSeeEachCommand) {
    write("part.dat", "title x\n");
    write("a.3dd", "poly brick (0,1) ; a cube\ncall part.dat\n");
    interpreter.run_file("a.3dd");
    EXPECT_EQ(begun, (Done{"poly brick (0,1)", "call part.dat", "title x"}));
    EXPECT_EQ(ended, (Done{"poly brick", "title", "call"}));
}

TEST_F(Decks, ChecksRunBeforeAnyCommand) {
    interpreter.checks.command = [](const std::any& command) {
        const auto* function = std::any_cast<FishDefinition>(&command);
        if (function && function->text.find("wrong") != std::string::npos) throw Diagnostic("the function is wrong");
    };
    write("a.3dd", "title one\ndef f\n wrong\nend\n");
    const Diagnostic d = failure("a.3dd");
    EXPECT_EQ(d.message, "the function is wrong");
    EXPECT_EQ(d.place.line, 2);
    EXPECT_TRUE(done.empty());
}

TEST_F(Decks, WarningsGetThePlaceOfTheRunningCommand) {
    on_call = [&](const std::string&) { interpreter.warn(Diagnostic("nothing is in the range")); };
    write("a.3dd", "\n@warn\n");
    interpreter.run_file("a.3dd");
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].severity, Severity::warning);
    EXPECT_EQ(warnings[0].place.line, 2);
}

TEST_F(Decks, TextOfAScriptKeepsItsLines) {
    on_call = [&](const std::string&) { interpreter.run_text("title in\npause\n", "a.3dd", 40); };
    write("a.3dd", "@f\n");
    const Diagnostic d = failure("a.3dd");
    EXPECT_EQ(d.place.line, 41);
    EXPECT_EQ(d.context, Done{"called from a.3dd:1"});
}

TEST_F(Decks, MoreIsNeeded) {
    EXPECT_TRUE(needs_more(classic(), "def f\n x = 1"));
    EXPECT_FALSE(needs_more(classic(), "def f\n x = 1\nend"));
    EXPECT_TRUE(needs_more(classic(), "lua\nx = 1\nend"));
    EXPECT_FALSE(needs_more(classic(), "lua a.lua"));
    EXPECT_TRUE(needs_more(classic(), "poly brick &"));
    EXPECT_FALSE(needs_more(classic(), "poly brick &\n 0 1"));
    EXPECT_FALSE(needs_more(classic(), ""));
}

TEST_F(Decks, ManyLines) {
    std::string text;
    for (int i = 0; i < 100000; ++i) text += fmt::format("poly brick {},{} 0,1 0,1 region {}\n", i, i + 1, i % 7);
    const auto start = std::chrono::steady_clock::now();
    const auto bound = bind_text(classic(), source_from_text("many", text), {"."});
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(bound->steps.size(), 100000u);
    fmt::print("100000 lines of poly brick bound in {:.2f} s\n", seconds.count());
}

} // namespace
} // namespace kaya::lang
