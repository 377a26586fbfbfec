// The kinds of cases: random input, and the command line that uses it.
#pragma once

#include "fish_soup.hpp"
#include "lua_soup.hpp"
#include "trial.hpp"

#include <span>
#include <string>
#include <string_view>

namespace kaya::soak {

class Cases {
public:
    Cases();
    /// A run whose journal the kind `journals` modifies.
    static Case journal_run();
    void set_journal(std::string text) { journal_ = std::move(text); }

    Case decks(Chance& c) const;
    Case scripts(Chance& c) const;
    Case files(Chance& c) const;
    Case studies(Chance& c) const;
    Case benches(Chance& c) const;
    Case journals(Chance& c) const;
    Case joint_models(Chance& c) const;

private:
    std::string lines(Chance& c, double odd, int most, bool in_script = false) const;

    Vocabulary vocabulary_;
    DeckLines lines_;
    FishSoup fish_;
    LuaSoup lua_;
    std::string journal_;
};

struct Kind {
    std::string_view name;
    std::string_view help;
    Case (Cases::*make)(Chance&) const;
    double
        least; ///< fractions of cases that must end normally and that must be refused; otherwise the test is too weak
};
std::span<const Kind> kinds();

} // namespace kaya::soak
