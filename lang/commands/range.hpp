// The range phrase, bound: what the words say, without knowing what they pick.
#pragma once

#include "base/diagnostic.hpp"
#include "base/vector.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace kaya::lang {

/// One element of a range phrase.
struct RangeElement {
    enum class Kind {
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
        surface,             ///< faces on which no other block lies, and what touches them
        orientation,         ///< normal, and radius1 as tolerance in degrees: faces and contacts
        concave,             ///< bodies that are not convex
        edge_length,         ///< low..high, shortest edge of a block
        aspect_ratio,        ///< low..high, extent over thickness of a block
        leader,              ///< low..high, number of the first block of a body
        polygon,             ///< vertices; distance from its plane
        ellipse,             ///< centre, half axes end2 and normal; distance from its plane
        ground               ///< above (side 1) or below (-1) the ground surface of the file name, moved by centre
    };
    static constexpr Kind last_kind = Kind::ground;
    Kind kind = Kind::x;
    double low = 0, high = 0;
    Vec3 centre = Vec3::Zero(), end2 = Vec3::Zero(), normal = Vec3::UnitZ();
    double radius1 = 0, radius2 = 0, distance = 0;
    int side = 0;
    std::string name, second_name;
    std::vector<std::int64_t> numbers;
    std::vector<Vec3> vertices;
    bool both = false; ///< `matches 2`: both blocks of a contact
    bool negated = false;
    Place place;
};

struct RangePhrase {
    std::vector<RangeElement> elements; ///< none: everything visible
    bool any = false;                   ///< `union`: one element is enough
    Place place;                        ///< of the word `range`; none when there is no phrase
    bool whole = false;                 ///< `extent`: all corners of an object, not only its place
};

} // namespace kaya::lang
