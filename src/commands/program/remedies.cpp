#include "commands/program/remedies.hpp"

#include <fmt/format.h>
#include <string_view>

namespace kaya {

namespace {

/// `{0}`, `{1}` stand for the values.
struct Wording {
    std::string_view hint;
    std::string_view modern;       ///< the hint in the words of the modern dialect
    std::string_view message = {}; ///< empty: unchanged
};

Wording wording_of(Advice advice) {
    switch (advice) {
    case Advice::give_density:
        return {"give it, e.g. `prop mat {0} dens 2600`", "give it, e.g. `block property density 2600`"};
    case Advice::give_moduli:
        return {"give it, e.g. `prop mat {0} bulk 4e9 shear 3e9`",
                "give it, e.g. `block zone property bulk 4e9 shear 3e9`"};
    case Advice::give_material_value:
        return {"give it, e.g. `prop mat {0} {1} value`", "give it, e.g. `block zone property {1} value`"};
    case Advice::change_material_value:
        return {"give another one with `prop mat {0} {1} value`",
                "give another one with `block zone property {1} value`"};
    case Advice::give_joint_property:
        return {"give it with `jmodel {0} value` or `prop jmat {1}`",
                "give it with `block contact property {0} value`, of contacts to come with `block contact "
                "material-table default property {0} value`"};
    case Advice::name_joint_model:
        return {"1 is mohr and 7 is elastic; others are assigned by name: jmodel model NAME",
                "assign one by its name: block contact jmodel assign NAME", "no joint model has the number jcons {0}"};
    case Advice::name_zone_model:
        return {"1 is elastic, 2 is mohr-coulomb; others have names: `zone model NAME`",
                "assign one by its name: `block zone cmodel assign NAME`"};
    case Advice::give_gravity:
        return {"write before it, for example: gravity 0 0 -9.81",
                "write before it, for example: model gravity 0 0 -9.81"};
    case Advice::give_shorter_step:
        return {
            "give a smaller one with `set dt`, or `set dt 0` for the one that is computed",
            "give a smaller one with `model mechanical timestep fix`, or write `model mechanical timestep automatic`"};
    case Advice::check_time_function:
        return {"look at the function or table after `hist`", "look at the function or table after `fish` or `table`"};
    case Advice::rotate_before_joining:
        return {"give it a rotation before `join`", "give it a rotation before `block join`"};
    }
    return {};
}

std::string filled(std::string_view text, const std::vector<std::string>& values) {
    std::string result(text);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::string gap = fmt::format("{{{}}}", i);
        for (std::size_t at = result.find(gap); at != result.npos; at = result.find(gap, at + values[i].size()))
            result.replace(at, gap.size(), values[i]);
    }
    return result;
}

} // namespace

Diagnostic worded(const Advised& mistake, bool modern) {
    const auto [hint, modern_hint, message] = wording_of(mistake.advice);
    Diagnostic said = mistake;
    said.hint = filled(modern ? modern_hint : hint, mistake.values);
    if (!message.empty()) said.message = filled(message, mistake.values);
    return said;
}

} // namespace kaya
