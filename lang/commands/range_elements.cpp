// The range phrase as a table: each element reads its parts and adds one RangeElement.
#include "lang/commands/range_parts.hpp"
#include "lang/commands/slots.hpp"

#include "lang/interp/short_list.hpp"

#include <fmt/format.h>

namespace kaya::lang {

RangeElement& add(Reader& reader, RangePhrase& phrase, RangeElement::Kind kind) {
    RangeElement element;
    element.kind = kind;
    element.place = reader.previous().place;
    phrase.elements.push_back(std::move(element));
    return phrase.elements.back();
}

void misspelt_part(const Reader& reader, std::string_view element, const std::vector<KeywordSpec>& words) {
    const Word* next = reader.peek();
    std::vector<std::string_view> candidates;
    for (const auto& keyword : words)
        for (const Spelling& s : keyword.words) candidates.push_back(s.word);
    if (next && next->kind == WordKind::word && !find_keyword(range_elements(), next->folded) &&
        !did_you_mean(next->folded, candidates).empty())
        reader.unknown(fmt::format("a word of {}", element), candidates);
}

void lacks_part(const Reader& reader, std::string_view element, const std::vector<KeywordSpec>& words,
                std::string message, std::string hint) {
    misspelt_part(reader, element, words);
    incomplete_line(reader, std::move(message), std::move(hint));
}

namespace {

using Kind = RangeElement::Kind;

/// One or two numbers; one alone is both limits.
void read_limits(Reader& reader, RangeElement& element, const ArgumentSpec& low, const ArgumentSpec& high) {
    const bool whole = low.kind == ArgumentKind::integer;
    const auto number = [&](const ArgumentSpec& a) {
        return whole ? static_cast<double>(reader.integer(a)) : reader.real(a);
    };
    element.low = element.high = number(low);
    if (!reader.at_number()) return;
    element.high = number(high);
    if (element.low > element.high && !reader.wildcards())
        throw Diagnostic(
            fmt::format("the lower limit {:g} is greater than the upper limit {:g}", element.low, element.high),
            "write the smaller one first")
            .at(reader.previous().place);
}

void add_coordinate(Keywords<RangePhrase>& table, std::vector<Spelling> words, Kind kind, std::string_view help) {
    const auto low = real("low").unit("length").spec;
    const auto high = real("high").unit("length").optional().spec;
    table.special(
        std::move(words), {low, high},
        [=](Reader& reader, RangePhrase& phrase) { read_limits(reader, add(reader, phrase, kind), low, high); }, help);
}

void numbers(Keywords<RangePhrase>& table, std::vector<Spelling> words, Kind kind, std::string_view help) {
    const auto low = integer("n").spec;
    const auto high = integer("m").optional().spec;
    table.special(
        std::move(words), {low, high},
        [=](Reader& reader, RangePhrase& phrase) { read_limits(reader, add(reader, phrase, kind), low, high); }, help);
}

void named(Keywords<RangePhrase>& table, std::vector<Spelling> words, Kind kind, std::string_view help) {
    const auto name = text("name").spec;
    table.special(
        std::move(words), {name},
        [=](Reader& reader, RangePhrase& phrase) {
            add(reader, phrase, kind);
            phrase.elements.back().name = reader.text(name);
        },
        help);
}

void add_flag(Keywords<RangePhrase>& table, std::vector<Spelling> words, Kind kind, std::string_view help) {
    table.special(
        std::move(words), {},
        [=](Reader& reader, RangePhrase& phrase) {
            add(reader, phrase, kind);
            const Word* word = reader.peek();
            const bool on = word && word->folded == "on", off = word && word->folded == "off";
            if (on || off) reader.take();
            phrase.elements.back().negated = off;
        },
        help);
}

/// A number, or several numbers: one of them is enough.
void numbered(Keywords<RangePhrase>& table, std::vector<Spelling> words, Kind kind, std::string_view help) {
    ArgumentSpec number = integer("n").spec;
    number.repeated = true;
    table.special(
        std::move(words), {number},
        [=](Reader& reader, RangePhrase& phrase) {
            RangeElement& element = add(reader, phrase, kind);
            element.low = element.high = static_cast<double>(reader.integer(number));
            if (!reader.at_number()) return;
            element.numbers.push_back(static_cast<std::int64_t>(element.low));
            while (reader.at_number()) element.numbers.push_back(reader.integer(number));
        },
        help);
}

void both_sides(Keywords<RangePhrase>& table, std::vector<Spelling> words, Kind kind, std::string_view help) {
    const auto first = integer("n").spec, second = integer("m").spec;
    table.special(
        std::move(words), {first, second},
        [=](Reader& reader, RangePhrase& phrase) {
            RangeElement& element = add(reader, phrase, kind);
            element.low = static_cast<double>(reader.integer(first));
            element.high = static_cast<double>(reader.integer(second));
        },
        help);
}

/// `group NAME [slot s] [matches n]`, or NAME alone with its slot in it.
void group(Keywords<RangePhrase>& table) {
    const auto name = text("name").spec;
    const auto matches = integer("n").at_least(1).at_most(2).spec;
    static const std::vector<KeywordSpec> words = [&] {
        Keywords<RangeElement> list;
        list.special(
            {Spelling{"matches", 3}}, {matches},
            [matches](Reader& reader, RangeElement& e) { e.both = reader.integer(matches) == 2; },
            "of contacts: 1, one of the two blocks is enough (if not given); 2, both must belong");
        list.action(
                {Spelling{"only", 3}}, [](RangeElement&) {}, "a block is in one group only: without effect")
            .ignored();
        list.special(
            {Spelling{"slot", 3}}, {name},
            [](Reader& reader, RangeElement& e) { slot_words().front().read(reader, &e.name); },
            "the slot of the group, or `any`; the default one if it has the group, else any");
        return std::move(list).list();
    }();
    table.special(
        {"group"}, {name},
        [=](Reader& reader, RangePhrase& phrase) {
            add(reader, phrase, Kind::group);
            phrase.elements.back().name = reader.text(name);
            read_keywords(reader, words, &phrase.elements.back());
            misspelt_part(reader, "group", words);
        },
        "members of a group", words);
}

void group_intersection(Keywords<RangePhrase>& table) {
    const auto first = text("name").spec, second = text("other").spec;
    table.special(
        {"gintersection", "group-intersection"}, {first, second},
        [=](Reader& reader, RangePhrase& phrase) {
            RangeElement& element = add(reader, phrase, Kind::group_intersection);
            element.name = reader.text(first);
            element.second_name = reader.text(second);
        },
        "contacts between blocks of two groups");
}

/// Two limits, both of which must be given.
void between_limits(Keywords<RangePhrase>& table, std::vector<Spelling> words, Kind kind, std::string_view unit,
                    std::string_view help) {
    const auto low = real("low").unit(unit).at_least(0).spec, high = real("high").unit(unit).spec;
    table.special(
        std::move(words), {low, high},
        [=](Reader& reader, RangePhrase& phrase) {
            RangeElement& element = add(reader, phrase, kind);
            if (reader.at_end()) reader.missing(low);
            element.low = reader.real(low);
            element.high = reader.real(high);
            if (element.low > element.high && !reader.wildcards())
                throw Diagnostic(
                    fmt::format("the lower limit {:g} is greater than the upper limit {:g}", element.low, element.high),
                    "write the smaller one first")
                    .at(reader.previous().place);
        },
        help);
}

void id_list(Keywords<RangePhrase>& table) {
    ArgumentSpec number = integer("n").spec;
    number.repeated = true;
    table.special(
        {"id-list", "idlist"}, {number},
        [=](Reader& reader, RangePhrase& phrase) {
            RangeElement& element = add(reader, phrase, Kind::id_list);
            do element.numbers.push_back(reader.integer(number));
            while (reader.at_number());
        },
        "identity numbers, one by one");
}

/// Elements of 3DEC that have no meaning in this engine yet.
void elements_to_come(Keywords<RangePhrase>& table) {
    static constexpr std::pair<const char*, const char*> known[] = {
        {"sregion", "regions of surfaces"},
    };
    for (const auto& [word, help] : known) table.not_yet({Spelling{word, 4}}, help);
}

/// `block id 5`: the old long form of `bid 5`.
void block_id(Keywords<RangePhrase>& table) {
    const auto low = integer("n").spec, high = integer("m").optional().spec;
    table.special(
        {Spelling{"block", 3}}, {low, high},
        [=](Reader& reader, RangePhrase& phrase) {
            RangeElement& element = add(reader, phrase, Kind::block_id);
            const Word* word = reader.peek();
            if (word && word->folded != "id") reader.unknown("the word 'id' of block id", {"id"});
            if (word) reader.take();
            read_limits(reader, element, low, high);
        },
        "`block id n`: the same as bid");
}

/// `dfn NAME [distance d]`.
void network(Keywords<RangePhrase>& table) {
    const auto name = text("name").spec, far = real("d").unit("length").at_least(0).spec;
    static const std::vector<KeywordSpec> words = [&] {
        Keywords<RangeElement> list;
        list.special(
            {Spelling{"distance", 4}}, {far},
            [far](Reader& reader, RangeElement& e) {
                e.side = 1;
                e.distance = reader.real(far);
            },
            "objects whose centre is within this distance of a fracture, whether it has cut them or not");
        return std::move(list).list();
    }();
    table.special(
        {"dfn"}, {name},
        [=](Reader& reader, RangePhrase& phrase) {
            add(reader, phrase, Kind::network);
            phrase.elements.back().name = reader.text(name);
            read_keywords(reader, words, &phrase.elements.back());
            misspelt_part(reader, "dfn", words);
        },
        "contacts and faces that the fractures of a network have cut, and blocks with such a face", words);
}

/// Several names may follow one nrange; each is a separate element.
void named_ranges(Keywords<RangePhrase>& table) {
    const auto name = text("name").spec;
    table.special(
        {"nrange", "name"}, {name},
        [=](Reader& reader, RangePhrase& phrase) {
            add(reader, phrase, Kind::named);
            phrase.elements.back().name = reader.text(name);
            while (const Word* word = reader.peek()) {
                const bool another = word->kind == WordKind::text ||
                                     (word->kind == WordKind::word && !find_keyword(range_elements(), word->folded));
                if (!another) return;
                reader.take();
                add(reader, phrase, Kind::named).name = word->text;
            }
        },
        "a range that was given a name with range name");
}

/// Elements whose parts need a special reader; some of them cover all kinds of a group.
void own_element(Keywords<RangePhrase>& table, Kind kind) {
    switch (kind) {
    case Kind::box: return space_elements(table);
    case Kind::polygon: return figure_elements(table);
    case Kind::group: return group(table);
    case Kind::group_intersection: return group_intersection(table);
    case Kind::block_id: return block_id(table);
    case Kind::named: return named_ranges(table);
    case Kind::id_list: return id_list(table);
    case Kind::network: return network(table);
    default: break;
    }
}

void add_element(Keywords<RangePhrase>& table, const RangeWords& row) {
    using enum RangeWords::Form;
    switch (row.form) {
    case coordinate: return add_coordinate(table, row.words, row.kind, row.help);
    case number: return numbered(table, row.words, row.kind, row.help);
    case limits_of_numbers: return numbers(table, row.words, row.kind, row.help);
    case two_numbers: return both_sides(table, row.words, row.kind, row.help);
    case limits: return between_limits(table, row.words, row.kind, row.unit, row.help);
    case name: return named(table, row.words, row.kind, row.help);
    case flag: return add_flag(table, row.words, row.kind, row.help);
    case own: return own_element(table, row.kind);
    }
}

std::vector<KeywordSpec> all_elements() {
    Keywords<RangePhrase> table;
    for (const RangeWords& row : range_words()) add_element(table, row);
    table.action(
        {"extent"}, [](RangePhrase& phrase) { phrase.whole = true; },
        "all corners of a block, a face or a zone must lie inside, not only its centroid");
    table.action(
        {"union"}, [](RangePhrase& phrase) { phrase.any = true; }, "one element is enough, not all are needed");
    table.special(
        {Spelling{"not", 3}}, {},
        [](Reader& reader, RangePhrase& phrase) {
            if (!phrase.elements.empty()) {
                phrase.elements.back().negated = true;
                return;
            }
            throw Diagnostic("'not' stands before the element that it negates", "write it after: range z 0 1 not")
                .at(reader.previous().place);
        },
        "negates the element before it");
    elements_to_come(table);
    return std::move(table).list();
}

[[noreturn]] void unknown_element(const Reader& reader, const RangeGrammar& grammar) {
    const bool asked = reader.peek()->text == "?";
    std::vector<std::string_view> candidates, listed;
    for (const auto& element : grammar.elements) {
        const bool there = element.support != Support::not_yet;
        if (there) listed.push_back(element.words.front().word);
        if (!there && asked) continue;
        for (const Spelling& s : element.words) candidates.push_back(s.word);
    }
    reader.unknown("a range element", candidates, ShortList(listed, "range", reader.peek()).words());
}

} // namespace

const std::vector<KeywordSpec>& range_elements() {
    static const std::vector<KeywordSpec> elements = all_elements();
    return elements;
}

const RangeGrammar& classic_ranges() {
    static const RangeGrammar grammar{range_elements(), "range z 0 1"};
    return grammar;
}

void read_range(Reader& reader, RangePhrase& phrase, const RangeGrammar& grammar) {
    const std::string example = fmt::format("write for example: {}", grammar.example);
    phrase.place = reader.peek()->place;
    // `ra` is enough, and no element starts so.
    if (Spelling{"range", 2}.matches(reader.peek()->folded)) {
        reader.take();
        reader.spell("range");
    }
    if (reader.at_end()) incomplete_line(reader, "the range is empty", example);
    while (!reader.at_end()) {
        read_keywords(reader, grammar.elements, &phrase);
        if (!reader.at_end()) unknown_element(reader, grammar);
    }
    if (phrase.elements.empty()) incomplete_line(reader, "the range has no element", example);
}

} // namespace kaya::lang
