#include "study/study_folder.hpp"

#include "base/ask_again.hpp"
#include "base/sha256.hpp"
#include "study/toml_section.hpp"
#include "system/door.hpp"
#include "system/whole_file.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sstream>
#include <system_error>

namespace kaya {

namespace fs = std::filesystem;

FileLock FileLock::of(const fs::path& file, Kind kind) {
    FileLock lock;
    lock.file_ = door::open(file, Use::own, door::Access::keep);
    if (!lock.file_)
        throw Diagnostic(fmt::format("cannot write {}: {}", file.string(), std::strerror(errno)), {}, Fault::run);
    // The lock belongs to the open file and not to the process: a child keeps it, and other machines see it on shared file systems.
    struct flock order {};
    order.l_type = kind == Kind::alone ? F_WRLCK : F_RDLCK;
    order.l_whence = SEEK_SET;
    if (::fcntl(lock.file_.number(), F_OFD_SETLK, &order) != 0) lock.file_.close();
    return lock;
}

namespace {

constexpr const char* another = "continue in another folder: --into FOLDER; --anew removes what is there";

void make_folder(const fs::path& folder) {
    if (const auto failed = door::make_folders(folder, Use::write))
        throw Diagnostic(fmt::format("cannot make the folder {}: {}", folder.string(), failed.message()), {},
                         Fault::run);
}

toml::table about(const Study& study, const std::string& version) {
    return toml::table{{"version", version},
                       {"study", fs::absolute(study.file).string()},
                       {"study_sha256", sha256(study.text)},
                       {"deck", fs::absolute(study.deck).string()},
                       {"deck_sha256", sha256(read_whole_file(study.deck))}};
}

toml::table read_about(const fs::path& folder) {
    const std::string file = (folder / "about.toml").string();
    const std::string text = read_whole_file(file);
    try {
        return parse_toml(source_of(file, text), text);
    } catch (const Diagnostic&) { throw Diagnostic(fmt::format("{} is damaged", file), another, Fault::run); }
}

void require_same(const fs::path& folder, const toml::table& now) {
    const toml::table then = read_about(folder);
    const auto differs = [&](const char* key) {
        return then[key].value_or(std::string()) != now[key].value_or(std::string("?"));
    };
    if (differs("study_sha256"))
        throw Diagnostic(fmt::format("{} holds runs of another study, or the study file has changed", folder.string()),
                         another);
    if (differs("deck_sha256"))
        throw Diagnostic(fmt::format("the deck has changed since the runs in {} began", folder.string()), another);
    if (differs("version"))
        throw Diagnostic(fmt::format("the runs in {} were begun by {}", folder.string(),
                                     then["version"].value_or(std::string("another version"))),
                         another);
}

} // namespace

bool is_study_folder(const fs::path& folder) {
    const std::string text = file_text(folder / "about.toml").value_or("");
    return text.find("study_sha256") != text.npos && text.find("deck_sha256") != text.npos;
}

StudyFolder::StudyFolder(fs::path folder, const Study& study, const std::string& version, bool ranks)
    : folder_(fs::absolute(std::move(folder))) {
    make_folder(folder_ / "runs");
    const bool locked = ask_again([&] {
        lock_ = FileLock::of(folder_ / ".lock", ranks ? FileLock::Kind::shared : FileLock::Kind::alone);
        return lock_.is_held();
    });
    if (!locked)
        throw Diagnostic(fmt::format("another kaya study is at work in {}", folder_.string()),
                         "wait for it, or give another folder: --into FOLDER", Fault::run);
    const toml::table now = about(study, version);
    std::error_code ignored;
    if (fs::exists(folder_ / "about.toml", ignored)) {
        require_same(folder_, now);
        return;
    }
    write_whole_file((folder_ / "study.toml").string(), study.text);
    std::ostringstream text;
    text << now << '\n';
    write_whole_file((folder_ / "about.toml").string(), text.str());
}

StudyFolder::StudyFolder(fs::path folder) : folder_(fs::absolute(std::move(folder))) {
    std::error_code ignored;
    if (!fs::exists(folder_ / "about.toml", ignored))
        throw Diagnostic(fmt::format("{} is not the folder of a study", folder_.string()));
}

fs::path StudyFolder::run(std::size_t number) const { return folder_ / "runs" / fmt::format("{:06}", number); }

std::string StudyFolder::study_file() const { return read_about(folder_)["study"].value_or(std::string()); }

std::string StudyFolder::study_text() const { return read_whole_file((folder_ / "study.toml").string()); }

} // namespace kaya
