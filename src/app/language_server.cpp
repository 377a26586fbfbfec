#include "app/language_server.hpp"

#include "app/editor_answers.hpp"
#include "app/message_stream.hpp"
#include "app/run.hpp"
#include "commands/session/deck_report.hpp"
#include "lang/interp/format.hpp"
#include "lang/modern/language.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <memory>
#include <set>

namespace kaya {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class Server {
public:
    Server(int input, int output) : stream_(input, output) {}

    int serve() {
        while (!ended_) {
            // The text is read when typing pauses: each letter would otherwise wait for a whole deck.
            constexpr int pause = 120; // milliseconds
            if (!unread_.empty() && stream_.is_idle(pause)) {
                publish(*unread_.begin());
                continue;
            }
            const auto text = stream_.next();
            if (!text) break;
            answer(*text);
        }
        return shut_down_ || !ended_ ? 0 : 1;
    }

private:
    void answer(const std::string& text) {
        const Json message = Json::parse(text, nullptr, false);
        if (!message.is_object()) return refuse(nullptr, {Refusal::Code::parse, "this is not a message in JSON"});
        const Json id = message.contains("id") ? message["id"] : Json();
        if (!message.contains("method") || !message["method"].is_string()) {
            if (message.contains("result") || message.contains("error")) return; // an answer to us
            return refuse(id, {Refusal::Code::request, "the message has no method"});
        }
        const std::string method = message["method"];
        const Json parameters = message.contains("params") ? message["params"] : Json::object();
        try {
            const auto found = methods().find(method);
            if (found == methods().end()) {
                if (id.is_null() || method.starts_with("$/")) return;
                throw Refusal{Refusal::Code::method, "kaya lsp has no method " + method};
            }
            Json result = found->second(*this, parameters);
            if (!id.is_null()) stream_.send({{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}});
        } catch (const Refusal& refusal) {
            if (!id.is_null()) refuse(id, refusal);
        } catch (const Json::exception&) {
            if (!id.is_null()) refuse(id, {Refusal::Code::parameters, "the parameters are not those of " + method});
        } catch (const Diagnostic& problem) {
            if (!id.is_null()) refuse(id, {Refusal::Code::refused, problem.message});
        }
    }

    void refuse(const Json& id, const Refusal& refusal) {
        stream_.send({{"jsonrpc", "2.0"},
                      {"id", id},
                      {"error", {{"code", static_cast<int>(refusal.code)}, {"message", refusal.message}}}});
    }

    using Method = std::function<Json(Server&, const Json&)>;
    static const std::map<std::string, Method>& methods() {
        static const std::map<std::string, Method> all{
            {"initialize", [](Server& s, const Json& p) { return s.begin(p); }},
            {"initialized", [](Server&, const Json&) { return Json(); }},
            {"shutdown", [](Server& s, const Json&) { return s.shut_down_ = true, Json(); }},
            {"exit", [](Server& s, const Json&) { return s.ended_ = true, Json(); }},
            {"textDocument/didOpen",
             [](Server& s, const Json& p) {
                 return s.take(p.at("textDocument").at("uri"), p["textDocument"].at("text"));
             }},
            {"textDocument/didChange", [](Server& s, const Json& p) { return s.change(p); }},
            {"textDocument/didClose", [](Server& s, const Json& p) { return s.close(p.at("textDocument").at("uri")); }},
            {"textDocument/completion", [](Server& s, const Json& p) { return s.answers_.completions(s.asked(p)); }},
            {"textDocument/hover", [](Server& s, const Json& p) { return s.answers_.hover(s.asked(p)); }},
            {"textDocument/definition", [](Server& s, const Json& p) { return s.answers_.definition(s.asked(p)); }},
            {"textDocument/references", [](Server& s, const Json& p) { return s.answers_.uses(s.asked(p)); }},
            {"textDocument/prepareRename",
             [](Server& s, const Json& p) { return s.answers_.name_to_change(s.asked(p)); }},
            {"textDocument/rename",
             [](Server& s, const Json& p) { return s.answers_.other_name(s.asked(p), p.at("newName")); }},
            {"textDocument/formatting", [](Server& s, const Json& p) { return s.format(p); }},
            {"textDocument/documentSymbol",
             [](Server& s, const Json& p) { return EditorAnswers::functions(s.decks_.deck(s.shown(p))); }},
            {"textDocument/codeAction", [](Server& s, const Json& p) { return s.actions(p); }},
        };
        return all;
    }

    Json begin(const Json& parameters) {
        const Json wanted = parameters.value("initializationOptions", Json::object());
        if (wanted.is_object()) answers_.propose(wanted.value("dialect", "both"));
        return abilities();
    }

    static Json abilities() {
        return {{"capabilities",
                 {{"textDocumentSync", {{"openClose", true}, {"change", 2}}},
                  {"completionProvider", {{"triggerCharacters", {"@", "[", "."}}}},
                  {"hoverProvider", true},
                  {"definitionProvider", true},
                  {"referencesProvider", true},
                  {"renameProvider", {{"prepareProvider", true}}},
                  {"documentFormattingProvider", true},
                  {"documentSymbolProvider", true},
                  {"codeActionProvider", {{"codeActionKinds", {"quickfix", "refactor.rewrite"}}}}}},
                {"serverInfo", {{"name", "kaya"}, {"version", program_version()}}}};
    }

    // Texts.

    Json take(const std::string& uri, std::string text) {
        decks_.open(uri, std::move(text));
        unread_.insert(uri);
        return {};
    }

    /// Throws Refusal when the editor does not show the text that it asks about.
    std::string shown(const Json& parameters) {
        std::string uri = parameters.at("textDocument").at("uri");
        if (decks_.text(uri) == nullptr) throw Refusal{Refusal::Code::parameters, "the file is not open"};
        return uri;
    }

    Json change(const Json& parameters) {
        const std::string uri = shown(parameters);
        std::string& whole = *decks_.text(uri);
        for (const auto& edit : parameters.at("contentChanges")) {
            const std::string text = edit.at("text");
            if (edit.contains("range")) {
                const std::size_t begin = offset_of(whole, edit["range"].at("start")),
                                  end = std::max(begin, offset_of(whole, edit["range"].at("end")));
                whole.replace(begin, end - begin, text);
            } else whole = text;
        }
        decks_.changed(uri);
        unread_.insert(uri);
        return {};
    }

    Json close(const std::string& uri) {
        decks_.close(uri);
        unread_.erase(uri);
        stream_.send(notice("textDocument/publishDiagnostics", {{"uri", uri}, {"diagnostics", Json::array()}}));
        return {};
    }

    static Json notice(const char* method, Json parameters) {
        return {{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(parameters)}};
    }

    /// Byte of the text at a position; the end of a line or of the text when it lies beyond.
    static std::size_t offset_of(const std::string& text, const Json& position) {
        std::size_t at = 0;
        for (auto line = position.at("line").get<std::int64_t>(); line > 0; --line) {
            const auto end = text.find('\n', at);
            if (end == text.npos) return text.size();
            at = end + 1;
        }
        const std::string_view line =
            std::string_view(text).substr(at, std::min(text.find('\n', at), text.size()) - at);
        return at + byte_of(line, position.at("character").get<std::size_t>());
    }

    Spot spot_of(const OpenDeck& deck, const Json& parameters) const {
        const auto& position = parameters.at("position");
        const auto line = position.at("line").get<std::int64_t>();
        if (line < 0 || line >= static_cast<std::int64_t>(deck.lines().size())) return {-1, 0};
        return {static_cast<int>(line),
                byte_of(deck.lines()[static_cast<std::size_t>(line)], position.at("character").get<std::size_t>())};
    }
    // Mistakes.

    void publish(const std::string& of) {
        const std::string uri = of;
        unread_.erase(uri);
        Json found = Json::array();
        const std::string path = path_of(uri);
        try {
            const OpenDeck& shown = decks_.deck(uri);
            const DeckReport report = check_text(path, *decks_.text(uri), own_joint_folders(program_folder("")));
            for (const auto& line : report.lines) found.push_back(EditorAnswers::diagnostic(shown, path, line));
        } catch (const Diagnostic& problem) {
            const Json start{{"line", 0}, {"character", 0}};
            found.push_back({{"range", {{"start", start}, {"end", start}}},
                             {"severity", 1},
                             {"source", "kaya"},
                             {"message", problem.message}});
        }
        stream_.send(notice("textDocument/publishDiagnostics", {{"uri", uri}, {"diagnostics", std::move(found)}}));
    }

    // Answers.

    EditorAnswers::Asked asked(const Json& parameters) {
        const std::string uri = shown(parameters);
        const OpenDeck& deck = decks_.deck(uri);
        return {deck, spot_of(deck, parameters), uri, decks_.family(uri)};
    }

    Json actions(const Json& parameters) {
        const std::string uri = shown(parameters);
        const OpenDeck& deck = decks_.deck(uri);
        Json actions = EditorAnswers::proposed_edits(uri, parameters.at("context").at("diagnostics"));
        const auto line = parameters.at("range").at("start").at("line").get<std::int64_t>();
        if (line >= 0 && line < static_cast<std::int64_t>(deck.lines().size()))
            for (auto& action : EditorAnswers::converted(deck, uri, static_cast<int>(line)))
                actions.push_back(std::move(action));
        return actions;
    }

    Json format(const Json& parameters) {
        const std::string& now = *decks_.text(shown(parameters));
        const std::string text = lang::format_deck(lang::language(), lang::source_from_text("deck", now));
        if (text == now) return Json::array();
        const auto lines = std::ranges::count(now, '\n') + 1;
        const Json whole{{"start", {{"line", 0}, {"character", 0}}}, {"end", {{"line", lines}, {"character", 0}}}};
        return Json::array({{{"range", whole}, {"newText", text}}});
    }

    MessageStream stream_;
    OpenDecks decks_;
    std::set<std::string> unread_; ///< texts that have changed since they were checked
    EditorAnswers answers_;
    bool shut_down_ = false, ended_ = false;
};

} // namespace

int serve_editor(int input, int output) { return Server(input, output).serve(); }

} // namespace kaya
