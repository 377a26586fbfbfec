// Objects that a deck makes and other lines of it use: blocks, groups, named ranges, tables, histories.
#pragma once

#include "lang/commands/commands.hpp"
#include "lang/interp/bare_names.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// Fed with the statements of a deck in their order, before any of it runs.
class DeckObjects {
public:
    /// `inside`: of a function, which may run at any time: it makes objects, and its uses are not looked up.
    void check(const lang::BoundCommand& command, bool inside);
    /// A text of FISH or Lua, which may make any object that it mentions.
    void check_script(std::string_view text);
    /// Files unknown before the run, or a model that is there already.
    void anything_may_be_made();

    std::vector<Diagnostic> findings() const;

private:
    enum class Kind { group, range, table };
    struct Use {
        Kind kind;
        std::string name;
        Place place;
    };
    void make(const lang::BoundCommand& command);
    void make_history(const lang::BoundCommand& command);
    void check_names(const lang::BoundCommand& command);
    void check_histories(const lang::BoundCommand& command);
    void check_plot(const lang::Plot& plot, const lang::BoundCommand& command);
    void check_order(const lang::BoundCommand& command);
    void use(Kind kind, const std::string& name, const Place& place);
    void use_history(std::int64_t number, const lang::BoundCommand& command, Severity severity);
    void forget();
    const std::map<std::string, Place>& made(Kind kind) const { return made_[static_cast<std::size_t>(kind)]; }

    std::array<std::map<std::string, Place>, 3>
        made_;                   ///< by Kind: name in lower case, and the line that makes it first
    std::array<bool, 3> open_{}; ///< by Kind: something unknown may make more
    std::vector<Use> missing_;   ///< nothing has made them yet
    std::set<std::int64_t> histories_;
    std::set<std::string> history_names_;
    struct Idle {
        const char* what;
        Place place;
    };
    std::vector<Idle> idle_; ///< histories and loads since the last cycle
    bool histories_open_ = false, blocks_ = false, cycled_ = false, ended_ = false;
    int made_plots_ = 0; ///< lines that describe a picture for a later line
    std::vector<Diagnostic> found_;
};

} // namespace kaya
