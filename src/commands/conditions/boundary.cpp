// fix, free, gravity, bound, apply, reset.
#include "commands/session/all_or_nothing.hpp"
#include "base/counted.hpp"
#include "commands/session/bodies.hpp"
#include "commands/session/handlers.hpp"
#include "commands/session/plausible.hpp"
#include "commands/conditions/tables.hpp"

#include "mechanics/supports/boundary.hpp"
#include "mechanics/assign/contact_properties.hpp"
#include "mechanics/shape/face_conditions.hpp"
#include "mechanics/supports/held_directions.hpp"
#include "mechanics/lanes/rotation.hpp"
#include "model/edit/links.hpp"
#include "model/edit/stop_motion.hpp"
#include "model/measure/measure.hpp"
#include "model/kinds/nearest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

constexpr std::array axis_names{"x", "y", "z"};
constexpr std::uint8_t all_axes = fix_x | fix_y | fix_z;

template <class List> bool any(const List& list) {
    return std::ranges::any_of(list, [](const auto& value) { return bool(value); });
}

StressField stress_field(const lang::Boundary& command) {
    const auto stress = [](const std::array<double, 6>& six) { return Stress(six.data()); };
    return {stress(*command.stress),
            {stress(command.x_gradient), stress(command.y_gradient), stress(command.z_gradient)}};
}

/// The time function of a `hist` clause. Throws Diagnostic when it gives no numbers, as far as is known before the run.
struct TimeFunctionOf {
    Session& session;

    TimeFunction operator()(const lang::Wave& wave) const {
        TimeFunction function;
        function.kind = kind_of(wave.form);
        function.frequency = wave.frequency;
        function.duration = wave.duration;
        return function;
    }
    TimeFunction operator()(const lang::TableValue& value) const {
        const std::int64_t number = table_number(session, value);
        check_table(session, number);
        TimeFunction function;
        function.kind = TimeFunction::Kind::table;
        function.table = number;
        return function;
    }
    TimeFunction operator()(const lang::ScriptValue& value) const {
        check_symbol(session, value.symbol);
        warn_of_no_value(session, value.symbol, {});
        TimeFunction function;
        function.kind = TimeFunction::Kind::script;
        function.script = value.symbol;
        return function;
    }

    static TimeFunction::Kind kind_of(lang::Wave::Form form) {
        using enum lang::Wave::Form;
        switch (form) {
        case sine: break;
        case cosine: return TimeFunction::Kind::cosine;
        case impulse: return TimeFunction::Kind::impulse;
        }
        return TimeFunction::Kind::sine;
    }
};

/// A wave begins at time 0 and has an end, if it has a duration.
void warn_of_past_wave(Session& session, const lang::Multiplier& multiplier) {
    const auto* wave = std::get_if<lang::Wave>(&multiplier.function);
    const double now = session.engine.model.clock.time;
    if (wave == nullptr || !(wave->duration > 0) || now < wave->duration) return;
    session.warn(Diagnostic(fmt::format("the wave ends at time {}, and the time is {}", number_text(wave->duration),
                                        number_text(now)),
                            "it does nothing: give `reset time` before a run that begins with it")
                     .at(multiplier.place));
}

/// The row of the function named by `hist`, checked to exist and to give numbers as far as is known before the run.
std::int32_t time_function(Session& session, const std::optional<lang::Multiplier>& multiplier) {
    if (!multiplier) return constant_in_time;
    try {
        TimeFunction function = std::visit(TimeFunctionOf{session}, multiplier->function);
        function.place = session.deck.here();
        warn_of_past_wave(session, *multiplier);
        return time_function_row(session.engine.model, function);
    } catch (Diagnostic& mistake) {
        mistake.at(multiplier->place);
        throw;
    }
}

std::uint8_t bits_of(const std::array<bool, 6>& components) {
    std::uint8_t bits = 0;
    for (std::size_t k = 0; k < 6; ++k) bits |= static_cast<std::uint8_t>(components[k] << k);
    return bits == 0 ? static_cast<std::uint8_t>(fix_all) : bits;
}

/// A load on a component that is held moves nothing.
void warn_of_held_loads(Session& session, const std::vector<Row>& blocks, const Place& place) {
    const auto& model = session.engine.model;
    static constexpr std::array directions{"x", "y", "z", "rotation about x", "rotation about y", "rotation about z"};
    const auto say = [&](Row b, int k, const char* what) {
        session.warn(Diagnostic(fmt::format("{} of block {} is loaded where it is held: {}", what,
                                            model.blocks.number[b], directions[static_cast<std::size_t>(k)]),
                                "the load moves nothing and only adds to the reaction")
                         .at(place));
    };
    for (const Row b : blocks) {
        if (!model.blocks.deformable[b]) {
            const Vec3 moment = load_moment(model, b);
            for (int k = 0; k < components; ++k) {
                const double load = k < 3 ? model.blocks.load[b][k] : moment[k - 3];
                // Moments of loads come with them, and turn a block that is held by its centroid only.
                const bool rests =
                    k >= 3 ? (model.blocks.fixed[b] & 7) == 7 : moment.norm() > 0 && (model.blocks.fixed[b] & 56) != 56;
                if (load != 0 && (model.blocks.fixed[b] & (1 << k)) && !rests) return say(b, k, "the centroid");
            }
            continue;
        }
        const Span span = model.blocks.gridpoints[b];
        for (Row g = span.first; g < span.end(); ++g)
            for (int k = 0; k < 3; ++k)
                if (model.gridpoints.load[g][k] != 0 && (model.gridpoints.fixed[g] & (1 << k)))
                    return say(b, k, "a gridpoint");
    }
}

void warn_of_no_face(Session& session, const lang::Boundary& command, std::size_t points, std::string_view what) {
    session.warn(
        Diagnostic(fmt::format("no face on the surface has all its corners among the {} gridpoints in range", points),
                   fmt::format("{} has no effect", what))
            .at(command.range.place ? command.range.place : command.place));
}

void put_reactions(Session& session, const lang::Boundary& command) {
    auto& model = session.engine.model;
    session.engine.cycle->prepare(); // forces and masses of now
    const Bodies bodies = pick_bodies(session, command.range);
    for (int axis = 0; axis < 3; ++axis) {
        if (!command.reaction[axis]) continue;
        const auto held = [&](std::uint8_t fixed) { return (fixed & (1 << axis)) != 0; };
        if (std::ranges::none_of(bodies.blocks, [&](Row b) { return held(model.blocks.fixed[b]); }) &&
            std::ranges::none_of(bodies.gridpoints, [&](Row g) { return held(model.gridpoints.fixed[g]); }))
            session.warn(
                Diagnostic(fmt::format("nothing in range is held in {}", axis_names[axis]),
                           fmt::format(fmt::runtime(session.deck.in_words(
                                           "{0}reaction has no effect: hold it first, e.g. `bound {0}vel 0`, and cycle",
                                           "reaction-{0} has no effect: hold it first, e.g. `block gridpoint apply "
                                           "velocity-{0} 0`, and cycle")),
                                       axis_names[axis]))
                    .at(command.place));
        replace_by_reaction(model, bodies, axis);
    }
}

std::uint8_t quiet_bits(const lang::Boundary& command) {
    std::uint8_t bits = 0;
    for (std::size_t k = 0; k < command.quiet.size(); ++k) bits |= static_cast<std::uint8_t>(command.quiet[k] << k);
    return bits;
}

/// Faces that a range picks by their own group, where it picks no gridpoint.
std::vector<Row> grouped_faces(Session& session, const lang::RangePhrase& range) {
    if (!has_element(session.deck.ranges, range, lang::RangeElement::Kind::group)) return {};
    if (!select(session.engine.model, ObjectKind::gridpoint, session.test_of(ObjectKind::gridpoint, range)).empty())
        return {};
    return select(session.engine.model, ObjectKind::face, session.test_of(ObjectKind::face, range));
}

/// The gridpoints in range, or those of its faces, in order.
std::vector<Row> points_in_range(Session& session, const lang::Boundary& command, const std::vector<Row>& faces) {
    if (faces.empty()) return session.pick(ObjectKind::gridpoint, command.range);
    const auto& triangles = session.engine.model.triangles;
    std::vector<Row> points;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        if (std::ranges::binary_search(faces, triangles.face[t]))
            points.insert(points.end(), triangles.gridpoints[t].begin(), triangles.gridpoints[t].end());
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

/// The exterior triangles of the faces, or of the gridpoints when there are none, that are covered by this part at most.
std::vector<Row> exterior_of(Session& session, const std::vector<Row>& faces, const std::vector<Row>& points,
                             double most_covered = 1) {
    find_contacts(session.engine.model, session.engine.joints); // they define the exterior faces
    return faces.empty() ? exterior_triangles(session.engine.model, points, most_covered)
                         : exterior_triangles_of_faces(session.engine.model, faces, most_covered);
}

/// The triangles on which nvel and quiet boundaries act: those that are free by half. Throws Diagnostic when all are of rigid blocks.
std::vector<Row> triangles_in_range(Session& session, const lang::Boundary& command, const std::vector<Row>& faces,
                                    const std::vector<Row>& points) {
    auto& model = session.engine.model;
    const bool quiet = quiet_bits(command) != 0;
    const auto triangles = exterior_of(session, faces, points, 0.5);
    if (triangles.empty()) warn_of_no_face(session, command, points.size(), quiet ? "the quiet boundary" : "nvel");
    const auto soft = [&](Row t) { return model.blocks.deformable[model.faces.block[model.triangles.face[t]]] != 0; };
    if (!triangles.empty() && std::ranges::none_of(triangles, soft))
        throw Diagnostic(
            "all faces in range belong to rigid blocks",
            quiet ? session.deck.in_words("a quiet boundary needs zones, in which waves run: give `generate "
                                          "edge` before it",
                                          "a quiet boundary needs zones, in which waves run: give `block zone "
                                          "generate edgelength` before it")
                  : session.deck.in_words("hold the blocks with `bound xvel` (or y, z), or give `generate "
                                          "edge` before it",
                                          "hold the blocks with `block gridpoint apply velocity-x` (or y, z), "
                                          "or give `block zone generate edgelength` before it"))
            .at(command.place);
    return triangles;
}

/// A dashpot on a component that is held does nothing.
void warn_of_held_dashpots(Session& session, const std::vector<Row>& triangles, const Place& place) {
    const Model& model = session.engine.model;
    for (const Row t : triangles)
        for (const Row g : model.triangles.gridpoints[t])
            for (int axis = 0; axis < 3; ++axis)
                if ((model.gridpoints.fixed[g] & (1 << axis)) &&
                    (model.triangles.quiet[t] & ((quiet_x << axis) | quiet_normal | quiet_shear))) {
                    session.warn(
                        Diagnostic(fmt::format("a gridpoint of block {} on the quiet boundary is held in {}",
                                               model.blocks.number[model.gridpoints.block[g]], axis_names[axis]),
                                   fmt::format(fmt::runtime(session.deck.in_words(
                                                   "waves come back from it: let it go with `bound {0}reaction`, which "
                                                   "keeps the force that holds it",
                                                   "waves come back from it: let it go with `block gridpoint apply "
                                                   "reaction-{0}`, which keeps the force that holds it")),
                                               axis_names[axis]))
                            .at(place));
                    return;
                }
}

/// nvel, and quiet boundaries.
void put_on_faces(Session& session, const lang::Boundary& command, const std::vector<Row>& triangles) {
    auto& model = session.engine.model;
    const std::uint8_t bits = quiet_bits(command);
    double area = 0;
    for (const Row t : triangles) area += triangle_area_vector(model, t).norm();
    session.program.output.say(
        fmt::format("{} an area of {}", bits != 0 ? "quiet boundary on" : "nvel holds", number_text(area)));
    if (command.normal_velocity) hold_normals(model, triangles, *command.normal_velocity);
    if (bits == 0) return;
    make_quiet(model, triangles, bits);
    warn_of_held_dashpots(session, triangles, command.place);
}

void reset_time(Session& session) { session.engine.model.clock.time = 0; }

void reset_histories(Session& session) { session.engine.model.histories = Histories{}; }

void reset_displacements(Session& session) {
    links::clear(session.engine.model.gridpoints, {Role::displacement});
    links::clear(session.engine.model.blocks, {Role::displacement});
    links::clear(session.engine.model.structures.member_nodes, {Role::displacement});
}

void reset_joint_displacements(Session& session) {
    links::clear(session.engine.model.sub_contacts, {Role::displacement});
}

void reset_energy(Session& session) {
    // The energy account restarts with the present kinetic energy.
    auto& energy = session.engine.model.energy;
    const double kinetic = energy.kinetic;
    energy = Energy{};
    energy.kinetic = energy.start = kinetic;
}

void reset_damping(Session& session) { session.engine.model.clock.global_viscosity = 0; }

void reset(Session& session, lang::Reset::What what) {
    using enum lang::Reset::What;
    switch (what) {
    case time: return reset_time(session);
    case histories: return reset_histories(session);
    case displacements: return reset_displacements(session);
    case velocities: return stop_motion(session.engine.model);
    case joint_displacements: return reset_joint_displacements(session);
    case energy: return reset_energy(session);
    case damping: return reset_damping(session);
    }
}

} // namespace

void run(Session& session, const lang::Fix& command) {
    const auto blocks = session.pick(ObjectKind::block, command.range);
    std::array<std::optional<double>, components> held;
    for (std::size_t k = 0; k < held.size(); ++k)
        if (command.components[k]) held[k] = 0;
    check_rotation(session.engine.model, {blocks, {}}, held, session.deck.interpreter.current_place());
    for (const Vec3& direction : command.directions) hold_direction(session.engine.model, {blocks, {}}, direction, 0);
    if (any(command.components) || command.directions.empty())
        fix_blocks(session.engine.model, blocks, bits_of(command.components));
    warn_of_held_loads(session, blocks, command.range.place);
}

void run(Session& session, const lang::Free& command) {
    const auto blocks = session.pick(ObjectKind::block, command.range);
    const std::uint8_t bits = command.directions && !any(command.components) ? 0 : bits_of(command.components);
    if (bits != 0) free_blocks(session.engine.model, blocks, bits);
    if (command.directions || (bits & all_axes) == all_axes) free_directions(session.engine.model, {blocks, {}});
}

void run(Session& session, const lang::Gravity& command) {
    doubt_gravity(session, command.value, session.deck.interpreter.current_place());
    session.engine.model.settings.gravity = command.value;
}

namespace {

bool on_faces(const lang::Boundary& command) { return any(command.quiet) || command.normal_velocity; }

void bound(Session& session, const lang::Boundary& command) {
    auto& model = session.engine.model;
    const auto function = time_function(session, command.multiplier);
    std::vector<Row> faces, points, triangles;
    const bool loads = any(command.load) || !command.directed_load.empty() || command.stress;
    if (command.stress || on_faces(command)) faces = grouped_faces(session, command.range);
    if (loads || on_faces(command)) points = points_in_range(session, command, faces);
    if (on_faces(command) && !points.empty()) triangles = triangles_in_range(session, command, faces, points);
    if (any(command.reaction)) put_reactions(session, command);
    if (any(command.velocity) || any(command.free)) {
        const Bodies bodies = pick_bodies(session, command.range);
        check_rotation(model, bodies, command.velocity, command.place);
        for (int k = 0; k < components; ++k) {
            if (command.velocity[k]) prescribe_velocity(model, bodies, k, *command.velocity[k], function);
            if (command.free[k]) release_velocity(model, bodies, k);
        }
        const auto axes = static_cast<std::uint8_t>(command.free[0] | command.free[1] << 1 | command.free[2] << 2);
        if (axes != 0) free_faces(model, bodies.gridpoints, axes);
        if (axes == all_axes) free_directions(model, bodies);
    }
    if (any(command.velocity) && !on_faces(command)) {
        std::vector<Row> quiet;
        for (Row t = 0; t < static_cast<Row>(model.triangles.size()); ++t)
            if (model.triangles.quiet[t] != 0) quiet.push_back(t);
        warn_of_held_dashpots(session, quiet, command.place);
    }
    if (!command.directed_velocity.empty()) {
        const Bodies bodies = pick_bodies(session, command.range);
        for (const auto& [speed, direction] : command.directed_velocity)
            hold_direction(model, bodies, direction, speed);
    }
    if (!triangles.empty()) put_on_faces(session, command, triangles);
    if (points.empty() || !loads) return;
    for (int axis = 0; axis < 3; ++axis) {
        if (!command.load[axis]) continue;
        add_load(model, points, axis, *command.load[axis], function);
        // Repeated loads add up, at every gridpoint: the number shows what the total became.
        session.program.output.say(fmt::format("{}load {} added at {}", axis_names[axis],
                                               number_text(*command.load[axis]), counted(points.size(), "gridpoint")));
    }
    for (const auto& [force, direction] : command.directed_load) {
        const Vec3 vector = force * direction.normalized();
        for (int axis = 0; axis < 3; ++axis)
            if (vector[axis] != 0) add_load(model, points, axis, vector[axis], function);
        session.program.output.say(fmt::format("load {} along {} added at {}", number_text(force),
                                               vector_text(direction.normalized()),
                                               counted(points.size(), "gridpoint")));
    }
    if (command.stress) {
        const double area = add_stress_on(model, exterior_of(session, faces, points), stress_field(command), function);
        if (area == 0) warn_of_no_face(session, command, points.size(), "the stress");
        else session.program.output.say(fmt::format("stress added on an area of {}", number_text(area)));
    }
    std::vector<Row> blocks;
    for (const Row g : points)
        if (blocks.empty() || blocks.back() != model.gridpoints.block[g]) blocks.push_back(model.gridpoints.block[g]);
    warn_of_held_loads(session, blocks, command.place);
}

} // namespace

void run(Session& session, const lang::Boundary& command) {
    // Exterior faces follow from contacts, which are updated first.
    if (command.stress || on_faces(command)) return all_or_nothing(session, [&] { bound(session, command); });
    bound(session, command);
}

namespace {

using Vec6 = std::array<double, 6>;

/// Force and moment of a line.
Vec6 load_of(const lang::Apply& command) {
    Vec6 sum{};
    for (std::size_t k = 0; k < 6; ++k) sum[k] = command.load[k].value_or(0);
    const auto add = [&](const std::vector<lang::Directed>& all, std::size_t first) {
        for (const auto& [value, direction] : all) {
            const Vec3 vector = value * direction.normalized();
            for (std::size_t k = 0; k < 3; ++k) sum[first + k] += vector[static_cast<Eigen::Index>(k)];
        }
    };
    add(command.directed_load, 0);
    add(command.directed_moment, 3);
    if (!std::ranges::all_of(sum, [](double part) { return std::isfinite(part); }))
        throw Diagnostic("the loads of the line add up to more than a number can hold").at(command.place);
    return sum;
}

/// A single place must lie in or on one block.
void check_place_of_load(Session& session, const lang::Apply& command, const std::vector<Row>& blocks) {
    const Model& model = session.engine.model;
    if (blocks.size() > 1)
        throw Diagnostic(
            fmt::format("{} are in range, and a force acts at a place of one", counted(blocks.size(), "block")),
            "pick one block, e.g. with range id n")
            .at(command.place);
    const Row b = blocks.front();
    const double away = distance_to(model, ObjectKind::block, b, *command.at);
    constexpr double on_it = 1e-3; // of the size of the block: places are given before it has moved a little
    if (away > on_it * block_size(model, b))
        session.warn(Diagnostic(fmt::format("{} is {} away from block {}, which is loaded there",
                                            place_text(*command.at), number_text(away), model.blocks.number[b]),
                                "the force acts on it as if by a rigid arm")
                         .at(command.place));
}

} // namespace

void run(Session& session, const lang::Apply& command) {
    auto& model = session.engine.model;
    const auto function = time_function(session, command.multiplier);
    const auto blocks = session.pick(ObjectKind::block, command.range);
    const Vec6 load = load_of(command);
    const bool loaded = any(command.load) || !command.directed_load.empty() || !command.directed_moment.empty();
    if (loaded)
        for (const Row b : blocks)
            if (model.blocks.deformable[b])
                throw Diagnostic(
                    fmt::format("block {} is deformable and takes no load as a whole", model.blocks.number[b]),
                    "load its gridpoints with bound, or exclude it from the range")
                    .at(command.place);
    if (command.at && !blocks.empty()) check_place_of_load(session, command, blocks);
    check_rotation(model, {blocks, {}}, command.velocity, command.place);
    for (int k = 0; k < components; ++k)
        if (command.velocity[k]) prescribe_velocity(model, {blocks, {}}, k, *command.velocity[k], function);
    for (const auto& [speed, direction] : command.directed_velocity)
        hold_direction(model, {blocks, {}}, direction, speed);
    for (int k = command.at ? 3 : 0; k < components; ++k)
        if (load[static_cast<std::size_t>(k)] != 0)
            add_block_load(model, blocks, k, load[static_cast<std::size_t>(k)], function);
    if (command.at)
        for (const Row b : blocks) add_load_at(model, b, *command.at, {load[0], load[1], load[2]}, function);
    if (loaded) warn_of_held_loads(session, blocks, command.place);
}

void run(Session& session, const lang::Reset& command) {
    for (const auto what : command.what) reset(session, what);
}

void add_handlers(HandlerTable& table, lang::BoundaryCommands list) { fill(table, list); }

} // namespace kaya
