#include "app/model_builder.hpp"

#include "app/adapter_cache.hpp"
#include "base/diagnostic.hpp"
#include "base/pattern.hpp"
#include "base/terminal_text.hpp"
#include "laws/joint_model.hpp"
#include "study/command_output.hpp"
#include "system/door.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <future>
#include <memory>
#include <set>
#include <sstream>
#include <unistd.h>

namespace kaya {

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

std::string source_text(const fs::path& source) {
    const auto text = file_text(source);
    if (!text)
        throw Diagnostic(fmt::format("the source {} cannot be read", source.string()),
                         "give the .cpp files of the model");
    return *text;
}

bool is_in_path(const std::string& program) {
    if (program.find('/') != program.npos) return access(program.c_str(), X_OK) == 0;
    const char* listed = std::getenv("PATH");
    std::istringstream folders(listed ? listed : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
    return false;
}

/// The compiler with words that follow it, as in CXX="ccache g++".
Words compiler_words(const std::string& asked) {
    const char* of_environment = std::getenv("CXX");
    const std::string given = !asked.empty() ? asked : of_environment ? of_environment : "";
    if (!given.empty()) {
        std::istringstream stream(given);
        Words words;
        for (std::string word; stream >> word;) words.push_back(word);
        if (!words.empty() && is_in_path(words.front())) return words;
        throw Diagnostic(fmt::format("the compiler '{}' is not there", given),
                         "give another one: --compiler g++, or the environment variable CXX");
    }
    for (const char* name : {"c++", "g++", "clang++"})
        if (is_in_path(name)) return {name};
    throw Diagnostic("there is no C++ compiler", "install g++ or clang++, or name one: --compiler NAME");
}

/// Runs a program, shows its output, which contains lines of the sources, and returns its status.
int run_program(const Words& words) {
    const CommandOutput said = output_of(words);
    print_text(stderr, said.output);
    return said.status;
}

/// A source that returns std::string where the base class has its own text needs the two to be one.
bool returns_std_string(const std::string& source) {
    static const Pattern pattern(R"(std::string\s+get(Name|FullName|PluginName|Properties|States|Energies)\s*\()");
    return pattern.is_in(source);
}

/// The texts of the sources and of the headers next to them that they include.
std::string all_text(const std::vector<fs::path>& sources) {
    static const Pattern include(R"re(^[ \t]*#[ \t]*include[ \t]*"([^"]+)")re");
    std::string all;
    std::set<fs::path> read;
    std::vector<fs::path> waiting = sources;
    while (!waiting.empty()) {
        const fs::path file = waiting.back();
        waiting.pop_back();
        if (!read.insert(file.lexically_normal()).second) continue;
        const std::string text = source_text(file);
        for (const auto& name : include.all(text, 1)) {
            const fs::path adjacent = file.parent_path() / name;
            if (fs::is_regular_file(adjacent) && door::peek(adjacent)) waiting.push_back(adjacent);
        }
        all += text + "\n";
    }
    return all;
}

/// Common beginning of all compiler lines of one library, and its link line.
struct Lines {
    Words compiler, flags;
    Words of_sources; ///< folders and macros that the adapter does without
    Words of_user;    ///< words that the user has given

    Words compile(const fs::path& source, const fs::path& object, bool own = true) const {
        Words line = compiler;
        if (own) line.insert(line.end(), of_sources.begin(), of_sources.end());
        line.insert(line.end(), flags.begin(), flags.end());
        line.insert(line.end(), of_user.begin(), of_user.end());
        line.insert(line.end(), {"-c", source.string(), "-o", object.string()});
        return line;
    }
    Words link(const std::vector<fs::path>& objects, const fs::path& library) const {
        Words line = compiler;
        line.insert(line.end(), {"-shared"});
        for (const auto& object : objects) line.push_back(object.string());
        line.insert(line.end(), of_user.begin(), of_user.end());
        line.insert(line.end(), {"-o", library.string()});
        return line;
    }
};

Lines lines_of(const BuildOrder& order, const std::string& text, const fs::path& include) {
    const bool native = is_native(text);
    Lines lines;
    lines.compiler = compiler_words(order.compiler);
    lines.of_user = order.flags;
    const auto add = [&](std::initializer_list<std::string> more) { lines.flags.insert(lines.flags.end(), more); };
    add({fmt::format("-std={}", native ? "gnu++20" : order.standard), "-O3", "-march=native", "-ffp-contract=off",
         "-fno-tree-slp-vectorize", "-fno-math-errno", "-fno-trapping-math", "-fPIC", "-fvisibility=hidden"});
    std::set<fs::path> folders;
    for (const auto& source : order.sources) folders.insert(source.has_parent_path() ? source.parent_path() : ".");
    for (const auto& folder : folders) lines.of_sources.insert(lines.of_sources.end(), {"-I", folder.string()});
    if (!native) {
        add({"-I", (include / "kaya/compat").string()});
        for (const auto& macro : export_macros(text)) lines.of_sources.push_back("-D" + macro);
        if (returns_std_string(text)) add({"-DKAYA_COMPAT_STD_STRING"});
        if (order.displacement_at_end) add({"-DKAYA_COMPAT_DISPLACEMENT_AT_END"});
        if (!order.as_it_is) add({"-include", "kaya/compat/msvc.h"});
    }
    add({"-I", include.string()});
    return lines;
}

/// A new folder for files in the making; it is removed with its content. In a folder of the user the compiler would write through links of
/// the expected names.
class DraftFolder {
public:
    explicit DraftFolder(const fs::path& parent) : path(parent / fmt::format(".kaya-jmodel-{}", getpid())) {
        std::error_code ignored;
        if (fs::symlink_status(path, ignored).type() != fs::file_type::not_found)
            throw Diagnostic(fmt::format("{} is there already", path.string()), "remove it: it is left from a build",
                             Fault::run);
        if (const auto failed = door::make_folders(path, Use::own))
            throw Diagnostic(fmt::format("the folder {} cannot be made: {}", path.string(), failed.message()),
                             "give another: --into FOLDER", Fault::run);
    }
    ~DraftFolder() { door::remove_all(path); }
    DraftFolder(const DraftFolder&) = delete;
    DraftFolder& operator=(const DraftFolder&) = delete;
    const fs::path path;
};

/// Compiles and links. The adapter, which prints nothing, is compiled in parallel, or taken from an earlier build.
void compile(const BuildOrder& order, const fs::path& include, const fs::path& library) {
    const fs::path drafts = library.parent_path();
    const std::string text = all_text(order.sources);
    const Lines lines = lines_of(order, text, include);
    const auto run = [&](const Words& line) {
        if (order.show) print_text(stderr, fmt::format("{}\n", fmt::join(line, " ")));
        return run_program(line);
    };
    const auto refuse = [&](const fs::path& what, int status) {
        throw Diagnostic(
            fmt::format("{} does not compile (status {} of {})", what.string(), status, lines.compiler.front()),
            "the messages of the compiler are above");
    };
    const fs::path adapter_draft = drafts / "adapter.o";
    const fs::path adapter_source = include / "kaya/compat/adapter.cpp";
    int adapter_status = 0;
    std::future<fs::path> adapter;
    if (!is_native(text)) {
        const AdapterCache cache(lines.compile(adapter_source, "", false), include);
        adapter = std::async(std::launch::async, [&, cache] {
            return cache.object(adapter_draft, [&] {
                adapter_status = run(lines.compile(adapter_source, adapter_draft, false));
                return adapter_status == 0;
            });
        });
    }
    std::vector<fs::path> objects;
    for (const auto& source : order.sources) {
        objects.push_back(drafts / fmt::format("{}.o", objects.size()));
        if (const int status = run(lines.compile(source, objects.back())); status != 0) {
            if (adapter.valid()) adapter.wait();
            refuse(source, status);
        }
    }
    if (adapter.valid()) {
        objects.push_back(adapter.get());
        if (objects.back().empty()) refuse(adapter_source, adapter_status);
    }
    if (const int status = run(lines.link(objects, library)); status != 0) refuse(order.sources.front(), status);
}

} // namespace

std::vector<std::string> export_macros(const std::string& source) {
    static const Pattern word(R"([A-Za-z_][A-Za-z0-9_]*_(EXPORTS|LIB)\b)");
    static const Pattern condition(R"(^[ \t]*#[ \t]*(if|elif))");
    std::set<std::string> macros;
    std::istringstream lines(source);
    for (std::string line; std::getline(lines, line);) {
        if (!condition.is_in(line)) continue;
        for (auto& macro : word.all(line)) macros.insert(std::move(macro));
    }
    return {macros.begin(), macros.end()};
}

bool is_native(const std::string& source) {
    static const Pattern pattern(R"(^[ \t]*#[ \t]*include[ \t]*["<]kaya/[jz]model\.h[">])");
    return pattern.is_in(source);
}

fs::path include_folder(const fs::path& program_folder) {
    const char* given = std::getenv("KAYA_INCLUDE");
    std::vector<fs::path> candidates;
    if (given) candidates.emplace_back(given);
    candidates.push_back(program_folder / "include");
    candidates.push_back(program_folder.parent_path() / "include");
    for (const auto& candidate : candidates)
        if (fs::exists(candidate / "kaya/jmodel.h")) return candidate;
    throw Diagnostic(
        "the headers of joint and zone models are not there",
        "install the package kaya-dev, or give the folder that holds kaya/jmodel.h in the environment variable "
        "KAYA_INCLUDE");
}

fs::path build_model(const BuildOrder& order, const fs::path& include) {
    if (!fs::is_directory(order.folder))
        throw Diagnostic(fmt::format("there is no folder {}", order.folder.string()), "make it, or give another one");
    const DraftFolder drafts(order.folder);
    const fs::path draft = drafts.path / "model.so";
    compile(order, include, draft);
    std::string name;
    {
        JointRegistry registry;
        const std::string file = fs::absolute(draft).string();
        name = order.zone_model ? registry.zones.get(file).name : registry.get(file).name;
    }
    const fs::path library = order.folder / (name + ".so");
    write_whole_file(library.string(), read_whole_file(draft.string()), Use::own);
    return library;
}

} // namespace kaya
