// Pictures described by plot lines.
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
    enum class Kind {
        blocks,
        joints,
        arrows,
        crosses,
        iso_surfaces,
        cables,
        beams,
        liners,
        histories,
        tables,
        net
    }; ///< the model, then charts
    Kind kind = Kind::blocks;
    std::string field; ///< of the colours; of arrows: velocity or displacement; of cables: slip or cable_force; of
                       ///< beams and liners: a number among the fields of their elements
    double scale = 0;  ///< of arrows and crosses
    std::vector<double> levels; ///< of iso-surfaces; none: five
    std::optional<CutPlane> cut;
    bool cut_in_middle = false;        ///< no origin was given: through the middle of the blocks
    double deformed = 1;               ///< displacements are drawn so many times as large
    std::vector<std::int64_t> numbers; ///< of histories and tables; below 0: upside down
    std::optional<std::int64_t> versus;
    std::string x_label, y_label;
    bool marks = false;        ///< a curve is a row of small circles
    std::optional<bool> equal; ///< axes of a chart; none: where both are lengths of one size
    std::string range;         ///< a range phrase, "" for all that is visible
};

struct PlotView {
    Scene settings; ///< its layers are made when it is drawn
    std::vector<PlotItem> items;
    std::string pair; ///< the kept picture to its left; none: alone
};

/// A picture that is made again and again while the model cycles: NAME-0001.png, NAME-0002.png ...
struct Movie {
    PlotView view;
    std::string stem;
    std::int64_t interval = 1; ///< cycles
    std::int64_t last = 0;     ///< cycle of the last picture
    int pictures = 0;
};

struct PlotViews {
    std::map<std::string, PlotView> views;
    std::string current;               ///< "": the view without a name
    std::int32_t pictures = 0;         ///< that were named by their number
    std::map<std::string, Scene> kept; ///< by `plot ... keep NAME`, for `pair NAME`
    std::vector<Movie> movies;
};

/// Content of one plot line.
struct PlotLine {
    enum class Task { draw, add, create, choose, clear, settings, write };
    Task task = Task::draw; ///< of `items`, at once
    std::string name;       ///< of a view
    std::string file;
    std::string keep;          ///< the name under which the picture is kept, to stand with a later one
    std::int64_t interval = 0; ///< cycles between the pictures of a movie; 0: one picture
    PlotView view;             ///< the current view, with the changes of the line
    std::vector<PlotItem> items;
    std::vector<std::string> unknown; ///< words without a meaning in kaya
    std::string meant;                ///< the known word nearest to the first of them, if one is near
};

/// Never throws for a word: unknown words are in `unknown`. Values of scripts are already inserted.
PlotLine read_plot_line(const std::vector<lang::Plot::Item>& words, const std::string& range, const PlotView& current);

} // namespace kaya
