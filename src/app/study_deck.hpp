// A study and the deck that it runs: whether their names meet, and the deck of one run.
#pragma once

#include "study/study_folder.hpp"

#include <set>
#include <string>
#include <vector>

namespace kaya {

/// Names that `param` lines of the deck declare, in lower case.
std::set<std::string> declared_names(const Study& study);

/// Throws Diagnostic at a parameter that neither the deck nor a file that it calls mentions.
void check_names(const Study& study);

/// Writes a deck next to that of the study; it sets the values of this run and calls the study's deck. Returns its name. Throws Diagnostic.
std::filesystem::path write_case_deck(const Study& study, const Case& one);

/// The runs that a search has done, from their folders.
std::vector<Case> searched_cases(const StudyFolder& folder);

} // namespace kaya
