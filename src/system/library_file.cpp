#include "system/library_file.hpp"

#include "system/crash_report.hpp"
#include "system/door.hpp"
#include "system/loaded_library.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <dlfcn.h>
#include <elf.h>
#include <fmt/format.h>
#include <optional>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace kaya {

bool is_there(const std::filesystem::path& file) {
    std::error_code impossible;
    return std::filesystem::exists(file, impossible);
}

std::string fault_of_library_file(const std::filesystem::path& file) {
    const std::string not_a_library = "is not a shared library";
    if (!std::filesystem::is_regular_file(file)) return not_a_library;
    const auto unreadable = [] { return fmt::format("cannot be read: {}", std::strerror(errno)); };
    const Descriptor opened = door::open(file, Use::read, door::Access::read); // the gate says why it refuses
    if (!opened) return unreadable();

    Elf64_Ehdr header{};
    const ssize_t got = ::pread(opened.number(), &header, sizeof header, 0);
    if (got < SELFMAG || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return not_a_library;
    const std::string cut_off = "is cut off: the file is shorter than its own table says";
    if (got < static_cast<ssize_t>(sizeof header)) return cut_off;
    if (header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_type != ET_DYN) return not_a_library;

    struct stat info {};
    if (::fstat(opened.number(), &info) != 0) return unreadable();
    const auto size = static_cast<std::uint64_t>(info.st_size);
    for (unsigned k = 0; k < header.e_phnum; ++k) {
        Elf64_Phdr segment{};
        const auto place = static_cast<off_t>(header.e_phoff + k * sizeof segment);
        const bool whole =
            ::pread(opened.number(), &segment, sizeof segment, place) == static_cast<ssize_t>(sizeof segment);
        if (!whole || segment.p_offset > size || segment.p_filesz > size - segment.p_offset) return cut_off;
    }
    return {};
}

namespace {

constexpr unsigned patience = 30; ///< seconds until the loading of a library is stopped

[[noreturn]] void load_and_leave(const std::filesystem::path& name, const char* entry, const Called* who, int answer) {
    begin_run_record(); // the process that tries a library is not the run
    const AtWork loading(called(who->name, who->file, who->noun), entry);
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM}) std::signal(signal, SIG_DFL);
    alarm(patience);
    // Its output appears when it is loaded into the program.
    if (const Descriptor nowhere = door::null_device()) {
        dup2(nowhere.number(), STDOUT_FILENO);
        dup2(nowhere.number(), STDERR_FILENO);
    }
    if (void* library = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) {
        try {
            if (void* function = dlsym(library, entry)) reinterpret_cast<const void* (*)()>(function)();
        } catch (...) { // the program catches exceptions, too
        }
    }
    const char well = 'k';
    const bool told = write(answer, &well, 1) == 1;
    _exit(told ? 0 : 1);
}

} // namespace

std::string fault_of_loading(const std::filesystem::path& name, const char* entry, const Called* who) {
    if (!who->foreign) return {}; // it ships with the program
    std::fflush(nullptr);
    int ends[2];
    std::optional<LoadingHeld> held(std::in_place); // other sessions may be at work
    if (pipe(ends) != 0) return {};
    const pid_t child = fork();
    if (child == 0) {
        LoadingHeld::forked();
        close(ends[0]);
        load_and_leave(name, entry, who, ends[1]);
    }
    close(ends[1]); // before another trial forks, or its process would hold it, too
    held.reset();
    const WaitsFor waiting(who, entry);
    char answer = 0;
    const bool well = child > 0 && read(ends[0], &answer, 1) == 1;
    close(ends[0]);
    if (child < 0) return {};
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {}
    if (well) return {};
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
        return fmt::format("does not come back within {} seconds when it is loaded", patience);
    if (WIFSIGNALED(status)) return fmt::format("crashes when it is loaded (signal {})", WTERMSIG(status));
    return "ends the program when it is loaded";
}

} // namespace kaya
