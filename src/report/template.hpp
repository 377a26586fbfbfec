// A text with places for values: src/report/page/page.html.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace kaya {

/// By name.
using TemplateValues = std::map<std::string, std::string, std::less<>>;

/// {{name}} becomes the value of that name. Lines between {{#name}} and {{/name}}, each alone on its line, are left out where that value is
/// empty. Throws std::logic_error for a name without a value, and for a part without an end.
std::string filled(std::string_view text, const TemplateValues& values);

} // namespace kaya
