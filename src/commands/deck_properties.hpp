// Words and values of properties in a deck, looked up before any of it runs.
#pragma once

#include "commands/property_meaning.hpp"
#include "lang/interp/bare_names.hpp"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// Fed with the statements of a deck in their order. A word is wrong if none of the models that the deck names anywhere has it, a value if
/// each of those that have the property refuses it.
class DeckProperties {
public:
    /// `inside`: of a function, where the line may not be reached.
    void check(const lang::BoundCommand& command, bool inside);
    /// A text of Lua, which may load models.
    void check_script(std::string_view text);
    void anything_may_be_loaded() { open_ = true; }

    /// Errors; warnings of lines inside functions. Loads the models that the deck names into `models`. Without any of them, for example one that the deck makes itself or whose code has not
    /// been allowed, nothing is known and nothing is found.
    std::vector<Diagnostic> findings(JointRegistry& models) const;

private:
    enum class Of { material, joint_material, joint_model, zone_model };
    struct Given {
        Of of;
        std::string model; ///< of a line that names it
        std::vector<lang::Property::Item> items;
        bool inside = false;
    };
    static void check_item(const Given& given, const lang::Property::Item& item, JointRegistry& models);
    /// The items of a line, with the moduli that its zone model has.
    static std::vector<lang::Property::Item> items_of(const Given& given, JointRegistry& models);

    std::vector<Given> given_;
    std::set<std::string> joint_models_, zone_models_;
    bool restored_ = false; ///< lines after `restore` are not looked up
    bool open_ = false;
};

} // namespace kaya
