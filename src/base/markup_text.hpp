// Text that stands in a page or in XML.
#pragma once

#include <string>
#include <string_view>

namespace kaya {

/// The text with its special letters written so that HTML and XML take none of it as a mark; control letters are left out.
std::string markup_text(std::string_view text);

} // namespace kaya
