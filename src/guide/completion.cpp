#include "guide/completion.hpp"

#include "guide/explanations.hpp"
#include "lang/interp/binder.hpp"
#include "lang/interp/help.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <sstream>

namespace kaya {

namespace {

namespace fs = std::filesystem;

using Names = std::set<std::string>;

std::vector<std::string> words_of(const std::string& line) {
    std::istringstream stream(lang::fold(line));
    return {std::istream_iterator<std::string>(stream), {}};
}

/// Whether a word is a beginning of `whole` with so many letters at least.
bool means(const std::string& word, std::string_view whole, std::size_t least) {
    return word.size() >= least && whole.starts_with(word);
}

/// Built-in names of FISH, and those of the session.
void add_fish(Names& names, const Session& session) {
    for (const auto& [name, writable] : session.engine.scripts->built_in_names()) names.insert(name);
    for (const auto& name : session.engine.scripts->symbols()) names.insert(name);
}

void add_fields(Names& names, const Session& session, bool with_object) {
    const auto add = [&](const std::vector<script::FieldInfo>& fields, std::string_view object) {
        for (const auto& field : fields)
            names.insert(with_object ? std::string(object) + "." + std::string(field.name) : std::string(field.name));
    };
    add(session.engine.world.globals(), "model");
    for (const auto& table : session.engine.world.tables()) add(table.fields, table.name);
}

Names lua_names(const Session& session, bool after_point) {
    if (after_point) {
        Names names;
        add_fields(names, session, false);
        return names;
    }
    Names names = {"model", "vector", "command", "count",  "nearest", "history",  "every", "print",
                   "pairs", "ipairs", "math",    "string", "table",   "function", "local", "return",
                   "end",   "then",   "else",    "elseif", "while",   "for",      "endlua"};
    for (const auto& table : session.engine.world.tables()) names.insert(std::string(table.name) + "s");
    for (const auto& name : session.engine.scripts->symbols()) names.insert(name);
    return names;
}

/// The open construct after several lines: none, a function, a chunk of Lua.
enum class Inside { nothing, function, lua };

Inside inside_of(const std::string& before) {
    const auto words = words_of(before.substr(0, before.find('\n')));
    if (words.empty()) return Inside::nothing;
    if (words.front() == "lua") return Inside::lua;
    const std::string& first = words.front() == "fish" && words.size() > 1 ? words[1] : words.front();
    return means(first, "define", 3) ? Inside::function : Inside::nothing;
}

bool takes_file(const std::vector<std::string>& words) {
    if (words.empty()) return false;
    const std::string& first = words.front();
    if (words.size() == 1 &&
        (means(first, "call", 2) || means(first, "restore", 3) || means(first, "save", 2) || first == "lua"))
        return true;
    if (means(first, "table", 2) && words.size() > 2) return words.back() == "read" || words.back() == "write";
    if (means(first, "jmodel", 2)) return words.back() == "load";
    return means(first, "import", 2) && words.size() > 1;
}

/// Files and folders whose path begins with the typed text.
Names files(const std::string& typed) {
    Names names;
    const auto slash = typed.rfind('/');
    const std::string folder = slash == typed.npos ? "" : typed.substr(0, slash + 1);
    std::error_code problem;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, problem), end; !problem && entry != end;
         entry.increment(problem)) {
        const std::string name = entry->path().filename().string();
        if (name.front() == '.' && typed.size() == folder.size()) continue;
        std::error_code ignored;
        names.insert(folder + name + (entry->is_directory(ignored) ? "/" : ""));
    }
    return names;
}

/// Joint models after `jmodel model`, zone models after `zone model`.
std::vector<std::string> models(const Session& session, const std::vector<std::string>& words) {
    if (words.size() < 2 || !means(words.back(), "model", 3)) return {};
    if (means(words[words.size() - 2], "jmodel", 2)) return session.engine.joints.available();
    if (words[words.size() - 2] == "zone") return session.engine.joints.zones.available();
    return {};
}

/// Properties of the joint models that the session has loaded or finds; those of materials are words of the language.
void add_properties(Names& names, const Session& session, const std::vector<std::string>& words) {
    const bool property = words.size() >= 3 && means(words.front(), "property", 2);
    const bool joint = words.size() >= 1 && means(words.front(), "jmodel", 2);
    if (!property && !joint) return;
    for (const auto& model : session.engine.joints.loaded())
        for (const auto& p : model->properties) {
            names.insert(p.name);
            names.insert(p.aliases.begin(), p.aliases.end());
        }
}

Names help_words(const Session& session) {
    Names names = {"range"};
    lang::for_each_command(lang::language(), [&](const lang::CommandSpec& command) {
        for (const auto& spelled : command.words)
            if (spelled.word != "@") names.insert(std::string(spelled.word));
    });
    names.insert({"loop", "case_of", "if", "def", "array", "local", "command", "section", "whilestepping"});
    add_fish(names, session);
    add_fields(names, session, true);
    return names;
}

Names codes() {
    Names names;
    std::istringstream lines(code_list());
    for (std::string line; std::getline(lines, line);)
        if (const auto words = words_of(line); !words.empty()) names.insert(words.front());
    return names;
}

Names all_names(const Session& session, const std::string& before, const std::string& line, const std::string& typed,
                const lang::Language& language) {
    const auto words = words_of(line.substr(0, line.size() - typed.size()));
    const Inside inside = inside_of(before);
    Names names;
    if (inside == Inside::lua)
        return lua_names(session, typed.empty() && !line.empty() && (line.back() == '.' || line.back() == ':'));
    if (inside == Inside::function) {
        add_fish(names, session);
        return names;
    }
    if (typed.starts_with("@")) {
        for (const auto& name : session.engine.scripts->symbols()) names.insert("@" + name);
        return names;
    }
    if (words.size() == 1 && words.front() == "help") return help_words(session);
    if (words.size() == 1 && words.front() == "explain") return codes();
    for (auto& model : models(session, words)) names.insert(std::move(model));
    if (!names.empty()) return names;
    if (takes_file(words)) return files(typed);
    for (auto& word : lang::completions(language, line)) names.insert(std::move(word));
    if (words.empty()) names.insert({"help", "explain"});
    add_properties(names, session, words);
    return names;
}

} // namespace

Proposals proposals(const Session& session, const std::string& before, const std::string& line,
                    const lang::Language& language) {
    const bool lua = inside_of(before) == Inside::lua;
    const auto blank = line.find_last_of(lua ? " \t=,()[]{}.:" : " \t=,()[]'\"");
    const std::string typed = line.substr(blank == line.npos ? 0 : blank + 1);
    Names names;
    if (lua && blank != line.npos && (line[blank] == '.' || line[blank] == ':')) names = lua_names(session, true);
    else names = all_names(session, before, line, typed, language);
    Proposals result{typed.size(), {}};
    const std::string folded = lang::fold(typed);
    for (const auto& name : names)
        if (name.starts_with(typed) || (!lua && lang::fold(name).starts_with(folded))) result.words.push_back(name);
    return result;
}

std::string filled(const std::vector<std::string>& words, std::size_t width) {
    std::string text, line;
    for (const auto& word : words) {
        if (!line.empty() && line.size() + 2 + word.size() > width) {
            text += line + "\n";
            line.clear();
        }
        line += (line.empty() ? "" : "  ") + word;
    }
    return text + line;
}

} // namespace kaya
