// One run: the program around it, the deck that it follows, and the engine that the deck moves.
#pragma once

#include "commands/session/deck.hpp"
#include "commands/world/engine.hpp"
#include "commands/review/plot_views.hpp"
#include "commands/program/program.hpp"
#include "commands/program/run_name.hpp"
#include "commands/program/text_table.hpp"
#include "io/vtk.hpp"

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace kaya {

class Autosave;

/// The argument of handlers. It holds three parts that do not know each other, and serves the interpreter and the scripts.
class Session : private lang::InterpreterHost, private WorldHost {
public:
    explicit Session(const Options& options, std::FILE* results = stdout, std::FILE* messages = stderr);

    /// Scripts are destroyed first: their finalisers may still call the rest.
    ~Session() override;

    /// Runs a deck from its first line to its last. Throws lang::DeckErrors before the first command
    /// when the deck does not bind, else the Diagnostic of the first command that fails.
    lang::Ended run_deck(const std::string& file);

    /// Shows a warning; under `--strict` throws it as an error. The place of the running command is
    /// added when it has none.
    void warn(Diagnostic warning);
    /// Shows a note at the running command, once per text.
    void note_once(const std::string& message, const std::string& hint = {});
    /// The same as a warning.
    void warn_once(const std::string& message, const std::string& hint = {});

    /// Warns once of each joint or zone model that changes how the processor computes; it was put back.
    void tell_of_arithmetic();

    /// The test of a range, of objects of that kind. Throws Diagnostic at the element that is wrong.
    RangeTest test_of(ObjectKind kind, const lang::RangePhrase& range);
    /// Inputs of range elements beyond the model; `excavated`: the model is that of the blocks that fill can put back.
    RangeExtras range_extras(bool excavated);
    /// Visible rows in a range, ascending. Warns when the range picks none.
    std::vector<Row> pick(ObjectKind kind, const lang::RangePhrase& range);
    /// The same, including hidden blocks and their parts.
    std::vector<Row> pick_hidden_too(ObjectKind kind, const lang::RangePhrase& range);

    /// The name prefix of the journal and the autosave of the present deck; reports when another run has the plain name.
    std::string run_name();

    /// A file of a deck to be read, see next_to_deck: asks the gate, and records it in files_read.
    std::filesystem::path input_file(const std::string& name);

    /// `print @x`: the value as FISH shows it.
    std::string symbol_text(const std::string& expression);

    /// Returns to the state of a new session; settings of the program (threads, log) stay, and so do scripts when one of them requests it.
    void clear();

    /// Requests a stop after the present cycle, and of scripts at once. For signal handlers.
    void interrupt() noexcept;
    /// A stop was requested and has not happened yet.
    bool is_to_stop() const noexcept { return interrupted_; }
    /// A script runs at a point where a stop request cannot reach it. For signal handlers.
    bool is_deaf() const noexcept;
    /// Throws Diagnostic when a stop was requested.
    void stop_if_interrupted();
    /// The same after a cycle; a journal can record it and a replay repeat it.
    void stop_after_cycle();
    /// Whether scripts of the deck act inside cycles: they may read and write fields, print, or keep data outside the model.
    bool scripts_act_in_cycles() const;

    Program program;
    Deck deck;
    Engine engine;

    std::optional<std::int64_t> stop_after; ///< a cycle: a replay stops there as the user did
    VtkSeries vtk;                          ///< the picture series of this run
    PlotViews plots;                        ///< the pictures that `plot` has described
    std::shared_ptr<Painter> painter;       ///< draws the pictures; null: searched automatically
    std::unique_ptr<Autosave> autosave;     ///< keeps the model when the run is cut off

private:
    // Services for the interpreter.
    void run(const lang::BoundCommand& command) override;
    lang::Value value(const std::string& expression, const Place& place) override;
    void deck_read(const lang::BoundFile& file, const lang::BareNames& names) override;
    void warning(const Diagnostic& of_interpreter) override { warn(of_interpreter); }
    void before(const lang::BoundCommand& command) override;
    void after(const lang::BoundCommand& command) override;
    void failed(const lang::BoundCommand& command) override;

    // Services for scripts.
    std::string run_text(const std::string& text, const std::string& chunk, int line, bool caught) override;
    void note(const std::string& message) override { note_once(message); }
    void warn_once_here(Diagnostic warning) override;
    const lang::RangePhrase* range_phrase(const std::string& name) override;
    RangeTest range_test_of(ObjectKind kind, const lang::RangePhrase& range) override { return test_of(kind, range); }
    bool asks_for_objects(const lang::RangePhrase& range) override;

    std::vector<Row> pick_rows(ObjectKind kind, const lang::RangePhrase& range, bool hidden_too);

    RunNames names_;
    std::atomic<bool> interrupted_ = false;
    bool stopped_inside_ = false; ///< the running command was stopped at a point that a replay cannot repeat
    std::optional<std::int64_t> stopped_after_; ///< cycle of a stop that is being handled
    int commands_of_scripts_ = 0;               ///< nested scripts that are giving commands
};

} // namespace kaya
