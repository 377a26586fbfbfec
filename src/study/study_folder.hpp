// Where a study keeps its runs.
#pragma once

#include "base/descriptor.hpp"
#include "study/outcome.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace kaya {

/// A lock on a file, which goes with the process that holds it, on whatever machine that is.
class FileLock {
public:
    enum class Kind { alone, shared };
    /// Makes the file. Not held when somebody else has it. Throws Diagnostic when no file can be made there.
    static FileLock of(const std::filesystem::path& file, Kind kind);
    bool is_held() const { return static_cast<bool>(file_); }
    /// Given up, which it stays in a child that was forked before.
    void release() { file_.close(); }

private:
    Descriptor file_;
};

/// Whether kaya has begun a study in the folder: its runs may be removed then.
bool is_study_folder(const std::filesystem::path& folder);

/// The folder of a study: study.toml and about.toml (what was run, by which version), runs/000001 and so on with the files of
/// each run, results.csv, results.h5 and report.html.
class StudyFolder {
public:
    /// Makes the folder, or goes on in it when it is of the same study and deck. `ranks`: several processes work in it at once. Throws
    /// Diagnostic: another study, a changed deck, another process at work.
    StudyFolder(std::filesystem::path folder, const Study& study, const std::string& version, bool ranks);
    /// One that is there already, for `show` and `rerun`; nobody is kept out.
    explicit StudyFolder(std::filesystem::path folder);

    const std::filesystem::path& path() const { return folder_; }
    std::filesystem::path run(std::size_t number) const;
    std::filesystem::path outcome_file(std::size_t number) const { return run(number) / "outcome.toml"; }
    std::optional<Outcome> outcome(const Case& one) const { return read_outcome(outcome_file(one.number), one); }

    /// What the study was begun with.
    std::string study_file() const; ///< its name then, absolute
    std::string study_text() const;

private:
    std::filesystem::path folder_;
    FileLock lock_;
};

} // namespace kaya
