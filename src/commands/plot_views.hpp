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
    double deformed = 1;               ///< displacements are drawn so many times as large
    std::vector<std::int64_t> numbers; ///< of histories and tables; below 0: upside down
    std::optional<std::int64_t> versus;
    std::string x_label, y_label;
    std::string range; ///< a range phrase, "" for all that is visible
};

struct PlotView {
    Scene settings; ///< its layers are made when it is drawn
    std::vector<PlotItem> items;
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
    std::string current;       ///< "": the view without a name
    std::int32_t pictures = 0; ///< that were named by their number
    std::vector<Movie> movies;
};

/// What one plot line asks for.
struct PlotLine {
    enum class Task { draw, add, create, choose, clear, settings, write };
    Task task = Task::draw; ///< of `items`, at once
    std::string name;       ///< of a view
    std::string file;
    std::int64_t interval = 0; ///< cycles between the pictures of a movie; 0: one picture
    PlotView view;             ///< the view that was current, with what the line changes
    std::vector<PlotItem> items;
    std::vector<std::string> unknown; ///< words that say nothing to kaya
};

/// Never throws for a word: what is not known stands in `unknown`. Values of scripts stand in the words already.
PlotLine read_plot_line(const std::vector<lang::Plot::Item>& words, const std::string& range, const PlotView& current);

class Session;

/// The words with what scripts say for those that are late (@name). Throws Diagnostic for a name that nothing has.
std::vector<lang::Plot::Item> with_script_values(Session& session, std::vector<lang::Plot::Item> words);

/// Draws a view into a file whose suffix says which kind. False, with a note, when there is no picture: that is no reason to end a run.
bool write_view(Session& session, const PlotView& view, const std::string& file);

/// Draws curves into a PNG or SVG file and says so; the same where there is no picture. Another suffix becomes .png.
void write_chart(Session& session, const Chart& chart, const std::string& file);

/// To be called after each cycle.
void shoot_movies(Session& session);

} // namespace kaya
