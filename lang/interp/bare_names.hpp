// Names written without the word or mark that identifies them: FISH without @, as in files for 3DEC 4 and before (`poly brick 0 width`, a
// line `build_wall`), and named ranges without nrange (`delete range left`).
#pragma once

#include "lang/interp/binder.hpp"

#include <set>
#include <string>

namespace kaya::lang {

/// Names that occur in a deck so far, in lower case: functions, names in functions and after @, ranges. Names that occur only further down
/// are not known yet.
class BareNames {
public:
    /// Records the names of a statement.
    void learn(const CommandSpec& spec, const Statement& statement);

    bool is_function(const std::string& folded) const { return functions_.contains(folded); }
    bool is_name(const std::string& folded) const { return names_.contains(folded); }
    bool is_range(const std::string& folded) const { return ranges_.contains(folded); }

private:
    void learn_function(const std::string& body);
    void learn_words(std::string_view line);

    std::set<std::string> functions_, names_, ranges_;
};

/// Replaces a word by the name that it is. A name of FISH takes the arguments in parentheses after it, force_on(3), and their words are
/// removed; the word nrange is put before the name of a range.
void read_as_name(Statement& statement, const BareName& name);

/// Binds a statement. A word that is not valid at its position is read as a name when it is one; BoundCommand::bare lists such words.
/// Throws the Diagnostic of the statement as written when this does not help.
BoundCommand bind_with_names(const Language& language, const Statement& statement, const BareNames& names,
                             Spelled* spelled = nullptr);

} // namespace kaya::lang
