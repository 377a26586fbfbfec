#include "app/study_deck.hpp"

#include "base/lower_case.hpp"
#include "io/whole_file.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <set>
#include <sstream>

namespace kaya {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 1000;

/// All words of a deck and of the files that it reads as text.
class Words {
public:
    /// False when a file cannot be read: then nothing is known about names.
    bool take(const fs::path& file) {
        if (files_.size() > most_files || !files_.insert(file.lexically_normal()).second) return true;
        std::string text;
        try {
            text = read_whole_file(file.string());
        } catch (const Diagnostic&) { return false; }
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);)
            if (!take_line(line, file.parent_path())) return false;
        return true;
    }
    bool has(const std::string& word) const { return words_.contains(lower_case(word)); }
    const std::set<std::string>& declared() const { return declared_; }
    std::vector<std::string_view> all() const { return {words_.begin(), words_.end()}; }

private:
    bool take_line(const std::string& line, const fs::path& folder) {
        std::istringstream rest(line);
        std::string command, name;
        rest >> command >> name;
        const auto in_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
        for (auto at = line.begin(); at != line.end();) {
            const auto begin = std::find_if(at, line.end(), in_word);
            at = std::find_if_not(begin, line.end(), in_word);
            if (begin != at) words_.insert(lower_case(std::string(begin, at)));
        }
        command = lower_case(command);
        if (command.size() >= 5 && std::string("parameter").starts_with(command)) {
            std::erase_if(name, [](char c) { return c == '@' || c == '\''; });
            declared_.insert(lower_case(name.substr(0, name.find('='))));
        }
        const bool reads =
            (command.size() >= 3 && std::string("call").starts_with(command)) || (command == "lua" && !name.empty());
        if (!reads || name.empty()) return true;
        std::erase_if(name, [](char c) { return c == '\'' || c == '"'; });
        return take(fs::path(name).has_extension() ? folder / name : folder / (name + ".3dd"));
    }

    std::set<fs::path> files_;
    std::set<std::string> words_, declared_;
};

std::string param_line(const std::string& name, const StudyValue& value) {
    const std::string text = text_of(value);
    return fmt::format("param {} = {}\n", is_property(name) ? "'" + name + "'" : name,
                       std::holds_alternative<std::string>(value) ? "'" + text + "'" : text);
}

} // namespace

std::set<std::string> declared_names(const Study& study) {
    Words words;
    words.take(study.deck);
    return words.declared();
}

void check_names(const Study& study) {
    Words words;
    if (!words.take(study.deck)) return;
    const auto check = [&](const std::string& name, const Place& place) {
        if (is_property(name) || words.has(name)) return; // of properties the run says whether the deck sets them
        const auto near = did_you_mean(lower_case(name), words.all());
        throw Diagnostic(fmt::format("the deck does not mention '{}'", name),
                         near.empty() ? fmt::format("write param {} = 30 in the deck, and use @{}", name, name)
                                      : fmt::format("did you mean '{}'?", near))
            .at(place);
    };
    for (const auto& factor : study.factors) check(factor.name, factor.place);
    if (study.critical) check(study.critical->parameter, study.critical->place);
    if (study.fit)
        for (const auto& unknown : study.fit->unknowns) check(unknown.parameter, study.fit->place);
    for (const auto& [name, value] : study.fixed) check(name, Place{});
}

fs::path write_case_deck(const Study& study, const Case& one) {
    const fs::path deck(study.deck);
    const fs::path file = deck.parent_path() / fmt::format("{}-run-{}.3dd", deck.stem().string(), one.number);
    std::string text = fmt::format("; Run {} of the study {}.\n", one.number, fs::path(study.file).filename().string());
    for (const auto& [name, value] : one.values) text += param_line(name, value);
    text += fmt::format("call '{}'\n", deck.filename().string());
    write_whole_file(file.string(), text);
    return file;
}

std::vector<Case> searched_cases(const StudyFolder& folder) {
    std::vector<Case> cases;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(folder.path() / "runs", failed))
        if (auto one = read_case(entry.path() / "outcome.toml")) cases.push_back(std::move(*one));
    std::ranges::sort(cases, {}, &Case::number);
    return cases;
}

} // namespace kaya
