#include "app/study_deck.hpp"

#include "commands/review/deck_words.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya {

namespace {

namespace fs = std::filesystem;

std::string param_line(const std::string& name, const StudyValue& value) {
    const std::string text = text_of(value);
    return fmt::format("param {} = {}\n", is_property(name) ? "'" + name + "'" : name,
                       std::holds_alternative<std::string>(value) ? "'" + text + "'" : text);
}

} // namespace

std::set<std::string> declared_names(const Study& study) {
    DeckWords words;
    words.take(study.deck);
    return words.declared();
}

void check_names(const Study& study) {
    DeckWords words;
    if (!words.take(study.deck)) return;
    for (const auto& factor : study.factors) words.require(factor.name, factor.place);
    if (study.critical) words.require(study.critical->parameter, study.critical->place);
    if (study.fit)
        for (const auto& unknown : study.fit->unknowns) words.require(unknown.parameter, study.fit->place);
    for (const auto& [name, value] : study.fixed) words.require(name, Place{});
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
