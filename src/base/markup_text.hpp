// Text that stands in a page or in XML.
#pragma once

#include <string>
#include <string_view>

namespace kaya {

/// Escapes the text for HTML and XML; characters that neither may hold are shown as base/terminal_text shows them.
std::string markup_text(std::string_view text);

} // namespace kaya
