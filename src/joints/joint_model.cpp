// The table of a joint model: checked once when it is loaded, then asked by name.
#include "joints/joint_model.hpp"

#include "base/diagnostic.hpp"
#include "joints/stiffness_trial.hpp"

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

/// A model that is stiffer than it says makes the run unstable. Twice is beyond any step of a curved law.
std::string too_soft(const JointModel& model, const std::vector<double>& values) {
    const auto trial = try_stiffness(model, values);
    if (!trial || trial->found <= 2 * trial->reported) return {};
    return fmt::format("it resists {} with a stiffness of {:.4g}, and reports {:.4g}", trial->resists, trial->found,
                       trial->reported);
}

} // namespace

JointModel::JointModel(const kaya_jmodel* d, std::filesystem::path from, std::shared_ptr<void> library)
    : LawTable(std::move(from)), descriptor_(d), library_(std::move(library)) {
    refuse_other_interface(joint_law, d);
    const std::pair<const char*, bool> parts[] = {{"name", d->name != nullptr},
                                                  {"run", d->run != nullptr},
                                                  {"initialise", d->initialise != nullptr},
                                                  {"max_stiffness", d->max_stiffness != nullptr}};
    for (const auto& [part, is_there] : parts)
        if (!is_there) refuse(joint_law, fmt::format("'{}' is NULL", part));
    functions_ = {d->initialise, d->run, {}, d->max_stiffness};
    if (d->check) functions_.check = [d](const double* values) { return text_or_empty(d->check(values)); };
    read_table(joint_law, *d);
    find_vectors();
}

JointModel::JointModel(const kaya_jmodel* d, std::filesystem::path from, std::shared_ptr<void> owner,
                       JointFunctions functions)
    : LawTable(std::move(from)), descriptor_(d), library_(std::move(owner)), functions_(std::move(functions)) {
    read_table(joint_law, *d);
    find_vectors();
}

void JointModel::find_vectors() {
    for (std::size_t k = 0; k + 2 < history.size(); ++k)
        if (are_a_vector(history[k].name, history[k + 1].name, history[k + 2].name)) vectors.push_back(k);
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
