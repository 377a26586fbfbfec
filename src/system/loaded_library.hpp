// Shared libraries that are loaded into this process.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace kaya {

struct Called;

/// While it exists, no other thread loads or unloads a law, and none makes or reads a Called. So a process that is forked meanwhile has these
/// whole; its own first act is forked().
class LoadingHeld {
public:
    LoadingHeld();
    ~LoadingHeld();
    LoadingHeld(const LoadingHeld&) = delete;
    LoadingHeld& operator=(const LoadingHeld&) = delete;

    static void forked();
};

/// Loads the library of a law; its symbols stay apart from those of others. Null: `fault` receives the reason. It is unloaded with its last
/// owner, and `who` is at work then.
std::shared_ptr<void> load_library(const std::filesystem::path& name, const Called* who, std::string& fault);

/// Null when the library has no such symbol.
void* symbol_of(void* library, const char* symbol);

/// Keeps a library that is loaded until the end of the process.
void keep_loaded(const std::filesystem::path& name);

/// The program or library that holds the code at that place; empty when the system does not tell.
std::filesystem::path file_of_code(const void* place);

} // namespace kaya
