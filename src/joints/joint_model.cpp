// The table of a joint model: checked once when it is loaded, then asked by name.
#include "joints/joint_model.hpp"

#include "base/diagnostic.hpp"
#include "joints/stiffness_trial.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <sstream>
#include <stdexcept>

namespace kaya {

namespace {

std::string text_or_empty(const char* text) { return text ? text : ""; }

std::vector<std::string> words_of(const char* text) {
    std::istringstream stream(text_or_empty(text));
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

std::string folded(std::string_view word) {
    std::string lower(word);
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return lower;
}

/// Decks fold case and split at blanks, so any other word could never be typed.
bool is_keyword(std::string_view word) {
    const auto allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_'; };
    return !word.empty() && word.front() >= 'a' && word.front() <= 'z' &&
           std::all_of(word.begin(), word.end(), allowed);
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
    Diagnostic error(fmt::format("the table of joint model {} is wrong: {}", file.string(), what),
                     "correct the descriptor that kaya_joint_model() returns and build the library again");
    error.code = "joint-model-table";
    throw error;
}

void refuse_other_interface(const kaya_jmodel& d, const std::filesystem::path& file) {
    if (d.interface_version == KAYA_JMODEL_INTERFACE) return;
    Diagnostic error(
        fmt::format("joint model {} was built for interface version {}, this program has version {}",
                    file.string(), d.interface_version, KAYA_JMODEL_INTERFACE),
        "build the model again with the kaya/jmodel.h of this program");
    error.code = "joint-model-version";
    throw error;
}

void refuse_wrong_counts(const kaya_jmodel& d, const std::filesystem::path& file) {
    struct Count {
        const char* things;
        std::size_t count, maximum;
        const void* table;
    };
    const Count counts[] = {
        {"properties", d.property_count, KAYA_JMODEL_MAX_PROPERTIES, d.properties},
        {"history variables", d.history_count, KAYA_JMODEL_MAX_HISTORY, d.history},
    };
    for (const auto& c : counts) {
        if (c.count > c.maximum)
            refuse(file, fmt::format("it has {} {}, {} at most are possible", c.count, c.things, c.maximum));
        if (c.count > 0 && !c.table)
            refuse(file, fmt::format("it says {} {} but gives no table", c.count, c.things));
    }
}

void refuse_missing_parts(const kaya_jmodel& d, const std::filesystem::path& file) {
    const std::pair<const char*, bool> parts[] = {
        {"name", d.name != nullptr},
        {"run", d.run != nullptr},
        {"initialise", d.initialise != nullptr},
        {"max_stiffness", d.max_stiffness != nullptr},
    };
    for (const auto& [part, is_there] : parts)
        if (!is_there) refuse(file, fmt::format("'{}' is NULL", part));
}

JointModel::Property property_of(const kaya_jproperty& p, std::size_t index,
                                 const std::filesystem::path& file) {
    if (!p.name) refuse(file, fmt::format("property {} has no name", index + 1));
    JointModel::Property property{
        p.name,    words_of(p.aliases), text_or_empty(p.unit), text_or_empty(p.help), p.initial,
        p.minimum, p.maximum,           p.optional != 0};
    if (std::isnan(p.minimum) || std::isnan(p.maximum) || p.minimum > p.maximum)
        refuse(file, fmt::format("the limits of property '{}' are {} and {}", p.name, p.minimum, p.maximum));
    if (p.initial < p.minimum || p.initial > p.maximum)
        refuse(file, fmt::format("the initial value of property '{}' is {}, outside its limits {} and {}",
                                 p.name, p.initial, p.minimum, p.maximum));
    return property;
}

void refuse_unusable_words(const JointModel& model) {
    std::map<std::string, std::string> owner; // word -> property
    for (const auto& property : model.properties) {
        auto words = property.aliases;
        words.insert(words.begin(), property.name);
        for (const auto& word : words) {
            if (!is_keyword(word))
                refuse(model.file,
                       fmt::format("'{}' cannot be typed as a property: use lower-case letters, digits, "
                                   "hyphens and underscores, a letter first",
                                   word));
            const auto [place, is_new] = owner.emplace(word, property.name);
            if (!is_new)
                refuse(model.file, fmt::format("the word '{}' stands for '{}' and for '{}'", word,
                                               place->second, property.name));
        }
    }
}

void refuse_repeated(const std::vector<std::string>& names, const char* kind,
                     const std::filesystem::path& file) {
    auto sorted = names;
    std::sort(sorted.begin(), sorted.end());
    const auto twin = std::adjacent_find(sorted.begin(), sorted.end());
    if (twin != sorted.end()) refuse(file, fmt::format("it has two {} named '{}'", kind, *twin));
}

/// "reversal-x", "reversal-y", "reversal-z"
bool are_a_vector(std::string_view x, std::string_view y, std::string_view z) {
    const auto stem = x.substr(0, x.size() - std::min<std::size_t>(x.size(), 2));
    return x.ends_with("-x") && y == fmt::format("{}-y", stem) && z == fmt::format("{}-z", stem);
}

/// A model that is stiffer than it says makes the run unstable. Twice is beyond any step of a curved law.
std::string too_soft(const JointModel& model, const std::vector<double>& values) {
    const auto trial = try_stiffness(model, values);
    if (!trial || trial->found <= 2 * trial->reported) return {};
    return fmt::format("it resists {} with a stiffness of {:.4g}, and reports {:.4g}", trial->resists, trial->found,
                       trial->reported);
}

} // namespace

JointModel::JointModel(const kaya_jmodel* d, std::filesystem::path from, std::shared_ptr<void> library)
    : file(std::move(from)), descriptor_(d), library_(std::move(library)) {
    // Version and size come first: with others the rest of the table lies elsewhere.
    if (!d) refuse(file, "kaya_joint_model() returned NULL");
    refuse_other_interface(*d, file);
    if (d->size != sizeof(kaya_jmodel))
        refuse(file, fmt::format("its size is {} bytes, it must be {}", d->size, sizeof(kaya_jmodel)));
    refuse_missing_parts(*d, file);
    functions_ = {d->initialise, d->run, {}, d->max_stiffness};
    if (d->check) functions_.check = [d](const double* values) { return text_or_empty(d->check(values)); };
    read_table();
}

JointModel::JointModel(const kaya_jmodel* d, std::filesystem::path from, std::shared_ptr<void> owner,
                       JointFunctions functions)
    : file(std::move(from)), descriptor_(d), library_(std::move(owner)), functions_(std::move(functions)) {
    read_table();
}

void JointModel::read_table() {
    const kaya_jmodel* d = descriptor_;
    refuse_wrong_counts(*d, file);

    name = d->name;
    title = text_or_empty(d->title);
    version = text_or_empty(d->version);
    if (!is_keyword(name))
        refuse(file, fmt::format(
                         "'{}' cannot be typed as the name of a joint model: use lower-case letters, digits, "
                         "hyphens and underscores, a letter first",
                         name));

    for (std::size_t i = 0; i < d->property_count; ++i)
        properties.push_back(property_of(d->properties[i], i, file));
    refuse_unusable_words(*this);

    std::vector<std::string> history_names;
    for (std::size_t i = 0; i < d->history_count; ++i) {
        const auto& h = d->history[i];
        if (!h.name) refuse(file, fmt::format("history variable {} has no name", i + 1));
        history.push_back({h.name, text_or_empty(h.unit), text_or_empty(h.help)});
        history_names.push_back(h.name);
    }
    refuse_repeated(history_names, "history variables", file);
    for (std::size_t k = 0; k + 2 < history.size(); ++k)
        if (are_a_vector(history_names[k], history_names[k + 1], history_names[k + 2])) vectors.push_back(k);

    states = words_of(d->state_names);
    if (states.size() > KAYA_JMODEL_MAX_STATES)
        refuse(file, fmt::format("it has {} states, {} at most are possible", states.size(),
                                 KAYA_JMODEL_MAX_STATES));
    refuse_repeated(states, "states", file);
}

std::optional<std::size_t> JointModel::find_property(std::string_view typed) const {
    const std::string word = folded(typed);
    if (word.empty()) return std::nullopt;
    std::optional<std::size_t> beginning;
    bool ambiguous = false;
    for (std::size_t i = 0; i < properties.size(); ++i) {
        const auto& p = properties[i];
        const auto is_word = [&](const std::string& name_) { return name_ == word; };
        const auto begins = [&](const std::string& name_) { return name_.starts_with(word); };
        if (is_word(p.name) || std::any_of(p.aliases.begin(), p.aliases.end(), is_word)) return i;
        if (begins(p.name) || std::any_of(p.aliases.begin(), p.aliases.end(), begins)) {
            ambiguous = beginning.has_value();
            beginning = beginning ? beginning : i;
        }
    }
    return ambiguous ? std::nullopt : beginning;
}

std::string JointModel::check(const std::vector<double>& values) const {
    if (!functions_.check) return {};
    try {
        return functions_.check(values.data());
    } catch (const std::exception& thrown) {
        return fmt::format("joint model {} threw an exception from check(): {}", name, thrown.what());
    } catch (...) {
        return fmt::format("joint model {} threw an exception from check()", name);
    }
}

std::vector<std::string> JointModel::missing(const std::vector<double>& values) const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < properties.size(); ++i)
        if (std::isnan(values[i]) && !properties[i].optional) names.push_back(properties[i].name);
    return names;
}

JointStiffness JointModel::initial_stiffness(const std::vector<double>& values) const {
    JointStiffness stiffness{std::nan(""), std::nan("")};
    std::string reason;
    try {
        functions_.max_stiffness(values.data(), &stiffness.normal, &stiffness.shear);
    } catch (const std::exception& thrown) {
        reason = fmt::format("it threw an exception: {}", thrown.what());
    } catch (...) {
        reason = "it threw an exception";
    }
    if (reason.empty() && !(std::isfinite(stiffness.normal) && stiffness.normal > 0))
        reason = fmt::format("the normal stiffness is {}; it must be above 0", stiffness.normal);
    if (reason.empty() && !(std::isfinite(stiffness.shear) && stiffness.shear >= 0))
        reason = fmt::format("the shear stiffness is {}; it must not be below 0", stiffness.shear);
    if (reason.empty()) reason = too_soft(*this, values);
    if (reason.empty()) return stiffness;
    Diagnostic error(fmt::format("joint model {} gives no stiffness to compute a time step from", name),
                     "give the joint its stiffnesses, or correct max_stiffness() of the model", Fault::run);
    error.code = "joint-model-stiffness";
    throw error.add(reason);
}

JointObject JointModel::restore_object(const std::vector<double>& values, std::string_view bytes) const {
    char message[KAYA_JMODEL_MESSAGE] = "";
    std::string reason;
    try {
        if (!keeps_objects()) throw std::runtime_error("it keeps no objects");
        JointObject object(descriptor_->restore(values.data(), bytes.data(), bytes.size(), message));
        if (object) return object;
        message[KAYA_JMODEL_MESSAGE - 1] = '\0';
        reason = message[0] != '\0' ? message : "it gives no reason";
    } catch (const std::exception& thrown) {
        reason = fmt::format("it threw an exception: {}", thrown.what());
    } catch (...) {
        reason = "it threw an exception";
    }
    Diagnostic error(fmt::format("joint model {} cannot take up what was saved of a sub-contact: {}", name, reason),
                     "use the library that was used then", Fault::run);
    error.code = "joint-model-restore";
    throw error;
}

} // namespace kaya
