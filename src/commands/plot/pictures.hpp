// Draws what plot lines describe.
#pragma once

#include "commands/review/plot_views.hpp"

#include <string>
#include <vector>

namespace kaya {

class Session;

/// Replaces late words (@name) by the values of scripts. Throws Diagnostic for an unknown name.
std::vector<lang::Plot::Item> with_script_values(Session& session, std::vector<lang::Plot::Item> words);

/// Draws a view into a file whose suffix selects the format. False, with a note, when there is no picture: that does not end a run.
bool write_view(Session& session, const PlotView& view, const std::string& file);

/// Draws curves into a PNG, SVG or PDF file and reports it, or why there is no picture. Another suffix becomes .png.
void write_chart(Session& session, const Chart& chart, const std::string& file);

/// To be called after each cycle.
void shoot_movies(Session& session);

} // namespace kaya
