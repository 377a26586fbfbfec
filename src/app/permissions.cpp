#include "app/permissions.hpp"

#include "base/diagnostic.hpp"
#include "base/sha256.hpp"
#include "system/door.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <sstream>

namespace kaya {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view folder_word = "folder", library_word = "library";
constexpr std::size_t digest_length = 64;

void write_permissions(const Permissions& permissions) {
    const fs::path file = permissions_file();
    if (file.empty())
        throw Diagnostic("there is no place for your permissions", "set HOME, or XDG_CONFIG_HOME to a whole path",
                         Fault::run);
    door::make_folders(file.parent_path(), Use::own); // a failure is reported by the file
    std::string text;
    for (const auto& folder : permissions.folders) text += fmt::format("{} {}\n", folder_word, folder.string());
    for (const auto& [digest, library] : permissions.libraries)
        text += fmt::format("{} {} {}\n", library_word, digest, library.string());
    write_whole_file(file.string(), text, Use::own);
}

/// Where it really is; that has to fit on a line of the list.
fs::path place_of(const fs::path& path) {
    const fs::path whole = resolved(path);
    if (whole.empty() || whole.string().find('\n') != std::string::npos)
        throw Diagnostic(fmt::format("'{}' has no name that can be kept", path.string()), "rename it");
    return whole;
}

[[noreturn]] void fail_damaged(const fs::path& file, std::size_t line) {
    throw Diagnostic(fmt::format("line {} of '{}' is not a permission", line, file.string()),
                     "remove the line, and allow it again with: kaya allow PATH", Fault::run);
}

} // namespace

fs::path permissions_file() {
    const char* configuration = std::getenv("XDG_CONFIG_HOME");
    if (configuration && fs::path(configuration).is_absolute()) return fs::path(configuration) / "kaya" / "allowed";
    const char* home = std::getenv("HOME");
    return home && *home != '\0' ? fs::path(home) / ".config" / "kaya" / "allowed" : fs::path();
}

Permissions read_permissions() {
    Permissions permissions;
    const fs::path file = permissions_file();
    std::error_code ignored;
    if (file.empty() || !fs::exists(file, ignored)) return permissions;
    std::istringstream lines(read_whole_file(file.string()));
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (line.empty()) continue;
        const auto blank = line.find(' ');
        const std::string word = line.substr(0, blank), rest = blank == line.npos ? "" : line.substr(blank + 1);
        if (word == folder_word && fs::path(rest).is_absolute()) permissions.folders.emplace_back(rest);
        else if (word == library_word && rest.size() > digest_length + 1 && rest[digest_length] == ' ')
            permissions.libraries[rest.substr(0, digest_length)] = rest.substr(digest_length + 1);
        else fail_damaged(file, number);
    }
    return permissions;
}

void allow(const fs::path& path) {
    Permissions permissions = read_permissions();
    const fs::path whole = place_of(path);
    std::error_code ignored;
    if (fs::is_directory(whole, ignored)) {
        if (std::ranges::find(permissions.folders, whole) != permissions.folders.end()) return;
        permissions.folders.push_back(whole);
    } else if (fs::is_regular_file(whole, ignored)) {
        const std::string bytes = read_whole_file(whole.string());
        if (!bytes.starts_with("\x7f"
                               "ELF"))
            throw Diagnostic(fmt::format("'{}' is neither a folder nor a library", path.string()),
                             "files are allowed by their folder");
        // A rebuilt library replaces its earlier version.
        std::erase_if(permissions.libraries, [&](const auto& known) { return known.second == whole; });
        permissions.libraries[sha256(bytes)] = whole;
    } else {
        throw Diagnostic(fmt::format("there is no folder or library '{}'", path.string()), "make it first");
    }
    write_permissions(permissions);
}

void revoke(const fs::path& path) {
    Permissions permissions = read_permissions();
    const fs::path whole = place_of(path);
    const auto folders = std::erase(permissions.folders, whole);
    const auto libraries =
        std::erase_if(permissions.libraries, [&](const auto& known) { return known.second == whole; });
    if (folders + libraries == 0)
        throw Diagnostic(fmt::format("'{}' was not allowed", path.string()), "'kaya allow' lists the permissions");
    write_permissions(permissions);
}

std::string describe(const Permissions& permissions) {
    std::string text;
    for (const auto& folder : permissions.folders) text += fmt::format("{:<8} {}\n", folder_word, folder.string());
    constexpr std::size_t shown = 12; // digits of a digest
    for (const auto& [digest, library] : permissions.libraries)
        text += fmt::format("{:<8} {} ({})\n", library_word, library.string(), digest.substr(0, shown));
    return text.empty() ? "only a run's own folders are allowed\n" : text;
}

} // namespace kaya
