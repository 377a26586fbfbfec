#include "commands/program/run_name.hpp"

#include "base/ask_again.hpp"
#include "system/door.hpp"
#include "system/locked_file.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace kaya {

namespace fs = std::filesystem;

namespace {

constexpr int most_runs = 1000;           ///< of one name in one folder
constexpr std::size_t longest_stem = 200; ///< bytes: file systems allow 255, and suffixes follow

} // namespace

RunNames::~RunNames() {
    for (const auto& [stem, held] : held_) {
        if (held.lock && is_empty(held.lock)) door::remove(held.file);
    }
}

RunNames::Taken RunNames::take(const std::string& stem) {
    if (const auto found = held_.find(stem); found != held_.end()) return {found->second.name, false, false};
    for (int number = 1; number <= most_runs; ++number) {
        const std::string name = number == 1 ? stem : fmt::format("{}-{}", stem, number);
        std::error_code ignored;
        const fs::path file = fs::absolute(fmt::format(".{}.kaya-lock", name), ignored);
        LockedFile lock = lock_file(file);
        const auto is_free = [&] { return !(lock = lock_file(file)).busy; };
        if (lock.busy && (number > 1 || !ask_again(is_free))) continue;
        const std::string& taken = lock.file ? name : stem;
        held_[stem] = {taken, std::move(lock.file), file};
        return {taken, true, taken != stem};
    }
    return {stem, true, false};
}

std::string stem_of_deck(const std::string& deck) {
    std::string stem = deck.empty() ? "prompt" : fs::path(deck).stem().string();
    std::replace_if(
        stem.begin(), stem.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, '_');
    std::size_t end = std::min(stem.size(), longest_stem);
    while (end > 0 && end < stem.size() && (static_cast<unsigned char>(stem[end]) & 0xc0) == 0x80)
        --end; // whole characters
    return stem.substr(0, end);
}

} // namespace kaya
