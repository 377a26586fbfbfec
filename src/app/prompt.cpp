#include "app/prompt.hpp"

#include "app/completion.hpp"
#include "app/explanations.hpp"
#include "app/interrupt.hpp"
#include "app/tools.hpp"
#include "base/door.hpp"
#include "lang/commands/language.hpp"
#include "lang/interp/help.hpp"

#include <algorithm>
#include <cerrno>
#include <clocale>
#include <csignal>
#include <fcntl.h>
#include <fmt/format.h>
#include <histedit.h>
#include <iostream>
#include <sstream>
#include <sys/ioctl.h>
#include <unistd.h>

namespace kaya {

namespace {

namespace fs = std::filesystem;

constexpr int kept_lines = 1000;

struct Screen {
    std::size_t columns = 80, rows = 24;
};

Screen screen() {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) return {};
    return {size.ws_col, size.ws_row};
}

/// Shows a long text by pages, on a terminal. The return key continues, q ends it.
void show_by_pages(Session& session, const std::string& text) {
    const bool terminal = isatty(STDIN_FILENO) == 1 && isatty(STDOUT_FILENO) == 1;
    const std::size_t page = std::max<std::size_t>(screen().rows, 4) - 2;
    std::istringstream lines(text);
    std::string part;
    std::size_t shown = 0;
    for (std::string line; std::getline(lines, line); ++shown) {
        if (terminal && shown == page) {
            session.output.print(part);
            session.output.flush();
            part.clear();
            shown = 0;
            std::fputs("-- more: the return key continues, q ends --", stdout);
            std::fflush(stdout);
            std::string answer;
            if (!std::getline(std::cin, answer) || answer.starts_with("q")) return;
        }
        part += line + "\n";
    }
    session.output.print(part);
}

/// The longest beginning that all words share.
std::string common_beginning(const std::vector<std::string>& words) {
    std::string beginning = words.front();
    for (const auto& word : words) {
        const auto [end, ignored] = std::mismatch(beginning.begin(), beginning.end(), word.begin(), word.end());
        beginning.erase(end, beginning.end());
    }
    return beginning;
}

/// At the prompt Ctrl-C clears the typed line.
extern "C" void leave_line(int) {}

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
            if (const Descriptor file = door::open(history_file(), Use::own, O_WRONLY))
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
        struct sigaction on_interrupt {
        }, before{};
        on_interrupt.sa_handler = leave_line; // without SA_RESTART: reading ends
        sigaction(SIGINT, &on_interrupt, &before);
        int size = 0;
        errno = 0;
        const char* text = el_gets(editor_, &size);
        const int problem = errno;
        sigaction(SIGINT, &before, nullptr);
        if (text == nullptr || size <= 0) {
            if (size < 0 && problem == EINTR) {
                el_reset(editor_);
                std::fputs("^C\n", stdout);
                return Read::interrupted;
            }
            std::fputs("\n", stdout);
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
        std::fputs(fmt::format("\n{}\n", filled(words, screen().columns - 1)).c_str(), stdout);
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
        if (!lang::completions(lang::classic(), asked).empty()) return false; // it lists words with more about them
        const auto words = proposals(session, "", asked).words;
        if (words.empty()) return false;
        session.output.print(filled(words, screen().columns - 1));
        return true;
    }
    if (word != "help" && word != "explain") return false;
    const std::string rest = statement.raw(1);
    if (word == "explain") show_by_pages(session, rest.empty() ? code_list() : explanation(rest));
    else show_by_pages(session, help_text(rest));
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
    const auto ended = session.interpreter.run_text(text, "prompt");
    session.output.flush();
    return ended;
}

/// Shows an error and returns its exit status.
int show(Session& session) {
    try {
        throw;
    } catch (const lang::DeckErrors& errors) {
        for (const auto& error : errors.all) session.output.message(error);
        return static_cast<int>(errors.fault);
    } catch (Diagnostic& error) {
        // Here the program is there already: its name is not typed.
        constexpr std::string_view to_type = "'kaya help";
        if (const auto at = error.hint.find(to_type); at != std::string::npos)
            error.hint.replace(at, to_type.size(), "'help");
        session.output.message(error);
        return static_cast<int>(error.fault);
    } catch (const std::bad_alloc&) {
        session.output.message(Diagnostic("there is not enough memory for this", {}, Fault::run));
        return static_cast<int>(Fault::run);
    } catch (const std::exception& error) {
        session.output.message(Diagnostic(fmt::format("internal error: {}", error.what()),
                                          "please report this, with the lines that were typed", Fault::own));
        return static_cast<int>(Fault::own);
    }
}

int from_keyboard(Session& session) {
    std::setlocale(LC_CTYPE, ""); // characters beyond ASCII take one column on the screen
    session.output.say(fmt::format("kaya {}: help lists the commands, ? in place of a word the valid words, quit ends",
                                   program_version()));
    LineEditor editor(session);
    std::string text, line;
    for (;;) {
        const auto read = editor.read(text, line);
        if (read == LineEditor::Read::end) return 0;
        if (read == LineEditor::Read::interrupted) {
            text.clear();
            continue;
        }
        text += line + '\n';
        if (lang::needs_more(lang::classic(), text)) continue;
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
            if (lang::needs_more(lang::classic(), text)) continue;
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
    session.deck = "prompt";
    return isatty(STDIN_FILENO) == 1 ? from_keyboard(session) : from_pipe(session);
}

} // namespace kaya
