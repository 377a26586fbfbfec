// One run of the program: the model, what acts on it, and where its words go.
#pragma once

#include "base/gate.hpp"
#include "commands/given_properties.hpp"
#include "commands/model_world.hpp"
#include "commands/occupied.hpp"
#include "commands/output.hpp"
#include "commands/plot_views.hpp"
#include "commands/ranges.hpp"
#include "commands/autosave.hpp"
#include "commands/run_name.hpp"
#include "commands/text_table.hpp"
#include "io/vtk.hpp"
#include "laws/joint_model.hpp"
#include "mechanics/cycle.hpp"
#include "model/model.hpp"

#include "lang/interp/interpreter.hpp"
#include "lang/script/scripts.hpp"

#include <any>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace kaya {

/// What the command line says.
struct Options {
    int threads = 0;     ///< 0: one for each core
    bool strict = false; ///< warnings are errors
    bool quiet = false;  ///< results and messages only
    bool echo = false;   ///< each command is shown before it runs
    bool trust = false;  ///< scripts may use the whole of Lua: files, other programs
    std::size_t script_memory = 0; ///< megabytes that scripts may take; 0: as much as there is
    std::vector<std::filesystem::path> joint_folders; ///< in which joint models are looked for
};

/// How a command of a deck came to its end.
struct Completion {
    enum class How {
        done,
        stopped, ///< by the user, after a cycle
        cut_off, ///< by the user, inside of a script: nobody can do just that again
        failed
    };
    How how = How::done;
    std::int64_t cycle = 0; ///< after which it was stopped
};

class Session {
public:
    explicit Session(const Options& options, std::FILE* results = stdout, std::FILE* messages = stderr);

    /// Scripts go first: what they do at their end may still call the rest.
    ~Session();

    /// Runs a deck from its first line to its last. Throws lang::DeckErrors before the first command
    /// when the deck does not bind, else the Diagnostic of the first command that fails.
    lang::Ended run_deck(const std::string& file);

    /// Shows a warning; under `--strict` throws it as an error. The place of the running command is
    /// added when it has none.
    void warn(Diagnostic warning);

    /// Warns once of each joint or zone model that changes how the processor computes; it was put back.
    void tell_of_arithmetic();

    /// The test of a range, of objects of that kind. Throws Diagnostic at the element that is wrong.
    RangeTest test_of(ObjectKind kind, const lang::RangePhrase& range);
    /// What range elements read besides the model; `excavated`: the model is that of the blocks that fill can put back.
    RangeExtras range_extras(bool excavated);
    /// Visible rows in a range, ascending. Warns when the range picks none.
    std::vector<Row> pick(ObjectKind kind, const lang::RangePhrase& range);
    /// The same, hidden blocks and their parts included.
    std::vector<Row> pick_hidden_too(ObjectKind kind, const lang::RangePhrase& range);

    /// What the journal and the autosave of the present deck begin with; says so when another run has the plain name.
    std::string run_name();

    /// "tunnel.3dd:12" of the running command, "" outside a deck.
    std::string here() const;

    /// A file of a deck: next to the deck when it is there, else in the current folder.
    std::filesystem::path next_to_deck(const std::string& name) const;
    /// The same, of a file that is going to be read: the gate is asked, and it is kept in files_read.
    std::filesystem::path input_file(const std::string& name);
    /// The name of a file that is going to be written, when the gate lets it through. Throws Diagnostic.
    const std::string& output_file(const std::string& name);

    /// `print @x`: the value as FISH shows it.
    std::string symbol_text(const std::string& expression);

    /// Shows a note at the running command, the first time that it is said.
    void note_once(const std::string& message, const std::string& hint = {});

    /// Back to the state of a new session; settings of the program (threads, log) stay, and so do scripts when one of them
    /// asks for it.
    void clear();

    Options options;
    std::shared_ptr<Gate> gate = std::make_shared<Gate>(); ///< open until somebody shuts it
    Output output;
    Model model;
    JointRegistry joints;
    NamedRanges ranges;
    ModelWorld world;
    std::unique_ptr<script::Scripts> scripts;
    std::unique_ptr<Cycle> cycle;
    lang::Interpreter interpreter;

    std::map<std::string, script::Value> parameters; ///< of `param` and `kaya --set`, by folded name; `new` keeps them
    GivenProperties given_properties; ///< of `param` and `kaya --set`, in the place of those of the deck
    std::string title;
    std::string log_file = "kaya.log"; ///< of the next `set log on`
    std::string deck;                  ///< file name of the deck that runs, for default names of output files
    VtkSeries vtk;                     ///< the picture series of this run
    PlotViews plots;                   ///< the pictures that `plot` has described
    std::shared_ptr<Painter> painter;  ///< what draws them; none: where it is looked for by itself
    std::vector<std::shared_ptr<const SourceText>> sources; ///< texts of the decks that ran, for save files
    std::set<std::string> files_read;  ///< names of files that commands have read, decks not among them
    /// Gets each command of decks after its run; those of scripts are part of the command that ran the script.
    std::function<void(const lang::BoundCommand&, const Completion&)> executed;
    std::function<void()> cycled;      ///< called after each cycle
    bool report = false;               ///< the run ends with a page: set report on
    std::optional<std::int64_t> stop_after; ///< a cycle: a replay stops there as the user did
    std::size_t warnings = 0;                               ///< shown so far
    std::vector<std::string> warning_texts;                 ///< the first hundred of them
    bool inside_cycle = false;                              ///< a hook is running: structure must not change
    std::vector<std::pair<Place, std::function<void()>>>
        deferred;                    ///< changes that wait for the end of the cycle
    Autosave autosave{*this};            ///< what is kept when the run is cut off
    Occupied occupied;               ///< where blocks stand, for the warning about two in one place
    std::set<std::string> said_once; ///< notes that are not repeated
    std::map<std::pair<std::int32_t, std::string>, Place>
        property_places; ///< of `prop` words, for late messages

    Place last_place; ///< of the command that ran last, for failures that have no place of their own

    /// Asks the run to stop after the present cycle, and scripts to stop at once. For signal handlers.
    void interrupt() noexcept;
    /// A script is where nothing reaches it, though somebody asked it to stop. For signal handlers.
    bool is_deaf() const noexcept;
    /// Somebody has asked the run to stop, and it has not yet.
    bool is_to_stop() const noexcept { return interrupted_; }
    /// Throws Diagnostic when somebody asked for it.
    void stop_if_interrupted();
    /// The same after a cycle, which a journal can tell and a replay do again.
    void stop_after_cycle();

    /// The cycle of the present model; to be made anew when the model was replaced.
    void make_cycle();

private:
    void review(const lang::BoundFile& file, const lang::BareNames& names);
    void show_command(const lang::BoundCommand& command);
    std::vector<Row> pick_rows(ObjectKind kind, const lang::RangePhrase& range, bool hidden_too);

    RunNames names_;
    std::atomic<bool> interrupted_ = false;
    bool stopped_inside_ = false; ///< the command that runs was stopped where nobody can stop it again
    std::optional<std::int64_t> stopped_after_; ///< cycle of the stop that is on its way up
    int commands_of_scripts_ = 0; ///< scripts that are giving commands at this moment, one in the other
};

/// What is looked at when a deck is bound, before its first command runs: whether FISH compiles.
lang::Checks deck_checks();

/// "0.1.0"
const char* program_version();

} // namespace kaya
