#include "commands/ranges/saved_ranges.hpp"

#include "commands/ranges/saved_text.hpp"

#include <fmt/format.h>
#include <limits>

namespace kaya {

namespace {

using lang::RangeElement;

/// All numbers of an element in one order, for writing and for reading.
template <class Element, class Visit> void visit_numbers(Element& e, Visit visit) {
    visit(e.low);
    visit(e.high);
    for (auto* vector : {&e.centre, &e.end2, &e.normal})
        for (int k = 0; k < 3; ++k) visit((*vector)[k]);
    visit(e.radius1);
    visit(e.radius2);
    visit(e.distance);
}

/// The others have no sets, so that ranges of earlier versions have the same text.
bool names_sets(RangeElement::Kind kind) {
    return kind == RangeElement::Kind::geometry_space || kind == RangeElement::Kind::geometry_distance;
}

std::string element_text(const RangeElement& e) {
    std::string text = fmt::format("{} {} {} {}", static_cast<int>(e.kind), e.side, e.negated ? 1 : 0, e.both ? 1 : 0);
    visit_numbers(e, [&](double value) { text += fmt::format(" {:a}", value); });
    text += fmt::format(" {}", e.numbers.size());
    for (const auto number : e.numbers) text += fmt::format(" {}", number);
    text += fmt::format(" {}", e.vertices.size());
    for (const Vec3& vertex : e.vertices)
        for (int k = 0; k < 3; ++k) text += fmt::format(" {:a}", vertex[k]);
    text += fmt::format(" {} {} {} {}", e.name.size(), e.name, e.second_name.size(), e.second_name);
    if (names_sets(e.kind)) {
        text += fmt::format(" {}", e.sets.size());
        for (const auto& set : e.sets) text += fmt::format(" {} {}", set.size(), set);
    }
    return text + "\n";
}

RangeElement read_element(SavedText& text) {
    RangeElement e;
    e.kind = static_cast<RangeElement::Kind>(text.whole(0, static_cast<int>(RangeElement::last_kind)));
    e.side = static_cast<int>(text.whole(std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
    e.negated = text.flag();
    e.both = text.flag();
    visit_numbers(e, [&](double& value) { value = text.number(); });
    for (std::size_t left = text.count(); left > 0; --left) e.numbers.push_back(text.whole());
    for (std::size_t left = text.count(); left > 0; --left) {
        const double x = text.number(), y = text.number(), z = text.number();
        e.vertices.emplace_back(x, y, z);
    }
    e.name = text.name();
    e.second_name = text.name();
    if (names_sets(e.kind))
        for (std::size_t left = text.count(); left > 0; --left) e.sets.push_back(text.name());
    return e;
}

} // namespace

std::string ranges_text(const NamedRanges& ranges) {
    std::string text = fmt::format("{}\n", ranges.size());
    for (const auto& [name, phrase] : ranges) {
        text += fmt::format("{} {} {} {} {}\n", phrase.elements.size(), phrase.any ? 1 : 0, phrase.whole ? 1 : 0,
                            name.size(), name);
        for (const auto& element : phrase.elements) text += element_text(element);
    }
    return text;
}

NamedRanges ranges_from_text(const std::string& saved) {
    SavedText text(saved, "named ranges");
    NamedRanges ranges;
    for (std::size_t left = text.count(); left > 0; --left) {
        const std::size_t elements = text.count();
        lang::RangePhrase phrase;
        phrase.any = text.flag();
        phrase.whole = text.flag();
        const std::string name = text.name();
        for (std::size_t k = 0; k < elements; ++k) phrase.elements.push_back(read_element(text));
        ranges[name] = std::move(phrase);
    }
    return ranges;
}

} // namespace kaya
