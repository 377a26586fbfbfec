// limit equilibrium: slip surfaces through a section of the model.
#include "base/counted.hpp"
#include "commands/plot/pictures.hpp"
#include "commands/session/fresh_water.hpp"
#include "commands/session/handlers.hpp"
#include "commands/stability/model_section.hpp"
#include "slopes/search.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <span>

namespace kaya {

namespace {

using lang::LimitEquilibrium;

constexpr std::size_t most_drawn = 300; ///< blocks in a picture; of more only the ground is drawn
constexpr int search_slices = 30;       ///< for comparisons in the search; the result uses the number of the command

SliceMethod method_of(LimitEquilibrium::Method method) {
    switch (method) {
    case LimitEquilibrium::Method::ordinary: return SliceMethod::ordinary;
    case LimitEquilibrium::Method::bishop: return SliceMethod::bishop;
    case LimitEquilibrium::Method::janbu: return SliceMethod::janbu;
    case LimitEquilibrium::Method::spencer: return SliceMethod::spencer;
    case LimitEquilibrium::Method::morgenstern_price: break;
    }
    return SliceMethod::morgenstern_price;
}

/// Methods in the order of their equilibrium conditions; the later of two answers counts.
std::vector<SliceMethod> methods_of(const LimitEquilibrium& command, bool circle) {
    std::vector<SliceMethod> methods;
    for (const auto method : command.methods) methods.push_back(method_of(method));
    if (methods.empty()) {
        using enum SliceMethod;
        methods =
            circle ? std::vector{bishop, spencer, morgenstern_price} : std::vector{janbu, spencer, morgenstern_price};
    }
    std::ranges::sort(methods);
    methods.erase(std::unique(methods.begin(), methods.end()), methods.end());
    for (const SliceMethod method : methods)
        if (!circle && needs_circle(method))
            throw Diagnostic(fmt::format("{} goes with circles only", name_of(method)),
                             "for other surfaces: janbu, spencer or morgenstern-price");
    return methods;
}

SectionPlane plane_of(const Session& session, const LimitEquilibrium& command) {
    const Model& model = session.engine.model;
    const double g = model.settings.gravity.norm();
    if (!(g > 0))
        throw Diagnostic("limit equilibrium needs gravity", "write before it, for example: gravity 0 0 -9.81");
    SectionPlane plane;
    plane.up = -model.settings.gravity / g;
    const Vec3 along = command.direction.value_or(Vec3(1, 0, 0));
    const Vec3 level = along - along.dot(plane.up) * plane.up;
    if (!(level.norm() > 1e-6 * along.norm()))
        throw Diagnostic("the direction of a section must not be that of gravity",
                         "write for example: direction 1 0 0");
    plane.along = level.normalized();
    if (command.origin) {
        plane.point = *command.origin;
    } else {
        Vec3 low = Vec3::Constant(INFINITY), high = Vec3::Constant(-INFINITY);
        for (Row p = 0; p < static_cast<Row>(model.gridpoints.size()); ++p) {
            if (model.blocks.hidden[model.gridpoints.block[p]]) continue;
            low = low.cwiseMin(model.gridpoints.position[p]), high = high.cwiseMax(model.gridpoints.position[p]);
        }
        if (!(low.x() <= high.x()))
            throw Diagnostic("there is no block", "limit equilibrium cuts a section through the model");
        plane.point = 0.5 * (low + high);
    }
    return plane;
}

/// A numbered table as the height of the water over the distance.
void add_water_table(Session& session, std::int64_t number, SlopeSection& section) {
    const auto& tables = session.engine.scripts->tables();
    const auto found = tables.find(number);
    if (found == tables.end() || found->second.points().empty())
        throw Diagnostic(fmt::format("there is no table {} with the height of the water", number),
                         fmt::format("write before it, for example: table {} 0 10 50 14", number));
    found->second.require_sorted(fmt::format("table {}", number));
    section.pore_pressure = [table = found->second, weight = section.water_weight](const SectionPoint& at) {
        return weight * (table.at(at.x()) - at.y());
    };
}

std::string surface_text(const SlipSurface& surface) {
    std::string text = fmt::format("from {}, {} to {}, {}", number_text(surface.points.front().x()),
                                   number_text(surface.points.front().y()), number_text(surface.points.back().x()),
                                   number_text(surface.points.back().y()));
    if (surface.circle)
        text += fmt::format(", centre {}, {} radius {}", number_text(surface.circle->centre.x()),
                            number_text(surface.circle->centre.y()), number_text(surface.circle->radius));
    return text;
}

class Assessment {
public:
    Assessment(Session& session, const LimitEquilibrium& command)
        : session_(session), command_(command), plane_(plane_of(session, command)) {
        section_ = section_of(session.engine.model, session.engine.joints, plane_);
        section_.seismic = command.seismic;
        section_.crack_depth = command.crack;
        section_.crack_water = command.crack_water;
        section_.pressure_ratio = command.pressure_ratio;
        const bool has_density =
            session.engine.model.settings.water == Water::table || session.engine.model.settings.water == Water::ground;
        const bool has_water = command.crack_water > 0 || command.water_table;
        const double density = has_density ? session.engine.model.settings.water_value
                               : has_water ? density_of_fresh_water(session, command.place)
                                           : 0;
        section_.water_weight = density * session.engine.model.settings.gravity.norm();
        section_.water_is_open = has_density || command.water_table;
        if (command.water_table) add_water_table(session, *command.water_table, section_);
        else if (session.engine.model.settings.water == Water::points)
            throw Diagnostic(
                "limit equilibrium has no water pressure of gridpoints (initialize pp, insitu pp)",
                "give the water as `water table` or `water pressure`, or as a table: limit equilibrium water-table 1")
                .at(command.place);
    }

    void run() {
        const SlopeColumns columns(section_);
        session_.program.output.say(
            fmt::format("limit equilibrium: {} cut through {} along {}, distances from {} to {}",
                        counted(section_.cells.size(), "block"), place_text(plane_.point), vector_text(plane_.along),
                        number_text(columns.left()), number_text(columns.right())));
        const bool given = command_.circle || !command_.surface.empty();
        const bool circle =
            given ? command_.circle.has_value() : command_.search == LimitEquilibrium::Surfaces::circles;
        TextTable table({"method", "factor", "lambda", "surface"});
        for (const SliceMethod method : methods_of(command_, circle)) {
            const auto found =
                given ? assess(columns, given_surface(columns), method) : search(columns, circle, method);
            if (!found) {
                table.add({std::string(name_of(method)), "none", "", "no state of equilibrium by this method"});
                continue;
            }
            const auto& answer = found->answer;
            const bool rigorous = method == SliceMethod::spencer || method == SliceMethod::morgenstern_price;
            std::string remark = surface_text(found->surface);
            remark += through(columns, found->surface);
            if (answer.pulled > 0) remark += fmt::format("; {} of its slices pulled", answer.pulled);
            table.add({std::string(name_of(method)), fmt::format("{:.4f}", answer.factor),
                       rigorous ? fmt::format("{:.4f}", answer.lambda) : "", remark});
            best_ = found;
            best_method_ = method;
        }
        session_.program.output.conclude(table.text());
        if (!best_)
            throw Diagnostic(
                "no slip surface has a factor of safety by these methods",
                "a tension crack often helps (crack d); or entry, exit and depth keep the search where a body can slide",
                Fault::run);
        session_.engine.model.clock.factor_of_safety = best_->answer.factor;
        session_.program.output.conclude(
            fmt::format("factor of safety: {:.4f} ({})", best_->answer.factor, name_of(best_method_)));
        doubt_joints(columns);
        if (under_open_water(columns))
            session_.note_once("the water above the ground loads it here, as open water",
                               "`solve fos` and `list stability` have that load from `bound stress` alone");
        if (25 * best_->answer.pulled > command_.slices && command_.crack == 0)
            session_.note_once("the upper end of the slip surface is in tension",
                               "a tension crack there is nearer to the truth: crack d");
        if (command_.table) keep_surface(*command_.table);
        if (!command_.file.empty()) write_chart(session_, picture(columns), command_.file);
    }

private:
    /// What the surface runs through: names of strengths with their parts of its length.
    std::string through(const SlopeColumns& columns, const SlipSurface& surface) const {
        std::map<std::string, double> lengths;
        double whole = 0;
        const auto body = body_above(columns, surface, static_cast<int>(command_.slices));
        for (const Slice& slice : body->slices) {
            const auto strength = static_cast<std::size_t>(slice.strength - section_.strengths.data());
            lengths[section_.names[strength]] += slice.base_length();
            whole += slice.base_length();
        }
        std::vector<std::string> parts;
        for (const auto& [name, length] : lengths)
            parts.push_back(lengths.size() == 1 ? name : fmt::format("{} ({:.0f} %)", name, 100 * length / whole));
        return fmt::format("; through {}", fmt::join(parts, ", "));
    }

    bool under_open_water(const SlopeColumns& columns) const {
        return section_.water_is_open && section_.pore_pressure &&
               std::ranges::any_of(columns.ground(),
                                   [&](const SectionPoint& at) { return section_.pore_pressure(at) > 0; });
    }

    /// Joints that are weaker than the rock around them, under the weight above, may let blocks slide or topple before the body slides.
    void doubt_joints(const SlopeColumns& columns) {
        std::size_t weaker = 0;
        for (const SectionJoint& joint : section_.joints) {
            const SectionPoint middle = 0.5 * (joint.from + joint.to), along = joint.to - joint.from;
            const Strength* rock = columns.strength_at(middle, SectionPoint::Zero());
            const double level = along.x() / along.norm(), stress = columns.column(middle).weight * level * level;
            const auto strength_of = [stress](const Strength& s) { return s.tangent(stress).at(stress); };
            weaker += rock == nullptr || !rock->fails() ||
                      strength_of(section_.strengths[joint.strength]) < strength_of(*rock);
        }
        if (weaker == 0) return;
        session_.warn(
            Diagnostic(fmt::format("{} of the section {} weaker than the rock next to {}: blocks between joints may "
                                   "slide or topple at a lower factor than this surface",
                                   counted(weaker, "joint"), weaker == 1 ? "is" : "are", weaker == 1 ? "it" : "them"),
                       "look at `list stability` and `solve fos`; `polylines` can follow joints, circles cannot")
                .at(command_.place));
    }

    SlipSurface given_surface(const SlopeColumns& columns) const {
        if (command_.circle) {
            const auto surface =
                circle_surface(columns, {(*command_.circle)[0], (*command_.circle)[1]}, (*command_.circle)[2]);
            if (!surface)
                throw Diagnostic("the circle cuts nothing off, or leaves the section",
                                 "look at its centre and radius; the section begins and ends as said above");
            return *surface;
        }
        SlipSurface surface;
        for (const auto& [distance, height] : command_.surface) surface.points.emplace_back(distance, height);
        check_end(columns, surface.points.front(), surface.points.back());
        check_end(columns, surface.points.back(), surface.points.front());
        return surface;
    }

    /// An end below the ground would be an unsupported vertical side of the body. It is allowed at a tension crack, or at a vertical side
    /// of the section.
    void check_end(const SlopeColumns& columns, const SectionPoint& end, const SectionPoint& other) const {
        using Side = SlopeColumns::Side;
        constexpr double rounded = 2e-3, near = 1e-9; // of the chord: coordinates as they are written; of the section
        const double width = columns.right() - columns.left();
        if (!(end.x() > columns.left() + near * width && end.x() < columns.right() - near * width)) return;
        const double ground = std::min(columns.ground_at(end.x(), Side::left).value_or(INFINITY),
                                       columns.ground_at(end.x(), Side::right).value_or(INFINITY));
        const double crack = end.y() > other.y() ? section_.crack_depth : 0;
        const double below = ground - crack - end.y();
        if (below > rounded * (end - other).norm())
            throw Diagnostic(fmt::format("the surface ends below the ground at {}", number_text(end.x())),
                             fmt::format("both ends lie on the ground, which is {} high there, or in a tension crack",
                                         number_text(ground)));
    }

    std::optional<FoundSurface> assess(const SlopeColumns& columns, const SlipSurface& surface,
                                       SliceMethod method) const {
        const auto body = body_above(columns, surface, static_cast<int>(command_.slices));
        if (!body)
            throw Diagnostic("the surface leaves the section, or passes above the ground",
                             "its points are distances and heights, both ends on the ground");
        if (std::ranges::any_of(body->slices, [](const Slice& slice) { return !slice.strength->fails(); }))
            throw Diagnostic("the surface passes through rock that has no strength to lose",
                             "give it one, e.g. `prop mat 1 bcoh 3e4 bfric 20`");
        const auto answer = factor_of_safety(*body, method);
        if (!answer) return std::nullopt;
        return FoundSurface{surface, *answer};
    }

    std::optional<FoundSurface> search(const SlopeColumns& columns, bool circles, SliceMethod method) const {
        SurfaceSearch search;
        search.method = method;
        search.slices = search_slices;
        search.entry = command_.entry;
        search.exit = command_.exit;
        search.corners = static_cast<int>(command_.corners);
        search.least_depth = command_.least_depth;
        const auto found = circles ? weakest_circle(columns, search) : weakest_polyline(columns, search);
        return found ? assess(columns, found->surface, method) : std::nullopt;
    }

    Chart picture(const SlopeColumns& columns) const {
        Chart chart;
        chart.title = fmt::format("{}: {:.3f}", name_of(best_method_), best_->answer.factor);
        chart.x_label = session_.deck.units.in_brackets("distance [length]");
        chart.y_label = session_.deck.units.in_brackets("height [length]");
        Curve blocks{"blocks", {}, {}}, joints{"joints", {}, {}}, water{"water", {}, {}},
            surface{"slip surface", {}, {}};
        const auto draw = [](Curve& curve, const SectionPoint& point) {
            curve.x.push_back(point.x()), curve.y.push_back(point.y());
        };
        const auto lift = [&](Curve& curve) { draw(curve, SectionPoint::Constant(std::nan(""))); };
        SectionPoint low = SectionPoint::Constant(INFINITY), high = -low;
        const bool each = section_.cells.size() <= most_drawn;
        for (const SectionCell& cell : section_.cells) {
            for (const SectionPoint& corner : cell.corners) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
            if (!each) continue;
            for (const SectionPoint& corner : cell.corners) draw(blocks, corner);
            draw(blocks, cell.corners.front());
            lift(blocks);
        }
        if (!each) {
            blocks.name = "ground";
            for (const SectionPoint& point : columns.ground()) draw(blocks, point);
        }
        for (const SectionJoint& joint :
             each ? std::span<const SectionJoint>(section_.joints) : std::span<const SectionJoint>())
            draw(joints, joint.from), draw(joints, joint.to), lift(joints);
        for (int k = 0; section_.pore_pressure && k <= 200; ++k) draw_water(columns, low, high, k / 200.0, water);
        for (const SectionPoint& point : best_->surface.points) draw(surface, point);
        for (Curve* curve : {&blocks, &joints, &water, &surface}) // the surface on top
            if (std::ranges::any_of(curve->x, [](double x) { return std::isfinite(x); }))
                chart.curves.push_back(std::move(*curve));
        // The height of equal scales: axes and titles take the rest.
        chart.equal = true;
        const SectionPoint size = high - low;
        chart.height = static_cast<std::int32_t>(std::clamp(1000 * size.y() / size.x() + 190, 400.0, 1600.0));
        return chart;
    }

    /// The height below which there is pressure, by halving.
    void draw_water(const SlopeColumns& columns, const SectionPoint& low, const SectionPoint& high, double part,
                    Curve& water) const {
        const double x = columns.left() + part * (columns.right() - columns.left());
        double wet = low.y(), dry = high.y() + (high.y() - low.y());
        const auto pressure = [&](double z) { return section_.pore_pressure({x, z}); };
        const bool any = pressure(wet) > 0 && !(pressure(dry) > 0);
        for (int i = 0; any && i < 50; ++i) (pressure(0.5 * (wet + dry)) > 0 ? wet : dry) = 0.5 * (wet + dry);
        water.x.push_back(x);
        water.y.push_back(any && wet <= high.y() ? wet : std::nan(""));
    }

    void keep_surface(std::int64_t number) {
        std::vector<script::TablePoint> points;
        for (const SectionPoint& point : best_->surface.points) points.push_back({point.x(), point.y()});
        session_.engine.scripts->tables()[number].replace(std::move(points));
    }

    Session& session_;
    const LimitEquilibrium& command_;
    SectionPlane plane_;
    SlopeSection section_;
    std::optional<FoundSurface> best_;
    SliceMethod best_method_ = SliceMethod::bishop;
};

} // namespace

void run(Session& session, const LimitEquilibrium& command) {
    try {
        Assessment(session, command).run();
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void add_handlers(HandlerTable& table, lang::SlopeCommands list) { fill(table, list); }

} // namespace kaya
