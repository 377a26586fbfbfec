// The whole state of a run. Nothing else owns state.
#pragma once

#include "model/tables/blocks.hpp"
#include "model/tables/contacts.hpp"
#include "model/tables/boundary_histories.hpp"
#include "model/tables/energy.hpp"
#include "model/tables/history.hpp"
#include "model/tables/materials.hpp"
#include "model/tables/model_edit.hpp"
#include "model/tables/placed_load_table.hpp"
#include "model/tables/settings.hpp"
#include "model/tables/structure_tables.hpp"
#include "geometry/ground/ground.hpp"
#include "model/tables/tie_tables.hpp"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace kaya {

/// Inactive blocks with all their parts. Their rows are linked as those of the model; they have no ids.
struct Excavated {
    Blocks blocks;
    Gridpoints gridpoints;
    Faces faces;
    Triangles triangles;
    Zones zones;
};

/// Directions in which gridpoints are held, and how fast they move along each: `bound nvel`.
struct Roller {
    std::int32_t count = 0;
    std::array<Vec3, 3> direction{Vec3::Zero(), Vec3::Zero(),
                                  Vec3::Zero()}; ///< unit, at right angles; the first `count`
    Vec3 speed = Vec3::Zero();                   ///< along each of them
    bool operator==(const Roller&) const = default;
};

/// Bits of Model::unreduced.
enum KeptStrength : std::uint8_t { keep_friction = 1, keep_cohesion = 2, keep_tension = 4 };

struct Model {
    // In model.cpp: 300 columns are copied or destroyed, too much code for each file that has a model.
    Model();
    Model(const Model& other);
    Model(Model&& other) noexcept;
    Model& operator=(const Model& other);
    Model& operator=(Model&& other) noexcept;
    ~Model();

    Blocks blocks;
    Gridpoints gridpoints;
    Faces faces;
    Triangles triangles;
    Zones zones;
    Contacts contacts;
    SubContacts sub_contacts;
    TiedPairs tied_pairs;
    Ties ties;
    BoundaryHistories boundary_histories;
    PlacedLoads placed_loads;
    Excavated excavated; ///< blocks that were excavated and may be put back
    Structures structures;

    std::map<std::int32_t, Material> materials;
    std::vector<JointProperties> joint_properties;
    std::vector<JointRule> joint_rules;                            ///< of new contacts; the first that fits counts
    std::vector<ZoneProperties> zone_properties{ZoneProperties{}}; ///< of blocks; the first is empty
    std::map<std::int32_t, std::string> joint_constitutive;        ///< model name of each `jcons` number
    std::vector<std::string> group_names{""}; ///< groups that objects have, one in every slot: groups.hpp
    std::vector<TimeFunction> time_functions; ///< of drives
    std::vector<Roller> rollers{Roller{}};    ///< the first holds nothing
    Ground water_ground;                      ///< the water table, where the settings take water from it

    Settings settings;
    Clock clock;
    Energy energy;
    Histories histories;

    std::int32_t next_block_number = 1;
    std::int32_t next_shape_number = 1;
    std::int32_t next_contact_number = 1;
    std::int32_t next_sub_contact_number = 1;
    std::int32_t ruled_contacts = 0; ///< contacts with lower numbers are not new to `joint_rules`

    Stale stale; ///< raised by ModelEdit

    /// Strengths of zones that Settings::strength_factor leaves alone, KeptStrength bits. Not part of the state: only trials of `solve
    /// fos` set it.
    std::uint8_t unreduced = 0;

    // Sub-contacts whose joint models must still be called (mechanics/contact/take_over.hpp). Not part of the state: this is done before the model
    // cycles or is saved.
    std::vector<SubContactId> forces_set; ///< by scripts
    std::vector<SubContactId> taken_over; ///< their joint model, its values or forces were set by commands

    /// Every table with its name, in a fixed order.
    template <class Visit> void tables(Visit&& visit) {
        present_tables(visit);
        visit("excavated_blocks", excavated.blocks);
        visit("excavated_gridpoints", excavated.gridpoints);
        visit("excavated_faces", excavated.faces);
        visit("excavated_triangles", excavated.triangles);
        visit("excavated_zones", excavated.zones);
    }
    /// The tables of active objects.
    template <class Visit> void present_tables(Visit&& visit) {
        visit("blocks", blocks);
        visit("gridpoints", gridpoints);
        visit("faces", faces);
        visit("triangles", triangles);
        visit("zones", zones);
        visit("contacts", contacts);
        visit("sub_contacts", sub_contacts);
        visit("tied_pairs", tied_pairs);
        visit("ties", ties);
        visit("drives", boundary_histories);
        visit("placed_loads", placed_loads);
    }
    /// The tables of structures.
    template <class Visit> void structure_tables(Visit&& visit) {
        cable_tables(visit);
        member_tables(visit);
    }
    template <class Visit> void cable_tables(Visit&& visit) {
        visit("cables", structures.cables);
        visit("cable_nodes", structures.cable_nodes);
    }
    template <class Visit> void member_tables(Visit&& visit) {
        visit("members", structures.members);
        visit("member_nodes", structures.member_nodes);
        visit("beams", structures.beams);
        visit("liners", structures.liners);
    }
};

inline ModelEdit::ModelEdit(Model& model, Change change) : stale_(model.stale), change_(change) {}

} // namespace kaya
