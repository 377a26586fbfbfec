// A joint model written in Lua: the table of a native one, and functions that take one sub-contact at a time.
#pragma once

#include "kaya/jmodel.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace kaya::script {

/// The file is a chunk that returns a table (docs/joint-models-in-lua.md). Each thread that runs it has a Lua state of
/// its own, with mathematics and texts but no files and no random numbers: a row's result depends on the row alone.
class JointScript {
public:
    /// Reads the file. Throws Diagnostic with file and line: it does not compile, it returns no table, an entry is
    /// missing or of another type.
    explicit JointScript(const std::filesystem::path& file);
    ~JointScript();
    JointScript(const JointScript&) = delete;
    JointScript& operator=(const JointScript&) = delete;

    /// Name, properties, history and states; the functions in it are NULL, those below stand for them.
    const kaya_jmodel& descriptor() const { return descriptor_; }

    // They mean what the members of kaya_jmodel mean, and may be called from several threads at once.
    ptrdiff_t initialise(kaya_jbatch* batch);
    ptrdiff_t run(kaya_jbatch* batch);
    std::string check(const double* values);
    void max_stiffness(const double* values, double* normal, double* shear); ///< throws std::runtime_error

private:
    struct Lease;

    std::string file_, text_;
    std::vector<std::string> texts_; ///< what the descriptor points at
    std::vector<kaya_jproperty> properties_;
    std::vector<kaya_jhistory> history_;
    kaya_jmodel descriptor_{};
    struct Pool;
    std::unique_ptr<Pool> pool_;
};

} // namespace kaya::script
