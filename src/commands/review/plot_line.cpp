// Reads the words of a plot line.
#include "commands/review/plot_views.hpp"

#include "base/diagnostic.hpp"
#include "model/fields/field.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <numbers>

namespace kaya {

namespace {

class LineReader {
public:
    LineReader(const std::vector<lang::Plot::Item>& words, PlotLine& line) : words_(words), line_(line) {}

    void read() {
        read_task();
        while (at_ < words_.size()) {
            if (!read_setting() && !read_item() && !read_detail()) leave_out();
        }
    }

private:
    using Words = std::initializer_list<const char*>;

    bool is(Words any) const {
        if (listing_) possible_.insert(possible_.end(), any.begin(), any.end());
        return at_ < words_.size() && !words_[at_].quoted &&
               std::ranges::any_of(any, [&](const char* word) { return words_[at_].folded == word; });
    }
    bool take(Words any) { return is(any) && ++at_; }

    std::optional<double> number_at(std::size_t place) const {
        if (place >= words_.size()) return std::nullopt;
        const std::string& text = words_[place].text;
        const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
        double value = 0;
        const auto [end, error] = std::from_chars(first, text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
        return value;
    }
    bool take_number(double& value) {
        const auto number = number_at(at_);
        if (number) value = *number, ++at_;
        return number.has_value();
    }
    template <class Array> bool take_vector(Array& vector) {
        for (std::size_t k = 0; k < 3; ++k)
            if (!number_at(at_ + k)) {
                if (k > 0) line_.unknown.push_back(fmt::format("{} with {} of 3 numbers", words_[at_ - 1].text, k));
                return false;
            }
        for (int k = 0; k < 3; ++k) vector[static_cast<decltype(vector.size())>(k)] = *number_at(at_++);
        return true;
    }
    std::string take_text() { return at_ < words_.size() ? words_[at_++].text : std::string(); }

    /// Numbers and texts belong to the word before them.
    void leave_out() {
        const auto& word = words_[at_];
        if (!word.quoted && !number_at(at_)) {
            if (line_.unknown.empty()) line_.meant = did_you_mean(word.folded, possible_words());
            if (line_.meant == word.folded) line_.meant.clear(); // of another item
            line_.unknown.push_back(word.text);
        }
        ++at_;
    }

    /// Those that could stand in the place of one that nothing takes.
    std::vector<std::string_view> possible_words() {
        listing_ = true;
        read_setting() || read_item() || read_detail();
        listing_ = false;
        std::vector<std::string_view> words = std::move(possible_);
        const bool of_joints = !line_.items.empty() && line_.items.back().kind == PlotItem::Kind::joints;
        const auto quantities = short_field_words(of_joints);
        words.insert(words.end(), quantities.begin(), quantities.end());
        for (const auto& field : fields())
            if (is_colour(std::string(field.name))) words.push_back(field.name);
        return words;
    }

    void read_task() {
        using enum PlotLine::Task;
        static constexpr std::array<const char*, 2> kinds{"plot", "view"}; // plot create view NAME
        const auto named = [&](PlotLine::Task task) {
            line_.task = task;
            if (at_ + 1 < words_.size() && std::ranges::find(kinds, words_[at_].folded) != kinds.end()) ++at_;
            line_.name = take_text();
        };
        if (take({"create", "cre"})) named(create);
        else if (take({"current", "cur"})) named(choose);
        else if (take({"clear", "reset", "cle"})) line_.task = clear;
        else if (take({"add"})) line_.task = add;
        else if (take({"item"})) line_.task = take({"create", "modify"}) ? add : add;
        else if (take({"set", "view", "title", "update"})) {
            line_.task = settings;
            if (words_[at_ - 1].folded == "title") --at_;
        } else if (take({"export", "bitmap", "hardcopy", "hard", "copy", "show"})) {
            line_.task = write;
            take({"bitmap", "png", "svg", "jpg", "bmp"});
        }
        if (line_.task == write && at_ < words_.size() && !is({"file", "filename", "size", "plot", "view"}))
            line_.file = take_text();
    }

    /// A view by its name, without perspective: lengths can be measured in it.
    bool read_side() {
        struct Side {
            const char* name;
            double dip, dip_direction;
        };
        static constexpr std::array<Side, 8> sides{{{"front", 90, 180},
                                                    {"back", 90, 0},
                                                    {"left", 90, 270},
                                                    {"right", 90, 90},
                                                    {"side", 90, 90},
                                                    {"top", 0, 180},
                                                    {"bottom", 180, 180},
                                                    {"isometric", 54.735610317245346, 135}}};
        Scene& scene = line_.view.settings;
        for (const Side& side : sides)
            if (take({side.name})) {
                scene.dip = side.dip, scene.dip_direction = side.dip_direction;
                scene.perspective = false;
                return true;
            }
        return false;
    }

    /// Settings of the whole picture.
    bool read_setting() {
        if (read_side()) return true;
        Scene& scene = line_.view.settings;
        double value = 0;
        if (take({"dip"})) return take_number(scene.dip), true;
        if (take({"dd", "dip-direction", "ddir"})) return take_number(scene.dip_direction), true;
        if (take({"center", "centre", "cen"})) return scene.has_centre = take_vector(scene.centre), true;
        if (take({"magnification", "mag", "magnify"})) return take_number(scene.magnification), true;
        if (take({"perspective", "persp"})) return scene.perspective = !take({"off"}), take({"on"}), true;
        if (take({"title", "caption"})) {
            take({"text"});
            scene.title = take_text();
            return true;
        }
        if (take({"size"})) {
            if (take_number(value)) scene.width = static_cast<std::int32_t>(std::clamp(value, 64.0, 8192.0));
            scene.height =
                take_number(value) ? static_cast<std::int32_t>(std::clamp(value, 64.0, 8192.0)) : scene.width * 3 / 4;
            return true;
        }
        if (take({"axes", "axis"})) return scene.axes = !take({"off"}), take({"on"}), true;
        if (take({"scale-bar", "scalebar"})) return scene.scale_bar = !take({"off"}), take({"on"}), true;
        if (take({"dpi"})) {
            if (take_number(value)) scene.paper.dpi = static_cast<std::int32_t>(std::clamp(value, 0.0, 4800.0));
            return true;
        }
        if (take({"interval", "every"})) {
            if (take_number(value)) line_.interval = std::max(1LL, std::llround(value));
            return true;
        }
        if (take({"file", "filename"})) return line_.file = take_text(), true;
        if (take({"keep"})) return line_.keep = take_text(), true;
        if (take({"pair"})) return line_.view.pair = take_text(), true;
        if (take({"background"})) return take_text(), true; // of the screen
        if (line_.task == PlotLine::Task::write && take({"plot", "view"})) return line_.name = take_text(), true;
        return false;
    }

    bool read_item() {
        using enum PlotItem::Kind;
        if (take({"block", "blocks", "zone", "zones", "bl", "face", "faces"})) return begin(blocks);
        if (take({"joint", "joints", "jplane", "jset", "contact", "contacts", "subcontact", "cx"}))
            return begin(joints);
        if (take({"vector", "vectors"})) {
            begin(arrows);
            take({"of"});
            item().field = take({"velocity", "vel"}) ? "velocity" : "displacement";
            take({"displacement", "disp"});
            return true;
        }
        if (take({"principal", "tensor", "crosses", "cross"})) return take({"stress"}), begin(crosses);
        if (take({"cable", "cables", "structure", "struct"})) {
            begin(cables);
            item().field = take({"slip"}) ? "slip" : "cable_force";
            take({"force", "axial", "tension"});
            return true;
        }
        if (take({"beam", "beams"})) return begin_members(beams, ObjectKind::beam_element, "axial_force");
        if (take({"liner", "liners"})) return begin_members(liners, ObjectKind::liner_element, "membrane_2");
        if (take({"iso", "isosurface", "iso-surface"})) {
            begin(iso_surfaces);
            take({"of"});
            if (at_ < words_.size() && find_colour_field(words_[at_].folded)) item().field = words_[at_++].folded;
            take({"level", "levels", "value", "values", "at"});
            for (double level = 0; take_number(level);) item().levels.push_back(level);
            return true;
        }
        if (take({"stereonet", "net", "schmidt"})) {
            begin(net);
            if (take({"slip"})) item().field = "slip";
            else if (take({"dfn", "fracture", "fractures"})) item().field = "dfn";
            else take({"poles", "joint", "joints"});
            return true;
        }
        if (take({"chart-history"})) return take({"history"}), begin_curves(histories);
        if (take({"chart-table"})) return take({"table"}), begin_curves(tables);
        if (const bool history = take({"hist", "history", "his"}); history || take({"table", "tab"}))
            return begin_curves(history ? histories : tables);
        if (!line_.items.empty()) return false;
        if (is({"velocity", "vel", "displacement", "disp"})) {
            begin(arrows);
            item().field = words_[at_++].folded.starts_with("v") ? "velocity" : "displacement";
            return true;
        }
        return false;
    }

    /// Histories or tables, by their numbers.
    bool begin_curves(PlotItem::Kind kind) {
        begin(kind);
        for (double number = 0; take_number(number);) item().numbers.push_back(std::llround(number));
        return true;
    }

    /// The next word selects their colours, if it is a number among their fields.
    bool begin_members(PlotItem::Kind kind, ObjectKind objects, const char* usual) {
        begin(kind);
        item().field = usual;
        const Field* field = at_ < words_.size() ? find_field(objects, words_[at_].folded) : nullptr;
        if (field != nullptr &&
            (field->unit.starts_with("force") || field->unit.starts_with("moment") || field->unit == "stress"))
            item().field = words_[at_++].folded;
        return true;
    }
    bool begin(PlotItem::Kind kind) {
        line_.items.emplace_back().kind = kind;
        return true;
    }
    PlotItem& item() { return line_.items.back(); }

    /// Details of the item before them; a colour or a cut without an item is for blocks.
    bool read_detail() {
        const bool colours =
            take({"contour", "colorby", "colourby", "color-by", "colour-by", "color", "colour", "by", "field"});
        if (colours || is({"cut", "xsection", "xsec", "section", "plane", "deformed"}) || is_field())
            if (line_.items.empty()) begin(PlotItem::Kind::blocks);
        // The screen that a deck was written for.
        if (take({"hold", "on", "off", "fill", "lines", "line", "solid", "outline", "wireframe", "both", "surface",
                  "active"}))
            return true;
        if (line_.items.empty()) return colours;
        if (is_field()) return item().field = words_[at_++].folded, true;
        if (colours) return true;
        if (take({"cut", "xsection", "xsec", "section", "plane"})) return read_cut(), true;
        if (take({"deformed", "deform"})) {
            item().deformed = 10;
            return take_number(item().deformed), true;
        }
        if (take({"scale"})) return take_number(item().scale), true;
        double value = 0;
        if (take({"vs", "v", "versus"})) {
            if (take_number(value)) item().versus = std::llround(value);
            return true;
        }
        if (item().kind >= PlotItem::Kind::histories && take({"marks", "points"})) return item().marks = true;
        if (item().kind >= PlotItem::Kind::histories && take({"equal"})) {
            take({"axes", "axis"});
            return item().equal = !take({"off"}), take({"on"}), true;
        }
        if (take({"xaxis", "x-axis"})) return take({"label"}), item().x_label = take_text(), true;
        if (take({"yaxis", "y-axis"})) return take({"label"}), item().y_label = take_text(), true;
        return false;
    }

    bool is_field() const {
        if (at_ >= words_.size()) return false;
        return is_colour(words_[at_].folded);
    }

    /// Whether the blocks or joints of the item before have this quantity.
    bool is_colour(const std::string& word) const {
        const bool of_joints = !line_.items.empty() && line_.items.back().kind == PlotItem::Kind::joints;
        if (!line_.items.empty() && line_.items.back().kind >= PlotItem::Kind::arrows) return false;
        return of_joints ? find_joint_field(word).has_value() : find_colour_field(word).has_value();
    }

    void read_cut() {
        constexpr double degree = std::numbers::pi / 180;
        CutPlane& cut = item().cut.emplace();
        double dip = 0, direction = 0;
        item().cut_in_middle = true;
        bool turned = false, given = false; // dip and dd after a normal belong to the picture
        for (bool more = true; more;) {
            more = true;
            if (take({"origin", "org", "point"})) item().cut_in_middle = !take_vector(cut.origin);
            else if (take({"normal", "norm"})) given = take_vector(cut.normal);
            else if (!given && take({"dip"})) turned = take_number(dip);
            else if (!given && take({"dd", "dip-direction", "ddir"})) turned = take_number(direction);
            else if (!take({"on", "surface", "plane"})) more = false;
        }
        if (turned)
            cut.normal = Vec3(std::sin(dip * degree) * std::sin(direction * degree),
                              std::sin(dip * degree) * std::cos(direction * degree), std::cos(dip * degree));
        if (cut.normal.norm() > 0) cut.normal.normalize();
        else cut.normal = Vec3::UnitX();
    }

    const std::vector<lang::Plot::Item>& words_;
    PlotLine& line_;
    std::size_t at_ = 0;
    bool listing_ = false; ///< words are listed, none is taken
    mutable std::vector<std::string_view> possible_;
};

} // namespace

PlotLine read_plot_line(const std::vector<lang::Plot::Item>& words, const std::string& range, const PlotView& current) {
    PlotLine line;
    line.view = current;
    LineReader(words, line).read();
    for (PlotItem& item : line.items) item.range = range;
    return line;
}

} // namespace kaya
