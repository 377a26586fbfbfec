#include "system/descriptor.hpp"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace kaya {

namespace fs = std::filesystem;

namespace {

/// Where the kernel lacks openat2 (before Linux 5.6), or a container refuses it: folder by folder.
Descriptor open_step_by_step(int folder, const fs::path& below, int flags, unsigned mode) {
    Descriptor at;
    for (auto part = below.begin(); part != below.end(); ++part) {
        const int from = at ? at.number() : folder;
        if (*part == "..") {
            errno = EXDEV;
            return Descriptor();
        }
        if (std::next(part) == below.end())
            return Descriptor(::openat(from, part->c_str(), flags | O_NOFOLLOW | O_CLOEXEC, mode));
        at = Descriptor(::openat(from, part->c_str(), O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
        if (!at) return at;
    }
    errno = ENOENT;
    return Descriptor();
}

} // namespace

bool Descriptor::close() { return number_ < 0 || ::close(std::exchange(number_, -1)) == 0; }

Descriptor handle_of(const fs::path& path, int more_flags) {
    return Descriptor(::open(path.c_str(), O_PATH | O_CLOEXEC | more_flags));
}

Descriptor open_beneath(int folder, const fs::path& below, int flags, unsigned mode) {
    open_how how{};
    how.flags = static_cast<std::uint64_t>(flags | O_CLOEXEC);
    how.mode = (flags & O_CREAT) != 0 ? mode : 0;
    how.resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS;
    const long opened = ::syscall(SYS_openat2, folder, below.c_str(), &how, sizeof how);
    if (opened >= 0 || (errno != ENOSYS && errno != EPERM)) return Descriptor(static_cast<int>(opened));
    return open_step_by_step(folder, below, flags, mode);
}

bool read_all(int descriptor, std::string& content, std::size_t most) {
    struct stat info {};
    if (::fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode))
        content.reserve(std::min(static_cast<std::size_t>(info.st_size), most));
    std::string buffer(std::size_t{1} << 18, '\0');
    while (content.size() <= most) {
        const ssize_t got = ::read(descriptor, buffer.data(), buffer.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return false;
        if (got == 0) break;
        content.append(buffer.data(), static_cast<std::size_t>(got));
    }
    return true;
}

bool write_all(int descriptor, std::string_view content) {
    while (!content.empty()) {
        const ssize_t written = ::write(descriptor, content.data(), content.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        content.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

Descriptor sealed_copy(const std::string& title, std::string_view content) {
#ifndef MFD_NOEXEC_SEAL // Linux 6.3: no program; a machine may demand it
    constexpr unsigned MFD_NOEXEC_SEAL = 8;
#endif
    Descriptor copy(::memfd_create(title.c_str(), MFD_CLOEXEC | MFD_ALLOW_SEALING | MFD_NOEXEC_SEAL));
    if (!copy && errno == EINVAL) copy = Descriptor(::memfd_create(title.c_str(), MFD_CLOEXEC | MFD_ALLOW_SEALING));
    if (!copy || !write_all(copy.number(), content) ||
        ::fcntl(copy.number(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE | F_SEAL_SEAL) != 0)
        return Descriptor();
    return copy;
}

} // namespace kaya
