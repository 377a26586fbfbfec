#include "lua_soup.hpp"

#include <array>
#include <fmt/format.h>

namespace kaya::soak {

namespace {

constexpr std::array variables{"a", "b", "c", "d", "object", "list"};

constexpr std::array library{"string.rep",
                             "string.format",
                             "string.find",
                             "string.gsub",
                             "string.match",
                             "string.gmatch",
                             "string.sub",
                             "string.byte",
                             "string.char",
                             "string.pack",
                             "string.unpack",
                             "string.reverse",
                             "table.concat",
                             "table.insert",
                             "table.remove",
                             "table.sort",
                             "table.unpack",
                             "table.move",
                             "table.pack",
                             "math.floor",
                             "math.tointeger",
                             "math.random",
                             "math.fmod",
                             "math.ult",
                             "tostring",
                             "tonumber",
                             "select",
                             "next",
                             "rawget",
                             "rawset",
                             "rawequal",
                             "rawlen",
                             "setmetatable",
                             "getmetatable",
                             "pcall",
                             "xpcall",
                             "error",
                             "assert",
                             "load",
                             "require",
                             "os.date",
                             "os.time",
                             "os.clock",
                             "io.open",
                             "io.write",
                             "io.lines",
                             "utf8.char",
                             "utf8.codepoint",
                             "utf8.offset",
                             "nearest",
                             "count",
                             "sum",
                             "mean",
                             "minimum",
                             "maximum",
                             "vector",
                             "property",
                             "set_property",
                             "history.add",
                             "hook.after_cycle",
                             "hook.before_cycle",
                             "hook.after_forces",
                             "hook.remove",
                             "command",
                             "capture",
                             "print",
                             "type",
                             "ipairs",
                             "pairs",
                             "model.save",
                             "model.restore",
                             "model.reset",
                             "collectgarbage",
                             "coroutine.create",
                             "debug.getinfo",
                             "os.execute",
                             "dofile"};

} // namespace

std::string LuaSoup::field(Chance& c) const {
    const auto& kind = c.of(vocabulary_.kinds);
    return kind.fields.empty() || c.heads(0.05) ? "no_such_field" : c.of(kind.fields);
}

std::string LuaSoup::object(Chance& c) const {
    static constexpr std::array more{"model.last_block", "object", "model", "history[1]", "tables[1]", "nil"};
    if (c.heads(0.3)) return c.of(more);
    return fmt::format("nearest('{}', {}, 0.5, 1.2)", c.of(vocabulary_.kinds).name, plain_number(c));
}

std::string LuaSoup::library_call(Chance& c, int depth) const {
    std::vector<std::string> arguments;
    for (int k = c.below(4); k > 0; --k) arguments.push_back(expression(c, depth + 1));
    return fmt::format("{}({})", c.of(library), join(arguments, ", "));
}

std::string LuaSoup::expression(Chance& c, int depth) const {
    static constexpr std::array texts{"''",         "'%d %s %99999f'", "'(.-)*%f[%w]'",  "string.rep('a', 1000000)",
                                      "'block'",    "'gridpoint'",     "'normal_force'", "'\\0\\255'",
                                      "'return 1'", "'low'",           "'../x'"};
    if (depth > 3) return c.of(variables);
    switch (c.below(13)) {
    case 0: return c.heads(0.7) ? plain_number(c) : "math.mininteger";
    case 1: return c.of(texts);
    case 2: return c.of(variables);
    case 3: return object(c) + "." + field(c);
    case 4: return library_call(c, depth);
    case 5: return fmt::format("{{{}, x = {}}}", expression(c, depth + 1), expression(c, depth + 1));
    case 6: return "vector(1, 2, 3)";
    case 7: return fmt::format("function(...) return {} end", expression(c, depth + 1));
    case 8: {
        const auto& name = c.of(vocabulary_.fish);
        return fmt::format("fish['{}']({})", name.name, name.least > 0 ? expression(c, depth + 1) : "");
    }
    case 9: return object(c);
    case 10: return fmt::format("({} .. {})", expression(c, depth + 1), expression(c, depth + 1));
    case 11: return c.heads() ? "0/0" : "1e308 * 10";
    default: return fmt::format("({} + {})", expression(c, depth + 1), expression(c, depth + 1));
    }
}

std::string LuaSoup::statement(Chance& c) const {
    switch (c.below(12)) {
    case 0: return fmt::format("object = {}", object(c));
    case 1:
    case 2: return fmt::format("local o = {} o.{} = {}", object(c), field(c), expression(c, 1));
    case 3: return fmt::format("command [[{}]]", lines_.short_line(c, 0.1));
    case 4: {
        static constexpr std::array changes{"delete range z 1 3", "new",         "gen edge 0.6", "cycle 2",
                                            "save here",          "restore here"};
        return fmt::format("command '{}'", c.of(changes));
    }
    case 5:
        return fmt::format("for o in {}s() do a = o.{} o.{} = {} end", c.of(vocabulary_.kinds).name, field(c), field(c),
                           expression(c, 2));
    case 6:
        return fmt::format("for o in {}s() do command 'delete range z 1 3' b = o.{} end", c.of(vocabulary_.kinds).name,
                           field(c));
    case 7: return fmt::format("tables[{}] = {}", number(c), expression(c, 1));
    case 8:
        return fmt::format(
            "setmetatable({}, {{__index = function(t, k) return {} end, __tostring = function() return {} end}})",
            c.of(variables), expression(c, 2), expression(c, 2));
    case 9:
        return fmt::format("hook.after_cycle(function() {} = {} end, {})", c.of(variables), expression(c, 1),
                           1 + c.below(3));
    case 10: return library_call(c, 0);
    default: return fmt::format("{} = {}", c.of(variables), expression(c, 0));
    }
}

std::string LuaSoup::chunk(Chance& c) const {
    std::string text = "lua\n";
    for (int k = 3 + c.below(12); k > 0; --k) text += fmt::format("try(function() {} end)\n", statement(c));
    return text + "endlua\n";
}

} // namespace kaya::soak
