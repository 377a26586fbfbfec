// The one door to files: whatever the program opens, makes, renames or removes by name goes through here, and the gate of the
// process checks each. No link on the path is followed after the check, so that no other process can redirect the path
// between the check and the opening. tests/house/check door refuses other openings.
#pragma once

#include "system/descriptor.hpp"
#include "system/gate.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

namespace kaya::door {

/// One gate for this process and its children, like the kernel's lock; for that reason no function takes it as an argument.
void set_gate(std::shared_ptr<Gate> gate);
/// That gate; without one a gate that allows everything.
std::shared_ptr<Gate> gate();

// All functions throw Diagnostic when the gate refuses.

enum class Access {
    read,
    write,  ///< a file that is there
    renew,  ///< made, or emptied, and written
    keep,   ///< made where there is none; read and written
    no_link ///< as `keep`, of a name that is not a link
};
/// Without a descriptor errno says why.
Descriptor open(const std::filesystem::path& file, Use use, Access access);
/// The same for a file that may be read or not: without a descriptor where the gate refuses, too.
Descriptor peek(const std::filesystem::path& file);

struct Close {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
};
using Stream = std::unique_ptr<std::FILE, Close>;
/// The mode is that of fopen: "r", "w+". Null: errno says why.
Stream open_stream(const std::filesystem::path& file, Use use, const std::string& mode);

/// The folder of a file, open, and the name in it: for operations on names. Without a folder errno says why.
struct Place {
    Descriptor folder;
    std::string name;
};
/// `follow`: of a name that is a link, the place of its target.
Place place_of(const std::filesystem::path& file, Use use, bool follow = true);

std::error_code make_folders(const std::filesystem::path& folder, Use use);
// For destructors: these two do not throw; a refusal of the gate is an error code, too.
/// A link is removed, not its target. No error when there is no such file.
std::error_code remove(const std::filesystem::path& file) noexcept;
/// A folder with all below it. Links are removed, not their targets.
std::error_code remove_all(const std::filesystem::path& folder) noexcept;
/// Changes the current folder. False: errno says why.
bool enter(const std::filesystem::path& folder);

/// /dev/null.
Descriptor null_device();
/// A file of the system by a name that is written in the program: /proc/meminfo. Empty when there is none.
std::string system_text(const char* name);

} // namespace kaya::door
