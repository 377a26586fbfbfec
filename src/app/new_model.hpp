// `kaya new-jmodel NAME` and `kaya new-zmodel NAME`: a model to begin with.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace kaya {

/// A file of such a model; @NAME@ stands for the name of the model, in its name and in its text.
struct ModelTemplate {
    const char* file;
    const char* text;
};

/// Where a new model is put, and the names that it must not have.
struct NewModel {
    std::string name;
    std::filesystem::path in;
    std::vector<std::string> taken;
};

/// Makes the folder `in`/NAME with these files. Returns them. Throws Diagnostic: the name cannot be typed in a deck, or is
/// taken; the folder is there.
std::vector<std::filesystem::path> write_templates(std::span<const ModelTemplate> templates, const NewModel& model);

/// A native model that works, a deck that shows it, a deck that tests it, a page and a CMakeLists.txt.
std::vector<std::filesystem::path> write_new_joint_model(const NewModel& model);

/// The same model in Lua, a deck that shows it, a deck that tests it and a page.
std::vector<std::filesystem::path> write_new_lua_model(const NewModel& model);

/// A native model that works, a path for `kaya ztest`, a deck that tests it, a page and a CMakeLists.txt.
std::vector<std::filesystem::path> write_new_zone_model(const NewModel& model);

} // namespace kaya
