#include "harness.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace kaya::fuzz {

namespace {

namespace fs = std::filesystem;

fs::path folder;

void remove_folder() {
    std::error_code ignored;
    fs::current_path(fs::temp_directory_path(ignored), ignored);
    fs::remove_all(folder, ignored);
}

} // namespace

void work_in_empty_folder() {
    std::string name = (fs::temp_directory_path() / "kaya-fuzz-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
        std::perror("a folder to work in");
        std::exit(2);
    }
    folder = name;
    fs::current_path(folder);
    std::atexit(remove_folder);
}

} // namespace kaya::fuzz

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    kaya::fuzz::work_in_empty_folder();
    return 0;
}
