// The program that draws, as kaya sees it.
#pragma once

#include "scene/wire.hpp"

#include <filesystem>
#include <string>
#include <sys/types.h>

namespace kaya {

/// One program kaya-painter next to this one, which waits until the first picture is asked for.
class Painter {
public:
    explicit Painter(std::filesystem::path program) : program_(std::move(program)) {}
    ~Painter();
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;

    /// Makes a process that becomes the painter when it is given its first drawing. Follows the lock of the file system no
    /// program can be started, so this comes before it; it draws numbers that it is given and knows no names of files.
    /// Nothing, when there is no such program.
    void stand_by();

    /// The bytes of a PNG file. Throws Diagnostic (Fault::run): what is missing, or what went wrong.
    std::string png(const Drawing& drawing);

private:
    void send(const std::string& bytes);
    std::string receive();
    std::string read(std::size_t size);
    void end();

    std::filesystem::path program_;
    pid_t process_ = -1;
    int to_ = -1, from_ = -1;
};

} // namespace kaya
