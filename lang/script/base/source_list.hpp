// Every piece of text that became Lua code, so that a line of Lua finds its line of the deck.
#pragma once

#include "base/diagnostic.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace kaya::script {

struct Source {
    std::string title; ///< name of the FISH function, or "" for a Lua chunk and an expression
    Place first;       ///< of Lua line 1
    bool is_fish = true;
};

class SourceList {
public:
    /// Chunk name to give to Lua: "=fish#3" or "=lua#3".
    std::string add(Source source);
    /// The source of a chunk name, or null.
    const Source* find(std::string_view chunk_name) const;
    void clear() { sources_.clear(); }

private:
    std::vector<Source> sources_;
};

/// Place of a whole line, from its first to its last character without surrounding blanks.
Place line_place(const Source& source, int lua_line);

/// Cuts "fish#3:12: text" into chunk, line and text. False when the message has no such head.
bool split_message(std::string_view message, std::string_view& chunk, int& line, std::string_view& text);

} // namespace kaya::script
