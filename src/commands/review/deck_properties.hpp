// Words and values of properties in a deck, looked up before any of it runs.
#pragma once

#include "commands/review/property_meaning.hpp"
#include "lang/interp/bare_names.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
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

    /// Errors; warnings of lines inside functions. Loads the models that the deck names into `models`. Without any of them, for example one
    /// that the deck makes itself or whose code has not been allowed, nothing is known; a name that nothing in `folders` has is found.
    std::vector<Diagnostic> findings(JointRegistry& models, const std::vector<std::filesystem::path>& folders) const;

private:
    enum class Of { material, joint_material, joint_model, zone_model };
    struct Given {
        Of of;
        std::string model; ///< of a line that names it
        std::vector<lang::Property::Item> items;
        bool inside = false;
        std::size_t models_before = 0; ///< how many of `named_` stand on this line and those before it
    };
    /// A line that names a model.
    struct Named {
        std::string model;
        bool zone = false, inside = false;
        Place place;
    };
    struct Checked {
        std::string word;
        std::optional<Diagnostic> mistake;
    };
    using Mistakes = std::vector<Checked>; ///< of each item of a line

    void add(Given given);
    std::string early_hint(const Given& given, const std::string& word, const JointRegistry& models) const;
    void name_model(std::string model, bool zone, bool inside, const Place& place);
    static bool load(const Named& named, JointRegistry& models, const std::vector<std::filesystem::path>& folders,
                     std::vector<Diagnostic>& found);
    bool needs_joints() const;
    static Mistakes mistakes_of(const Given& given, JointRegistry& models);
    static void check_item(const Given& given, const lang::Property::Item& item, JointRegistry& models);
    /// The items of a line, with the moduli that its zone model has.
    static std::vector<lang::Property::Item> items_of(const Given& given, JointRegistry& models);

    std::vector<Given> given_;
    std::vector<Named> named_;
    bool numbered_ = false; ///< models are chosen by number as well
    bool restored_ = false; ///< lines after `restore` are not looked up
    bool open_ = false;
};

} // namespace kaya
