#include "commands/program/program.hpp"

#include <algorithm>
#include <thread>

namespace kaya {

Program::Program(const Options& given, std::FILE* results, std::FILE* messages)
    : options(given), output(results, messages) {
    output.quiet = options.quiet;
    output.set_in_place(options.progress.value_or(output.in_place() && !options.quiet));
    if (options.colour != "auto") output.set_colour(options.colour == "always");
    set_threads(options.threads > 0 ? options.threads
                                    : static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
}

void Program::set_threads(int count) {
    if (team_) team_->set_count(count);
    else team_ = options.host->threads(count);
}

void Program::tell_cycled() const {
    for (Listener* listener : listeners_) listener->cycled();
}

bool Program::any_listener_reads() const {
    return std::ranges::any_of(listeners_, [](const Listener* listener) { return listener->reads_model(); });
}

void Program::tell_executed(const lang::BoundCommand& command, const Completion& completion) const {
    for (Listener* listener : listeners_) listener->executed(command, completion);
}

void Program::show_warning(Diagnostic warning) {
    if (options.strict) {
        warning.severity = Severity::error;
        throw warning;
    }
    warning.severity = Severity::warning;
    ++warnings;
    if (warning_texts.size() < 100) warning_texts.push_back(render(warning));
    output.message(warning);
}

void Program::show_note(Diagnostic note) {
    note.severity = Severity::note;
    output.message(note);
}

const std::string& Program::output_file(const std::string& name) {
    gate->may_write(name);
    files_written.push_back(name);
    return name;
}

const char* program_version() { return KAYA_VERSION; }

} // namespace kaya
