// The functions of include/kaya/kaya.h.
#include "base/text_stream.hpp"
#include "kaya/kaya.h"

#include "commands/program/program.hpp"
#include "commands/session/autosave.hpp"
#include "commands/session/session.hpp"
#include "lang/interp/deck.hpp"
#include "library/field_span.hpp"
#include "model/whole/state_hash.hpp"
#include "system/loaded_library.hpp"
#include "system/run_record.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using namespace kaya;

struct Mistake {
    kaya_status status;
    std::string message, hint, file, text;
    int line = 0, column = 0;

    Mistake(kaya_status status_, std::string message_) : status(status_), message(std::move(message_)), text(message) {}
    explicit Mistake(const Diagnostic& problem)
        : status(static_cast<kaya_status>(problem.fault)), message(problem.message), hint(problem.hint),
          text(render(problem)) {
        if (!problem.place) return;
        file = problem.place.source->name;
        line = problem.place.line;
        column = problem.place.column;
    }
};

/// The folders next to this library, where an installation and the folder of a build have the joint models.
std::vector<fs::path> installed_joints() {
    const fs::path own = file_of_code(reinterpret_cast<const void*>(&kaya_version));
    if (own.empty()) return {};
    std::error_code failed;
    const fs::path folder = fs::canonical(own, failed).parent_path();
    for (const auto& candidate :
         {folder / "joints", folder / "kaya" / "joints", folder.parent_path() / "kaya" / "joints"})
        if (fs::is_directory(candidate, failed)) return {candidate};
    return {};
}

/// Without `write` the text is not kept.
TextStream text_to(kaya_writer write, void* user) {
    return text_stream([write, user](std::string_view text) {
        if (write != nullptr) write(user, text.data(), text.size());
    });
}

} // namespace

struct kaya_model {
    explicit kaya_model(const kaya_options& options, const Options& of_session)
        : output(text_to(options.output, options.user)), messages(text_to(options.messages, options.user)),
          session(of_session, output.get(), messages.get()) {
        session.deck.file = "library";
        session.autosave->set_interval(std::nullopt); // the caller keeps the model
    }

    /// Runs `work`; what it throws becomes the mistakes of the call.
    template <class Work> kaya_status attempt(const Work& work) {
        mistakes.clear();
        const WithTeam loops(session.program.team());
        try {
            try {
                work();
            } catch (const lang::DeckErrors& several) {
                for (const auto& one : several.all) mistakes.emplace_back(one);
                throw;
            }
            session.program.output.flush();
            std::fflush(messages.get());
            return KAYA_DONE;
        } catch (const Diagnostic& problem) {
            if (mistakes.empty()) mistakes.emplace_back(problem);
        } catch (const std::bad_alloc&) {
            mistakes.emplace_back(KAYA_FAULT, "there is not enough memory");
        } catch (const std::exception& problem) { mistakes.emplace_back(KAYA_FAULT, problem.what()); }
        return mistakes.front().status;
    }

    /// The same for commands, which a function inside a cycle may not give.
    template <class Work> kaya_status command(const Work& work) {
        if (running) return refuse("commands cannot be given by a function inside a cycle");
        running = true;
        const kaya_status status = attempt(work);
        running = false;
        return status;
    }

    kaya_status refuse(const char* message) {
        mistakes.assign(1, Mistake(KAYA_WRONG, message));
        return KAYA_WRONG;
    }

    TextStream output, messages; // the session writes to them until its end
    Session session;
    std::vector<Mistake> mistakes;
    library::FieldSpan span;
    bool running = false;
};

extern "C" {

const char* kaya_version(void) { return program_version(); }

kaya_status kaya_open(const kaya_options* options, kaya_model** model) {
    if (model == nullptr) return KAYA_WRONG;
    *model = nullptr;
    if (options == nullptr || options->interface != KAYA_LIBRARY_INTERFACE) return KAYA_WRONG;
    try {
        Options of_session;
        of_session.colour = "never";
        of_session.strict = options->strict != 0;
        of_session.trust = options->trust != 0;
        of_session.own_joints =
            options->joints != nullptr ? std::vector<fs::path>{options->joints} : installed_joints();
        of_session.joint_folders = of_session.own_joints;
        add_own_folders(of_session.own_joints);
        *model = new kaya_model(*options, of_session);
        return KAYA_DONE;
    } catch (...) { return KAYA_FAULT; }
}

void kaya_close(kaya_model* model) { delete model; }

kaya_status kaya_run(kaya_model* model, const char* commands, const char* name) {
    if (model == nullptr) return KAYA_WRONG;
    if (commands == nullptr) return model->refuse("there are no commands");
    return model->command(
        [=] { model->session.deck.interpreter.run_text(commands, name != nullptr ? name : "commands"); });
}

kaya_status kaya_run_file(kaya_model* model, const char* file) {
    if (model == nullptr) return KAYA_WRONG;
    if (file == nullptr) return model->refuse("the name of the file is missing");
    return model->command([=] { model->session.run_deck(file); });
}

void kaya_interrupt(kaya_model* model) {
    if (model != nullptr) model->session.interrupt();
}

kaya_status kaya_after_cycles(kaya_model* model, int64_t interval, void (*function)(void*, kaya_model*), void* user) {
    if (model == nullptr) return KAYA_WRONG;
    return model->command([=] {
        if (interval < 1) throw Diagnostic("the interval is at least 1 cycle");
        if (function == nullptr) throw Diagnostic("there is no function to call");
        auto& callbacks = model->session.engine.callbacks;
        const int number = callbacks.empty() ? 1 : callbacks.back().number + 1;
        callbacks.push_back({number, script::Moment::after_cycle, interval, [=] { function(user, model); }});
    });
}

size_t kaya_error_count(const kaya_model* model) { return model != nullptr ? model->mistakes.size() : 0; }

kaya_error kaya_error_at(const kaya_model* model, size_t number) {
    if (model == nullptr || number >= model->mistakes.size()) return {KAYA_DONE, "", "", "", 0, 0, ""};
    const auto& one = model->mistakes[number];
    return {one.status, one.message.c_str(), one.hint.c_str(), one.file.c_str(),
            one.line,   one.column,          one.text.c_str()};
}

kaya_status kaya_field(kaya_model* model, const char* kind, const char* field, kaya_span* span) {
    if (model == nullptr) return KAYA_WRONG;
    if (kind == nullptr || field == nullptr || span == nullptr) return model->refuse("a name or the span is NULL");
    return model->attempt([=] { *span = model->span.read(model->session, kind, field); });
}

kaya_status kaya_set_field(kaya_model* model, const char* kind, const char* field, size_t row, const double* numbers,
                           size_t count) {
    if (model == nullptr) return KAYA_WRONG;
    if (kind == nullptr || field == nullptr) return model->refuse("a name is NULL");
    return model->attempt([=] { library::set_field(model->session, kind, field, row, numbers, count); });
}

uint64_t kaya_hash(kaya_model* model) { return model != nullptr ? state_hash(model->session.engine.model) : 0; }

} // extern "C"
