// One Lua state that holds a joint model. Internal to this folder.
#pragma once

#include "kaya/jmodel.h"

#include <string>
#include <vector>

struct lua_State;

namespace kaya::script {

/// The description in the file.
struct JointScriptTable {
    struct Property {
        std::string name, aliases, unit, help;
        double initial, minimum, maximum;
        bool optional;
        kaya_jrole role;
    };
    struct Kept {
        std::string name, unit, help;
    };
    std::string name, title, version, states;
    std::vector<Property> properties;
    std::vector<Kept> history;
};

/// Every member throws std::runtime_error with the sentence of Lua, but for `rows`.
class JointScriptState {
public:
    JointScriptState(const std::string& text, const std::string& file);
    ~JointScriptState();
    JointScriptState(const JointScriptState&) = delete;
    JointScriptState& operator=(const JointScriptState&) = delete;

    const JointScriptTable& table() const { return table_; }

    /// Calls `function` for each row; -1, or the row that failed with its sentence in the batch's message.
    ptrdiff_t rows(kaya_jbatch& batch, const char* function);

    std::string check(const double* values);
    void stiffness(const double* values, double& normal, double& shear);

private:
    void read_table();
    void freeze();
    void refuse_change();
    void set_property_names();
    void set_values(const double* values);
    void push_row(const kaya_jbatch& batch, std::size_t i);
    void take_row(kaya_jbatch& batch, std::size_t i);
    void call(int arguments, int results);

    lua_State* lua_ = nullptr;
    JointScriptTable table_;
    std::vector<std::vector<std::string>> names_of_properties_; ///< words under which run() finds each value
    std::vector<std::string> spellings_;                        ///< of the history, with _ for -
    const kaya_jbatch* batch_ = nullptr;                        ///< of the running call, for tables
    int chunk_ = 0, model_ = 0, row_ = 0, values_ = 0, view_ = 0, kept_ = 0; ///< numbers in Lua's registry
    int changed_ = 0; ///< of a function that gives the name of a variable that was changed since the file was read

    friend struct JointScriptTables;
};

} // namespace kaya::script
