// The range phrase as a table: each element reads its parts and adds one RangeElement.
#include "lang/commands/range_parts.hpp"
#include "lang/commands/slots.hpp"

#include "lang/interp/short_list.hpp"

#include <fmt/format.h>

namespace kaya::lang {

Parts<RangePhrase> element(RangeElement::Kind kind, const Parts<RangeElement>& parts) {
    const auto next = next_of(&RangePhrase::elements);
    const Lens<RangePhrase, RangeElement> of_kind{[=](RangePhrase& phrase) -> RangeElement& {
                                                      RangeElement& made = next.open(phrase);
                                                      made.kind = kind;
                                                      return made;
                                                  },
                                                  [=](const RangePhrase& wanted, const RangePhrase& present) {
                                                      const RangeElement* found = next.wanted(wanted, present);
                                                      return found != nullptr && found->kind == kind ? found : nullptr;
                                                  }};
    return Parts<RangePhrase>().in(of_kind, Parts<RangeElement>().mark(&RangeElement::place).then(parts));
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

/// A whole number in a member that holds any number.
auto whole(double RangeElement::*member) {
    return Through{[member](RangeElement& e, std::int64_t n) { e.*member = static_cast<double>(n); },
                   [member](const RangeElement& e) { return std::optional(static_cast<std::int64_t>(e.*member)); }};
}

void check_order(Reader& reader, const RangeElement& e) {
    if (e.low > e.high && !reader.wildcards())
        throw Diagnostic(fmt::format("the lower limit {:g} is greater than the upper limit {:g}", e.low, e.high),
                         "write the smaller one first")
            .at(reader.previous().place);
}

/// One or two numbers; one alone is both limits.
Parts<RangeElement> one_or_two_limits(std::string_view unit) {
    return Parts<RangeElement>()
        .then(real("low").unit(unit), Through{[](RangeElement& e, double value) { e.low = e.high = value; },
                                              [](const RangeElement& e) { return std::optional(e.low); }})
        .maybe(real("high").unit(unit).optional(), &RangeElement::high)
        .check(check_order);
}
Parts<RangeElement> whole_limits() {
    return Parts<RangeElement>()
        .then(integer("n"), Through{[](RangeElement& e, std::int64_t n) { e.low = e.high = static_cast<double>(n); },
                                    whole(&RangeElement::low).get})
        .maybe(integer("m").optional(), whole(&RangeElement::high))
        .check(check_order);
}
/// Two limits, both of which must be given.
Parts<RangeElement> both_limits(std::string_view unit) {
    return Parts<RangeElement>()
        .then(real("low").unit(unit).at_least(0), &RangeElement::low)
        .then(real("high").unit(unit), &RangeElement::high)
        .check(check_order);
}

/// A number, or several numbers: one of them is enough.
Parts<RangeElement> any_of_numbers() {
    ArgumentSpec number = integer("n").spec;
    number.repeated = true;
    return Parts<RangeElement>().argument(number).by(
        [number](Reader& reader, RangeElement& e) {
            e.low = e.high = static_cast<double>(reader.integer(number));
            if (!reader.at_number()) return;
            e.numbers.push_back(static_cast<std::int64_t>(e.low));
            while (reader.at_number()) e.numbers.push_back(reader.integer(number));
        },
        [](Parts<RangeElement>::Form form, const RangeElement& e) {
            form.after.low = form.after.high = e.low;
            form.after.numbers = e.numbers;
            if (e.numbers.empty()) print_value(form.words, static_cast<std::int64_t>(e.low));
            for (const std::int64_t n : e.numbers) print_value(form.words, n);
            return Parts<RangeElement>::Forms{std::move(form)};
        });
}

/// Nothing, on or off.
Parts<RangeElement> on_or_off() {
    return Parts<RangeElement>().perhaps(
        {{"on", {}}, {"off", Parts<RangeElement>().set(&RangeElement::negated, true)}});
}

/// `group NAME [slot s] [matches n]`, or NAME alone with its slot in it.
void group(Keywords<RangePhrase>& table) {
    const auto name = text("name");
    static const std::vector<KeywordSpec> words = [&] {
        Keywords<RangeElement> list;
        list.keyword({Spelling{"matches", 3}}, integer("n").at_least(1).at_most(2),
                     Through{[](RangeElement& e, std::int64_t n) { e.both = n == 2; },
                             [](const RangeElement& e) { return std::optional<std::int64_t>(e.both ? 2 : 1); }},
                     "of contacts: 1, one of the two blocks is enough (if not given); 2, both must belong");
        list.action(
                {Spelling{"only", 3}}, [](RangeElement&) {}, "a block is in one group only: without effect")
            .ignored();
        list.special(
            {Spelling{"slot", 3}}, {name.spec},
            [](Reader& reader, RangeElement& e) { slot_words().front().read(reader, &e.name); },
            "the slot of the group, or `any`; the default one if it has the group, else any");
        return std::move(list).list();
    }();
    table.keyword(
        {"group"},
        element(
            Kind::group,
            Parts<RangeElement>().then(name, &RangeElement::name).words(words).check([](Reader& reader, RangeElement&) {
                misspelt_part(reader, "group", words);
            })),
        "members of a group");
}

/// Elements of 3DEC that have no meaning in this engine yet.
void elements_to_come(Keywords<RangePhrase>& table) {
    static constexpr std::pair<const char*, const char*> known[] = {
        {"sregion", "regions of surfaces"},
    };
    for (const auto& [word, help] : known) table.not_yet({Spelling{word, 4}}, help);
}

/// `block id 5`: the old long form of `bid 5`, as which it is printed.
void block_id(Keywords<RangePhrase>& table) {
    const auto parts = element(Kind::block_id, Parts<RangeElement>()
                                                   .check([](Reader& reader, RangeElement&) {
                                                       const Word* word = reader.peek();
                                                       if (word && word->folded != "id")
                                                           reader.unknown("the word 'id' of block id", {"id"});
                                                       if (word) reader.take();
                                                   })
                                                   .then(whole_limits()));
    table.keyword({Spelling{"block", 3}}, parts, "`block id n`: the same as bid").prints({});
}

/// `dfn NAME [distance d]`.
void network(Keywords<RangePhrase>& table) {
    static const std::vector<KeywordSpec> words = [] {
        Keywords<RangeElement> list;
        list.keyword({Spelling{"distance", 4}},
                     Parts<RangeElement>()
                         .set(&RangeElement::side, 1)
                         .then(real("d").unit("length").at_least(0), &RangeElement::distance),
                     "objects whose centre is within this distance of a fracture, whether it has cut them or not");
        return std::move(list).list();
    }();
    table.keyword(
        {"dfn"},
        element(Kind::network, Parts<RangeElement>()
                                   .then(text("name"), &RangeElement::name)
                                   .words(words)
                                   .check([](Reader& reader, RangeElement&) { misspelt_part(reader, "dfn", words); })),
        "contacts and faces that the fractures of a network have cut, and blocks with such a face");
}

/// Several names may follow one nrange; each is a separate element.
void named_ranges(Keywords<RangePhrase>& table) {
    const auto parts = element(Kind::named, Parts<RangeElement>().then(text("name"), &RangeElement::name));
    const auto further = [](Reader& reader, RangePhrase& phrase) {
        while (const Word* word = reader.peek()) {
            const bool another = word->kind == WordKind::text ||
                                 (word->kind == WordKind::word && !find_keyword(range_elements(), word->folded));
            if (!another) return;
            reader.take();
            RangeElement& next = phrase.elements.emplace_back();
            next.kind = Kind::named;
            next.place = word->place;
            next.name = word->text;
        }
    };
    table.keyword({"nrange", "name"}, Parts<RangePhrase>(parts).check(further),
                  "a range that was given a name with range name");
}

/// Elements whose parts are those of no form; some of them cover all kinds of a group.
void own_element(Keywords<RangePhrase>& table, Kind kind) {
    const auto number = integer("n");
    switch (kind) {
    case Kind::box: return space_elements(table);
    case Kind::polygon: return figure_elements(table);
    case Kind::group: return group(table);
    case Kind::group_intersection:
        table.keyword({"gintersection", "group-intersection"},
                      element(kind, Parts<RangeElement>()
                                        .then(text("name"), &RangeElement::name)
                                        .then(text("other"), &RangeElement::second_name)),
                      "contacts between blocks of two groups");
        return;
    case Kind::block_id: return block_id(table);
    case Kind::named: return named_ranges(table);
    case Kind::id_list:
        table.keyword({"id-list", "idlist"}, element(kind, Parts<RangeElement>().each(number, &RangeElement::numbers)),
                      "identity numbers, one by one");
        return;
    case Kind::network: return network(table);
    default: break;
    }
}

/// What stands after the word of an element.
Parts<RangeElement> parts_of(const RangeWords& row) {
    using enum RangeWords::Form;
    switch (row.form) {
    case coordinate: return one_or_two_limits("length");
    case number: return any_of_numbers();
    case limits_of_numbers: return whole_limits();
    case two_numbers:
        return Parts<RangeElement>()
            .then(integer("n"), whole(&RangeElement::low))
            .then(integer("m"), whole(&RangeElement::high));
    case limits: return both_limits(row.unit);
    case name: return Parts<RangeElement>().then(text("name"), &RangeElement::name);
    case flag: return on_or_off();
    case own: break;
    }
    return {};
}

std::vector<KeywordSpec> all_elements() {
    Keywords<RangePhrase> table;
    for (const RangeWords& row : range_words()) {
        if (row.form == RangeWords::own) own_element(table, row.kind);
        else table.keyword(row.words, element(row.kind, parts_of(row)), row.help);
    }
    table.action(
        {"extent"}, [](RangePhrase& phrase) { phrase.whole = true; },
        "all corners of a block, a face or a zone must lie inside, not only its centroid");
    table.action(
        {"union"}, [](RangePhrase& phrase) { phrase.any = true; }, "one element is enough, not all are needed");
    const auto after_an_element = [](Reader& reader, RangePhrase& phrase) {
        if (phrase.elements.empty())
            throw Diagnostic("'not' stands before the element that it negates", "write it after: range z 0 1 not")
                .at(reader.previous().place);
    };
    table.keyword({Spelling{"not", 3}},
                  Parts<RangePhrase>()
                      .check(after_an_element)
                      .in(last_of(&RangePhrase::elements), Parts<RangeElement>().set(&RangeElement::negated, true)),
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
