#include "system/gate.hpp"

#include "base/diagnostic.hpp"
#include "base/sha256.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <deque>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

namespace kaya {

namespace fs = std::filesystem;

namespace {

constexpr int most_links = 40; // as the system itself allows

/// Files there are interfaces to the system and to other programs.
constexpr std::array<std::string_view, 3> system_folders{"/proc", "/sys", "/dev"};

[[noreturn]] void refuse(const char* code, std::string message, std::string hint) {
    Diagnostic error(std::move(message), std::move(hint), Fault::run);
    error.code = code;
    throw error;
}

bool lies_below(const fs::path& whole, const fs::path& folder) {
    const auto [end, ignored] = std::mismatch(folder.begin(), folder.end(), whole.begin(), whole.end());
    return end == folder.end() || (std::next(end) == folder.end() && end->empty()); // "/a/" is "/a"
}

/// Quoted for a shell.
std::string quoted(const fs::path& path) {
    const std::string text = path.string();
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./+,:@%";
    if (!text.empty() && text.find_first_not_of(plain) == text.npos) return text;
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

/// The folder of a file as the user would write it, unless a link leads elsewhere.
fs::path folder_to_name(const fs::path& file, const fs::path& whole) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    return resolved(folder) == whole.parent_path() ? folder : whole.parent_path();
}

[[noreturn]] void refuse_other_kind(const fs::path& file) {
    refuse("file-special", fmt::format("'{}' is not an ordinary file", file.string()),
           "name an ordinary file; --trust allows pipes and devices");
}

/// A pipe could hold the run up for ever, and a file with two names is in two places, and one of them may be anywhere.
void refuse_kind(const fs::path& file, const struct stat& info) {
    if (S_ISDIR(info.st_mode)) return; // its reader reports it
    if (!S_ISREG(info.st_mode)) refuse_other_kind(file);
    if (info.st_nlink > 1)
        refuse(
            "file-special",
            fmt::format("'{}' has {} names (hard links), and the others may be anywhere", file.string(), info.st_nlink),
            fmt::format("make a copy of it: cp {0} {0}.copy && mv {0}.copy {0}", quoted(file)));
}

/// "./a" is "a"; what ".." means depends on links.
fs::path without_points(const fs::path& path) {
    fs::path plain;
    for (const auto& part : path)
        if (part != ".") plain /= part;
    return plain;
}

bool has_hidden_part(const fs::path& whole, const fs::path& folder) {
    const fs::path rest = whole.lexically_relative(folder);
    return std::any_of(rest.begin(), rest.end(), [](const fs::path& part) {
        const auto& name = part.native();
        return name.size() > 1 && name.front() == '.' && name != "..";
    });
}

} // namespace

fs::path resolved(const fs::path& path) {
    std::error_code problem;
    const fs::path from = path.is_absolute() ? path : fs::current_path(problem) / path;
    std::deque<fs::path> rest(from.begin(), from.end());
    fs::path whole;
    for (int links = 0; !rest.empty();) {
        const fs::path part = rest.front();
        rest.pop_front();
        if (part.empty() || part == ".") continue;
        if (part == "..") {
            whole = whole.parent_path();
            continue;
        }
        const fs::path next = part.is_absolute() ? part : whole / part;
        if (!fs::is_symlink(fs::symlink_status(next, problem))) {
            whole = next;
            continue;
        }
        if (++links > most_links) return {};
        const fs::path target = fs::read_symlink(next, problem);
        if (problem) return {};
        rest.insert(rest.begin(), target.begin(), target.end());
    }
    return whole;
}

bool is_library_name(const fs::path& file) {
    const std::string name = file.filename().string();
    const auto at = name.rfind(".so");
    return at != name.npos && name.find_first_not_of("0123456789.", at + 3) == name.npos;
}

void Gate::shut(Policy policy) {
    shut_ = true;
    policy_ = std::move(policy);
    for (auto* paths : {&policy_.folders, &policy_.libraries, &policy_.own}) {
        for (auto& path : *paths) {
            const fs::path given = std::exchange(path, resolved(path));
            if (!path.empty()) opened_.try_emplace(path, handle_of(given, O_DIRECTORY));
        }
        std::erase_if(*paths, [](const fs::path& path) { return path.empty(); });
    }
    if (!policy_.permissions.empty()) policy_.permissions = resolved(policy_.permissions);
}

bool Gate::is_below(const fs::path& whole, const std::vector<fs::path>& folders) const {
    return std::any_of(folders.begin(), folders.end(),
                       [&](const fs::path& folder) { return lies_below(whole, folder); });
}

bool Gate::is_named(const fs::path& file) const {
    const fs::path plain = without_points(file);
    return std::ranges::any_of(policy_.named, [&](const fs::path& one) { return without_points(one) == plain; });
}

std::vector<fs::path> Gate::folders_for(Use use) const {
    std::vector<fs::path> folders = policy_.folders;
    if (use == Use::write) return folders;
    folders.insert(folders.end(), policy_.own.begin(), policy_.own.end());
    if (use == Use::read) folders.insert(folders.end(), policy_.libraries.begin(), policy_.libraries.end());
    return folders;
}

void Gate::refuse_outside(const fs::path& file, const fs::path& whole, const std::vector<fs::path>& folders) const {
    if (whole.empty())
        refuse("file-outside", fmt::format("the links of '{}' form a loop", file.string()), "name the file itself");
    for (const auto system : system_folders)
        if (lies_below(whole, system))
            refuse("file-special", fmt::format("'{}' belongs to the system, not to a deck", file.string()),
                   "name an ordinary file; --trust allows it");
    if (is_below(whole, folders)) return;
    refuse("file-outside", fmt::format("'{}' is outside of the folders that this run may use", file.string()),
           fmt::format("allow it once for all with: kaya allow {}", quoted(folder_to_name(file, whole))));
}

void Gate::refuse_special(const fs::path& file, const fs::path& whole) const {
    struct stat info {};
    if (::lstat(whole.c_str(), &info) == 0) refuse_kind(file, info);
}

void Gate::refuse_special(const fs::path& file, int opened) const {
    struct stat info {};
    if (::fstat(opened, &info) != 0) refuse_other_kind(file);
    refuse_kind(file, info);
}

void Gate::refuse_in_use(const fs::path& file, const fs::path& whole) const {
    const bool used = code_.contains(whole) || std::any_of(code_.begin(), code_.end(), [&](const fs::path& code) {
                          std::error_code ignored;
                          return fs::equivalent(code, whole, ignored);
                      });
    if (used)
        refuse("file-in-use",
               fmt::format("this run takes its commands from '{}', and would overwrite it", file.string()),
               "give it another name");
    if (!policy_.permissions.empty() && whole == policy_.permissions)
        refuse("file-in-use", fmt::format("'{}' holds the permissions of runs, and no run may write it", file.string()),
               "use the command 'kaya allow'");
}

void Gate::may_read(const fs::path& file) const {
    if (!shut_ || is_named(file)) return;
    const fs::path whole = resolved(file);
    refuse_outside(file, whole, policy_.folders);
    refuse_special(file, whole);
}

void Gate::may_read_code(const fs::path& file) {
    may_read(file);
    if (const fs::path whole = resolved(file); !whole.empty()) code_.insert(whole);
}

void Gate::may_write(const fs::path& file) {
    const fs::path whole = resolved(file);
    if (!shut_) return refuse_in_use(file, whole);
    refuse_outside(file, whole, policy_.folders);
    refuse_special(file, whole);
    refuse_in_use(file, whole);
    const bool in_sight = std::any_of(policy_.folders.begin(), policy_.folders.end(), [&](const fs::path& folder) {
        return lies_below(whole, folder) && !has_hidden_part(whole, folder);
    });
    if (!in_sight && !is_named(file))
        refuse("file-hidden", fmt::format("'{}' is a hidden file, where programs keep their settings", file.string()),
               "give it a name without a point in front; --trust allows it");
    if (is_library_name(whole) && !is_named(file))
        refuse("file-hidden", fmt::format("'{}' has the name of a shared library", file.string()),
               "give it another ending than .so; --trust allows it");
    written_.insert(whole);
}

/// Empty when its contents are not allowed. The library is loaded from the bytes that were compared.
fs::path Gate::may_load_by_digest(const fs::path& whole) {
    std::error_code ignored;
    if (policy_.digests.empty() || !fs::is_regular_file(whole, ignored)) return {};
    const Descriptor root = handle_of("/", O_DIRECTORY);
    const Descriptor file = open_beneath(root.number(), whole.relative_path(), O_RDONLY | O_NONBLOCK);
    std::string bytes;
    if (!file || !read_all(file.number(), bytes)) return {};
    const std::string digest = sha256(bytes);
    if (!policy_.digests.contains(digest)) return {};
    Descriptor& copy = copies_[digest];
    if (!copy) copy = sealed_copy(whole.filename().string(), bytes);
    if (!copy)
        refuse("library-not-allowed", fmt::format("cannot copy joint model {} into memory", whole.string()),
               std::strerror(errno));
    return copy.name();
}

fs::path Gate::may_load(const fs::path& file) {
    const fs::path whole = resolved(file);
    if (!shut_) {
        code_.insert(whole);
        return fs::absolute(file);
    }
    if (written_.contains(whole))
        refuse("library-not-allowed", fmt::format("joint model {} was written by this run", file.string()),
               "load it in a separate run");
    // By the name that is given, as the loader decides. A script of a joint model can do nothing but calculate.
    const bool in_folder = is_below(whole, policy_.libraries), is_script = file.extension() == ".lua";
    if (is_script && !in_folder) may_read(file);
    const fs::path name = is_script ? file : in_folder && is_library_name(whole) ? whole : may_load_by_digest(whole);
    if (name.empty())
        refuse("library-not-allowed", fmt::format("joint model {} is code that has not been allowed", file.string()),
               fmt::format("if you know where it comes from, allow it once with: kaya allow {}", quoted(file)));
    code_.insert(whole);
    return name;
}

Gate::Route Gate::route_to(const fs::path& file, Use use) {
    if (!shut_ || (use == Use::read && is_named(file))) return {-1, file};
    if (use == Use::write) may_write(file);
    const fs::path whole = resolved(file);
    const auto from_root = [&] {
        Descriptor& root = opened_["/"];
        if (!root) root = handle_of("/", O_DIRECTORY);
        return Route{root.number(), whole.relative_path()};
    };
    if (use == Use::read && is_named(whole)) return from_root(); // a library that was allowed, by another path
    const auto folders = folders_for(use);
    refuse_outside(file, whole, folders);
    // Installers that save room give equal libraries one file of many names, also below the working folder.
    const bool library = is_below(whole, policy_.libraries) && whole.extension() == ".so";
    const bool plain = use != Use::read || (is_below(whole, policy_.folders) && !library);
    if (plain) refuse_special(file, whole);
    const auto folder = std::ranges::find_if(folders, [&](const fs::path& one) { return lies_below(whole, one); });
    Descriptor& opened = opened_[*folder];
    if (!opened) opened = handle_of(*folder, O_DIRECTORY); // it was not there at the start
    if (opened) return {opened.number(), whole.lexically_relative(*folder), plain};
    return from_root(); // it is not there yet
}

} // namespace kaya
