// Text in scripts of gnuplot.
#pragma once

#include <string>
#include <string_view>

namespace kaya {

/// The text in single quotes. In double quotes gnuplot would run what stands between backquotes.
std::string gnuplot_text(std::string_view text);

} // namespace kaya
