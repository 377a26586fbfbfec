#include "laws/library_file.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <dlfcn.h>
#include <elf.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

namespace kaya {

std::string fault_of_library_file(const std::filesystem::path& file) {
    const std::string not_a_library = "is not a shared library";
    if (!std::filesystem::is_regular_file(file)) return not_a_library;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return "cannot be read";

    Elf64_Ehdr header{};
    stream.read(reinterpret_cast<char*>(&header), sizeof header);
    if (stream.gcount() < SELFMAG || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return not_a_library;
    const std::string cut_off = "is cut off: the file is shorter than its own table says";
    if (!stream) return cut_off;
    if (header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_type != ET_DYN) return not_a_library;

    const auto size = std::filesystem::file_size(file);
    for (unsigned k = 0; k < header.e_phnum; ++k) {
        Elf64_Phdr segment{};
        stream.seekg(static_cast<std::streamoff>(header.e_phoff + k * sizeof segment));
        stream.read(reinterpret_cast<char*>(&segment), sizeof segment);
        if (!stream || segment.p_offset > size || segment.p_filesz > size - segment.p_offset) return cut_off;
    }
    return {};
}

namespace {

constexpr unsigned patience = 30; ///< seconds that a library may take to be loaded

[[noreturn]] void load_and_leave(const std::filesystem::path& file, const char* entry, int answer) {
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM}) std::signal(signal, SIG_DFL);
    alarm(patience);
    // What it prints is printed when it is loaded in earnest.
    if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) {
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
    }
    if (void* library = dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL)) {
        try {
            if (void* function = dlsym(library, entry)) reinterpret_cast<const void* (*)()>(function)();
        } catch (...) { // what is thrown is caught there, too
        }
    }
    const char well = 'k';
    const bool told = write(answer, &well, 1) == 1;
    _exit(told ? 0 : 1);
}

} // namespace

std::string fault_of_loading(const std::filesystem::path& file, const char* entry) {
    int ends[2];
    if (pipe(ends) != 0) return {};
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        load_and_leave(file, entry, ends[1]);
    }
    close(ends[1]);
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
