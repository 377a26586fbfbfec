// Built-in functions of FISH on texts, conversions, arrays, and output.
#include "base/lower_case.hpp"
#include "lang/script/libraries/families.hpp"
#include "lang/script/names/built_ins.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"
#include "lang/script/values/handles.hpp"
#include "lang/script/values/value_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace kaya::script {

namespace {

void push_text(lua_State* L, std::string_view text) { lua_pushlstring(L, text.data(), text.size()); }

constexpr std::int64_t widest_field = 1000;
constexpr int most_values = 50; ///< of buildstr

/// string(value [, width [, fill [, digits]]])
int string(lua_State* L) {
    // A pointer shows as its number, as in 3DEC.
    std::string text = lua_type(L, 1) == LUA_TLIGHTUSERDATA
                           ? fmt::format("{}", handle_number(world_of(L), unpack_handle(lua_touserdata(L, 1))))
                           : text_at(L, 1);
    if (lua_gettop(L) == 4 && lua_type(L, 1) == LUA_TNUMBER && !lua_isinteger(L, 1)) {
        const std::int64_t digits = std::clamp<std::int64_t>(integer_argument(L, 4, "string"), 1, 40);
        text = fmt::format("{:.{}g}", lua_tonumber(L, 1), static_cast<int>(digits));
    }
    if (lua_gettop(L) >= 2) {
        const auto width =
            static_cast<std::size_t>(std::clamp<std::int64_t>(integer_argument(L, 2, "string"), 0, widest_field));
        const std::string fill =
            lua_gettop(L) >= 3 && lua_type(L, 3) == LUA_TSTRING ? text_argument(L, 3, "string") : " ";
        if (text.size() < width) text.insert(0, width - text.size(), fill.empty() ? ' ' : fill[0]);
    }
    push_text(L, text);
    return 1;
}

/// A number in a text; false when the whole text is none.
bool push_number(lua_State* L, std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    if (text.empty()) return false;
    const char* end = text.data() + text.size();
    std::int64_t whole = 0;
    if (const auto result = std::from_chars(text.data(), end, whole); result.ec == std::errc{} && result.ptr == end) {
        lua_pushinteger(L, whole);
        return true;
    }
    double number = 0;
    if (const auto result = std::from_chars(text.data(), end, number); result.ec != std::errc{} || result.ptr != end)
        return false;
    lua_pushnumber(L, number);
    return true;
}

double number_from(lua_State* L, const char* function) {
    if (lua_type(L, 1) != LUA_TSTRING) return number_argument(L, 1, function);
    const std::string text = text_argument(L, 1, function);
    if (!push_number(L, text))
        throw Diagnostic(fmt::format("'{}' is given the text '{}', which is not a number", function, text), {},
                         Fault::run);
    return lua_tonumber(L, -1);
}

int to_integer(lua_State* L) {
    if (lua_isinteger(L, 1)) {
        lua_settop(L, 1);
        return 1;
    }
    const double number = std::trunc(number_from(L, "int"));
    if (!(std::abs(number) < 0x1p63))
        throw Diagnostic(fmt::format("{:g} is too large for an integer", number), {}, Fault::run);
    lua_pushinteger(L, static_cast<lua_Integer>(number));
    return 1;
}

int to_real(lua_State* L) {
    lua_pushnumber(L, number_from(L, "float"));
    return 1;
}

int length(lua_State* L) {
    lua_pushinteger(L, static_cast<lua_Integer>(text_argument(L, 1, "strlen").size()));
    return 1;
}

/// substr(text, first [, count]); positions outside of the text are ignored.
int part(lua_State* L) {
    const std::string text = text_argument(L, 1, "substr");
    const auto size = static_cast<std::int64_t>(text.size());
    const std::int64_t first = std::clamp<std::int64_t>(integer_argument(L, 2, "substr"), 1, size + 1);
    const std::int64_t rest = size - first + 1;
    const std::int64_t count =
        lua_gettop(L) == 3 ? std::clamp<std::int64_t>(integer_argument(L, 3, "substr"), 0, rest) : rest;
    push_text(L, std::string_view(text).substr(static_cast<std::size_t>(first - 1), static_cast<std::size_t>(count)));
    return 1;
}

int to_lower(lua_State* L) {
    push_text(L, kaya::lower_case(text_argument(L, 1, "tolower")));
    return 1;
}

int to_upper(lua_State* L) {
    std::string text = text_argument(L, 1, "toupper");
    for (char& c : text)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    push_text(L, text);
    return 1;
}

/// index(text, part): place of the part, 0 when it is not there.
int find(lua_State* L) {
    const auto at = text_argument(L, 1, "index").find(text_argument(L, 2, "index"));
    lua_pushinteger(L, at == std::string::npos ? 0 : static_cast<lua_Integer>(at) + 1);
    return 1;
}

int character(lua_State* L) {
    const std::int64_t code = integer_argument(L, 1, "char");
    if (code < 1 || code > 255)
        throw Diagnostic(fmt::format("'char' is given {}; characters have the numbers 1 to 255", code), {}, Fault::run);
    const char c = static_cast<char>(code);
    push_text(L, {&c, 1});
    return 1;
}

/// The i-th word of a text into `word`; false when there are fewer words.
bool find_word(const std::string& text, std::int64_t wanted, std::string_view& word) {
    constexpr std::string_view blanks = " \t,()=\r\n";
    std::size_t at = 0;
    while ((at = text.find_first_not_of(blanks, at)) != std::string::npos) {
        std::size_t from = at, end = 0;
        if (text[at] == '\'' || text[at] == '"') {
            from = at + 1;
            end = text.find(text[at], from);
            at = end == std::string::npos ? text.size() : end + 1;
        } else {
            end = text.find_first_of(blanks, at);
            at = end;
        }
        word = std::string_view(text).substr(from, end == std::string::npos ? end : end - from);
        if (--wanted == 0) return true;
        if (at == std::string::npos) break;
    }
    return false;
}

/// parse(text, i): the i-th word, as a number when it is one; 0 when there are fewer words.
int parse(lua_State* L) {
    const std::string text = text_argument(L, 1, "parse");
    std::string_view word;
    if (!find_word(text, integer_argument(L, 2, "parse"), word)) lua_pushinteger(L, 0);
    else if (!push_number(L, word)) push_text(L, word);
    return 1;
}

/// pre_parse(text, i): the i-th word as a text; empty when there are fewer words.
int pre_parse(lua_State* L) {
    const std::string text = text_argument(L, 1, "pre_parse");
    std::string_view word;
    push_text(L, find_word(text, integer_argument(L, 2, "pre_parse"), word) ? word : std::string_view{});
    return 1;
}

/// buildstr(pattern, a, b, ...): %1, %2, ... in the pattern become the values; %% is a %.
int build_text(lua_State* L) {
    const std::string pattern = text_argument(L, 1, "buildstr");
    const int values = lua_gettop(L) - 1;
    std::string text;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        const char next = i + 1 < pattern.size() ? pattern[i + 1] : '\0';
        if (pattern[i] != '%' || (next != '%' && (next < '1' || next > '9'))) {
            text += pattern[i];
            continue;
        }
        ++i;
        if (next == '%') {
            text += '%';
            continue;
        }
        int number = next - '0';
        while (i + 1 < pattern.size() && pattern[i + 1] >= '0' && pattern[i + 1] <= '9' && number < most_values)
            number = 10 * number + (pattern[++i] - '0');
        if (number > values)
            throw Diagnostic(fmt::format("'buildstr' has no value for %{}: it is given {}", number, values), {},
                             Fault::run);
        text += text_at(L, number + 1);
    }
    push_text(L, text);
    return 1;
}

/// get_array(n [, m ...]): a new array, filled with 0.
int new_array(lua_State* L) {
    const int sizes = lua_gettop(L);
    push_runtime(L, "array");
    lua_pushstring(L, "get_array");
    lua_pushnil(L); // no result
    for (int i = 1; i <= sizes; ++i) lua_pushvalue(L, i);
    lua_call(L, sizes + 2, 1);
    return 1;
}

/// Arrays are freed when no variable holds them.
int lose_array(lua_State* L) {
    lua_pushinteger(L, 0);
    return 1;
}

int code_name(lua_State* L) {
    push_text(L, "kaya");
    return 1;
}

/// type(x): 1 integer, 2 real, 3 text, 4 pointer, 5 array, 6 vector.
int type(lua_State* L) {
    int number = 5;
    switch (lua_type(L, 1)) {
    case LUA_TNUMBER: number = lua_isinteger(L, 1) ? 1 : 2; break;
    case LUA_TSTRING: number = 3; break;
    case LUA_TLIGHTUSERDATA: number = 4; break;
    case LUA_TUSERDATA: number = 6; break;
    default: break;
    }
    lua_pushinteger(L, number);
    return 1;
}

int out(lua_State* L) {
    print_line(L, text_at(L, 1));
    lua_pushinteger(L, 0);
    return 1;
}

int no_error(lua_State* L) {
    lua_pushinteger(L, 0);
    return 1;
}

/// `error = 'text'` stops everything with that text.
int raise(lua_State* L) { throw Diagnostic(text_at(L, 1), {}, Fault::run); }

/// Pushes the sizes of the array at `index`.
void push_dimensions(lua_State* L, int index, const char* function) {
    if (!is_array(L, index)) fail_argument(L, index, function, "an array");
    lua_getfield(L, index, "dimensions");
}

int array_dimensions(lua_State* L) {
    push_dimensions(L, 1, "array_dim");
    lua_pushinteger(L, static_cast<lua_Integer>(lua_rawlen(L, -1)));
    return 1;
}

int array_size(lua_State* L) {
    const std::int64_t wanted = integer_argument(L, 2, "array_size");
    push_dimensions(L, 1, "array_size");
    if (wanted < 1 || wanted > static_cast<std::int64_t>(lua_rawlen(L, -1)))
        throw Diagnostic(fmt::format("the array has no dimension {}", wanted), {}, Fault::run);
    lua_rawgeti(L, -1, wanted);
    return 1;
}

constexpr std::array text_functions{
    BuiltInFunction{"string", 1, 4, guarded<string>},
    BuiltInFunction{"int", 1, 1, guarded<to_integer>},
    BuiltInFunction{"float", 1, 1, guarded<to_real>},
    BuiltInFunction{"strlen", 1, 1, guarded<length>},
    BuiltInFunction{"substr", 2, 3, guarded<part>},
    BuiltInFunction{"tolower", 1, 1, guarded<to_lower>},
    BuiltInFunction{"toupper", 1, 1, guarded<to_upper>},
    BuiltInFunction{"index", 2, 2, guarded<find>},
    BuiltInFunction{"char", 1, 1, guarded<character>},
    BuiltInFunction{"parse", 2, 2, guarded<parse>},
    BuiltInFunction{"pre_parse", 2, 2, guarded<pre_parse>},
    BuiltInFunction{"buildstr", 1, most_values, guarded<build_text>},
    BuiltInFunction{"get_array", 1, 10, guarded<new_array>},
    BuiltInFunction{"lose_array", 1, 1, guarded<lose_array>},
    BuiltInFunction{"code_name", 0, 0, guarded<code_name>},
    BuiltInFunction{"notify", 1, 1, guarded<out>},
    BuiltInFunction{"type", 1, 1, guarded<type>},
    BuiltInFunction{"out", 1, 1, guarded<out>},
    BuiltInFunction{"error", 0, 0, guarded<no_error>, guarded<raise>},
    BuiltInFunction{"array_dim", 1, 1, guarded<array_dimensions>},
    BuiltInFunction{"array_size", 2, 2, guarded<array_size>},
};

} // namespace

void add_texts(lua_State* L) { add_built_ins(L, text_functions); }

} // namespace kaya::script
