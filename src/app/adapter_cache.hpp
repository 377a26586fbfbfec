// The compiled adapter of sources for 3DEC, cached between builds: it takes longer than most sources and never changes.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace kaya {

/// kaya below XDG_CACHE_HOME, or .cache of the home folder; empty when there is neither.
std::filesystem::path cache_folder();

class AdapterCache {
public:
    /// `line` is the compiler's command without the name of the object, `include` the folder of headers. Cached objects depend on this
    /// line, the compiler, the headers and this machine's processor.
    AdapterCache(const std::vector<std::string>& line, const std::filesystem::path& include);

    /// The object. `compile` makes a missing one at `draft` and returns whether it succeeded; the object is then cached if there is a
    /// folder for it. Empty when it could not be made.
    std::filesystem::path object(const std::filesystem::path& draft, const std::function<bool()>& compile) const;

private:
    std::filesystem::path file_; ///< empty: no folder
};

} // namespace kaya
