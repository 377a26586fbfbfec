#include "app/landlock.hpp"

#include <cstdint>
#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace kaya {

namespace {

// The C library has no functions for these; their numbers are the same on every machine.
constexpr long create_ruleset = 444, add_rule = 445, restrict_self = 446;

// Rights that headers of older systems do not know.
constexpr std::uint64_t right_to_refer = 1ULL << 13, right_to_truncate = 1ULL << 14;

constexpr std::uint64_t reading = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t rights_of_files =
    LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_EXECUTE | right_to_truncate;

std::uint64_t all_rights(int version) {
    std::uint64_t rights = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1; // those of the first version
    if (version >= 2) rights |= right_to_refer;
    if (version >= 3) rights |= right_to_truncate;
    return rights;
}

/// What is not there cannot be used either, and needs no rule.
void allow_below(int rules, const std::filesystem::path& path, std::uint64_t rights) {
    landlock_path_beneath_attr beneath{};
    beneath.parent_fd = ::open(path.c_str(), O_PATH | O_CLOEXEC);
    if (beneath.parent_fd < 0) return;
    struct stat info {};
    const bool is_folder = ::fstat(beneath.parent_fd, &info) == 0 && S_ISDIR(info.st_mode);
    beneath.allowed_access = is_folder ? rights : rights & rights_of_files;
    ::syscall(add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &beneath, 0);
    ::close(beneath.parent_fd);
}

} // namespace

int landlock_version() {
    const long version = ::syscall(create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
    return version > 0 ? static_cast<int>(version) : 0;
}

bool lock_file_system(const std::vector<std::filesystem::path>& writable,
                      const std::vector<std::filesystem::path>& readable) {
    const int version = landlock_version();
    if (version == 0) return false;
    landlock_ruleset_attr handled{};
    handled.handled_access_fs = all_rights(version);
    const auto rules = static_cast<int>(::syscall(create_ruleset, &handled, sizeof handled.handled_access_fs, 0));
    if (rules < 0) return false;
    const std::uint64_t writing = handled.handled_access_fs & ~std::uint64_t{LANDLOCK_ACCESS_FS_EXECUTE};
    for (const auto& path : writable) allow_below(rules, path, writing);
    for (const auto& path : readable) allow_below(rules, path, reading);
    const bool held = ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::syscall(restrict_self, rules, 0) == 0;
    ::close(rules);
    return held;
}

} // namespace kaya
