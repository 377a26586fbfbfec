// The compiled adapter of sources for 3DEC, kept between builds: it takes longer than most sources, and is always the same.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace kaya {

class AdapterCache {
public:
    /// `line` is the compiler's line without the name of the object, `include` the folder of headers. What is kept belongs
    /// to this line, to what the compiler and the headers are now, and to this machine's processor.
    AdapterCache(const std::vector<std::string>& line, const std::filesystem::path& include);

    /// The object, made by `compile`, which gets the file to write and says whether it could, unless it is there.
    /// Empty when it could not. Without a place for a cache the object is made at `otherwise`.
    std::filesystem::path object(const std::filesystem::path& otherwise,
                                 const std::function<bool(const std::filesystem::path&)>& compile) const;

private:
    std::filesystem::path file_; ///< empty: there is no place
};

} // namespace kaya
