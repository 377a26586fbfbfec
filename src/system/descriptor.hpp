// An open file or folder, closed at the end of its scope, and the calls of the system on one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace kaya {

class Descriptor {
public:
    explicit Descriptor(int number = -1) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~Descriptor() { close(); }

    explicit operator bool() const { return number_ >= 0; }
    int number() const { return number_; }
    /// For a library that opens files by their names alone.
    std::string name() const { return "/proc/self/fd/" + std::to_string(number_); }
    int release() { return std::exchange(number_, -1); }
    /// False when data could not be written.
    bool close();

private:
    int number_;
};

/// A file or folder to be examined, or as the start of a path; links are followed. Nothing is read or written through it.
Descriptor handle_of(const std::filesystem::path& path, int more_flags = 0);

/// Opens a file below a folder, by a path that only descends. A link anywhere on the path is an error, so that the file is the
/// one that was checked before, even when another process changes the folders meanwhile. Without a descriptor errno says why.
Descriptor open_beneath(int folder, const std::filesystem::path& below, int flags, unsigned mode = 0666);

/// False: errno says why. Reading ends when there are more than `most` bytes.
bool read_all(int descriptor, std::string& content, std::size_t most = std::string::npos);
bool write_all(int descriptor, std::string_view content);

/// A file in memory, without a name in any folder, that cannot be changed. Without a descriptor errno says why.
Descriptor sealed_copy(const std::string& title, std::string_view content);

} // namespace kaya
