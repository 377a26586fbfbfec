#include "lang/interp/interpreter.hpp"

#include "lang/interp/named_word.hpp"

#include <fmt/format.h>

namespace kaya::lang {

namespace fs = std::filesystem;

Ended Interpreter::run_file(const std::string& name) {
    const auto deck = bind_deck(language_, name, searched(), &checks, &names_);
    host_.deck_read(*deck, names_);
    return run(*deck);
}

Ended Interpreter::run_text(const std::string& text, const std::string& name, int first_line) {
    return run(*bind_text(language_, source_from_text(name, text, first_line), searched(), &checks, &names_));
}

Ended Interpreter::run(const BoundFile& file) {
    if (frames_.size() >= deepest_call)
        throw Diagnostic(fmt::format("more than {} files and scripts call each other", deepest_call),
                         "does one of them call itself?");
    struct Leave { // the frame is removed on every exit
        std::vector<Frame>& frames;
        ~Leave() { frames.pop_back(); }
    };
    frames_.push_back({file.path.parent_path(), {}});
    const Leave leave{frames_};

    for (const auto& step : file.steps) {
        const Place place = step.command.place;
        frames_.back().place = place;
        const Flow flow = step.command.spec->flow;
        if (flow == Flow::leave_file) return Ended::end_of_deck;
        if (flow == Flow::leave_all) return Ended::quit;
        try {
            if (run_step(step) == Ended::quit) return Ended::quit;
        } catch (Diagnostic& problem) {
            place_problem(problem, language_, place);
            if (problem.place.source != place.source)
                problem.add(fmt::format("called from {}:{}", place.source->name, place.line));
            throw;
        }
    }
    return Ended::end_of_deck;
}

Ended Interpreter::run_step(const BoundFile::Step& step) {
    host_.before(step.command);
    BoundCommand with_values;
    const BoundCommand* command = &step.command;
    if (command->late) {
        Lexer lexer(command->place.source, command->place.line);
        Statement statement;
        lexer.read_only(command->dialects);
        next_statement(*command->language, lexer, statement);
        for (const BareName& name : command->bare) read_as_name(statement, name);
        const ValueSource values = [this](const std::string& expression, const Place& place) {
            return host_.value(expression, place);
        };
        with_values = bind_statement(*command->language, statement, &values);
        command = &with_values;
    }
    Ended ended = Ended::end_of_deck;
    try {
        if (command->spec->flow == Flow::call) ended = run_call(step, *command);
        else host_.run(*command);
    } catch (...) {
        host_.failed(*command);
        throw;
    }
    host_.after(*command);
    return ended;
}

Ended Interpreter::run_call(const BoundFile::Step& step, const BoundCommand& command) {
    const std::string name = command.spec->called_file(command.command);
    // The deck itself may have written the file since it was bound.
    if (step.called && read_source(step.called->path, name)->lines == step.called->source->lines)
        return run(*step.called);
    return run(*bind_deck(language_, name, searched(), &checks, &names_));
}

std::vector<fs::path> Interpreter::searched() const {
    std::vector<fs::path> searched;
    for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame)
        if (!frame->folder.empty()) searched.push_back(frame->folder);
    searched.insert(searched.end(), folders.begin(), folders.end());
    return searched;
}

std::vector<std::string> Interpreter::call_chain() const {
    std::vector<std::string> chain;
    for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame)
        if (frame != frames_.rbegin() && frame->place)
            chain.push_back(fmt::format("called from {}:{}", frame->place.source->name, frame->place.line));
    return chain;
}

void Interpreter::warn(Diagnostic warning) const {
    if (warning.severity == Severity::error) warning.severity = Severity::warning;
    host_.warning(warning.at(current_place()));
}

} // namespace kaya::lang
