#include "guide/explanations.hpp"

#include "base/diagnostic.hpp"
#include "base/lower_case.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace kaya {

namespace {

struct Explanation {
    std::string_view code, title, text;
};

constexpr Explanation explanations[] = {
    // Words of a command.
    {"choices", "an answer to '?'",
     "A '?' in place of a word lists the valid words. The line is not run.\n"
     "Example: bound ?"},
    {"incomplete-line", "an incomplete line",
     "All words of the line are right, but a required word or value is missing, such as the quantity to reset or the\n"
     "property to set. The hint shows a whole line. 'kaya help COMMAND' shows the syntax."},
    {"left-over", "a word too many",
     "The command is complete, and another word follows. Often a continuation mark (& or ...) is in a line that\n"
     "should end, or a text with blanks is not in quotes."},
    {"missing-value", "a value or a word is missing",
     "The line ends before a number, a name or a second word of the command. A blank after '@' counts too:\n"
     "write @name."},
    {"implausible", "valid, but probably not intended",
     "An angle of friction below 1.6 degrees, a Poisson's ratio below 0, local damping of 1, a text compared with a\n"
     "number, a duplicate case, a continuation mark on the last line, a run without blocks. The run continues;\n"
     "--strict stops it."},
    {"far-away", "a place outside of the model",
     "A history takes the nearest object, however far away it is. 'list hist' shows the object, its place and the\n"
     "distance from the place that was given."},
    {"lua-syntax", "Lua cannot read a chunk",
     "All chunks between 'lua' and 'endlua', and the files of 'lua FILE', are read with the deck, before anything runs.\n"
     "The line is where Lua stopped reading; the mistake may be before it."},
    {"other-language", "a file of another program",
     "The first line that kaya does not know looks like one of Python, MATLAB, FLAC3D, PFC, UDEC, Abaqus or Ansys. The rest of the file is\n"
     "not read. 'kaya help' lists the commands."},
    {"never-read", "a variable of FISH that is set and never read",
     "A name that differs by one letter is read: this one may be misspelt. Whole decks are checked, with the files that\n"
     "they call; there is no warning when a restored model or an unknown file may read it."},
    {"never-set", "a name of FISH that is never set",
     "A variable that is never set is 0. Set it, write 'global NAME' in a function, or correct the name. There is no\n"
     "warning when a restored model, a file that is not known before the run, or Lua may set it."},
    {"no-value", "a function of FISH that never sets its name",
     "The value of a function is what a line sets under its name, or what it returns. Without such a line it is 0: a history\n"
     "records 0, and a load is multiplied by 0. A function that sets other variables runs in cycles by 'fish callback add'."},
    {"never-ended", "a function or a chunk of Lua without its end",
     "A 'def' needs a line with 'end' alone, and 'lua' a line with 'endlua' alone. Inside a function each loop, if,\n"
     "case_of, section and command needs its own closing word."},
    {"not-closed", "a quote or a bracket is not closed",
     "Quotes, brackets and the parenthesis of @name( must be closed on the same line. Inside of quotes a doubled quote\n"
     "is one quote."},
    {"not-a-number", "a word in place of a number",
     "Numbers are written 12, -0.5, 1e-6. A variable of FISH needs an '@' in front: fric @angle."},
    {"not-whole", "a number with a point in place of a whole number",
     "Counts and identity numbers are whole. Write 3, not 3.0 or 3e0."},
    {"not-on-off", "neither on nor off", "A switch takes on or off; true, false, yes, no mean the same."},
    {"not-a-word", "a number in place of a word",
     "A keyword must follow here. Perhaps the value before it takes fewer numbers than the line gives."},
    {"not-a-symbol", "a name without '@'",
     "Here the name of a variable or function of FISH is needed, with '@' in front."},
    {"not-supported-yet", "a word of 3DEC that kaya does not support yet",
     "The command or keyword is one of 3DEC, and this version of kaya does not support it. 'kaya check FILE' lists all\n"
     "such lines of a deck before anything runs."},
    {"out-of-limits", "a number outside of its limits",
     "The message has the limits. Units are those of the deck: kaya never converts them."},
    {"unknown-command", "the first word of a line is not a command",
     "'kaya help' lists the commands. Words may be shortened to their first letters; a misspelt word gets a\n"
     "suggestion. A line that should continue the one before needs '&' or '...' at the end of that one."},
    {"unknown-word", "a word that the command does not know",
     "The hint lists the valid words, or the nearest one. '?' in place of the word lists them too."},
    {"unknown-property", "a property that the joint model does not have",
     "'list jmodel' lists the joint models that are loaded with their properties."},
    {"wrong-type", "a value of a script of the wrong kind",
     "The expression after '@' or in '[ ]' has a value that cannot be used here: a text in place of a number, a\n"
     "pointer, or a number that is infinite or undefined."},
    {"no-object", "a group, range, table or history that no earlier line makes",
     "The whole deck is read before its first command runs. A name counts when a line before it makes the object; there\n"
     "is no such message after a restored model, or when a script or an imported file may make it."},
    {"no-effect", "a command that has nothing to act on",
     "No line before it makes a block. 'kaya check' says so before the run, the run when it reaches the line."},
    {"no-file", "a missing file",
     "Decks are searched next to the deck that calls them, then in the folder where kaya was started. The endings\n"
     ".3dd .dat .3ddat .fis .txt may be left out."},
    // Permissions of a run: docs/safety.md.
    {"file-outside", "a file outside of the folders that a run may use",
     "Without --trust a run reads and writes below the folder where it was started, below the folders of its decks, and\n"
     "below those that 'kaya allow FOLDER' has named. The message shows that command. Of a link the target counts."},
    {"file-special", "a pipe, a device, a file of the system or with several names",
     "Such a file could block the run, or be a file elsewhere under a second name. Name an ordinary file, or run with\n"
     "--trust."},
    {"file-in-use", "a file that a run must not overwrite",
     "It is the deck, something that the deck has called or loaded, or the list of your permissions."},
    {"file-hidden", "a name that decks do not write",
     "Files that begin with a point are settings of programs, files that end in .so are libraries of code. Give another name."},
    {"wide-folder", "a run in the home folder or in /",
     "Without --trust a run may write everything that is not hidden below the folder where it starts and below that of its deck:\n"
     "in the home folder that is all of the user's work. Put decks into a separate folder, and start runs there."},
    {"library-not-allowed", "a joint model that has not been allowed",
     "A library is code that can do whatever you can. Those of the installed folder, of --joints and of KAYA_JOINTS are loaded;\n"
     "another one is loaded after 'kaya allow FILE', until the file changes. 'kaya jmodel build' allows the library that it makes."},
    // Scripts.
    {"unknown-fish-name", "an unknown name of FISH",
     "In a command @name must be a variable that some function mentions, a function, or a built-in name. Inside of a\n"
     "function an unknown name is a new variable with the value 0."},
    {"unsupported-fish-name", "a name of 3DEC's FISH that kaya does not have",
     "As a variable it would silently be 0, so it is refused. docs/fish.md lists every name with what to\n"
     "use in its place. A local variable or an argument may have such a name."},
    // Joint models.
    {"joint-model-unknown", "no joint model of this name",
     "A joint model is a shared library NAME.so next to the program, in a folder of --joints or of KAYA_JOINTS, or\n"
     "next to the deck. 'jmodel load FILE' takes one by its path."},
    {"joint-model-version", "a joint model for another version of the interface",
     "Libraries of older interfaces load, from version 2 on. A newer one needs a newer program."},
    {"joint-model-table", "the table of a joint model is wrong",
     "The library was found, and its description of itself is invalid; the message names the entry. This is a\n"
     "mistake in the joint model, not in the deck."},
    {"joint-model-stiffness", "a joint model gives no usable stiffness",
     "The time step needs a normal stiffness above 0 and a shear stiffness of at least 0, both finite. Check first\n"
     "the values that the deck gives to the model."},
    {"joint-model-failed", "a joint model failed while it ran",
     "It threw an exception, or left a number that is not finite. The message says at which contact, in which cycle.\n"
     "The usual reasons are large overlaps from too long a step, or inconsistent properties."},
    {"joint-model-trespass", "a joint model writes outside of its data",
     "It was tried on one sub-contact whose columns are between fences. It wrote to read-only data, or outside of its\n"
     "columns. In a run that would damage other sub-contacts, or memory that the program uses later."},
    {"joint-model-arithmetic", "a model changes how the processor computes",
     "It changes the rounding, flushes very small numbers to 0, or traps divisions by 0, and does not reset it. The\n"
     "program resets it, since later results would differ, also between numbers of threads. -ffast-math does this."},
    {"joint-model-conduct", "a joint or zone model changes the process of the run",
     "It started a second process by fork(), which ends the run; it changed the working folder, signal handlers, limits or\n"
     "the standard streams, which are restored; or it started threads. The message names the model and its file. A model\n"
     "computes in its own columns and changes nothing else. See docs/safety.md."},
    {"joint-model-other-file", "the file of a joint model has changed since the model was saved",
     "A save file keeps path and SHA-256 of a joint model that was loaded by its path. The run continues with the\n"
     "present file; if the source is the same and only built again, nothing is wrong."},
    {"zone-model-unknown", "no zone model of this name",
     "Zone models are found by name in the folder 'zones' next to that of the joint models, or by the path of a library. The\n"
     "message lists the available ones. Constitutive number 1 is elastic, 2 is mohr-coulomb."},
    {"zone-model-version", "a zone model for another version of the interface",
     "The library was compiled against another include/kaya/zmodel.h. Compile it again."},
    {"zone-model-table", "the table of a zone model is wrong",
     "The library was found, and its description of itself is invalid; the message names the entry. This is a\n"
     "mistake in the zone model, not in the deck."},
    {"zone-model-not-a-library", "a file that is not a zone model",
     "It must be a shared library that was built for this machine: c++ -shared -fPIC, or kaya_add_zone_model in CMake."},
    {"zone-model-crashes", "a zone model that crashes when it is loaded",
     "It was tried in a separate process first, so the run is not affected. Check its static objects and its descriptor."},
    {"zone-model-no-entry", "a library without a zone model",
     "It has no function kaya_zone_model. Include kaya/zmodel.h and define it with C linkage."},
    {"zone-model-name-taken", "two zone models with one name",
     "A name belongs to the first folder that has it. Give the other model another name in its descriptor."},
    {"zone-model-moduli", "a zone model that gives no moduli",
     "The time step needs bulk and shear moduli that are finite and above 0. Check first the values that the deck gives."},
    {"zone-model-trespass", "a zone model writes outside of its data",
     "It was tried on one zone whose columns are between fences. It wrote to read-only data, or outside of its columns. In a\n"
     "run that would damage other zones, or memory that the program uses later."},
    {"zone-model-failed", "a zone model failed while it ran",
     "It threw an exception, or left a number that is not finite. The message says in which zone. The usual reasons are\n"
     "too long a step, or inconsistent properties."},
    {"zone-crushed", "a zone is crushed or turned inside out",
     "It has less than a fifth of its volume, is flatter than two degrees, or has turned inside out. Its stresses would\n"
     "have no meaning. The usual reasons are a boundary that moves too far, a load without support, and a step that is too\n"
     "long. The state before the cycle is saved."},
    {"joint-model-restore", "a saved model needs a joint model that has changed",
     "The saved state belongs to the library of that time: same name, same properties. Use that one."},
    {"property-missing", "a required property is missing",
     "The joint or block model cannot run without it. Give it with 'prop' or 'jmodel property' before the first cycle."},
    {"forces-not-carried", "a joint model cannot carry the forces that a joint has",
     "The joint had them from another model, from 'insitu' or from a script. They are cut to the strength of the new model,\n"
     "and the rest is lost. Check the strength, or bring the model to rest before the change."},
    {"water-line", "the water of a joint ends between two of its sub-contacts",
     "Sub-contacts below a ground surface have the pressure at their places, each on its area: where the water ends within a\n"
     "joint of few places, the sum is not the force of the water. The message has both forces. Cut the blocks at the water\n"
     "level, or give smaller cells. Below a plane table and with 'water pressure', joints have the exact force and moment."},
    // Runs.
    {"motion-lost", "the run diverged: a velocity became NaN or infinite",
     "The step was too long, nearly always because a stiffness was reported too low, or because loads are in other units\n"
     "than stiffnesses. Look at the last histories, and try a\n"
     "smaller 'set fraction'."},
    {"step-makes-energy", "a time step beyond the bound creates energy",
     "The step of 'set dt' is above the stability bound, and the energy residual is more than a tenth of the energy turned\n"
     "over. Give a smaller step, or 'set dt 0' for the computed one."},
    // Exit status.
    {"status-1", "the deck is wrong",
     "Exit status 1. No command has run when the mistake is in the words of the deck."},
    {"status-2", "the run failed",
     "Exit status 2: the deck could be read, and a command of it failed while it ran, or Ctrl-C stopped it."},
    {"status-3", "internal error", "Exit status 3: a fault of the program. Please report it with the deck."},
};

} // namespace

std::string code_list() {
    std::size_t longest = 0;
    for (const auto& entry : explanations) longest = std::max(longest, entry.code.size());
    std::string text;
    for (const auto& entry : explanations) text += fmt::format("{:{}}  {}\n", entry.code, longest, entry.title);
    return text;
}

std::string explanation(std::string_view words) {
    // As they are printed after a message, in brackets.
    const bool in_brackets = words.size() > 2 && words.front() == '[' && words.back() == ']';
    const std::string code = lower_case(in_brackets ? words.substr(1, words.size() - 2) : words);
    const auto* const found = std::ranges::find(explanations, std::string_view(code), &Explanation::code);
    if (found != std::end(explanations)) return fmt::format("{}: {}\n\n{}\n", found->code, found->title, found->text);
    std::vector<std::string_view> codes;
    for (const auto& entry : explanations) codes.push_back(entry.code);
    const auto meant = did_you_mean(code, codes);
    throw Diagnostic(fmt::format("there is no message code '{}'", code),
                     meant.empty() ? "'kaya explain' lists the codes" : fmt::format("did you mean '{}'?", meant));
}

} // namespace kaya
