// The folder in which a study stores its runs.
#pragma once

#include "study/outcome.hpp"
#include "system/descriptor.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace kaya {

/// A lock on a file, released when its process ends, on any machine.
class FileLock {
public:
    enum class Kind { alone, shared };
    /// Creates the file. Not held when another process has the lock. Throws Diagnostic when the file cannot be created.
    static FileLock of(const std::filesystem::path& file, Kind kind);
    bool is_held() const { return static_cast<bool>(file_); }
    /// Released here; a child that was forked before keeps it.
    void release() { file_.close(); }

private:
    Descriptor file_;
};

/// Whether kaya has begun a study in the folder: its runs may be removed then.
bool is_study_folder(const std::filesystem::path& folder);

/// The folder of a study: study.toml and about.toml (the deck and the version of the program), runs/000001 and so on with the files of each
/// run, results.csv, results.h5 and report.html.
class StudyFolder {
public:
    /// Creates the folder, or continues in it when it belongs to the same study and deck. `ranks`: several processes work in it at once.
    /// Throws Diagnostic: another study, a changed deck, another process at work.
    StudyFolder(std::filesystem::path folder, const Study& study, const std::string& version, bool ranks);
    /// An existing folder, for `show` and `rerun`; takes no lock.
    explicit StudyFolder(std::filesystem::path folder);

    const std::filesystem::path& path() const { return folder_; }
    std::filesystem::path run(std::size_t number) const;
    std::filesystem::path outcome_file(std::size_t number) const { return run(number) / "outcome.toml"; }
    std::optional<Outcome> outcome(const Case& one) const { return read_outcome(outcome_file(one.number), one); }

    /// The study as it began.
    std::string study_file() const; ///< its name then, absolute
    std::string study_text() const;

private:
    std::filesystem::path folder_;
    FileLock lock_;
};

} // namespace kaya
