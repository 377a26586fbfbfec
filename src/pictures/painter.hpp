// The program that draws, seen from kaya.
#pragma once

#include "scene/wire.hpp"

#include <filesystem>
#include <string>
#include <sys/types.h>

namespace kaya {

/// A process of kaya-painter, which is started for the first picture.
class Painter {
public:
    explicit Painter(std::filesystem::path program) : program_(std::move(program)) {}
    ~Painter();
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;

    /// Makes a process that becomes the painter when it receives its first drawing. After the file system is locked no program can be
    /// started, so this is called before it; the painter receives numbers only, and no names of files. Does nothing when the program is
    /// missing.
    void stand_by();

    /// The bytes of a PNG file. Throws Diagnostic (Fault::run): a missing program, or an error of the painter.
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
