// Template, style and scripts of the report's page: src/report/page.
#pragma once

#include <span>
#include <string_view>

namespace kaya {

struct PagePart {
    std::string_view kind; ///< its ending: "html" (the template), "css" or "js"
    std::string_view text;
};
/// In the order of the page.
std::span<const PagePart> page_parts();

} // namespace kaya
