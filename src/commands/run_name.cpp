#include "commands/run_name.hpp"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace kaya {

namespace fs = std::filesystem;

namespace {

constexpr int most_runs = 1000;           ///< of one name in one folder
constexpr std::size_t longest_stem = 200; ///< bytes: file systems take 255, and endings follow

/// The descriptor of a file that is locked for this run; -1: another run has it, -2: none can be made here.
int locked(const fs::path& file) {
    for (;;) {
        const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
        if (descriptor < 0) return -2;
        if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
            const bool busy = errno == EWOULDBLOCK;
            ::close(descriptor);
            return busy ? -1 : -2;
        }
        struct stat mine {
        }, there{};
        const bool same =
            ::fstat(descriptor, &mine) == 0 && ::stat(file.c_str(), &there) == 0 && mine.st_ino == there.st_ino;
        if (same) return descriptor;
        ::close(descriptor); // the run before has taken it away in this moment
    }
}

} // namespace

RunNames::~RunNames() {
    for (const auto& [stem, held] : held_) {
        if (held.descriptor < 0) continue;
        ::unlink(held.file.c_str());
        ::close(held.descriptor);
    }
}

RunNames::Taken RunNames::take(const std::string& stem) {
    if (const auto found = held_.find(stem); found != held_.end()) return {found->second.name, false, false};
    for (int number = 1; number <= most_runs; ++number) {
        const std::string name = number == 1 ? stem : fmt::format("{}-{}", stem, number);
        std::error_code ignored;
        const fs::path file = fs::absolute(fmt::format(".{}.kaya-lock", name), ignored);
        const int descriptor = locked(file);
        if (descriptor == -1) continue;
        const std::string& taken = descriptor < 0 ? stem : name;
        held_[stem] = {taken, descriptor, file};
        return {taken, true, taken != stem};
    }
    return {stem, true, false};
}

std::string stem_of_deck(const std::string& deck) {
    std::string stem = deck.empty() ? "prompt" : fs::path(deck).stem().string();
    std::replace_if(
        stem.begin(), stem.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, '_');
    std::size_t end = std::min(stem.size(), longest_stem);
    while (end > 0 && end < stem.size() && (static_cast<unsigned char>(stem[end]) & 0xc0) == 0x80)
        --end; // whole characters
    return stem.substr(0, end);
}

} // namespace kaya
