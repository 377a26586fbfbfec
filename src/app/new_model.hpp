// `kaya new-jmodel NAME` and `kaya new-zmodel NAME`: a model to begin with.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// Where a new model is put, and the names that it must not have.
struct NewModel {
    std::string name;
    std::filesystem::path in;
    std::vector<std::string> taken;
};

/// Creates the folder `in`/NAME with the templates of these kinds (model_templates.hpp): a working model, a deck or a path that shows it, a
/// deck that tests it, a page. Returns the files. Throws Diagnostic: the name cannot be typed in a deck, or is in use; the folder exists.
std::vector<std::filesystem::path> write_new_model(std::span<const std::string_view> kinds, const NewModel& model);

} // namespace kaya
