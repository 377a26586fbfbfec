// The table of a joint model: checked once when it is loaded, then queried by name.
#include "laws/joint_model.hpp"

#include "base/diagnostic.hpp"
#include "laws/arithmetic.hpp"
#include "system/crash_report.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace kaya {

namespace {

std::string text_or_empty(const char* text) { return text ? text : ""; }

/// "reversal-x", "reversal-y", "reversal-z"
bool are_a_vector(std::string_view x, std::string_view y, std::string_view z) {
    const auto stem = x.substr(0, x.size() - std::min<std::size_t>(x.size(), 2));
    return x.ends_with("-x") && y == fmt::format("{}-y", stem) && z == fmt::format("{}-z", stem);
}

} // namespace

JointModel::JointModel(const kaya_jmodel* descriptor, std::filesystem::path from, std::shared_ptr<void> library)
    : LawTable(std::move(from)), descriptor_(understood(joint_law, descriptor)), library_(std::move(library)) {
    const kaya_jmodel* d = &descriptor_;
    const std::pair<const char*, bool> parts[] = {{"name", d->name != nullptr},
                                                  {"run", d->run != nullptr},
                                                  {"initialise", d->initialise != nullptr},
                                                  {"max_stiffness", d->max_stiffness != nullptr}};
    for (const auto& [part, is_there] : parts)
        if (!is_there) refuse(joint_law, fmt::format("'{}' is NULL", part));
    functions_ = {d->initialise, d->run, {}, d->max_stiffness};
    if (d->check) functions_.check = [check = d->check](const double* values) { return text_or_empty(check(values)); };
    read_table(joint_law, *d);
    read_fields();
    find_vectors();
}

JointModel::JointModel(const kaya_jmodel* d, std::filesystem::path from, std::shared_ptr<void> owner,
                       JointFunctions functions)
    : LawTable(std::move(from)), descriptor_(*d), library_(std::move(owner)), functions_(std::move(functions)) {
    read_table(joint_law, *d);
    read_fields();
    find_vectors();
}

void JointModel::read_fields() {
    const kaya_jmodel& d = descriptor_;
    if (d.field_count > KAYA_JMODEL_MAX_FIELDS)
        refuse(joint_law,
               fmt::format("it has {} fields, {} at most are possible", d.field_count, KAYA_JMODEL_MAX_FIELDS));
    if (d.field_count > 0 && !d.fields)
        refuse(joint_law, fmt::format("it says {} fields but gives no table", d.field_count));
    for (std::size_t i = 0; i < d.field_count; ++i) {
        const kaya_jfield& f = d.fields[i];
        if (!f.name) refuse(joint_law, fmt::format("field {} has no name", i + 1));
        const auto is_name = [&](const auto& other) { return other.name == f.name; };
        if (std::ranges::any_of(fields, is_name))
            refuse(joint_law, fmt::format("it has two fields named '{}'", f.name));
        if (std::ranges::any_of(history, is_name))
            refuse(joint_law, fmt::format("'{}' is a field and a history variable", f.name));
        const auto property = std::ranges::find_if(properties, is_name);
        const bool is_property = property != properties.end();
        if (!is_property && find_property(f.name))
            refuse(
                joint_law,
                fmt::format(
                    "the field '{}' has another word of property '{}': give it the property's own name, or one apart",
                    f.name, properties[*find_property(f.name)].name));
        if (!is_property && !std::isfinite(f.initial))
            refuse(joint_law, fmt::format("the initial value of field '{}' is {}", f.name, f.initial));
        fields.push_back({f.name, text_or_empty(f.unit), text_or_empty(f.help), f.initial,
                          is_property ? std::optional<std::size_t>(property - properties.begin()) : std::nullopt});
    }
}

/// The field of that name, or of the property with that name.
std::optional<std::size_t> JointModel::find_field(std::string_view word) const {
    const auto property = find_property(word);
    for (std::size_t k = 0; k < fields.size(); ++k)
        if (fields[k].name == word || (property && fields[k].property == property)) return k;
    return std::nullopt;
}

void JointModel::find_vectors() {
    for (std::size_t k = 0; k + 2 < history.size(); ++k)
        if (are_a_vector(history[k].name, history[k + 1].name, history[k + 2].name)) vectors.push_back(k);
}

std::string JointModel::check(const std::vector<double>& values) const {
    if (!functions_.check) return {};
    try {
        const AtWork at_work(who(), "check");
        ArithmeticGuard arithmetic;
        auto complaint = functions_.check(values.data());
        note_arithmetic(arithmetic.put_back());
        return complaint;
    } catch (const std::exception& thrown) {
        return fmt::format("joint model {} threw an exception from check(): {}", name, thrown.what());
    } catch (...) { return fmt::format("joint model {} threw an exception from check()", name); }
}

namespace {

/// Calls a function of the model and turns exceptions into a Diagnostic.
template <class Call> auto asked(const JointModel& model, const char* what, Call call) {
    std::string reason = "not a std::exception";
    try {
        const AtWork at_work(model.who(), what);
        ArithmeticGuard arithmetic;
        const auto answer = call();
        model.note_arithmetic(arithmetic.put_back());
        return answer;
    } catch (const std::exception& thrown) { reason = thrown.what(); } catch (...) {
    }
    Diagnostic error(fmt::format("joint model {} threw an exception from {}(): {}", model.name, what, reason),
                     "correct its source", Fault::run);
    error.code = "joint-model-failed";
    throw error;
}

} // namespace

std::optional<double> JointModel::object_value(const JointObject& object, std::size_t property) const {
    if (!object || object.is_asleep() || descriptor_.object_value == nullptr) return std::nullopt;
    return asked(*this, "object_value", [&] { return descriptor_.object_value(object.get(), property); });
}

bool JointModel::set_object_value(JointObject& object, std::size_t property, double value) const {
    if (!object || object.is_asleep() || descriptor_.set_object_value == nullptr) return false;
    return asked(*this, "set_object_value",
                 [&] { return descriptor_.set_object_value(*object.address(), property, value) == 0; });
}

JointObject JointModel::restore_object(const std::vector<double>& values, std::string_view bytes) const {
    char message[KAYA_JMODEL_MESSAGE] = "";
    std::string reason;
    try {
        if (!keeps_objects()) throw std::runtime_error("it keeps no objects");
        const AtWork at_work(who(), "restore");
        ArithmeticGuard arithmetic;
        JointObject object(descriptor_.restore(values.data(), bytes.data(), bytes.size(), message));
        note_arithmetic(arithmetic.put_back());
        if (object) return object;
        message[KAYA_JMODEL_MESSAGE - 1] = '\0';
        reason = message[0] != '\0' ? message : "it gives no reason";
    } catch (const std::exception& thrown) {
        reason = fmt::format("it threw an exception: {}", thrown.what());
    } catch (...) { reason = "it threw an exception"; }
    Diagnostic error(fmt::format("joint model {} cannot take up what was saved of a sub-contact: {}", name, reason),
                     "use the library that was used then", Fault::run);
    error.code = "joint-model-restore";
    throw error;
}

} // namespace kaya
