// The pictures that plot lines describe, and what these lines say.
#pragma once

#include "lang/commands/commands.hpp"
#include "pictures/model_picture.hpp"
#include "pictures/painter.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace kaya {

/// One thing that a picture shows.
struct PlotItem {
    enum class Kind { blocks, joints, arrows, histories, tables };
    Kind kind = Kind::blocks;
    std::string field;  ///< of the colours; of arrows: velocity or displacement
    double scale = 0;   ///< of arrows
    std::optional<CutPlane> cut;
    double deformed = 1; ///< displacements are drawn so many times as large
    std::vector<std::int64_t> numbers; ///< of histories and tables; below 0: upside down
    std::optional<std::int64_t> versus;
    std::string x_label, y_label;
    std::string range; ///< a range phrase, "" for all that is visible
};

struct PlotView {
    Scene settings; ///< its layers are made when it is drawn
    std::vector<PlotItem> items;
};

struct PlotViews {
    std::map<std::string, PlotView> views;
    std::string current;     ///< "": the view without a name
    std::int32_t pictures = 0; ///< that were named by their number
};

/// What one plot line asks for.
struct PlotLine {
    enum class Task { draw, add, create, choose, clear, settings, write };
    Task task = Task::draw; ///< of `items`, at once
    std::string name;       ///< of a view
    std::string file;
    PlotView view;          ///< the view that was current, with what the line changes
    std::vector<PlotItem> items;
    std::vector<std::string> unknown; ///< words that say nothing to kaya
};

/// Never throws for a word: what is not known stands in `unknown`. Values of scripts stand in the words already.
PlotLine read_plot_line(const std::vector<lang::Plot::Item>& words, const std::string& range, const PlotView& current);

} // namespace kaya
