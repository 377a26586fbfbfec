#include "lang/commands/printer.hpp"

#include <tuple>

namespace kaya::lang {

Progress progress(const MemberHashes& before, const MemberHashes& after, const MemberHashes& wanted) {
    const auto has = [](const MemberHashes& in, const MemberHash& member) {
        return std::ranges::binary_search(in, member);
    };
    Progress found;
    for (const MemberHash& member : after) {
        if (has(before, member)) continue;
        ++(has(wanted, member) ? found.gained : found.wrong);
    }
    for (const MemberHash& member : before)
        if (!has(after, member)) ++(has(wanted, member) ? found.lost : found.mended);
    return found;
}

Wording StructPrinter::result() && {
    const bool ends_wrong = taken_.size() > 1 && taken_.back().keyword != nullptr && taken_.back().keyword->between;
    if (ends_wrong) std::swap(taken_.back(), taken_[taken_.size() - 2]);
    Wording wording{{}, std::move(present_)};
    for (const auto& [keyword, words] : taken_) {
        if (keyword != nullptr && !keyword->words.empty())
            wording.words.push_back({std::string(keyword->words.front().word)});
        wording.words.insert(wording.words.end(), words.begin(), words.end());
    }
    return wording;
}

void StructPrinter::take(Wording wording, const KeywordSpec* keyword) {
    taken_.push_back({keyword, std::move(wording.words)});
    present_ = std::move(wording.after);
    now_ = hash_(present_.get());
}

bool StructPrinter::take_best(const std::vector<const KeywordSpec*>& keywords, Rule rule) {
    const auto rank = [](const Progress& p, const Wording& wording) {
        return std::tuple(p.gained - p.wrong, -static_cast<int>(wording.words.size()));
    };
    const KeywordSpec* best = nullptr;
    Wording best_wording;
    Progress best_progress;
    for (const KeywordSpec* keyword : keywords)
        for (Wording& wording : keyword->write(wanted_, present_.get())) {
            const Progress now = progress(now_, hash_(wording.after.get()), goal_);
            if (now.gained == 0 || now.lost > 0) continue;
            if ((now.wrong > 0 && rule != Rule::may_mislead) || (now.mended == 0 && rule == Rule::must_mend)) continue;
            if (best != nullptr && rank(now, wording) <= rank(best_progress, best_wording)) continue;
            best = keyword;
            best_wording = std::move(wording);
            best_progress = now;
        }
    if (best == nullptr) return false;
    take(std::move(best_wording), best);
    return true;
}

std::size_t StructPrinter::members_to_change() const {
    std::size_t same = 0;
    for (const MemberHash& member : now_) same += std::ranges::binary_search(goal_, member);
    return now_.size() + goal_.size() - 2 * same;
}

bool StructPrinter::print(const std::vector<PositionalSpec>& arguments) {
    const auto take_value = [](StructPrinter& printer, const PositionalSpec& argument) {
        auto wordings = argument.write(printer.wanted_, printer.present_.get());
        if (wordings.empty()) return false;
        printer.take(std::move(wordings.front()));
        return true;
    };
    StructPrinter further = *this; // with values that may be left out
    for (const PositionalSpec& argument : arguments) {
        if (!take_value(further, argument)) return argument.argument.optional;
        if (!argument.argument.optional || further.members_to_change() < members_to_change()) *this = further;
    }
    return true;
}

void StructPrinter::print(const std::vector<const KeywordSpec*>& keywords) {
    std::vector<const KeywordSpec*> printed;
    for (const KeywordSpec* keyword : keywords)
        if (keyword->write && keyword->support == Support::runs) printed.push_back(keyword);
    for (bool further = true; further && !done();) {
        further = false;
        for (const KeywordSpec* keyword : printed)
            while (!done() && take_best({keyword}, Rule::strict)) further = true;
        if (further || done()) continue;
        further = take_best(printed, Rule::may_mislead);
        while (further && !done() && take_best(printed, Rule::must_mend)) {}
    }
}

} // namespace kaya::lang
