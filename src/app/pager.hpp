// Long texts at the prompt, by pages.
#pragma once

#include "commands/program/output.hpp"

#include <string>

namespace kaya {

struct Screen {
    std::size_t columns = 80, rows = 24;
};

/// Of the terminal on the standard output.
Screen screen();

/// Lines are broken between words. On a terminal a longer text stops at the end of the screen: Return or a blank shows the next page; q, Escape and
/// Ctrl-C return. Other keys do nothing.
void show_by_pages(Output& output, const std::string& text);

} // namespace kaya
