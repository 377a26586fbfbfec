#include "system/locked_file.hpp"

#include "base/diagnostic.hpp"
#include "system/door.hpp"

#include <cerrno>
#include <sys/file.h>
#include <sys/stat.h>

namespace kaya {

namespace fs = std::filesystem;

namespace {

Descriptor opened(const fs::path& file) {
    try {
        return door::open(file, Use::own, door::Access::no_link);
    } catch (const Diagnostic&) { return Descriptor(); } // a link that leads elsewhere, say
}

} // namespace

LockedFile lock_file(const fs::path& file) {
    for (;;) {
        LockedFile lock{opened(file)};
        if (!lock.file) return lock;
        if (::flock(lock.file.number(), LOCK_EX | LOCK_NB) != 0) return {Descriptor(), errno == EWOULDBLOCK};
        struct stat mine {
        }, there{};
        const bool same =
            ::fstat(lock.file.number(), &mine) == 0 && ::stat(file.c_str(), &there) == 0 && mine.st_ino == there.st_ino;
        if (same) return lock;
        // Otherwise the run before has just removed it.
    }
}

bool is_empty(const Descriptor& file) {
    struct stat info {};
    return ::fstat(file.number(), &info) == 0 && info.st_size == 0;
}

} // namespace kaya
