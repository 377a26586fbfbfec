#include "vocabulary.hpp"

#include "commands/session/session.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>

namespace kaya::soak {

namespace {

/// An expression that walks a relation from an object, or from the whole model.
std::string walk(const script::RelationInfo& relation, const std::string& from) {
    using enum script::RelationInfo::Form;
    const std::string name(relation.classic);
    if (relation.form == nearest) return name + "(0.5,0.5,1.2)";
    if (from.empty()) return name;
    return relation.form == numbered ? name + "(" + from + ",1)" : name + "(" + from + ")";
}

} // namespace

Vocabulary::Vocabulary() {
    const auto file = std::unique_ptr<std::FILE, decltype(&std::fclose)>(std::tmpfile(), &std::fclose);
    Options options;
    options.threads = 1;
    Session session(options, file.get(), file.get());
    for (const auto& [name, writable] : session.engine.scripts->built_in_names()) {
        const fish::Meaning meaning = session.engine.scripts->meaning_of(name);
        fish.push_back(
            {name, meaning.least, std::min(std::max(meaning.most, meaning.least), meaning.least + 3), writable});
    }
    for (const auto& table : session.engine.world.tables()) {
        Kind kind{std::string(table.name), std::string(table.classic), {}, {}};
        for (const auto& field : table.fields) kind.fields.emplace_back(field.name);
        kinds.push_back(std::move(kind));
    }
    for (int steps = 0; steps < 3; ++steps)
        for (const auto& relation : session.engine.world.relations()) {
            if (relation.classic.empty() || relation.to < 0) continue;
            const bool whole = relation.from < 0;
            if (!whole && kinds[static_cast<std::size_t>(relation.from)].objects.empty()) continue;
            const std::string expression =
                walk(relation, whole ? "" : kinds[static_cast<std::size_t>(relation.from)].objects.back());
            auto& objects = kinds[static_cast<std::size_t>(relation.to)].objects;
            if (std::ranges::find(objects, expression) == objects.end()) objects.push_back(expression);
        }
}

const Vocabulary::Kind* Vocabulary::kind_of(const std::string& name) const {
    const std::string prefix = name.substr(0, name.find('_'));
    const auto found =
        std::ranges::find_if(kinds, [&](const Kind& kind) { return kind.prefix == prefix && !kind.objects.empty(); });
    return prefix == name || found == kinds.end() ? nullptr : &*found;
}

} // namespace kaya::soak
