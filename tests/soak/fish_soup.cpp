#include "fish_soup.hpp"

#include "scenes.hpp"

#include <array>
#include <fmt/format.h>

namespace kaya::soak {

namespace {

constexpr std::array variables{"v1", "v2", "v3", "v4", "v5", "list"};
constexpr std::array operators{"+", "-", "*", "/", "^", "=", "#", "<", ">", "<=", ">=", "&", "|"};

std::string indented(const std::string& text) { return "  " + text + "\n"; }

} // namespace

std::string FishSoup::literal(Chance& c) const {
    switch (c.below(9)) {
    case 0: return std::to_string(c.below(5));
    case 1: return c.heads() ? "-1" : "9223372036854775807";
    case 2: return fmt::format("{:.3g}", c.between(-2, 2));
    case 3: return c.heads() ? "1e308" : "-1e-320";
    case 4: return "'text " + std::string(static_cast<std::size_t>(c.scale(1, 300)), 'x') + "'";
    case 5: return "''";
    case 6: return "null";
    case 7: return "vector(1,0,2)";
    default: return c.of(variables);
    }
}

std::string FishSoup::object(Chance& c, const Vocabulary::Kind* kind) const {
    if (kind == nullptr || c.heads(0.1)) kind = &c.of(vocabulary_.kinds);
    if (kind->objects.empty() || c.heads(0.3)) return c.of(variables);
    return c.of(kind->objects);
}

std::string FishSoup::call(const Vocabulary::Name& name, Chance& c, int depth) const {
    int count = name.least + c.below(name.most - name.least + 1);
    if (c.heads(0.005)) count += c.heads() ? 1 : -1;
    if (count <= 0) return name.name;
    std::vector<std::string> arguments;
    const Vocabulary::Kind* kind = vocabulary_.kind_of(name.name);
    for (int k = 0; k < count; ++k)
        arguments.push_back(k == 0 && kind != nullptr && c.heads(0.9) ? object(c, kind) : expression(c, depth + 1));
    return name.name + "(" + join(arguments, ",") + ")";
}

std::string FishSoup::expression(Chance& c, int depth) const {
    if (depth > 4) return literal(c);
    switch (c.below(8)) {
    case 0:
    case 1: return literal(c);
    case 2: return object(c, nullptr);
    case 3: return fmt::format("({} {} {})", expression(c, depth + 1), c.of(operators), expression(c, depth + 1));
    case 4: return "-" + expression(c, depth + 1);
    case 5: return fmt::format("list({})", expression(c, depth + 1));
    default: return call(c.of(vocabulary_.fish), c, depth);
    }
}

std::string FishSoup::commands(Chance& c) const {
    static constexpr std::array structural{"delete range z 1 3",
                                           "new",
                                           "gen edge 0.6",
                                           "cycle 1",
                                           "save here",
                                           "restore here",
                                           "jset dip 45",
                                           "hide range z 0 1",
                                           "seek",
                                           "reset disp",
                                           "join range z 0 2",
                                           "excavate range z 1 3",
                                           "copy 0 0 3"};
    std::string text = "command\n";
    for (int k = 1 + c.below(2); k > 0; --k)
        text += indented(c.heads(0.6) ? c.of(structural) : lines_.short_line(c, 0.1));
    return text + "endcommand";
}

std::string FishSoup::block(Chance& c, int depth) const {
    std::string text;
    for (int k = 1 + c.below(3); k > 0; --k) text += indented(statement(c, depth + 1));
    return text;
}

std::string FishSoup::statement(Chance& c, int depth) const {
    if (depth > 3) return fmt::format("{} = {}", c.of(variables), expression(c, 1));
    switch (c.below(14)) {
    case 0: return fmt::format("if {} then\n{}else\n{}endif", expression(c, 2), block(c, depth), block(c, depth));
    case 1: return fmt::format("loop n (1, {})\n{}endloop", 1 + c.below(4), block(c, depth));
    case 2: {
        const auto& kind = c.of(vocabulary_.kinds);
        static constexpr std::array lists{"block.list", "block.gp.list", "block.contact.list", "block.zone.list",
                                          "list"};
        return kind.objects.empty() ? "null"
                                    : fmt::format("loop foreach v1 {}\n{}endloop", c.of(lists), block(c, depth));
    }
    case 3: return fmt::format("case_of {}\n{}case 1\n{}endcase", expression(c, 2), block(c, depth), block(c, depth));
    case 4: return fmt::format("array list({})", c.heads(0.8) ? std::to_string(1 + c.below(9)) : expression(c, 3));
    case 5: return commands(c);
    case 6: return fmt::format("{} = {}", c.of(variables), object(c, nullptr));
    case 7: return fmt::format("list({}) = {}", c.below(4), expression(c, 1));
    case 8: return "section\n" + block(c, depth) + "exit section\nendsection";
    case 9:
    case 10:
    case 11: {
        const auto* name = &c.of(vocabulary_.fish);
        while (!name->writable) name = &c.of(vocabulary_.fish);
        return fmt::format("{} = {}", call(*name, c, 2), expression(c, 2));
    }
    default: return fmt::format("{} = {}", c.of(variables), expression(c, 0));
    }
}

std::string FishSoup::function(const std::string& name, Chance& c) const {
    std::string text = "def " + name + "\n";
    if (c.heads(0.05)) text += "whilestepping\n";
    for (int k = 2 + c.below(6); k > 0; --k) text += indented(statement(c, 0));
    return text + indented(name + " = " + expression(c, 1)) + "end\n";
}

} // namespace kaya::soak
