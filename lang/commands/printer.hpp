// From a struct to the words that fill it. Keywords are tried in the order of their table: one is printed when it makes members equal to
// those of the wanted struct and changes no other.
#pragma once

#include "lang/commands/struct_hashes.hpp"
#include "lang/interp/spec.hpp"

namespace kaya::lang {

using HashStruct = std::function<MemberHashes(const void*)>;
template <class Struct> MemberHashes hash_struct(const void* value) {
    return hashes_of(*static_cast<const Struct*>(value));
}

class StructPrinter {
public:
    StructPrinter(const void* wanted, std::shared_ptr<void> present, HashStruct hash)
        : wanted_(wanted), hash_(std::move(hash)), goal_(hash_(wanted)), present_(std::move(present)),
          now_(hash_(present_.get())) {}

    /// The values before the keywords; false when one is missing.
    bool print(const std::vector<PositionalSpec>& arguments);
    /// Prints keywords until none of them makes progress. One without words is a value that no word announces.
    void print(const std::vector<const KeywordSpec*>& keywords);
    /// The words of all, and the struct that they lead to.
    Wording result() &&;

private:
    bool done() const { return now_ == goal_; }
    void take(Wording wording, const KeywordSpec* keyword = nullptr);
    enum class Rule {
        strict,
        may_mislead, ///< may give members a value that other keywords must change
        must_mend    ///< changes such values
    };
    /// Takes the best wording of several keywords; false when none makes progress by the rule.
    bool take_best(const std::vector<const KeywordSpec*>& keywords, Rule rule);
    std::size_t members_to_change() const;

    const void* wanted_;
    HashStruct hash_;
    MemberHashes goal_;
    std::shared_ptr<void> present_;
    MemberHashes now_;
    struct Taken {
        const KeywordSpec* keyword;
        PrintedWords words;
    };
    std::vector<Taken> taken_;
};

/// Pointers to the keywords.
inline std::vector<const KeywordSpec*> pointers_to(const std::vector<KeywordSpec>& keywords) {
    std::vector<const KeywordSpec*> all;
    for (const KeywordSpec& keyword : keywords) all.push_back(&keyword);
    return all;
}

} // namespace kaya::lang
