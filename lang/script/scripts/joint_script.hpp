// A joint model written in Lua: the table of a native one, and functions that take one sub-contact at a time.
#pragma once

#include "kaya/jmodel.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace kaya::script {

/// The file is a chunk that returns a table (docs/joint-models-in-lua.md). Each thread that runs it has a separate Lua state, with
/// mathematics and texts and without files and random numbers: a row's result depends on the row alone.
class JointScript {
public:
    /// Reads the file. Throws Diagnostic with file and line: it does not compile, it returns no table, an entry is
    /// missing or of another type.
    explicit JointScript(const std::filesystem::path& file);
    ~JointScript();
    JointScript(const JointScript&) = delete;
    JointScript& operator=(const JointScript&) = delete;

    /// Name, properties, history and states; its functions are NULL, the members below replace them.
    const kaya_jmodel& descriptor() const { return descriptor_; }

    // Same meaning as the members of kaya_jmodel; may be called from several threads at once.
    ptrdiff_t initialise(kaya_jbatch* batch);
    ptrdiff_t run(kaya_jbatch* batch);
    std::string check(const double* values);
    void max_stiffness(const double* values, double* normal, double* shear); ///< throws std::runtime_error

private:
    struct Lease;

    std::string file_, text_;
    std::vector<std::string> texts_; ///< owns the texts of the descriptor
    std::vector<kaya_jproperty> properties_;
    std::vector<kaya_jhistory> history_;
    kaya_jmodel descriptor_{};
    struct Pool;
    std::unique_ptr<Pool> pool_;
};

} // namespace kaya::script
