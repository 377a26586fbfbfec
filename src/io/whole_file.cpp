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
#include <unistd.h>
#include <utility>

namespace kaya {

namespace {

/// Closes a descriptor and, unless kept, removes the unfinished file of that name.
class OpenFile {
public:
    OpenFile(int descriptor, std::string unfinished) : descriptor_(descriptor), unfinished_(std::move(unfinished)) {}
    OpenFile(OpenFile&& other) noexcept
        : descriptor_(std::exchange(other.descriptor_, -1)), unfinished_(std::exchange(other.unfinished_, {})) {}
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    ~OpenFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (!unfinished_.empty()) ::unlink(unfinished_.c_str());
    }

    int descriptor() const { return descriptor_; }
    const std::string& name() const { return unfinished_; }
    bool close() { return ::close(std::exchange(descriptor_, -1)) == 0; }
    void keep() { unfinished_.clear(); }

private:
    int descriptor_;
    std::string unfinished_;
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
    OpenFile file(::open(path.c_str(), O_WRONLY | O_CLOEXEC), {});
    if (file.descriptor() < 0 || !write_all(file.descriptor(), content)) fail_to_write(path, errno);
    if (!file.close()) fail_to_write(path, errno);
}

// The name of an unfinished file is that of the file with this and six more characters after it.
constexpr std::string_view unfinished_mark = ".kaya-", unfinished_end = "XXXXXX";

/// What runs that were killed have left in a folder; a run that still writes holds its file by a lock. Once for each folder: a
/// run that was killed before this one began.
void sweep(const std::filesystem::path& folder) {
    static std::set<std::filesystem::path> swept;
    if (!swept.insert(folder).second) return;
    std::error_code problem;
    for (std::filesystem::directory_iterator entry(folder, problem), end; !problem && entry != end;
         entry.increment(problem)) {
        const std::string name = entry->path().filename().string();
        const std::size_t tail = unfinished_mark.size() + unfinished_end.size();
        if (name.size() <= tail || name.compare(name.size() - tail, unfinished_mark.size(), unfinished_mark) != 0)
            continue;
        const int descriptor = ::open(entry->path().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
        if (descriptor < 0) continue;
        struct stat info {};
        const bool left =
            ::fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode) && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
        if (left) ::unlink(entry->path().c_str());
        ::close(descriptor);
    }
}

/// A new file next to the target, locked. Between its making and its lock another process may have swept it away: then another.
OpenFile unfinished_for(const std::string& target, const std::string& path) {
    for (;;) {
        std::string name = fmt::format("{}{}{}", target, unfinished_mark, unfinished_end);
        const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
        if (descriptor < 0) fail_to_write(path, errno);
        OpenFile file(descriptor, name);
        ::flock(descriptor, LOCK_EX); // until it is closed
        struct stat info {};
        if (::fstat(descriptor, &info) != 0) fail_to_write(path, errno);
        if (info.st_nlink > 0) return file;
        file.keep(); // there is nothing to remove
    }
}

/// A new name in a folder is on the disk only when the folder is.
void sync_folder_of(const std::string& path) {
    const auto parent = std::filesystem::path(path).parent_path();
    const int folder = ::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return; // the file itself is complete all the same
    ::fsync(folder);
    ::close(folder);
}

} // namespace

void write_whole_file(const std::string& path, std::string_view content) {
    if (path.empty()) throw Diagnostic("cannot write a file without a name", "give it a name", Fault::run);
    // The target of a link is replaced, not the link.
    std::error_code none;
    std::string target = path;
    if (std::filesystem::is_symlink(path, none)) {
        const auto followed = std::filesystem::canonical(path, none);
        if (!none) target = followed.string();
    }
    struct stat old {};
    const bool exists = ::stat(target.c_str(), &old) == 0;
    if (exists && S_ISDIR(old.st_mode)) fail_to_write(path, EISDIR);
    if (exists && !S_ISREG(old.st_mode)) return write_directly(path, content);
    // Renaming would replace a file that its owner has write-protected.
    if (exists && ::access(target.c_str(), W_OK) != 0) fail_to_write(path, errno);

    const auto folder = std::filesystem::path(target).parent_path();
    sweep(folder.empty() ? "." : folder);
    OpenFile file = unfinished_for(target, path);
    const mode_t mask = ::umask(0);
    ::umask(mask);
    const int descriptor = file.descriptor();
    ::fchmod(descriptor, exists ? old.st_mode & 07777 : 0666 & ~mask);
    if (!write_all(descriptor, content) || ::fsync(descriptor) != 0) fail_to_write(path, errno);
    // Renamed while it is locked: a finished file without a lock would be taken for one that was left.
    if (::rename(file.name().c_str(), target.c_str()) != 0) fail_to_write(path, errno);
    file.keep();
    if (!file.close()) fail_to_write(path, errno);
    sync_folder_of(target);
}

std::string read_whole_file(const std::string& path) {
    const auto fail = [&path](int error) {
        if (error == ENOENT || error == ENOTDIR)
            return Diagnostic(fmt::format("there is no file '{}'", path), "check the name and the folder");
        if (error == EISDIR) return Diagnostic(fmt::format("'{}' is a folder", path), "give the name of a file");
        return Diagnostic(fmt::format("cannot read '{}': {}", path, std::strerror(error)), {}, Fault::run);
    };
    OpenFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC), {});
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
