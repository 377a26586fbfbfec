#include "commands/world/lua_joint_models.hpp"

#include "lang/script/scripts/joint_script.hpp"

namespace kaya {

void add_lua_loader(JointRegistry& joints) {
    joints.add_loader(".lua", [](const std::filesystem::path& file) {
        const auto script = std::make_shared<script::JointScript>(file);
        JointFunctions functions;
        functions.initialise = [s = script.get()](kaya_jbatch* batch) { return s->initialise(batch); };
        functions.run = [s = script.get()](kaya_jbatch* batch) { return s->run(batch); };
        functions.check = [s = script.get()](const double* values) { return s->check(values); };
        functions.max_stiffness = [s = script.get()](const double* values, double* normal, double* shear) {
            s->max_stiffness(values, normal, shear);
        };
        return std::make_unique<JointModel>(&script->descriptor(), file, script, std::move(functions));
    });
}

} // namespace kaya
