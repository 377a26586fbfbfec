#include "system/whole_file.hpp"

#include "base/diagnostic.hpp"
#include "system/door.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <memory>
#include <mutex>
#include <set>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <tuple>

namespace kaya {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail_to_write(const std::string& path, int error) {
    std::string hint;
    if (error == ENOSPC || error == EDQUOT || error == EFBIG)
        hint = "make room or write elsewhere; an existing file of that name is unchanged";
    else if (error == ENOENT || error == ENOTDIR) hint = "make the folder first";
    else if (error == EACCES || error == EPERM || error == EROFS) hint = "write to a folder of yours";
    else if (error == EISDIR) hint = "give the name of a file";
    throw Diagnostic(fmt::format("cannot write '{}': {}", path, std::strerror(error)), hint, Fault::run);
}

void write_directly(const std::string& path, std::string_view content, Use use) {
    Descriptor file = door::open(path, use, door::Access::write);
    if (!file || !write_all(file.number(), content)) fail_to_write(path, errno);
    if (!file.close()) fail_to_write(path, errno);
}

/// The name of an unfinished file. It is hidden and holds the number of the file itself: neither a user nor a copy has it.
std::string unfinished_name(ino_t number) { return fmt::format(".kaya-{}.unfinished", number); }

/// The name before its number is known: that of a process, and when it was made.
std::string first_name() { return fmt::format(".kaya-{}-{}.unfinished", ::getpid(), ::time(nullptr)); }

/// Whether the name is a first one of a file that was made then. Such a file is still empty.
bool is_first_name(const std::string& name, const struct stat& info) {
    long process = 0, made = 0;
    return info.st_size == 0 && std::sscanf(name.c_str(), ".kaya-%ld-%ld", &process, &made) == 2 &&
           name == fmt::format(".kaya-{}-{}.unfinished", process, made) && std::abs(info.st_mtime - made) <= 1;
}

/// Whether kaya began to write this file and no run still writes it. A run locks its file before the file has its second name.
bool is_left_over(int descriptor, const std::string& name) {
    struct stat info {};
    return ::fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode) && info.st_nlink == 1 &&
           info.st_uid == ::geteuid() && (name == unfinished_name(info.st_ino) || is_first_name(name, info)) &&
           ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
}

/// Removes the left-overs of killed runs in a folder; once for each folder.
void sweep(int folder, const std::filesystem::path& path) {
    static std::set<std::tuple<dev_t, ino_t, std::filesystem::path>> swept;
    static std::mutex of_swept;
    struct stat info {};
    if (::fstat(folder, &info) != 0) return;
    {
        const std::lock_guard guard(of_swept);
        if (!swept.emplace(info.st_dev, info.st_ino, path.parent_path()).second) return;
    }
    Descriptor listed = open_beneath(folder, ".", O_RDONLY | O_DIRECTORY);
    const std::unique_ptr<DIR, int (*)(DIR*)> entries(listed ? ::fdopendir(listed.number()) : nullptr, ::closedir);
    if (!entries) return;
    listed.release();
    while (const dirent* entry = ::readdir(entries.get())) {
        const std::string name = entry->d_name;
        if (!name.starts_with(".kaya-")) continue;
        const Descriptor file = open_beneath(folder, name, O_RDONLY | O_NONBLOCK);
        if (file && is_left_over(file.number(), name)) ::unlinkat(folder, name.c_str(), 0);
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

    int number() const { return file_.number(); }

    /// Gives it the name of the target and replaces the earlier file. It is locked until then: see is_left_over.
    void take_place_of(const std::string& target) {
        if (name_.empty()) {
            const std::string name = unfinished_name(inode(number())), self = file_.name();
            if (::linkat(AT_FDCWD, self.c_str(), folder_, name.c_str(), AT_SYMLINK_FOLLOW) != 0)
                fail_to_write(path_, errno);
            name_ = name;
        }
        if (::renameat(folder_, name_.c_str(), folder_, target.c_str()) != 0) fail_to_write(path_, errno);
        name_.clear();
        if (!file_.close()) fail_to_write(path_, errno);
    }

private:
    Descriptor make() {
        Descriptor nameless(::openat(folder_, ".", O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600));
        if (nameless) {
            ::flock(nameless.number(), LOCK_EX);
            return nameless;
        }
        if (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL) fail_to_write(path_, errno);
        // Another run may take the file for a left-over and remove it before it is locked.
        constexpr int most_tries = 100;
        for (int k = 0; k < most_tries; ++k) {
            const std::string first = first_name();
            Descriptor named(::openat(folder_, first.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
            if (!named && errno == EEXIST) continue; // of another thread, for some microseconds
            if (!named) fail_to_write(path_, errno);
            name_ = first;
            ::flock(named.number(), LOCK_EX);
            const std::string name = unfinished_name(inode(named.number()));
            if (::renameat(folder_, first.c_str(), folder_, name.c_str()) == 0) {
                name_ = name;
                return named;
            }
            if (errno != ENOENT) fail_to_write(path_, errno);
        }
        name_.clear();
        fail_to_write(path_, ENOENT);
    }

    ino_t inode(int descriptor) const {
        struct stat info {};
        if (::fstat(descriptor, &info) != 0) fail_to_write(path_, errno);
        return info.st_ino;
    }

    int folder_;
    const std::string& path_; ///< for messages
    std::string name_;        ///< that it has at the moment
    Descriptor file_;
};

/// A new name in a folder is on the disk only when the folder is. The file itself is complete where this fails.
void sync_folder(int folder) {
    const Descriptor opened = open_beneath(folder, ".", O_RDONLY | O_DIRECTORY);
    if (opened) ::fsync(opened.number());
}

} // namespace

void write_whole_file(const std::string& path, std::string_view content, Use use) {
    if (path.empty()) throw Diagnostic("cannot write a file without a name", "give it a name", Fault::run);
    // The target of a link is replaced, not the link.
    const door::Place place = door::place_of(path, use);
    if (!place.folder) fail_to_write(path, errno);
    const int folder = place.folder.number();
    struct stat old {};
    const bool exists = ::fstatat(folder, place.name.c_str(), &old, 0) == 0;
    if (place.name.empty() || (exists && S_ISDIR(old.st_mode))) fail_to_write(path, EISDIR);
    if (exists && !S_ISREG(old.st_mode)) return write_directly(path, content, use);
    // Renaming would replace a file that its owner has write-protected.
    if (exists && ::faccessat(folder, place.name.c_str(), W_OK, 0) != 0) fail_to_write(path, errno);

    sweep(folder, path);
    Draft draft(folder, path);
    const mode_t mask = ::umask(0);
    ::umask(mask);
    ::fchmod(draft.number(), exists ? old.st_mode & 07777 : 0666 & ~mask);
    if (!write_all(draft.number(), content) || ::fsync(draft.number()) != 0) fail_to_write(path, errno);
    draft.take_place_of(place.name);
    sync_folder(folder);
}

std::string read_whole_file(const std::string& path) {
    const auto fail = [&path](int error) {
        if (error == ENOENT || error == ENOTDIR)
            return Diagnostic(fmt::format("there is no file '{}'", path), "check the name and the folder");
        if (error == EISDIR) return Diagnostic(fmt::format("'{}' is a folder", path), "give the name of a file");
        return Diagnostic(fmt::format("cannot read '{}': {}", path, std::strerror(error)), {}, Fault::run);
    };
    const Descriptor file = door::open(path, Use::read, door::Access::read);
    std::string content;
    if (!file || !read_all(file.number(), content)) throw fail(errno);
    return content;
}

std::optional<std::string> file_text(const std::filesystem::path& file) {
    const Descriptor opened = door::open(file, Use::read, door::Access::read);
    std::string text;
    if (!opened || !read_all(opened.number(), text)) return std::nullopt;
    return text;
}

} // namespace kaya
