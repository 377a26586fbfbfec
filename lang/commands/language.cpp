#include "lang/commands/language.hpp"

#include "lang/commands/builder.hpp"

namespace kaya::lang {

const Language& classic() {
    static const Language language = {
        {control(), geometry(), materials(), boundary(), history(), output(), solution(), slopes(), structures(),
         script(), not_supported_yet()},
        range_elements(),
    };
    return language;
}

std::size_t word_among(Reader& reader, const ArgumentSpec& spec, std::string_view what,
                       const std::vector<std::string_view>& words) {
    if (reader.at_end()) reader.missing(spec);
    const std::string& given = reader.peek()->folded;
    for (std::size_t i = 0; i < words.size(); ++i)
        if (!given.empty() && words[i].starts_with(given)) {
            reader.take();
            reader.spell(words[i]);
            return i;
        }
    reader.unknown(what, words);
}

void incomplete_line(const Reader& reader, std::string message, std::string hint) {
    Place place = reader.previous().place;
    place.column += place.length;
    place.length = 1;
    Diagnostic d(std::move(message), std::move(hint));
    d.code = "incomplete-line";
    throw d.at(place);
}

} // namespace kaya::lang
