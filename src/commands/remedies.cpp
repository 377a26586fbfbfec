#include "commands/remedies.hpp"

#include <string_view>

namespace kaya {

namespace {

/// Each `{}` stands for the next value.
struct Wording {
    std::string_view hint;
    std::string_view message = {}; ///< empty: unchanged
};

Wording wording_of(Advice advice) {
    switch (advice) {
    case Advice::give_density: return {"give it, e.g. `prop mat {} dens 2600`"};
    case Advice::give_moduli: return {"give it, e.g. `prop mat {} bulk 4e9 shear 3e9`"};
    case Advice::give_material_value: return {"give it, e.g. `prop mat {} {} value`"};
    case Advice::change_material_value: return {"give another one with `prop mat {} {} value`"};
    case Advice::give_joint_property: return {"give it with `jmodel {} value` or `prop jmat {}`"};
    case Advice::name_joint_model:
        return {"1 is mohr and 7 is elastic; others are assigned by name: jmodel model NAME",
                "no joint model has the number jcons {}"};
    case Advice::name_zone_model: return {"1 is elastic, 2 is mohr-coulomb; others have names: `zone model NAME`"};
    case Advice::give_gravity: return {"write before it, for example: gravity 0 0 -9.81"};
    case Advice::give_shorter_step:
        return {"give a smaller one with `set dt`, or `set dt 0` for the one that is computed"};
    case Advice::check_time_function: return {"look at the function or table after `hist`"};
    case Advice::rotate_before_joining: return {"give it a rotation before `join`"};
    }
    return {};
}

std::string filled(std::string_view text, const std::vector<std::string>& values) {
    constexpr std::string_view gap = "{}";
    std::string result;
    auto value = values.begin();
    for (std::size_t at = text.find(gap); at != text.npos && value != values.end(); at = text.find(gap)) {
        result.append(text.substr(0, at)).append(*value++);
        text.remove_prefix(at + gap.size());
    }
    return result.append(text);
}

} // namespace

Diagnostic worded(const Advised& mistake) {
    const auto [hint, message] = wording_of(mistake.advice);
    Diagnostic said = mistake;
    said.hint = filled(hint, mistake.values);
    if (!message.empty()) said.message = filled(message, mistake.values);
    return said;
}

} // namespace kaya
