// list stability: blocks that could leave their place, by block theory.
#include "commands/list/stability.hpp"

#include "commands/list/listing.hpp"
#include "commands/list/model_strengths.hpp"

#include "mechanics/common/masses.hpp"
#include "mechanics/assign/contact_properties.hpp"
#include "mechanics/lanes/rotation.hpp"
#include "mechanics/bodies/run_cables.hpp"
#include "model/edit/joined.hpp"
#include "model/measure/joint_polygons.hpp"
#include "model/measure/joint_water.hpp"
#include "mechanics/supports/water.hpp"
#include "model/measure/measure.hpp"
#include "model/measure/overlap_rows.hpp"
#include "model/measure/structure_rows.hpp"
#include "model/structures/structures.hpp"
#include "slopes/sliding.hpp"
#include "slopes/turning.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <fmt/format.h>
#include <map>
#include <numbers>

namespace kaya {

namespace {

constexpr std::array<const char*, 6> mode_names{
    "held", "at rest", "falls", "slides on one plane", "slides on two planes", "turns"};

/// Trend and plunge of a direction in degrees: "150/37".
std::string line_text(const Vec3& direction, const Vec3& up) {
    constexpr double degrees = 180 / std::numbers::pi;
    if (direction.isZero()) return "-";
    double trend = std::atan2(direction.x(), direction.y()) * degrees;
    if (trend < 0) trend += 360;
    return fmt::format("{:.1f}/{:.1f}", trend, std::asin(std::clamp(-direction.dot(up), -1.0, 1.0)) * degrees);
}

/// A body and its supports.
struct Held {
    BodyStability body;
    double mass = 0;
    Vec3 centre = Vec3::Zero();                       ///< of its mass
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero(); ///< the moment about the centre
    struct Side {
        std::size_t other;
        HeldFace face;
        Row contact;
    };
    std::vector<Side> sides;
    std::vector<Vec3> held; ///< directions in which it is held, unit and at right angles

    /// Holds it in one direction more, or in none.
    void hold(Vec3 direction) {
        constexpr double rounding = 1e-6;
        for (const Vec3& known : held) direction -= known.dot(direction) * known;
        if (held.size() < 3 && direction.norm() > rounding) held.push_back(direction.normalized());
    }

    /// Frictionless faces on both sides of the body across each direction in which it is held.
    void add_guides(std::vector<HeldFace>& faces) const {
        for (const Vec3& direction : held)
            for (const double side : {1.0, -1.0}) faces.push_back({side * direction, 0, nullptr});
    }
    bool is_pushed_on_guides() const {
        constexpr double part = 1e-6;
        return std::ranges::any_of(
            held, [&](const Vec3& direction) { return std::abs(direction.dot(force)) > part * force.norm(); });
    }

    void push(const Vec3& more, const Vec3& place) {
        force += more;
        moment += (place - centre).cross(more);
    }
};

class StandingBodies {
public:
    StandingBodies(Model& model, JointRegistry& laws) : model_(model) {
        find_contacts(model, laws);
        if (model.settings.water == Water::points) put_water(model);
        gather();
        const WaterPressure water(model);
        for (Row contact = 0; contact < static_cast<Row>(model.contacts.size()); ++contact)
            add_contact(contact, laws, water);
        assess();
    }

    std::vector<BodyStability> all() const {
        std::vector<BodyStability> bodies;
        for (const Held& held : bodies_) bodies.push_back(held.body);
        return bodies;
    }

private:
    void gather() {
        std::map<std::int32_t, std::size_t> of_joined;
        body_of_.resize(model_.blocks.size());
        for (Row block = 0; block < static_cast<Row>(model_.blocks.size()); ++block) {
            const auto joined = model_.blocks.body[block];
            std::size_t body = bodies_.size();
            if (joined != 0) body = of_joined.try_emplace(joined, body).first->second;
            if (body == bodies_.size()) bodies_.emplace_back();
            body_of_[static_cast<std::size_t>(block)] = body;
            Held& held = bodies_[body];
            BodyStability& at = held.body;
            at.blocks.push_back(block);
            hold(block, held);
            at.fixed = held.held.size() == 3;
            at.volume += model_.blocks.volume[block];
            held.centre += mass_of(block) * model_.blocks.centroid[block];
            held.mass += mass_of(block);
        }
        for (Held& held : bodies_) {
            held.centre /= held.mass;
            for (const Row block : held.body.blocks) add_loads(block, held);
        }
        add_structures();
    }

    double mass_of(Row block) const {
        const double density = density_of(model_, block);
        if (std::isnan(density))
            throw Diagnostic(fmt::format("block {} has no density", model_.blocks.number[block]),
                             "give it with `prop mat`; block theory needs weights");
        return density * model_.blocks.volume[block];
    }

    void add_loads(Row block, Held& held) const {
        const Vec3& centroid = model_.blocks.centroid[block];
        held.push(mass_of(block) * model_.settings.gravity, centroid);
        if (!model_.blocks.deformable[block]) {
            held.push(model_.blocks.load[block], centroid);
            held.moment += load_moment(model_, block);
            return;
        }
        const Span points = model_.blocks.gridpoints[block];
        for (Row g = points.first; g < points.end(); ++g)
            held.push(model_.gridpoints.load[g], model_.gridpoints.position[g]);
    }

    /// Cables pull with the tension that they have, beams and liners with the forces of the last cycle.
    void add_structures() {
        if (!model_.structures.cables.empty()) {
            take_structure_properties(model_);
            std::vector<CableChain> chains;
            run_cables(model_, chains, 0);
        }
        each_structure_force(model_, [this](Row block, const Vec3& force, const Vec3& place, const Vec3&) {
            bodies_[body_of_[static_cast<std::size_t>(block)]].push(force, place);
        });
    }

    /// Takes the directions in which a velocity is prescribed anywhere on a block.
    void hold(Row block, Held& held) const {
        const auto hold_in = [&](std::uint8_t fixed, Row roller) {
            for (int k = 0; k < 3; ++k)
                if (fixed & (1 << k)) held.hold(Vec3::Unit(k));
            if (roller == 0) return;
            const Roller& along = model_.rollers[static_cast<std::size_t>(roller)];
            for (int k = 0; k < along.count; ++k) held.hold(along.direction[static_cast<std::size_t>(k)]);
        };
        const auto& points = model_.gridpoints;
        const Span span = model_.blocks.gridpoints[block];
        if (!model_.blocks.deformable[block]) return hold_in(model_.blocks.fixed[block], points.roller[span.first]);
        for (Row g = span.first; g < span.end(); ++g) hold_in(points.fixed[g], points.roller[g]);
    }

    void add_contact(Row contact, JointRegistry& laws, const WaterPressure& water) {
        const auto& contacts = model_.contacts;
        // Blocks that meet in an edge or a corner hold each other by no plane.
        if (contacts.face1[contact] == no_row || contacts.face2[contact] == no_row || !(contacts.area[contact] > 0))
            return;
        const std::size_t a = body_of_[static_cast<std::size_t>(contacts.block1[contact])],
                          b = body_of_[static_cast<std::size_t>(contacts.block2[contact])];
        if (a == b) return;
        const auto& strength = strengths_.emplace_back(joint_strength(model_, laws, contact));
        const double area = contacts.area[contact];
        const Vec3 normal = contacts.normal[contact];
        bodies_[a].sides.push_back({b, {normal, area, strength ? &*strength : nullptr}, contact});
        bodies_[b].sides.push_back({a, {-normal, area, strength ? &*strength : nullptr}, contact});
        const auto push_apart = [&](double force, const Vec3& place) {
            bodies_[a].push(-force * normal, place);
            bodies_[b].push(force * normal, place);
        };
        if (model_.settings.water == Water::points) {
            const Span span = contacts.sub_contacts[contact];
            for (Row s = span.first; s < span.end(); ++s)
                push_apart(model_.sub_contacts.pore_pressure[s] * wet_area(model_, contact, s),
                           model_.sub_contacts.position[s]);
        } else if (model_.settings.water != Water::none) push_water(model_, contact, water, push_apart);
    }

    /// One that rests without friction where it cannot slide may still roll out.
    void check_turning(const Held& held, const std::vector<char>& gone, SlidingAnswer& answer) const {
        std::vector<RestingCorner> corners;
        for (const Held::Side& side : held.sides) {
            if (gone[side.other]) continue;
            const HeldFace& face = side.face;
            const double stress = std::max(0.0, face.outward.dot(held.force)) / face.area;
            const Coulomb strength = face.strength != nullptr ? face.strength->tangent(stress) : Coulomb{};
            const auto polygons = joint_polygons(model_, side.contact);
            double count = 0;
            for (const auto& polygon : polygons) count += static_cast<double>(polygon.size());
            for (const auto& polygon : polygons)
                for (const Vec3& corner : polygon)
                    corners.push_back({face.outward, corner - held.centre, face.area / count, strength});
        }
        answer.factor = turning_factor(held.force, held.moment, corners);
        if (answer.factor) answer.mode = SlidingMode::turning;
    }

    /// Between these faces, and along the directions in which it is not held.
    SlidingAnswer answer_of(const Held& held, const std::vector<char>& gone, std::vector<HeldFace> faces) const {
        const std::size_t joints = faces.size();
        held.add_guides(faces);
        SlidingAnswer answer = slide(held.force, faces);
        const bool guided = std::erase_if(answer.faces, [&](std::size_t face) { return face >= joints; }) > 0;
        if (guided) answer.mode = answer.faces.empty() ? SlidingMode::falling : SlidingMode::one_plane;
        if (answer.mode == SlidingMode::at_rest && !held.is_pushed_on_guides()) check_turning(held, gone, answer);
        return answer;
    }

    /// Each body against those that stay; when some have been removed, the remaining ones again.
    void assess() {
        std::vector<char> gone(bodies_.size(), 0);
        for (int stage = 1;; ++stage) {
            std::vector<std::size_t> leave;
            for (std::size_t i = 0; i < bodies_.size(); ++i) {
                BodyStability& body = bodies_[i].body;
                if (body.fixed || gone[i]) continue;
                std::vector<HeldFace> faces;
                for (const Held::Side& side : bodies_[i].sides)
                    if (!gone[side.other]) faces.push_back(side.face);
                const SlidingAnswer before = body.answer;
                body.answer = answer_of(bodies_[i], gone, std::move(faces));
                const bool other = body.answer.mode != before.mode || body.answer.factor != before.factor;
                if (other && body.answer.mode != SlidingMode::held) body.stage = stage;
                if (body.answer.factor && *body.answer.factor < 1) leave.push_back(i);
            }
            if (leave.empty()) return;
            for (const std::size_t i : leave) gone[i] = 1;
        }
    }

    Model& model_;
    std::vector<Held> bodies_;
    std::deque<std::optional<Strength>> strengths_; ///< of contacts; places in it do not move
    std::vector<std::size_t> body_of_;
};

} // namespace

std::vector<BodyStability> stability_of(Model& model, JointRegistry& laws) { return StandingBodies(model, laws).all(); }

std::string list_stability(Session& session, const lang::List& command) {
    Model& model = session.engine.model;
    const double g = model.settings.gravity.norm();
    const Vec3 up = g > 0 ? Vec3(-model.settings.gravity / g) : Vec3(0, 0, 1);
    const auto rows = select(model, ObjectKind::block, session.test_of(ObjectKind::block, command.range));
    const auto shown = [&](Row block) { return std::ranges::binary_search(rows, block); };
    TextTable table({"block", "stage", "mode", "trend/plunge", "factor", "volume", "planes"});
    std::size_t count = 0, free = 0, leaving = 0;
    std::optional<double> least;
    for (const BodyStability& body : stability_of(model, session.engine.joints)) {
        const Row first = body.blocks.front();
        if (body.fixed || std::ranges::none_of(body.blocks, shown)) continue;
        ++count;
        if (body.stage == 0) continue;
        ++free;
        const auto& answer = body.answer;
        if (answer.factor && *answer.factor < 1) ++leaving;
        if (answer.factor && body.stage == 1) least = std::min(least.value_or(INFINITY), *answer.factor);
        if (table.size() < longest_table)
            table.add({std::to_string(model.blocks.number[first]), std::to_string(body.stage),
                       mode_names[static_cast<std::size_t>(answer.mode)], line_text(answer.direction, up),
                       answer.factor ? fmt::format("{:.4f}", *answer.factor) : "-", number_text(body.volume),
                       std::to_string(answer.faces.size())});
    }
    if (least) model.clock.factor_of_safety = *least;
    std::string text = free > 0 ? table.text() + "\n" : "";
    if (free > longest_table)
        text += fmt::format("... and {} more; a range picks which are shown\n", free - longest_table);
    return text +
           fmt::format(
               "{} of {} free bodies can leave their place, {} of them do (factor below 1); the others are held by their neighbours",
               free, count, leaving);
}

} // namespace kaya
