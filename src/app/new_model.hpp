// `kaya new-jmodel NAME`: a joint model to begin with.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace kaya {

/// Makes the folder `in`/NAME with a native model that works, a deck that shows it, a deck that tests it, a page
/// and a CMakeLists.txt. Returns the files. Throws Diagnostic: the name cannot be typed in a deck, the folder is there.
std::vector<std::filesystem::path> write_new_model(const std::string& name, const std::filesystem::path& in);

} // namespace kaya
