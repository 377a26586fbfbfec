#include "io/whole_file.hpp"

#include "base/diagnostic.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <set>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>
#include <utility>

namespace kaya {

namespace fs = std::filesystem;

namespace {

class OpenFile {
public:
    explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
    OpenFile(OpenFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    ~OpenFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }

    int descriptor() const { return descriptor_; }
    bool close() { return ::close(std::exchange(descriptor_, -1)) == 0; }

private:
    int descriptor_;
};

[[noreturn]] void fail_to_write(const std::string& path, int error) {
    std::string hint;
    if (error == ENOSPC || error == EDQUOT || error == EFBIG)
        hint = "make room or write elsewhere; a file of that name from before is as it was";
    else if (error == ENOENT || error == ENOTDIR) hint = "make the folder first";
    else if (error == EACCES || error == EPERM || error == EROFS) hint = "write to a folder that is yours";
    else if (error == EISDIR) hint = "give the name of a file";
    throw Diagnostic(fmt::format("cannot write '{}': {}", path, std::strerror(error)), hint, Fault::run);
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

void write_directly(const std::string& path, std::string_view content) {
    OpenFile file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (file.descriptor() < 0 || !write_all(file.descriptor(), content)) fail_to_write(path, errno);
    if (!file.close()) fail_to_write(path, errno);
}

/// The name of an unfinished file. It is hidden and holds the number of the file itself: neither a user nor a copy has it.
std::string unfinished_name(ino_t number) { return fmt::format(".kaya-{}.unfinished", number); }

/// Whether kaya began to write this file and no run still writes it. A run locks its file before the file has a name.
bool is_left_over(int descriptor, const std::string& name) {
    struct stat info {};
    return ::fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode) && info.st_nlink == 1 &&
           info.st_uid == ::geteuid() && name == unfinished_name(info.st_ino) &&
           ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
}

/// Removes what killed runs have left in a folder; once for each folder.
void sweep(int folder, const fs::path& path) {
    static std::set<fs::path> swept;
    if (!swept.insert(path).second) return;
    std::error_code problem;
    for (fs::directory_iterator entry(path, problem), end; !problem && entry != end; entry.increment(problem)) {
        const std::string name = entry->path().filename().string();
        if (!name.starts_with(".kaya-")) continue;
        const OpenFile file(::openat(folder, name.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
        if (file.descriptor() >= 0 && is_left_over(file.descriptor(), name)) ::unlinkat(folder, name.c_str(), 0);
    }
}

/// A new file that is complete before it has the name of its target. Until it is finished it has no name at all, so that a kill
/// leaves nothing. Where the file system has no files without a name (NFS) it has a hidden one.
class Draft {
public:
    Draft(int folder, const std::string& path) : folder_(folder), path_(path), file_(make()) {}
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;
    ~Draft() {
        if (!name_.empty()) ::unlinkat(folder_, name_.c_str(), 0);
    }

    int descriptor() const { return file_.descriptor(); }

    /// Gives it the name of the target, whose file before is replaced. It is locked until then: see is_left_over.
    void take_place_of(const std::string& target) {
        if (name_.empty()) {
            const std::string name = unfinished_name(number()), self = fmt::format("/proc/self/fd/{}", descriptor());
            if (::linkat(AT_FDCWD, self.c_str(), folder_, name.c_str(), AT_SYMLINK_FOLLOW) != 0)
                fail_to_write(path_, errno);
            name_ = name;
        }
        if (::renameat(folder_, name_.c_str(), folder_, target.c_str()) != 0) fail_to_write(path_, errno);
        name_.clear();
        if (!file_.close()) fail_to_write(path_, errno);
    }

private:
    OpenFile make() {
        OpenFile nameless(::openat(folder_, ".", O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600));
        if (nameless.descriptor() >= 0) {
            ::flock(nameless.descriptor(), LOCK_EX);
            return nameless;
        }
        if (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL) fail_to_write(path_, errno);
        const std::string first = fmt::format(".kaya-{}-{}.unfinished", ::getpid(), ::time(nullptr));
        OpenFile named(::openat(folder_, first.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
        if (named.descriptor() < 0) fail_to_write(path_, errno);
        name_ = first; // not the name that is swept, until it is locked
        ::flock(named.descriptor(), LOCK_EX);
        const std::string name = unfinished_name(number(named.descriptor()));
        if (::renameat(folder_, first.c_str(), folder_, name.c_str()) == 0) name_ = name;
        return named;
    }

    ino_t number() const { return number(descriptor()); }
    ino_t number(int descriptor) const {
        struct stat info {};
        if (::fstat(descriptor, &info) != 0) fail_to_write(path_, errno);
        return info.st_ino;
    }

    int folder_;
    const std::string& path_; ///< for messages
    std::string name_;        ///< that it has at the moment
    OpenFile file_;
};

/// A new name in a folder is on the disk only when the folder is. The file itself is complete where this fails.
void sync_folder(int folder) {
    const OpenFile opened(::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (opened.descriptor() >= 0) ::fsync(opened.descriptor());
}

} // namespace

void write_whole_file(const std::string& path, std::string_view content) {
    if (path.empty()) throw Diagnostic("cannot write a file without a name", "give it a name", Fault::run);
    // The target of a link is replaced, not the link.
    std::error_code none;
    fs::path target = path;
    if (fs::is_symlink(path, none)) {
        const auto followed = fs::canonical(path, none);
        if (!none) target = followed;
    }
    const fs::path parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
    const std::string name = target.filename().string();
    const OpenFile folder(::open(parent.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (folder.descriptor() < 0) fail_to_write(path, errno);
    const int at = folder.descriptor();
    struct stat old {};
    const bool exists = ::fstatat(at, name.c_str(), &old, 0) == 0;
    if (name.empty() || (exists && S_ISDIR(old.st_mode))) fail_to_write(path, EISDIR);
    if (exists && !S_ISREG(old.st_mode)) return write_directly(path, content);
    // Renaming would replace a file that its owner has write-protected.
    if (exists && ::faccessat(at, name.c_str(), W_OK, 0) != 0) fail_to_write(path, errno);

    sweep(at, parent);
    Draft draft(at, path);
    const mode_t mask = ::umask(0);
    ::umask(mask);
    ::fchmod(draft.descriptor(), exists ? old.st_mode & 07777 : 0666 & ~mask);
    if (!write_all(draft.descriptor(), content) || ::fsync(draft.descriptor()) != 0) fail_to_write(path, errno);
    draft.take_place_of(name);
    sync_folder(at);
}

std::string read_whole_file(const std::string& path) {
    const auto fail = [&path](int error) {
        if (error == ENOENT || error == ENOTDIR)
            return Diagnostic(fmt::format("there is no file '{}'", path), "check the name and the folder");
        if (error == EISDIR) return Diagnostic(fmt::format("'{}' is a folder", path), "give the name of a file");
        return Diagnostic(fmt::format("cannot read '{}': {}", path, std::strerror(error)), {}, Fault::run);
    };
    OpenFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.descriptor() < 0) throw fail(errno);
    struct stat info {};
    if (::fstat(file.descriptor(), &info) != 0) throw fail(errno);
    if (S_ISDIR(info.st_mode)) throw fail(EISDIR);

    std::string content;
    content.reserve(static_cast<std::size_t>(info.st_size));
    std::string buffer(std::size_t{1} << 20, '\0');
    for (;;) {
        const ssize_t got = ::read(file.descriptor(), buffer.data(), buffer.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw fail(errno);
        if (got == 0) return content;
        content.append(buffer.data(), static_cast<std::size_t>(got));
    }
}

} // namespace kaya
