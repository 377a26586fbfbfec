// Joint models loaded from a path: a save file records the path, so that a restored run finds the file.
#pragma once

#include "commands/session/session.hpp"

#include <string>
#include <vector>

namespace kaya {

struct JointFile {
    std::string model, digest, path; ///< name of the joint model, sha256 of its file, absolute path
};

/// The files of joint models that joints of the model use or have used.
std::vector<JointFile> joint_files(Session& session);

/// Written as a part of a save file, one line each, and read back. Throws Diagnostic for other text.
std::string joint_files_text(const std::vector<JointFile>& files);
std::vector<JointFile> joint_files_from_text(const std::string& text);

/// The joint model of that name: the loaded one, else the recorded file, or one next to the save, if it is identical, else found by name.
/// Warns when the file differs. Throws Diagnostic that lists the places searched.
const JointModel& find_saved_model(Session& session, const std::string& name, const std::vector<JointFile>& files,
                                   const std::string& save_file);

} // namespace kaya
