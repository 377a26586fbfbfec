#include "lang/modern/language.hpp"

#include "lang/commands/language.hpp"
#include "lang/modern/leaf.hpp"

namespace kaya::lang {

const Language& modern() {
    static const Language language = {
        {model_family(), program_family(), create_family(), block_family(), contact_family(), gridpoint_family(),
         zone_family(), structure_family(), surface_family(), fracture_family(), other_family(), unsupported_family(),
         script()},
        modern_ranges().elements,
    };
    return language;
}

const Language& language() {
    static const Language both = [] {
        Language language = classic();
        language.modern = &modern();
        return language;
    }();
    return both;
}

} // namespace kaya::lang
