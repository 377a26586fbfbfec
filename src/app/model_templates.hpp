// The files of stdlib/templates, compiled in.
#pragma once

#include <span>
#include <string_view>

namespace kaya {

/// A file of a new model. @NAME@ stands for the name of the model, in the file's name and in its text.
struct ModelTemplate {
    std::string_view kind; ///< its folder: joint, joint-lua, joint-shared (of both), zone
    std::string_view file;
    std::string_view text;
};

std::span<const ModelTemplate> model_templates();

} // namespace kaya
