#include "lang/script/base/source_list.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace kaya::script {

std::string SourceList::add(Source source) {
    sources_.push_back(std::move(source));
    return fmt::format("={}#{}", sources_.back().is_fish ? "fish" : "lua", sources_.size() - 1);
}

const Source* SourceList::find(std::string_view name) const {
    if (name.starts_with('=')) name.remove_prefix(1);
    const auto mark = name.find('#');
    if (mark == std::string_view::npos) return nullptr;
    if (name.substr(0, mark) != "fish" && name.substr(0, mark) != "lua") return nullptr;
    std::size_t number = 0;
    const auto result = std::from_chars(name.data() + mark + 1, name.data() + name.size(), number);
    if (result.ec != std::errc{} || number >= sources_.size()) return nullptr;
    return &sources_[number];
}

Place line_place(const Source& source, int lua_line) {
    Place place = source.first;
    if (!place) return place;
    place.line = source.first.line + std::max(lua_line, 1) - 1;
    place.column = 1;
    const auto& lines = place.source->lines;
    if (place.line > static_cast<int>(lines.size())) return place;
    const std::string& text = lines[place.line - 1];
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string::npos) return place;
    // A comment is not part of the place of an error.
    auto last = text.find_last_not_of(" \t\r", text.find(source.is_fish ? ";" : "--", first));
    if (last != std::string::npos && text.compare(last, 1, ";") == 0) last = text.find_last_not_of(" \t;", last);
    place.column = static_cast<int>(first) + 1;
    place.length = last == std::string::npos || last < first ? 1 : static_cast<int>(last - first) + 1;
    return place;
}

bool split_message(std::string_view message, std::string_view& chunk, int& line, std::string_view& text) {
    const auto first = message.find(':');
    if (first == std::string_view::npos) return false;
    const auto second = message.find(": ", first + 1);
    if (second == std::string_view::npos) return false;
    const auto result = std::from_chars(message.data() + first + 1, message.data() + second, line);
    if (result.ec != std::errc{} || result.ptr != message.data() + second) return false;
    chunk = message.substr(0, first);
    text = message.substr(second + 2);
    return chunk.find('#') != std::string_view::npos;
}

} // namespace kaya::script
