// Joint models that were loaded by the path of a file: a save file says which file, so that a restored run finds it again.
#pragma once

#include "commands/session.hpp"

#include <string>
#include <vector>

namespace kaya {

struct JointFile {
    std::string model, digest, path; ///< name of the joint model, sha256 of its file, absolute path
};

/// Of the joint models that joints of the model have now or had.
std::vector<JointFile> joint_files(Session& session);

/// As a part of a save file: a line for each, and back. Throws Diagnostic for what is no such part.
std::string joint_files_text(const std::vector<JointFile>& files);
std::vector<JointFile> joint_files_from_text(const std::string& text);

/// The joint model of that name: as it is loaded, else from the place that the save file says or next to the save file, where
/// the file is the same bit by bit, else as its name finds it. Warns when it is another file than it was. Throws Diagnostic that
/// says where it was looked for.
const JointModel& find_saved_model(Session& session, const std::string& name, const std::vector<JointFile>& files,
                                   const std::string& save_file);

} // namespace kaya
