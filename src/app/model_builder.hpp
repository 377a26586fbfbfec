// `kaya jmodel build` and `kaya zmodel build`: sources of a joint model or a zone model made into a library.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace kaya {

struct BuildOrder {
    bool zone_model = false; ///< and not a joint model
    std::vector<std::filesystem::path> sources;
    std::filesystem::path folder = "."; ///< where the library is put
    std::string compiler;               ///< "": CXX, else the first of c++, g++, clang++ that is there
    std::string standard = "gnu++17";   ///< of sources written for 3DEC; native ones take gnu++20
    bool displacement_at_end = false;   ///< State::normal_disp_ includes the increment of the step
    bool as_it_is = false;              ///< without the macro for std::exception("text")
    bool show = false;                  ///< the compiler's line is printed
    std::vector<std::string> flags;     ///< more words for the compiler
};

/// Compiles the sources, loads the library, and names it after its model. Compiler output goes to the standard error. Returns the file.
/// Throws Diagnostic: missing source, no compiler, compile error, not a model. `include` is the folder that holds kaya/jmodel.h.
std::filesystem::path build_model(const BuildOrder& order, const std::filesystem::path& include);

/// The folder of headers of the program in `program_folder`, installed or not. Throws Diagnostic.
std::filesystem::path include_folder(const std::filesystem::path& program_folder);

/// Names that conditions of a source use and that project files of other systems define: words that end in _EXPORTS or _LIB on lines that
/// begin with #if.
std::vector<std::string> export_macros(const std::string& source);

/// Whether a source is written against kaya/jmodel.h or kaya/zmodel.h, rather than against jointmodel.h.
bool is_native(const std::string& source);

} // namespace kaya
