#include "system/door.hpp"

#include "base/diagnostic.hpp"

#include <cerrno>
#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>

namespace kaya::door {

namespace fs = std::filesystem;

namespace {

std::shared_ptr<Gate>& gate_of_process() {
    static std::shared_ptr<Gate> gate;
    return gate;
}

std::error_code last_error() { return {errno, std::generic_category()}; }

int flags_of(const std::string& mode) {
    const bool both = mode.find('+') != mode.npos;
    switch (mode.empty() ? 'r' : mode.front()) {
    case 'w': return (both ? O_RDWR : O_WRONLY) | O_CREAT | O_TRUNC;
    case 'a': return (both ? O_RDWR : O_WRONLY) | O_CREAT | O_APPEND;
    default: return both ? O_RDWR : O_RDONLY;
    }
}

/// All below an open folder, then the folder itself.
std::error_code remove_below(int parent, const char* name) {
    Descriptor folder(::openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (!folder) {
        const bool is_folder = errno != ENOTDIR && errno != ELOOP;
        if (is_folder && errno != ENOENT) return last_error();
        return ::unlinkat(parent, name, 0) == 0 || errno == ENOENT ? std::error_code() : last_error();
    }
    DIR* entries = ::fdopendir(folder.number());
    if (entries == nullptr) return last_error();
    const std::unique_ptr<DIR, int (*)(DIR*)> closing(entries, ::closedir);
    const int number = folder.release();
    std::error_code problem;
    while (const dirent* entry = ::readdir(entries)) {
        const std::string_view one = entry->d_name;
        if (one != "." && one != "..")
            if (const auto failed = remove_below(number, entry->d_name)) problem = failed;
    }
    if (problem) return problem;
    return ::unlinkat(parent, name, AT_REMOVEDIR) == 0 ? std::error_code() : last_error();
}

} // namespace

void set_gate(std::shared_ptr<Gate> gate) { gate_of_process() = std::move(gate); }

std::shared_ptr<Gate> gate() { return gate_of_process() ? gate_of_process() : std::make_shared<Gate>(); }

namespace {

/// The flags are those of open(2).
Descriptor open_with(const fs::path& file, Use use, int flags) {
    const auto held = gate();
    const Gate::Route route = held->route_to(file, use);
    if (route.folder < 0) return Descriptor(::open(route.below.c_str(), flags | O_CLOEXEC, 0666));
    // A pipe does not block it, and the file is not truncated before its kind is known.
    Descriptor opened = open_beneath(route.folder, route.below, (flags & ~O_TRUNC) | O_NONBLOCK | O_NOCTTY);
    if (!opened) return opened;
    if (route.plain) held->refuse_special(file, opened.number());
    if ((flags & O_TRUNC) != 0 && ::ftruncate(opened.number(), 0) != 0) return Descriptor();
    return opened;
}

int flags_of(Access access) {
    switch (access) {
    case Access::read: return O_RDONLY;
    case Access::write: return O_WRONLY;
    case Access::renew: return O_WRONLY | O_CREAT | O_TRUNC;
    case Access::keep: return O_RDWR | O_CREAT;
    case Access::no_link: return O_RDWR | O_CREAT | O_NOFOLLOW;
    }
    return O_RDONLY;
}

} // namespace

Descriptor open(const fs::path& file, Use use, Access access) { return open_with(file, use, flags_of(access)); }

Descriptor peek(const fs::path& file) {
    try {
        return open(file, Use::read, Access::read);
    } catch (const Diagnostic&) {
        errno = EACCES;
        return Descriptor();
    }
}

Stream open_stream(const fs::path& file, Use use, const std::string& mode) {
    Descriptor opened = open_with(file, use, flags_of(mode));
    Stream stream(opened ? ::fdopen(opened.number(), mode.c_str()) : nullptr);
    if (stream) opened.release();
    return stream;
}

Place place_of(const fs::path& file, Use use, bool follow) {
    const auto held = gate();
    const fs::path parent = file.has_parent_path() ? file.parent_path() : fs::path(".");
    const Gate::Route route = held->route_to(follow ? file : parent, use);
    if (route.folder >= 0) {
        const fs::path folder = follow ? route.below.parent_path() : route.below;
        return {open_beneath(route.folder, folder.empty() ? fs::path(".") : folder, O_PATH | O_DIRECTORY),
                (follow ? route.below : file).filename().string()};
    }
    std::error_code none;
    fs::path target = file;
    if (follow && fs::is_symlink(file, none)) {
        const auto followed = fs::canonical(file, none);
        if (!none) target = followed;
    }
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    return {handle_of(folder, O_DIRECTORY), target.filename().string()};
}

namespace {

std::error_code removed(const fs::path& file, std::error_code (*action)(int, const char*)) noexcept {
    std::error_code problem;
    try {
        const Place place = place_of(file, Use::own, false);
        problem = place.folder ? action(place.folder.number(), place.name.c_str()) : last_error();
    } catch (const std::exception&) { problem = std::make_error_code(std::errc::permission_denied); }
    return problem == std::errc::no_such_file_or_directory ? std::error_code() : problem;
}

} // namespace

std::error_code make_folders(const fs::path& folder, Use use) {
    const Gate::Route route = gate()->route_to(folder, use);
    std::error_code problem;
    if (route.folder < 0) {
        fs::create_directories(route.below, problem);
        return problem;
    }
    Descriptor at = open_beneath(route.folder, ".", O_PATH | O_DIRECTORY);
    for (const auto& part : route.below) {
        if (!at) break;
        if (part == ".") continue;
        if (::mkdirat(at.number(), part.c_str(), 0777) != 0 && errno != EEXIST) return last_error();
        at = open_beneath(at.number(), part, O_PATH | O_DIRECTORY);
    }
    return at ? problem : last_error();
}

std::error_code remove(const fs::path& file) noexcept {
    return removed(file, [](int folder, const char* name) {
        return ::unlinkat(folder, name, 0) == 0 ? std::error_code() : last_error();
    });
}

std::error_code remove_all(const fs::path& folder) noexcept { return removed(folder, remove_below); }

bool enter(const fs::path& folder) {
    const Gate::Route route = gate()->route_to(folder, Use::own);
    if (route.folder < 0) return ::chdir(route.below.c_str()) == 0;
    const Descriptor opened = open_beneath(route.folder, route.below, O_PATH | O_DIRECTORY);
    return opened && ::fchdir(opened.number()) == 0;
}

Descriptor null_device() { return Descriptor(::open("/dev/null", O_RDWR | O_CLOEXEC)); }

std::string system_text(const char* name) {
    const Descriptor file(::open(name, O_RDONLY | O_CLOEXEC));
    std::string text;
    if (file) read_all(file.number(), text);
    return text;
}

} // namespace kaya::door
