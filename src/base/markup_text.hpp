// Text that stands in a page or in XML.
#pragma once

#include <string>
#include <string_view>

namespace kaya {

/// Escapes the text for HTML and XML; control characters are left out.
std::string markup_text(std::string_view text);

} // namespace kaya
