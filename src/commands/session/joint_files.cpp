#include "commands/session/joint_files.hpp"

#include "base/diagnostic.hpp"
#include "base/sha256.hpp"
#include "system/door.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <set>
#include <sstream>

namespace kaya {

namespace fs = std::filesystem;

namespace {

/// Empty when the file cannot be read.
std::string digest_of(const fs::path& file) {
    const Descriptor opened = door::peek(file);
    std::string bytes;
    return opened && read_all(opened.number(), bytes) ? sha256(bytes) : std::string();
}

bool is_digest(const std::string& word) {
    return word.size() == 64 && word.find_first_not_of("0123456789abcdef") == word.npos;
}

constexpr std::size_t shown = 12; ///< hash digits that distinguish two files

void compare(Session& session, const JointModel& model, const JointFile& saved) {
    const std::string now = digest_of(model.file);
    if (now == saved.digest) return;
    Diagnostic warning(
        fmt::format("joint model '{}' in {} is not the one that the model was saved with", model.name,
                    model.file.string()),
        fmt::format("the saved one had {}; check whether the file was built again, or is a different one", saved.path));
    warning.add(fmt::format("sha256 {} then, {} now", saved.digest.substr(0, shown),
                            now.empty() ? "none" : now.substr(0, shown)));
    warning.code = "joint-model-other-file";
    session.warn(std::move(warning));
}

} // namespace

std::vector<JointFile> joint_files(Session& session) {
    std::vector<JointFile> files;
    std::set<std::string> names;
    for (const auto& set : session.engine.model.joint_properties) {
        const JointModel* joint = session.engine.joints.find(set.model);
        if (joint == nullptr || !names.insert(joint->name).second || !session.engine.joints.is_by_path(*joint))
            continue;
        const std::string path = fs::absolute(joint->file).lexically_normal().string();
        if (path.find('\n') == path.npos) files.push_back({joint->name, digest_of(joint->file), path});
    }
    return files;
}

std::string joint_files_text(const std::vector<JointFile>& files) {
    std::string text;
    for (const auto& file : files) text += fmt::format("{} {} {}\n", file.model, file.digest, file.path);
    return text;
}

std::vector<JointFile> joint_files_from_text(const std::string& text) {
    std::vector<JointFile> files;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        JointFile file;
        words >> file.model >> file.digest;
        words.get();
        std::getline(words, file.path);
        if (!is_digest(file.digest) || file.path.empty() || file.path.front() != '/')
            throw Diagnostic("the save file has invalid paths of joint models", "the file was changed", Fault::run);
        files.push_back(std::move(file));
    }
    return files;
}

const JointModel& find_saved_model(Session& session, const std::string& name, const std::vector<JointFile>& files,
                                   const std::string& save_file) {
    const auto saved = std::ranges::find(files, name, &JointFile::model);
    if (saved == files.end()) return session.engine.joints.get(name);
    if (const JointModel* loaded = session.engine.joints.find(name)) {
        compare(session, *loaded, *saved);
        return *loaded;
    }
    std::vector<std::string> tried; // and not fit
    const fs::path adjacent = fs::absolute(save_file).parent_path() / fs::path(saved->path).filename();
    for (const fs::path& file : {fs::path(saved->path), adjacent}) {
        std::error_code unreadable;
        std::string found = "looked for " + file.string();
        if (fs::exists(file, unreadable)) {
            const std::string digest = digest_of(file);
            if (digest == saved->digest) found.clear();
            else
                found +=
                    fmt::format(": its sha256 begins with {}", digest.empty() ? "nothing" : digest.substr(0, shown));
        }
        if (!found.empty()) { // a file named by the save is loaded if it is identical, else refused
            if (tried.empty() || tried.back() != found) tried.push_back(found);
            continue;
        }
        const JointModel& model = session.engine.joints.get(file.string());
        if (model.name != name)
            throw Diagnostic(
                fmt::format("{} holds joint model '{}' now, and held '{}' when the model was saved", file.string(),
                            model.name, name),
                fmt::format("restore the file whose sha256 begins with {}", saved->digest.substr(0, shown)),
                Fault::run);
        return model;
    }
    try {
        const JointModel& model = session.engine.joints.get(name); // it may have moved to a folder that is searched
        compare(session, model, *saved);
        return model;
    } catch (const Diagnostic& unknown) {
        if (unknown.code != "joint-model-unknown") throw;
    }
    Diagnostic error(fmt::format("joint model '{}' of the save file is not there", name),
                     "restore the file; a rebuilt one is used if it is loaded before: jmodel load FILE", Fault::run);
    for (const auto& line : tried) error.add(line);
    error.add(fmt::format("searched {}.so and {}.lua in the folders of joint models", name, name));
    error.add(fmt::format("the sha256 of its file began with {}", saved->digest.substr(0, shown)));
    error.code = "joint-model-unknown";
    throw error;
}

} // namespace kaya
