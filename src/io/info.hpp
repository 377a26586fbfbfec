// Description of a save file in words.
#pragma once

#include <string>

namespace kaya {

/// A page of text: program, title, state of the run, sizes of tables, joint models, histories, decks, state hash. The whole file is read
/// and checked; throws Diagnostic as restore does.
std::string describe_save_file(const std::string& path);

} // namespace kaya
