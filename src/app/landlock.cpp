#include "app/landlock.hpp"

#include "system/descriptor.hpp"

#include <cstddef>
#include <cstdint>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>

namespace kaya {

namespace {

// The C library has no functions for these; their numbers are the same on every machine.
constexpr long create_ruleset = 444, add_rule = 445, restrict_self = 446;

// Rights missing from older headers.
constexpr std::uint64_t right_to_refer = 1ULL << 13, right_to_truncate = 1ULL << 14;

// These too are missing in the headers of older systems.
constexpr std::uint64_t to_bind = 1ULL << 0, to_connect = 1ULL << 1; // TCP
constexpr auto rule_of_port = static_cast<landlock_rule_type>(2);
constexpr std::uint64_t to_signal = 1ULL << 1;
struct Ruleset {
    std::uint64_t files, connections, kept_inside;
};
struct PortRule {
    std::uint64_t rights, port;
};

constexpr std::uint64_t reading = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t rights_of_files =
    LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_EXECUTE | right_to_truncate;

std::uint64_t all_rights(int version) {
    std::uint64_t rights = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1; // rights of the first version
    if (version >= 2) rights |= right_to_refer;
    if (version >= 3) rights |= right_to_truncate;
    return rights;
}

/// A missing path cannot be used and needs no rule.
void allow_below(int rules, const std::filesystem::path& path, std::uint64_t rights) {
    const Descriptor opened = handle_of(path);
    if (!opened) return;
    landlock_path_beneath_attr beneath{};
    beneath.parent_fd = opened.number();
    struct stat info {};
    const bool is_folder = ::fstat(opened.number(), &info) == 0 && S_ISDIR(info.st_mode);
    beneath.allowed_access = is_folder ? rights : rights & rights_of_files;
    ::syscall(add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &beneath, 0);
}

} // namespace

int landlock_version() {
    const long version = ::syscall(create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
    return version > 0 ? static_cast<int>(version) : 0;
}

bool lock_by_kernel(const KernelLock& lock) {
    const int version = landlock_version();
    if (version == 0) return false;
    const bool with_connections = version >= landlock_with_connections && !lock.connects;
    const Ruleset handled{all_rights(version), with_connections ? to_bind | to_connect : 0,
                          version >= landlock_with_signals ? to_signal : 0};
    const std::size_t known = version >= landlock_with_signals       ? sizeof handled
                              : version >= landlock_with_connections ? offsetof(Ruleset, kept_inside)
                                                                     : sizeof handled.files;
    const Descriptor rules(static_cast<int>(::syscall(create_ruleset, &handled, known, 0)));
    if (!rules) return false;
    const std::uint64_t writing = handled.files & ~std::uint64_t{LANDLOCK_ACCESS_FS_EXECUTE};
    for (const auto& path : lock.writable) allow_below(rules.number(), path, writing);
    for (const auto& path : lock.readable) allow_below(rules.number(), path, reading);
    for (const auto& path : lock.programs) allow_below(rules.number(), path, reading | LANDLOCK_ACCESS_FS_EXECUTE);
    if (with_connections && lock.listens) {
        const PortRule port{to_bind, static_cast<std::uint64_t>(*lock.listens)};
        ::syscall(add_rule, rules.number(), rule_of_port, &port, 0);
    }
    return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::syscall(restrict_self, rules.number(), 0) == 0;
}

} // namespace kaya
