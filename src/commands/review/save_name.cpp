#include "commands/review/save_name.hpp"

#include <filesystem>

namespace kaya {

std::string save_name(const std::string& name) {
    return std::filesystem::path(name).has_extension() ? name : name + std::string(save_ending);
}

} // namespace kaya
