// The elements of a range phrase, and the words of those whose parts are numbers, a name or nothing.
#pragma once

#include "lang/interp/spec.hpp"

#include <string_view>
#include <vector>

namespace kaya::lang {

enum class RangeKind {
    x,
    y,
    z,        ///< low, high (one value: low == high, a plane)
    box,      ///< position v1 v2: corner1, corner2
    plane,    ///< normal, origin, side (+1 above, -1 below) or distance
    sphere,   ///< centre, radius1 (inner, 0) and radius2
    cylinder, ///< centre, end2, radius1, radius2
    group,
    material,
    constitutive,
    joint_material,
    region,
    joint_set, ///< name or number
    id,        ///< low..high
    block_id,  ///< low..high, of the block the object belongs to
    material_intersection,
    region_intersection, ///< low and high are the two numbers
    named,               ///< `range nrange NAME`: name
    volume,              ///< low..high, of blocks
    deformable,          ///< blocks with zones
    visible,             ///< objects of blocks that are not hidden
    group_intersection,  ///< contacts between the groups name and second_name
    joint_model,         ///< contacts that have the joint model name
    id_list,             ///< numbers
    joint_group,         ///< contacts of the group name
    excavated,           ///< blocks that fill can put back
    joint_state,         ///< sub-contacts in the state name, and contacts that have one
    surface,             ///< faces without a block on the other side, and objects on them
    orientation,         ///< normal, and radius1 as tolerance in degrees: faces and contacts
    concave,             ///< bodies that are not convex
    edge_length,         ///< low..high, shortest edge of a block
    aspect_ratio,        ///< low..high, longest edge of a block over the cube root of its volume
    face_area,           ///< low..high, smallest face of a block
    leader,              ///< low..high, number of the first block of a body
    polygon,             ///< vertices; distance from its plane
    ellipse,             ///< centre, half axes end2 and normal; distance from its plane
    ground,              ///< above (side 1) or below (-1) the ground surface of the file name, moved by centre
    geometry_space, ///< a ray along normal crosses the surfaces of sets an odd (side 1) or even (-1) number of times, or `low` times (2)
    geometry_distance, ///< within distance of the surfaces of sets
    fracture,          ///< cut by the fracture of an id, or of one of several; 0: by none
    network            ///< cut by the fractures of the network name, or within distance of them where `side` is 1
};

/// How the element of a kind is written.
struct RangeWords {
    enum Form {
        coordinate,        ///< one value, or two limits
        number,            ///< one number, or several
        limits_of_numbers, ///< a number, or the first and the last
        two_numbers,       ///< of the blocks on both sides of a contact
        limits,            ///< two limits
        name,
        flag, ///< nothing, on or off
        own   ///< special parts: lang/commands/range.cpp
    };
    RangeKind kind;
    Form form;
    std::vector<Spelling> words;
    std::string_view unit, help;
};

/// In the order in which abbreviations are resolved.
inline const std::vector<RangeWords>& range_words() {
    using enum RangeWords::Form;
    static const std::vector<RangeWords> rows = {
        // clang-format off
        {RangeKind::x, coordinate, {"x", "xr", Spelling{"position-x", 10}}, "length", "x between two limits, or at one value"},
        {RangeKind::y, coordinate, {"y", "yr", Spelling{"position-y", 10}}, "length", "y between two limits, or at one value"},
        {RangeKind::z, coordinate, {"z", "zr", Spelling{"position-z", 10}}, "length", "z between two limits, or at one value"},
        {RangeKind::box, own, {}, "", ""},
        {RangeKind::group, own, {}, "", ""},
        {RangeKind::material, number, {"material", "mat"}, "", "blocks of a material number, or of one of several"},
        {RangeKind::constitutive, number, {"constitutive", "cons"}, "", "blocks of a constitutive number"},
        {RangeKind::joint_material, number, {"jmaterial", "jmat"}, "", "contacts of a joint material number, or of one of several"},
        {RangeKind::joint_model, number, {"jconstitutive", "jcons"}, "", "contacts of a joint constitutive number"},
        {RangeKind::region, number, {"region"}, "", "blocks of a region number, or of one of several"},
        {RangeKind::joint_set, number, {"jset", "joint-set"}, "", "contacts of a joint set, or of one of several"},
        {RangeKind::id, limits_of_numbers, {"id"}, "", "identity numbers of the objects themselves"},
        {RangeKind::block_id, limits_of_numbers, {"bid"}, "", "identity numbers of the blocks that the objects belong to"},
        {RangeKind::block_id, own, {}, "", ""},
        {RangeKind::material_intersection, two_numbers, {"mintersection"}, "", "contacts between two materials"},
        {RangeKind::region_intersection, two_numbers, {"rintersection"}, "", "contacts between two regions"},
        {RangeKind::named, own, {}, "", ""},
        {RangeKind::group_intersection, own, {}, "", ""},
        {RangeKind::joint_model, name, {"jmodel"}, "", "contacts that have a joint model"},
        {RangeKind::volume, limits, {"volume"}, "volume", "blocks of a volume between two limits"},
        {RangeKind::deformable, flag, {"deformable"}, "", "blocks with zones, and their parts"},
        {RangeKind::visible, flag, {"visible"}, "", "blocks that are not hidden"},
        {RangeKind::id_list, own, {}, "", ""},
        {RangeKind::joint_group, name, {"jgroup"}, "", "contacts of a group of joints"},
        {RangeKind::excavated, flag, {"excavated"}, "", "blocks that fill can put back"},
        {RangeKind::joint_state, name, {Spelling{"state", 4}}, "", "sub-contacts in a state of their joint model, and contacts that have one; `slip` means slip-now and slip-past"},
        {RangeKind::surface, flag, {Spelling{"surface", 4}}, "", "faces on which no other block lies, and what is on them"},
        {RangeKind::concave, flag, {Spelling{"concave", 4}}, "", "joined blocks that make a body which is not convex"},
        {RangeKind::edge_length, limits, {Spelling{"edge-length", 4}}, "length", "blocks whose shortest edge is between two limits"},
        {RangeKind::aspect_ratio, limits, {Spelling{"aspect-ratio", 4}}, "", "blocks whose longest edge over the cube root of their volume is between two limits; 1 for a cube"},
        {RangeKind::face_area, limits, {Spelling{"face-area", 4}}, "area", "blocks whose smallest face is between two limits"},
        {RangeKind::leader, limits_of_numbers, {Spelling{"leader-id", 4}}, "", "blocks of bodies by the number of the body's first block; a block on its own is its own leader"},
        {RangeKind::fracture, number, {"fid", "fracture-id"}, "", "contacts and faces that a fracture has cut, and blocks with such a face; 0: those of no fracture"},
        {RangeKind::network, own, {}, "", ""},
        {RangeKind::polygon, own, {}, "", ""},
        // clang-format on
    };
    return rows;
}

} // namespace kaya::lang
