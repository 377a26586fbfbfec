// Which files the program may use. Commands, scripts, restore, replay, logs and joint models query it before they open one, and the door
// (system/door.hpp) queries it again for every file; docs/safety.md describes the rules.
#pragma once

#include "system/descriptor.hpp"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace kaya {

/// The real path: every link is followed, also to a target that does not exist. Empty for a circle of links.
std::filesystem::path resolved(const std::filesystem::path& path);

/// Whether a file has the name of a shared library: x.so, x.so.1.
bool is_library_name(const std::filesystem::path& file);

/// The purpose of opening a file.
enum class Use {
    read,
    write, ///< under a name that a deck, a save file or the user has given
    own    ///< under a name that the program alone gives: a lock, a library that it built, the list of permissions
};

class Gate {
public:
    struct Policy {
        std::vector<std::filesystem::path> folders;   ///< files below may be read and written
        std::vector<std::filesystem::path> named;     ///< files that the user named at the start, of any kind
        std::vector<std::filesystem::path> libraries; ///< folders with joint models
        std::vector<std::filesystem::path> own;       ///< folders of the program's own files
        std::set<std::string> digests;                ///< sha256 of joint models that are allowed separately
        std::filesystem::path permissions;            ///< the user's list of these: no run writes there
    };

    /// Until then everything is let through.
    void shut(Policy policy);
    bool is_shut() const { return shut_; }
    const Policy& policy() const { return policy_; }

    // Each throws Diagnostic, which names the command that allows the file, when it is refused.
    void may_read(const std::filesystem::path& file) const;
    /// Commands or functions: such a file is not overwritten by the run.
    void may_read_code(const std::filesystem::path& file);
    void may_write(const std::filesystem::path& file);
    /// A joint model: a library, or a script of one. Returns the name by which it is to be opened; exchanging `file` afterwards does not change what
    /// that name leads to.
    std::filesystem::path may_load(const std::filesystem::path& file);

    /// An allowed folder, open, and a path from there without links. Folder -1: the path is opened directly.
    struct Route {
        int folder = -1;
        std::filesystem::path below;
        bool plain = true; ///< pipes, devices and files with further names are refused
    };
    /// For the door. Throws Diagnostic as the functions above do.
    Route route_to(const std::filesystem::path& file, Use use);
    /// Refuses a file that is open and is a pipe or device, or has further names.
    void refuse_special(const std::filesystem::path& file, int opened) const;

private:
    bool is_below(const std::filesystem::path& whole, const std::vector<std::filesystem::path>& folders) const;
    bool is_named(const std::filesystem::path& file) const;
    /// The folders below which a file may be for that use.
    std::vector<std::filesystem::path> folders_for(Use use) const;
    void refuse_outside(const std::filesystem::path& file, const std::filesystem::path& whole,
                        const std::vector<std::filesystem::path>& folders) const;
    void refuse_special(const std::filesystem::path& file, const std::filesystem::path& whole) const;
    void refuse_in_use(const std::filesystem::path& file, const std::filesystem::path& whole) const;

    std::filesystem::path may_load_by_digest(const std::filesystem::path& whole);

    bool shut_ = false;
    Policy policy_;
    std::map<std::filesystem::path, Descriptor> opened_; ///< folders of the policy, by their resolved paths
    std::map<std::string, Descriptor> copies_; ///< of libraries, by digest; never closed: the loader knows them by name
    std::set<std::filesystem::path> code_, written_; ///< resolved
};

} // namespace kaya
