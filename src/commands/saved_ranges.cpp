#include "commands/saved_ranges.hpp"

#include <cstdlib>
#include <fmt/format.h>
#include <sstream>

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

std::string element_text(const RangeElement& e) {
    std::string text = fmt::format("{} {} {} {}", static_cast<int>(e.kind), e.side, e.negated ? 1 : 0, e.both ? 1 : 0);
    visit_numbers(e, [&](double value) { text += fmt::format(" {:a}", value); });
    text += fmt::format(" {}", e.numbers.size());
    for (const auto number : e.numbers) text += fmt::format(" {}", number);
    text += fmt::format(" {}", e.vertices.size());
    for (const Vec3& vertex : e.vertices)
        for (int k = 0; k < 3; ++k) text += fmt::format(" {:a}", vertex[k]);
    return text + fmt::format(" {} {} {} {}\n", e.name.size(), e.name, e.second_name.size(), e.second_name);
}

[[noreturn]] void refuse() { throw Diagnostic("the named ranges of the save file cannot be read", {}, Fault::run); }

/// strtod reads what {:a} writes; streams do not.
double read_number(std::istream& stream) {
    std::string word;
    stream >> word;
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (word.empty() || *end != '\0') refuse();
    return value;
}

std::string read_name(std::istream& stream) {
    std::size_t length = 0;
    stream >> length;
    stream.get();
    if (!stream || length > 1 << 20) refuse();
    std::string name(length, '\0');
    stream.read(name.data(), static_cast<std::streamsize>(length));
    if (!stream) refuse();
    return name;
}

RangeElement read_element(std::istream& stream) {
    RangeElement e;
    int kind = -1, negated = 0, both = 0;
    stream >> kind >> e.side >> negated >> both;
    if (!stream || kind < 0 || kind > static_cast<int>(RangeElement::last_kind)) refuse();
    e.kind = static_cast<RangeElement::Kind>(kind);
    e.negated = negated != 0;
    e.both = both != 0;
    visit_numbers(e, [&](double& value) { value = read_number(stream); });
    std::size_t count = 0;
    stream >> count;
    if (!stream || count > 1 << 20) refuse();
    e.numbers.resize(count);
    for (auto& number : e.numbers) stream >> number;
    stream >> count;
    if (!stream || count > 1 << 20) refuse();
    e.vertices.resize(count);
    for (Vec3& vertex : e.vertices)
        for (int k = 0; k < 3; ++k) vertex[k] = read_number(stream);
    e.name = read_name(stream);
    e.second_name = read_name(stream);
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

NamedRanges ranges_from_text(const std::string& text) {
    std::istringstream stream(text);
    std::size_t count = 0;
    stream >> count;
    if (!stream) refuse();
    NamedRanges ranges;
    for (std::size_t i = 0; i < count; ++i) {
        std::size_t elements = 0;
        int any = 0, whole = 0;
        stream >> elements >> any >> whole;
        if (!stream) refuse();
        lang::RangePhrase phrase;
        phrase.any = any != 0;
        phrase.whole = whole != 0;
        const std::string name = read_name(stream);
        for (std::size_t k = 0; k < elements; ++k) phrase.elements.push_back(read_element(stream));
        ranges[name] = std::move(phrase);
    }
    return ranges;
}

} // namespace kaya
