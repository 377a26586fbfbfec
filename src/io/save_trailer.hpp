// The last bytes of a save file: its length and a digest of all bytes before. HDF5 readers ignore them; kaya checks them first, so that a
// file that was cut short or changed never reaches HDF5.
#pragma once

#include <string>
#include <string_view>

namespace kaya {

std::string with_trailer(std::string image);

/// The bytes before the trailer. Throws Diagnostic (Fault::run) about the file `name`: empty, not a save
/// file, cut short, changed since it was written.
std::string_view without_trailer(std::string_view file, const std::string& name);

} // namespace kaya
