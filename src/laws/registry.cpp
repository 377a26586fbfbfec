// Finds joint models on disk and loads them.
#include "laws/joint_model.hpp"

#include "base/diagnostic.hpp"
#include "base/lower_case.hpp"
#include "laws/arithmetic.hpp"
#include "system/crash_report.hpp"
#include "system/door.hpp"
#include "system/library_file.hpp"
#include "system/loaded_library.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <utility>

namespace kaya {

namespace fs = std::filesystem;

namespace {

constexpr const char* library_ending = ".so";
constexpr const char* entry_point = "kaya_joint_model";

/// The model that a name is meant for: a near one, one that the name continues (mohr-coulomb), or one that it is another word for.
std::string_view near_model(const std::string& wanted, const std::vector<std::string>& names) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 4> others{
        {{"coulomb", "mohr"}, {"mc", "mohr"}, {"linear", "elastic"}, {"bb", "barton-bandis"}}};
    const auto known = [&](std::string_view name) { return std::ranges::find(names, name) != names.end(); };
    const std::string low = lower_case(wanted);
    for (const auto& [other, name] : others)
        if (low == other && known(name)) return name;
    if (const auto near = did_you_mean(low, {names.begin(), names.end()}); !near.empty()) return near;
    const auto longer = std::ranges::find_if(names, [&](const auto& name) { return low.starts_with(name); });
    return longer == names.end() ? std::string_view{} : *longer;
}

[[noreturn]] void refuse(const char* code, std::string message, std::string hint) {
    Diagnostic error(std::move(message), std::move(hint));
    error.code = code;
    throw error;
}

/// Words of 3DEC for models that have another name here.
constexpr std::pair<std::string_view, std::string_view> synonyms[] = {{"cyjm", "continuously-yielding"}};

/// The part of a file name between `jmodel` and three digits, as in the names of 3DEC's libraries: libjmodelslip009.so usually holds
/// `slip`; only the model itself knows its keyword.
std::optional<std::string> stem_of_3dec(const fs::path& file) {
    if (file.extension() != library_ending) return std::nullopt;
    std::string name = lower_case(file.stem().string());
    if (name.starts_with("lib")) name.erase(0, 3);
    constexpr std::string_view beginning = "jmodel";
    constexpr std::size_t digits = 3;
    if (!name.starts_with(beginning) || name.size() <= beginning.size() + digits) return std::nullopt;
    if (!std::all_of(name.end() - digits, name.end(), [](unsigned char c) { return std::isdigit(c) != 0; }))
        return std::nullopt;
    return name.substr(beginning.size(), name.size() - beginning.size() - digits);
}

bool same_file(const fs::path& a, const fs::path& b) {
    std::error_code ignored;
    return fs::equivalent(a, b, ignored);
}

void refuse_other_files(const fs::path& file) {
    if (const auto fault = fault_of_library_file(file); !fault.empty())
        refuse("joint-model-not-a-library", fmt::format("{} {}", file.string(), fault),
               "build it with kaya_add_joint_model in CMake, or with c++ -shared -fPIC");
}

/// `name` is that by which the loader opens the file.
void refuse_crashing(const fs::path& file, const fs::path& name, const Called* who) {
    if (const auto fault = fault_of_loading(name, entry_point, who); !fault.empty())
        refuse(
            "joint-model-crashes", fmt::format("joint model {} {}", file.string(), fault),
            "look at what its source does before any of its functions is called: static objects, the functions that describe it");
}

std::shared_ptr<void> open_library(const fs::path& file, const fs::path& name, const Called* who) {
    std::string fault;
    auto library = load_library(name, who, fault);
    if (!library) refuse("joint-model-not-a-library", fmt::format("{} could not be loaded", file.string()), fault);
    return library;
}

const kaya_jmodel* descriptor_of(void* library, const fs::path& file) {
    using Entry = const kaya_jmodel* (*)();
    const auto entry = reinterpret_cast<Entry>(symbol_of(library, entry_point));
    if (!entry)
        refuse("joint-model-no-entry",
               fmt::format("{} is not a joint model: it has no function {}", file.string(), entry_point),
               "include kaya/jmodel.h and define that function with C linkage");
    const auto refuse_thrown = [&](const std::string& what) {
        refuse("joint-model-table", fmt::format("joint model {} cannot say what it is: {}", file.string(), what),
               "correct its source and build it again");
    };
    try {
        return entry();
    } catch (const std::exception& thrown) { refuse_thrown(thrown.what()); } catch (...) {
        refuse_thrown("it threw something other than a std::exception");
    }
    return nullptr;
}

} // namespace

bool JointRegistry::is_file_name(std::string_view name) const {
    if (name.find('/') != name.npos) return true;
    const auto known = endings();
    return std::any_of(known.begin(), known.end(), [&](const auto& e) { return name.ends_with(e); });
}

/// A library takes precedence over a script of the same name.
std::vector<std::string> JointRegistry::endings() const {
    std::vector<std::string> all{library_ending};
    for (const auto& [ending, maker] : makers_) all.push_back(ending);
    return all;
}

/// The file of that path, else the file in one of the folders.
fs::path JointRegistry::file_named(const fs::path& name) const {
    if (is_there(name) || name.is_absolute()) return name;
    for (const auto& folder : path_)
        if (is_there(folder / name)) return folder / name;
    return name;
}

std::unique_ptr<JointModel> JointRegistry::open(const fs::path& file) const {
    const auto maker = makers_.find(file.extension().string());
    // A file that is not a library is harmless, and its user needs that message; unless the file cannot even be read.
    if (maker == makers_.end() && door::peek(file)) refuse_other_files(file);
    // An absolute path keeps the system from looking elsewhere.
    const fs::path name = before_loading ? before_loading(file) : fs::absolute(file);
    if (maker != makers_.end()) return maker->second(file);
    refuse_other_files(file);
    const Called* who = called(file.filename().string(), file.string(), joint_law.noun);
    refuse_crashing(file, name, who);
    const AtWork at_work(who, joint_law.entry_point);
    ArithmeticGuard arithmetic; // a library that was linked with -ffast-math changes it when it is loaded
    const auto library = open_library(file, name, who);
    auto model = std::make_unique<JointModel>(descriptor_of(library.get(), file), file, library);
    // Objects of a model may outlive the registry, and their code must be there when they go.
    if (model->keeps_objects()) keep_loaded(name);
    model->note_arithmetic(arithmetic.put_back());
    return model;
}

std::string JointRegistry::keyword_of(std::string_view word) {
    const std::string keyword = lower_case(word);
    for (const auto& [synonym, meant] : synonyms)
        if (keyword == synonym) return std::string(meant);
    return keyword;
}

const JointModel& JointRegistry::get(std::string_view name) {
    if (is_file_name(name)) return load(file_named(fs::path(name)));

    const std::string keyword = lower_case(name);
    if (const auto* model = find(keyword)) return *model;

    const auto file = file_of(keyword);
    if (!file) {
        if (const auto meant = keyword_of(keyword); meant != keyword) return get(meant);
        if (const auto* model = find_among_3dec(keyword)) return *model;
        const auto names = available();
        const auto near = near_model(keyword, names);
        std::error_code ignored;
        const std::string in_folder = fmt::format("./{}.so", name);
        Diagnostic error(fmt::format("there is no joint model '{}'", name),
                         fs::exists(in_folder, ignored)
                             ? fmt::format("a file of that name is here: write {}", in_folder)
                         : near.empty() ? "give one of the names below, or the file of a joint model"
                                        : fmt::format("did you mean '{}'?", near));
        error.code = "joint-model-unknown";
        if (names.empty()) error.add("no joint models were found in the folders that are searched");
        else error.add(fmt::format("joint models: {}", fmt::join(names, ", ")));
        throw error;
    }
    return load(*file);
}

const JointModel& JointRegistry::load(const fs::path& file) {
    for (const auto& model : models_)
        if (same_file(model->file, file)) return *model;
    if (!is_there(file))
        refuse("joint-model-unknown", fmt::format("there is no joint model file {}", file.string()),
               "a name with a slash or with the ending .so or .lua is a file; give its path from the working folder");

    auto model = open(file);

    // The file in the folders owns its name whether it is loaded or not, so that the meaning of a name
    // does not depend on which of two files a deck mentions first.
    const auto* loaded_one = find(model->name);
    const auto owner = loaded_one ? std::optional(loaded_one->file) : file_of(model->name);
    if (owner && !same_file(*owner, file))
        refuse("joint-model-name-taken",
               fmt::format("the joint model in {} is named '{}', and that name belongs to {}", file.string(),
                           model->name, owner->string()),
               "give the model another name in its descriptor");
    if (!owner && !stem_of_3dec(file) && std::any_of(path_.begin(), path_.end(), [&](const fs::path& folder) {
            return same_file(folder, file.parent_path());
        }))
        refuse("joint-model-name", fmt::format("{} holds a joint model named '{}'", file.string(), model->name),
               fmt::format("a file in a folder that is searched must have the name of its model: {}{}", model->name,
                           file.extension().string()));

    model->tables = tables_->interface();
    models_.push_back(std::move(model));
    return *models_.back();
}

const JointModel* JointRegistry::find(std::string_view name) const {
    const std::string keyword = lower_case(name);
    for (const auto& model : models_)
        if (model->name == keyword) return model.get();
    return nullptr;
}

bool JointRegistry::is_by_path(const JointModel& model) const {
    const auto file = file_of(model.name);
    return (!file || !same_file(*file, model.file)) && !stem_of_3dec(model.file);
}

std::optional<fs::path> JointRegistry::file_of(const std::string& keyword) const {
    for (const auto& folder : path_)
        for (const auto& ending : endings()) {
            const auto file = folder / (keyword + ending);
            if (is_there(file)) return file;
        }
    return std::nullopt;
}

const JointModel* JointRegistry::find_among_3dec(const std::string& keyword) {
    // First the files whose name suggests the keyword. The name may be misleading, so then all others.
    std::vector<fs::path> promising, others;
    for (const auto& folder : path_) {
        std::error_code unreadable;
        for (const auto& entry : fs::directory_iterator(folder, unreadable))
            if (const auto stem = stem_of_3dec(entry.path()))
                (*stem == keyword ? promising : others).push_back(entry.path());
    }
    std::sort(promising.begin(), promising.end());
    std::sort(others.begin(), others.end());
    for (const auto* files : {&promising, &others})
        for (const auto& file : *files) {
            try {
                const auto model = open(file);
                if (model->name != keyword) continue;
            } catch (const Diagnostic&) {
                if (files == &promising) throw; // the requested model is broken
                continue;
            }
            return &load(file);
        }
    return nullptr;
}

std::vector<std::string> JointRegistry::available() const {
    std::set<std::string> names;
    for (const auto& model : models_) names.insert(model->name);
    // Most .lua files next to a deck are not joint models: those are found when they are named.
    for (const auto& folder : path_) {
        std::error_code unreadable; // a folder of the list need not be there
        for (const auto& entry : fs::directory_iterator(folder, unreadable))
            if (entry.path().extension() == library_ending)
                names.insert(stem_of_3dec(entry.path()).value_or(entry.path().stem().string()));
    }
    return {names.begin(), names.end()};
}

} // namespace kaya
