// What a save file holds, in words.
#pragma once

#include <string>

namespace kaya {

/// A page of text for people: program, title, where the run stands, sizes of tables, joint models,
/// histories, decks, state hash. The file is read and checked whole; throws Diagnostic as restore does.
std::string describe_save_file(const std::string& path);

} // namespace kaya
