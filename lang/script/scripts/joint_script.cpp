#include "lang/script/scripts/joint_script.hpp"

#include "base/diagnostic.hpp"
#include "system/whole_file.hpp"
#include "lang/script/scripts/joint_script_state.hpp"

#include <fmt/format.h>
#include <mutex>
#include <stdexcept>

namespace kaya::script {

/// States that no thread uses at the moment.
struct JointScript::Pool {
    std::mutex lock;
    std::vector<std::unique_ptr<JointScriptState>> free;
};

/// A state for the time of one call.
struct JointScript::Lease {
    explicit Lease(JointScript& of) : script(of) {
        {
            const std::lock_guard guard(script.pool_->lock);
            if (!script.pool_->free.empty()) {
                state = std::move(script.pool_->free.back());
                script.pool_->free.pop_back();
            }
        }
        if (!state) state = std::make_unique<JointScriptState>(script.text_, script.file_);
    }
    ~Lease() {
        const std::lock_guard guard(script.pool_->lock);
        script.pool_->free.push_back(std::move(state));
    }
    JointScript& script;
    std::unique_ptr<JointScriptState> state;
};

namespace {

std::string text_of(const std::filesystem::path& file) {
    auto text = file_text(file);
    if (!text)
        throw Diagnostic(fmt::format("the joint model {} cannot be read", file.string()),
                         "look at the name of the file");
    return *std::move(text);
}

} // namespace

JointScript::JointScript(const std::filesystem::path& file)
    : file_(file.filename().string()), text_(text_of(file)), pool_(std::make_unique<Pool>()) {
    JointScriptTable table;
    try {
        Lease lease(*this);
        table = lease.state->table();
    } catch (const std::runtime_error& mistake) {
        throw Diagnostic(fmt::format("the joint model {} is wrong: {}", file.string(), mistake.what()),
                         "it is a Lua file that returns a table with name, properties, run and stiffness");
    }
    // All texts first: the descriptor points into them.
    const auto keep = [this](const std::string& text) {
        texts_.push_back(text);
        return texts_.size() - 1;
    };
    std::vector<std::size_t> numbers;
    for (const auto* text : {&table.name, &table.title, &table.version, &table.states}) numbers.push_back(keep(*text));
    for (const auto& p : table.properties)
        for (const auto* text : {&p.name, &p.aliases, &p.unit, &p.help}) numbers.push_back(keep(*text));
    for (const auto& h : table.history)
        for (const auto* text : {&h.name, &h.unit, &h.help}) numbers.push_back(keep(*text));

    std::size_t next = 0;
    const auto text = [&] { return texts_[numbers[next++]].c_str(); };
    descriptor_.interface_version = KAYA_JMODEL_INTERFACE;
    descriptor_.size = sizeof descriptor_;
    descriptor_.name = text();
    descriptor_.title = text();
    descriptor_.version = text();
    descriptor_.state_names = text();
    for (const auto& p : table.properties) {
        const char *name = text(), *aliases = text(), *unit = text(), *help = text();
        properties_.push_back(
            {name, aliases, unit, help, p.initial, p.minimum, p.maximum, p.optional ? 1u : 0u, p.role});
    }
    for (std::size_t k = 0; k < table.history.size(); ++k) {
        const char *name = text(), *unit = text(), *help = text();
        history_.push_back({name, unit, help});
    }
    descriptor_.properties = properties_.data();
    descriptor_.property_count = properties_.size();
    descriptor_.history = history_.data();
    descriptor_.history_count = history_.size();
}

JointScript::~JointScript() = default;

ptrdiff_t JointScript::initialise(kaya_jbatch* batch) { return Lease(*this).state->rows(*batch, "initialise"); }

ptrdiff_t JointScript::run(kaya_jbatch* batch) { return Lease(*this).state->rows(*batch, "run"); }

std::string JointScript::check(const double* values) { return Lease(*this).state->check(values); }

void JointScript::max_stiffness(const double* values, double* normal, double* shear) {
    Lease(*this).state->stiffness(values, *normal, *shear);
}

} // namespace kaya::script
