// Joints within which the water below a ground surface ends: they do not have its exact force.
#include "commands/session/plausible.hpp"

#include "base/counted.hpp"
#include "commands/session/session.hpp"
#include "model/measure/joint_water.hpp"
#include "model/measure/overlap_rows.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

/// Whether this water has not been looked at for this rock: a deck may run a few cycles a thousand times.
bool is_new(Session& session) {
    const Settings& s = session.engine.model.settings;
    const Vec3 &d = s.water_direction, &o = s.water_origin;
    const auto key =
        fmt::format("water {} {} {} {} {} {} {} {} {} {}", static_cast<int>(s.water), s.water_value, d.x(), d.y(),
                    d.z(), o.x(), o.y(), o.z(), session.engine.model.blocks.size(), session.engine.model.zones.size());
    return session.program.said_once.insert(key).second;
}

/// Whether the pressure is above 0 at some sub-contacts of a joint and would be below 0 at others.
bool ends_within(const Model& model, const WaterPressure& water, Row contact) {
    bool wet = false, dry = false;
    const Span span = model.contacts.sub_contacts[contact];
    for (Row s = span.first; s < span.end(); ++s) {
        const double pressure = water.unlimited_at(model.sub_contacts.load_place(s));
        wet = wet || pressure > 0;
        dry = dry || pressure < 0;
    }
    return wet && dry;
}

double by_sub_contacts(const Model& model, const WaterPressure& water, Row contact) {
    double force = 0;
    const Span span = model.contacts.sub_contacts[contact];
    for (Row s = span.first; s < span.end(); ++s)
        force += water.at(model.sub_contacts.load_place(s)) * wet_area(model, contact, s);
    return force;
}

} // namespace

void doubt_water_lines(Session& session) {
    constexpr double noticeable = 0.02; // of the weight of the lighter block
    const Model& model = session.engine.model;
    const double g = model.settings.gravity.norm();
    if (model.settings.water != Water::ground || !(g > 0)) return;
    if (!is_new(session)) return;
    const WaterPressure water(model);
    const auto weight = [&](Row block) {
        const auto material = model.materials.find(model.blocks.material[block]);
        const double density = material == model.materials.end() ? 0 : material->second.density;
        return density > 0 ? density * model.blocks.volume[block] * g : 0;
    };
    std::int64_t count = 0;
    double most = 0, there = 0, exact = 0;
    Row worst = no_row;
    for (Row c = 0; c < static_cast<Row>(model.contacts.size()); ++c) {
        if (!ends_within(model, water, c)) continue;
        double force = 0;
        push_water(model, c, water, [&](double part, const Vec3&) { force += part; });
        const double found = by_sub_contacts(model, water, c), off = std::abs(found - force);
        if (!(off > noticeable * std::min(weight(model.contacts.block1[c]), weight(model.contacts.block2[c]))))
            continue;
        ++count;
        if (off <= most) continue;
        most = off;
        there = found;
        exact = force;
        worst = c;
    }
    if (count == 0) return;
    const Row b1 = model.contacts.block1[worst], b2 = model.contacts.block2[worst];
    const std::string text = fmt::format(
        "the water ends within {}, and sub-contacts take another force from it: {:.4g} for {:.4g} between blocks {} and {}",
        counted(count, "joint"), there, exact, model.blocks.number[b1], model.blocks.number[b2]);
    if (!session.program.said_once.insert(fmt::format("water line {} {}", b1, b2)).second) return;
    Diagnostic d(text,
                 session.deck.in_words(
                     "they have the pressure of their places: give more of them with `facetri edge`, smaller cells "
                     "with `generate edge`, or cut the blocks at the water level",
                     "they have the pressure of their places: give more of them with `block face triangulate "
                     "edge-max`, smaller cells with `block zone generate edgelength`, or cut the blocks at the "
                     "water level"));
    d.code = "water-line";
    session.warn(std::move(d));
}

} // namespace kaya
