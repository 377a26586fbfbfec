#include "system/generated_files.hpp"

#include "base/diagnostic.hpp"
#include "system/door.hpp"
#include "system/whole_file.hpp"

#include <iostream>

namespace kaya {

namespace fs = std::filesystem;

std::string text_of_file(const fs::path& file) { return file_text(file).value_or(""); }

int write_generated(const std::map<fs::path, std::string>& files, bool check, const std::string& hint) {
    int status = 0;
    for (const auto& [file, text] : files) {
        if (text_of_file(file) == text) continue;
        if (check) {
            std::cout << file.string() << ": " << hint << '\n';
            status = 1;
            continue;
        }
        try {
            door::make_folders(file.parent_path(), Use::own); // a failure is reported by the file
            write_whole_file(file.string(), text, Use::own);
        } catch (const Diagnostic& problem) {
            std::cerr << problem.message << '\n';
            return 2;
        }
        std::cout << "wrote " << file.string() << '\n';
    }
    return status;
}

} // namespace kaya
