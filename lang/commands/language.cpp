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

void incomplete_line(const Reader& reader, std::string message, std::string hint) {
    Place place = reader.previous().place;
    place.column += place.length;
    place.length = 1;
    Diagnostic d(std::move(message), std::move(hint));
    d.code = "incomplete-line";
    throw d.at(place);
}

} // namespace kaya::lang
