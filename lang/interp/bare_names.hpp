// Names that stand without the word or mark that says what they are: FISH without @, as files for 3DEC 4 and before have it
// (`poly brick 0 width`, a line `build_wall`), and named ranges without nrange (`delete range left`).
#pragma once

#include "lang/interp/binder.hpp"

#include <set>
#include <string>

namespace kaya::lang {

/// Names that a deck has said so far, folded: functions, what functions and @ mention, ranges. What stands only further
/// down is no name yet.
class BareNames {
public:
    /// Takes what a statement brings.
    void learn(const CommandSpec& spec, const Statement& statement);

    bool is_function(const std::string& folded) const { return functions_.contains(folded); }
    bool is_name(const std::string& folded) const { return names_.contains(folded); }
    bool is_range(const std::string& folded) const { return ranges_.contains(folded); }

private:
    void learn_function(const std::string& body);
    void learn_words(std::string_view line);

    std::set<std::string> functions_, names_, ranges_;
};

/// Reads a word as the name that it is. A name of FISH takes the arguments in parentheses after it, force_on(3), and
/// their words go; in front of the name of a range comes the word nrange.
void read_as_name(Statement& statement, const BareName& name);

/// Binds a statement. A word that makes no sense where it stands is read as a name when it is one; BoundCommand::bare
/// says which. Throws Diagnostic, that of the statement as it stands, when this does not help.
BoundCommand bind_with_names(const Language& language, const Statement& statement, const BareNames& names,
                             Spelled* spelled = nullptr);

} // namespace kaya::lang
