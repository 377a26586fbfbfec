#include "app/adapter_cache.hpp"

#include "base/diagnostic.hpp"
#include "base/sha256.hpp"
#include "system/door.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <set>
#include <sstream>
#include <unistd.h>

namespace kaya {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_objects = 8; ///< of other compilers, options and versions

/// The program that a word of the line starts: where it is, how large and how old.
std::string program_of(const std::string& word) {
    std::istringstream folders(word.find('/') != word.npos ? "" : std::getenv("PATH") ? std::getenv("PATH") : "");
    fs::path program = word;
    for (std::string folder; std::getline(folders, folder, ':');)
        if (access((fs::path(folder) / word).c_str(), X_OK) == 0) {
            program = fs::path(folder) / word;
            break;
        }
    std::error_code missing;
    const fs::path whole = fs::canonical(program, missing);
    if (missing) return word;
    return fmt::format("{} {} {}", whole.string(), fs::file_size(whole, missing),
                       fs::last_write_time(whole, missing).time_since_epoch().count());
}

/// The processor that -march=native refers to: different machines may share a home folder.
std::string processor() {
    std::istringstream lines(door::system_text("/proc/cpuinfo"));
    std::set<std::string> said;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("model name") || line.starts_with("flags") || line.starts_with("Features") ||
            line.starts_with("CPU part"))
            said.insert(line);
    std::string text;
    for (const auto& line : said) text += line + "\n";
    return text;
}

void remove_oldest(const fs::path& folder) {
    std::error_code ignored;
    std::vector<std::pair<fs::file_time_type, fs::path>> objects;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (entry.path().extension() == ".o")
            objects.emplace_back(fs::last_write_time(entry.path(), ignored), entry.path());
    if (objects.size() <= most_objects) return;
    std::sort(objects.begin(), objects.end());
    for (std::size_t k = 0; k + most_objects < objects.size(); ++k) door::remove(objects[k].second);
}

} // namespace

fs::path cache_folder() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    if (cache && fs::path(cache).is_absolute()) return fs::path(cache) / "kaya";
    const char* home = std::getenv("HOME");
    return home && fs::path(home).is_absolute() ? fs::path(home) / ".cache" / "kaya" : fs::path();
}

AdapterCache::AdapterCache(const std::vector<std::string>& line, const fs::path& include) {
    const fs::path folder = cache_folder();
    if (folder.empty()) return;
    std::string all;
    for (const auto& word : line) all += word + '\0';
    if (!line.empty()) all += program_of(line.front());
    all += processor();
    std::error_code ignored;
    std::set<fs::path> headers;
    for (const auto& entry : fs::recursive_directory_iterator(include / "kaya", ignored))
        if (entry.is_regular_file(ignored)) headers.insert(entry.path());
    for (const auto& header : headers) all += fmt::format("{}\n{}", header.string(), door::system_text(header.c_str()));
    try {
        if (!door::make_folders(folder, Use::own) && access(folder.c_str(), W_OK) == 0)
            file_ = folder / fmt::format("adapter-{}.o", sha256(all).substr(0, 32));
    } catch (const Diagnostic&) {} // XDG_CACHE_HOME may name a folder that cannot be written
}

fs::path AdapterCache::object(const fs::path& draft, const std::function<bool()>& compile) const {
    std::error_code failed;
    if (!file_.empty() && fs::is_regular_file(file_, failed)) return file_;
    if (!compile()) return {};
    if (file_.empty()) return draft;
    write_whole_file(file_.string(), read_whole_file(draft.string()), Use::own);
    remove_oldest(file_.parent_path());
    return file_;
}

} // namespace kaya
