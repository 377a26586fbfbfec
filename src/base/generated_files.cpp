#include "base/generated_files.hpp"

#include <fstream>
#include <iostream>

namespace kaya {

namespace fs = std::filesystem;

std::string text_of_file(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

int write_generated(const std::map<fs::path, std::string>& files, bool check, const std::string& hint) {
    int status = 0;
    for (const auto& [file, text] : files) {
        if (text_of_file(file) == text) continue;
        if (check) {
            std::cout << file.string() << ": " << hint << '\n';
            status = 1;
            continue;
        }
        fs::create_directories(file.parent_path());
        if (!(std::ofstream(file) << text)) {
            std::cerr << "cannot write " << file.string() << '\n';
            return 2;
        }
        std::cout << "wrote " << file.string() << '\n';
    }
    return status;
}

} // namespace kaya
