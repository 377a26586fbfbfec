#include "app/prompt.hpp"

#include "guide/completion.hpp"
#include "guide/explanations.hpp"
#include "app/interrupt.hpp"
#include "app/keeper.hpp"
#include "app/pager.hpp"
#include "guide/help_text.hpp"
#include "base/terminal_text.hpp"
#include "commands/session/autosave.hpp"
#include "lang/modern/language.hpp"
#include "lang/interp/help.hpp"
#include "system/door.hpp"

#include <algorithm>
#include <cerrno>
#include <clocale>
#include <fmt/format.h>
#include <histedit.h>
#include <iostream>
#include <unistd.h>

namespace kaya {

namespace {

namespace fs = std::filesystem;

constexpr int kept_lines = 1000;

/// The longest beginning that all words share.
std::string common_beginning(const std::vector<std::string>& words) {
    std::string beginning = words.front();
    for (const auto& word : words) {
        const auto [end, ignored] = std::mismatch(beginning.begin(), beginning.end(), word.begin(), word.end());
        beginning.erase(end, beginning.end());
    }
    return beginning;
}

class LineEditor {
public:
    explicit LineEditor(const Session& session)
        : session_(session), editor_(el_init("kaya", stdin, stdout, stderr)), history_(history_init()) {
        HistEvent event;
        history(history_, &event, H_SETSIZE, kept_lines);
        history(history_, &event, H_SETUNIQUE, 1);
        if (const Descriptor file = door::peek(history_file())) history(history_, &event, H_LOAD, file.name().c_str());
        el_set(editor_, EL_CLIENTDATA, this);
        el_set(editor_, EL_PROMPT, prompt_of);
        el_set(editor_, EL_EDITOR, "emacs");
        el_set(editor_, EL_HIST, history, history_);
        el_set(editor_, EL_ADDFN, "kaya-complete", "completes a word", complete);
        el_set(editor_, EL_BIND, "^I", "kaya-complete", nullptr);
    }
    ~LineEditor() {
        try {
            HistEvent event;
            if (const Descriptor file = door::open(history_file(), Use::own, door::Access::write))
                history(history_, &event, H_SAVE, file.name().c_str());
        } catch (const Diagnostic&) { // without a place for it the history ends with the session
        }
        history_end(history_);
        el_end(editor_);
    }
    LineEditor(const LineEditor&) = delete;
    LineEditor& operator=(const LineEditor&) = delete;

    enum class Read { line, interrupted, end };

    /// Reads one line, without its end. `above` are the lines of an unfinished statement.
    Read read(const std::string& above, std::string& line) {
        before_ = above;
        int size = 0;
        errno = 0;
        const char* text = el_gets(editor_, &size);
        const int problem = errno;
        if (text == nullptr || size <= 0) {
            if (size < 0 && problem == EINTR) {
                el_reset(editor_);
                print_text(stdout, "^C\n");
                return Read::interrupted;
            }
            print_text(stdout, "\n");
            return Read::end;
        }
        line.assign(text, static_cast<std::size_t>(size));
        while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.pop_back();
        if (!line.empty()) {
            HistEvent event;
            history(history_, &event, H_ENTER, line.c_str());
        }
        return Read::line;
    }

private:
    static LineEditor& of(EditLine* editor) {
        LineEditor* own = nullptr;
        el_get(editor, EL_CLIENTDATA, &own);
        return *own;
    }

    static char* prompt_of(EditLine* editor) {
        static char first[] = "kaya> ", further[] = "    > ";
        return of(editor).before_.empty() ? first : further;
    }

    static unsigned char complete(EditLine* editor, int) {
        const LineInfo* info = el_line(editor);
        const std::string line(info->buffer, static_cast<std::size_t>(info->cursor - info->buffer));
        const auto [typed, words] = proposals(of(editor).session_, of(editor).before_, line);
        if (words.empty()) return CC_REFRESH_BEEP;
        std::string rest = common_beginning(words);
        rest.erase(0, std::min(typed, rest.size()));
        if (words.size() == 1 && !words.front().ends_with("/")) rest += ' '; // a path may continue after a folder
        if (!rest.empty()) return el_insertstr(editor, rest.c_str()) == 0 ? CC_REFRESH : CC_ERROR;
        print_text(stdout, fmt::format("\n{}\n", filled(words, screen().columns - 1)));
        return CC_REDISPLAY;
    }

    const Session& session_;
    EditLine* editor_;
    ::History* history_;
    std::string before_;
};

/// Commands of the prompt that are not part of the language; true when the line was one of them.
bool own_command(Session& session, const std::string& text) {
    lang::Lexer lexer(lang::source_from_text("prompt", text));
    lang::Statement statement;
    if (!lexer.next(statement)) return true; // a blank line, a comment
    const std::string& word = statement.words.front().folded;
    // `jmodel model ?`: names of the session, which the language does not know.
    const std::string raw = statement.raw(0);
    if (raw.ends_with(" ?") && raw.find('\n') == raw.npos) {
        const std::string asked = raw.substr(0, raw.size() - 1);
        if (!lang::completions(lang::language(), asked).empty()) return false; // it lists words with more about them
        const auto words = proposals(session, "", asked).words;
        if (words.empty()) return false;
        session.program.output.print(filled(words, screen().columns - 1));
        return true;
    }
    if (word != "help" && word != "explain") return false;
    const std::string rest = statement.raw(1);
    if (word == "explain") show_by_pages(session.program.output, rest.empty() ? code_list() : explanation(rest));
    else show_by_pages(session.program.output, help_text(rest, session.deck.units));
    return true;
}

/// A wish to stop that a script has met is not one for the next command.
void forget_interrupt(Session& session) {
    try {
        session.stop_if_interrupted();
    } catch (const Diagnostic&) { return; }
}

/// Runs one statement; throws what the session throws.
lang::Ended run_text(Session& session, const std::string& text) {
    forget_interrupt(session);
    if (own_command(session, text)) return lang::Ended::end_of_deck;
    const InterruptGuard guard(session);
    const auto ended = session.deck.interpreter.run_text(text, "prompt");
    session.program.output.flush();
    return ended;
}

/// Shows an error and returns its exit status.
int show(Session& session) {
    try {
        throw;
    } catch (const lang::DeckErrors& errors) {
        for (const auto& error : errors.all) session.program.output.message(error);
        return static_cast<int>(errors.fault);
    } catch (Diagnostic& error) {
        // Here the program is there already: its name is not typed.
        constexpr std::string_view to_type = "'kaya help";
        if (const auto at = error.hint.find(to_type); at != std::string::npos)
            error.hint.replace(at, to_type.size(), "'help");
        session.program.output.message(error);
        return static_cast<int>(error.fault);
    } catch (const std::bad_alloc&) {
        session.program.output.message(Diagnostic("there is not enough memory for this", {}, Fault::run));
        return static_cast<int>(Fault::run);
    } catch (const std::exception& error) {
        session.program.output.message(Diagnostic(fmt::format("internal error: {}", error.what()),
                                                  "please report this, with the lines that were typed", Fault::own));
        return static_cast<int>(Fault::own);
    }
}

int from_keyboard(Session& session) {
    std::setlocale(LC_CTYPE, ""); // characters beyond ASCII take one column on the screen
    session.program.output.say(fmt::format(
        "kaya {}: help lists the commands, ? in place of a word what may stand there, quit ends", program_version()));
    session.autosave->find_earlier();
    session.autosave->set_typed();
    const PromptSignals signals;
    const Keeper keeper(session);
    LineEditor editor(session);
    std::string text, line;
    for (;;) {
        const auto read = PromptSignals::is_to_end() ? LineEditor::Read::end : editor.read(text, line);
        if (read == LineEditor::Read::end) {
            session.autosave->keep(); // before anything is said: the terminal may have gone
            return PromptSignals::is_to_end() ? static_cast<int>(Fault::run) : 0;
        }
        if (read == LineEditor::Read::interrupted) {
            text.clear();
            continue;
        }
        text += line + '\n';
        if (lang::needs_more(lang::language(), text)) continue;
        session.autosave->before_typed();
        try {
            if (run_text(session, std::exchange(text, {})) == lang::Ended::quit) return 0;
        } catch (...) { show(session); }
    }
}

int from_pipe(Session& session) {
    std::string text;
    try {
        for (std::string line; std::getline(std::cin, line);) {
            text += line + '\n';
            if (lang::needs_more(lang::language(), text)) continue;
            if (run_text(session, std::exchange(text, {})) == lang::Ended::quit) return 0;
        }
        if (!text.empty()) run_text(session, text);
    } catch (...) { return show(session); }
    return 0;
}

} // namespace

std::filesystem::path history_file() {
    if (const char* named = std::getenv("KAYA_HISTORY")) return named;
    if (const char* state = std::getenv("XDG_STATE_HOME")) return std::filesystem::path(state) / "kaya" / "history";
    if (const char* home = std::getenv("HOME"))
        return std::filesystem::path(home) / ".local" / "state" / "kaya" / "history";
    return {};
}

int run_prompt(Session& session) {
    session.deck.file = "prompt";
    return isatty(STDIN_FILENO) == 1 ? from_keyboard(session) : from_pipe(session);
}

} // namespace kaya
