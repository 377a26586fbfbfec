#include "mechanics/assign/cut_joints.hpp"

#include "mechanics/assign/contact_properties.hpp"
#include "mechanics/common/near_pairs.hpp"
#include "mechanics/common/property_sets.hpp"
#include "mechanics/contact/contact_geometry.hpp"
#include "mechanics/contact/contact_load.hpp"
#include "mechanics/contact/contact_table.hpp"
#include "mechanics/contact/load_before.hpp"
#include "mechanics/contact/overlap_contact.hpp"
#include "mechanics/shape/flat_face.hpp"
#include "mechanics/shape/search_scratch.hpp"
#include "model/measure/block_box.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace kaya {

namespace {

/// A future row of the contact table: a contact, or a copy of it for two pieces of its blocks.
struct Share {
    Row block1, block2;
    Row from;
    bool copy;
    bool meets = true;                  ///< its blocks touch where the whole ones did
    Row face1 = no_row, face2 = no_row; ///< that they have on its plane
    double faces_area = 0;              ///< common to these
};

/// Joints of whole blocks by the rows of these blocks, which are those of the first pieces.
class WholeJoints {
public:
    WholeJoints(const Model& model, const std::vector<WholeJoint>& whole, const std::vector<BlockId>& origin) {
        for (const BlockId& id : origin) first_piece_.push_back(model.blocks.ids.row(id));
        for (const WholeJoint& joint : whole)
            of_pair_[pair_of(model.blocks.ids.row(joint.block1), model.blocks.ids.row(joint.block2))] = &joint;
    }

    /// Of the blocks from which two pieces were cut, or null.
    const WholeJoint* of(Row piece1, Row piece2) const {
        const auto found = of_pair_.find(pair_of(first_piece(piece1), first_piece(piece2)));
        return found == of_pair_.end() ? nullptr : found->second;
    }
    Row first_piece(Row piece) const { return first_piece_[static_cast<std::size_t>(piece)]; }

private:
    static std::pair<Row, Row> pair_of(Row a, Row b) { return {std::min(a, b), std::max(a, b)}; }

    std::vector<Row> first_piece_;
    std::map<std::pair<Row, Row>, const WholeJoint*> of_pair_;
};

/// Finds out which pieces touch.
class CommonFaces {
public:
    CommonFaces(const Model& model, const std::vector<Share>& shares) : model_(model) {
        std::vector<Row> blocks;
        for (const Share& share : shares) {
            blocks.push_back(share.block1);
            blocks.push_back(share.block2);
        }
        std::ranges::sort(blocks);
        const auto again = std::ranges::unique(blocks);
        blocks.erase(again.begin(), again.end());
        surfaces_.update(model, blocks);
    }

    /// Pieces of blocks that lie on faces share a part of their plane: elsewhere they touch at corners, which carry nothing yet.
    void note(Share& share) {
        const auto& contacts = model_.contacts;
        const auto& margin = model_.blocks.margin;
        points_.clear();
        ContactGeometry geometry{{}, ContactPoints(points_)};
        const double reach = 0.5 * (margin[share.block1] + margin[share.block2]);
        const bool found = find_geometry(model_, surfaces_, share.block1, share.block2, no_row, FinePlaces::none, reach,
                                         geometry, scratch_);
        const bool on_faces = found && geometry.kind == ContactKind::joint && geometry.type == ContactType::face_face &&
                              std::abs(geometry.normal.dot(contacts.normal[share.from])) > 1 - nearly_parallel;
        if (on_faces) {
            share.face1 = geometry.face1;
            share.face2 = geometry.face2;
            share.faces_area = geometry.area;
        }
        share.meets = contacts.type[share.from] == ContactType::face_face ? on_faces : found;
    }

private:
    const Model& model_;
    Surfaces surfaces_;
    SearchScratch scratch_;
    std::vector<ContactPoint> points_;
};

/// The joints that pieces of two blocks may share, which are near each other.
std::vector<Share> possible_shares(const Model& model, const WholeJoints& whole) {
    const auto& contacts = model.contacts;
    std::vector<Share> shares;
    std::vector<Box> boxes;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        const Box box = block_box(model, static_cast<Row>(b));
        const Vec3 margin = Vec3::Constant(model.blocks.margin[b]);
        boxes.push_back({box.low - margin, box.high + margin});
    }
    NearPairs near;
    for (const auto& [one, two] : near.of(boxes)) {
        const WholeJoint* joint = whole.of(one, two);
        if (joint == nullptr) continue;
        const Row c = contacts.ids.row(joint->contact);
        const bool copy = whole.first_piece(one) != one || whole.first_piece(two) != two;
        // Places of small strain do not follow the blocks: an overlap there cannot be divided.
        if (copy && contacts.kind[c] == ContactKind::overlap && !model.settings.large_strain) continue;
        shares.push_back({one, two, c, copy});
    }
    return shares;
}

/// Contacts of other blocks, and joints of cut ones with copies for the pieces; sorted by their blocks.
std::vector<Share> shares_of(const Model& model, const WholeJoints& whole) {
    const auto& contacts = model.contacts;
    std::vector<Share> shares = possible_shares(model, whole);
    CommonFaces faces(model, shares);
    for (Share& share : shares) faces.note(share);
    std::erase_if(shares, [](const Share& share) { return !share.meets; });
    for (std::size_t c = 0; c < contacts.size(); ++c)
        if (whole.of(contacts.block1[c], contacts.block2[c]) == nullptr)
            shares.push_back({contacts.block1[c], contacts.block2[c], static_cast<Row>(c), false});
    std::ranges::sort(shares, {}, [](const Share& share) { return std::pair(share.block1, share.block2); });
    return shares;
}

void book_lost(Model& model, double energy) {
    if (model.settings.energy) model.energy.joint_lost += energy;
}

/// Lays out the tables as the shares say. The copies still have the blocks of the whole joint.
void copy_joints(Model& model, const std::vector<Share>& shares) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    std::vector<char> kept(contacts.size(), 0);
    std::vector<Row> rows, sub_rows;
    std::vector<Span> spans;
    for (const Share& share : shares) {
        const Span span = contacts.sub_contacts[share.from];
        if (!share.copy) kept[share.from] = 1;
        rows.push_back(share.from);
        spans.push_back({static_cast<Row>(sub_rows.size()), span.count});
        for (Row s = span.first; s < span.end(); ++s) sub_rows.push_back(s);
    }
    book_lost(model, stored_in_parted(model, kept));
    for (std::size_t c = 0; c < kept.size(); ++c) {
        if (kept[c]) continue;
        contacts.ids.destroy(contacts.id[c]);
        const Span span = contacts.sub_contacts[c];
        for (Row s = span.first; s < span.end(); ++s) subs.ids.destroy(subs.id[s]);
    }
    contacts.gather(rows);
    subs.gather(sub_rows);
    for (std::size_t c = 0; c < shares.size(); ++c) {
        const Row row = static_cast<Row>(c);
        const bool copy = shares[c].copy;
        contacts.sub_contacts[c] = spans[c];
        if (copy) {
            contacts.id[c] = contacts.ids.create(row);
            contacts.number[c] = model.next_contact_number++;
            contacts.withdrawn_energy[c] = 0;
            book_lost(model, -ContactLoad(model, row).stored());
        } else {
            contacts.ids.move(contacts.id[c], row);
        }
        for (Row s = spans[c].first; s < spans[c].end(); ++s) {
            subs.contact[s] = row;
            if (copy) {
                subs.id[s] = subs.ids.create(s);
                subs.number[s] = model.next_sub_contact_number++;
            } else {
                subs.ids.move(subs.id[s], s);
            }
        }
    }
}

/// The same contact, seen from the other block.
void turn_round(Model& model, Row c) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    if (contacts.reference[c] != 0) contacts.reference[c] = 3 - contacts.reference[c];
    contacts.normal[c] *= -1;
    contacts.offset_normal[c] *= -1;
    for (Row s = contacts.sub_contacts[c].first; s < contacts.sub_contacts[c].end(); ++s) {
        std::swap(subs.side1[s], subs.side2[s]);
        if (subs.type[s] == SubContactType::vertex_face) subs.type[s] = SubContactType::face_vertex;
        else if (subs.type[s] == SubContactType::face_vertex) subs.type[s] = SubContactType::vertex_face;
        subs.shear_force.set(s, -Vec3(subs.shear_force[s]));
        subs.shear_displacement.set(s, -Vec3(subs.shear_displacement[s]));
        subs.dashpot_shear.set(s, -Vec3(subs.dashpot_shear[s]));
    }
}

/// Gives a row the blocks of its share. The tilt of a closure counts from the centroid of the first block.
void give_blocks(Model& model, Row c, const Share& share, const WholeJoints& whole) {
    auto& contacts = model.contacts;
    if (whole.first_piece(share.block1) != contacts.block1[c]) turn_round(model, c);
    contacts.block1[c] = share.block1;
    contacts.block2[c] = share.block2;
    const WholeJoint* joint = whole.of(share.block1, share.block2);
    if (joint == nullptr) return;
    contacts.face1[c] = share.face1;
    contacts.face2[c] = share.face2;
    if (contacts.whole_area[c] > 0) contacts.whole_area[c] = share.faces_area;
    contacts.offset[c] += contacts.offset_tilt[c].dot(model.blocks.centroid[share.block1] - joint->centroid1);
}

/// Moves the sub-contacts of joints from the places of the whole joint, whose state they have, to their own.
void move_to_places(Model& model, JointRegistry& joints, const WholeJoints& whole) {
    constexpr double same = 1e-6;
    const auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    std::vector<char> moved(subs.size(), 0), taken(subs.size(), 0);
    const auto each_joint = [&](const auto& see) {
        for (std::size_t c = 0; c < contacts.size(); ++c)
            if (const WholeJoint* joint = whole.of(contacts.block1[c], contacts.block2[c]);
                joint != nullptr && contacts.kind[c] == ContactKind::joint)
                see(c, *joint,
                    whole.first_piece(contacts.block1[c]) == model.blocks.ids.row(joint->block1) ? 1.0 : -1.0);
    };
    each_joint([&](std::size_t c, const WholeJoint& joint, double hand) {
        const PlaneMotion& motion = joint.motion;
        if (!motion.along_normal() && !motion.in_plane()) return;
        for (Row s = contacts.sub_contacts[c].first; s < contacts.sub_contacts[c].end(); ++s) {
            const Eigen::Vector4d wanted = motion.at(subs.position[s]);
            const double more = wanted[0] - subs.normal_displacement[s];
            const Vec3 slide = hand * wanted.tail<3>() - Vec3(subs.shear_displacement[s]);
            moved[static_cast<std::size_t>(s)] = 1;
            subs.normal_displacement_increment[s] = motion.along_normal() ? more : 0;
            subs.shear_displacement_increment.set(s, motion.in_plane() ? slide : Vec3::Zero());
        }
    });
    move_sub_contacts(model, joints, moved);
    // Forces that do not come from displacements, as those of `insitu`.
    each_joint([&](std::size_t c, const WholeJoint& joint, double hand) {
        if (!joint.motion.carries()) return;
        for (Row s = contacts.sub_contacts[c].first; s < contacts.sub_contacts[c].end(); ++s) {
            const Eigen::Vector4d wanted = subs.area[s] * joint.motion.traction_at(subs.position[s]);
            const Vec3 shear = hand * wanted.tail<3>();
            const double off =
                std::max(std::abs(wanted[0] - subs.normal_force[s]), (shear - Vec3(subs.shear_force[s])).norm());
            if (off <= same * wanted.norm()) continue;
            subs.normal_force[s] = wanted[0];
            subs.shear_force.set(s, shear);
            taken[static_cast<std::size_t>(s)] = 1;
        }
    });
    initialise_sub_contacts(model, joints, taken);
}

/// The energy in the springs of joints of cut blocks.
double stored_in(const Model& model, const WholeJoints& whole) {
    double stored = 0;
    for (std::size_t c = 0; c < model.contacts.size(); ++c)
        if (whole.of(model.contacts.block1[c], model.contacts.block2[c]) != nullptr)
            stored += ContactLoad(model, static_cast<Row>(c)).stored();
    return stored;
}

} // namespace

std::vector<WholeJoint> whole_joints(Model& model, JointRegistry& joints, const std::vector<Row>& blocks) {
    const auto& contacts = model.contacts;
    if (contacts.empty()) return {};
    const std::int32_t material = model.settings.default_joint_material;
    const Row found_anew = property_set(model, joints, default_joint_model(model), material, "");
    const auto is_new = [&](std::size_t c) {
        return contacts.material[c] == material && contacts.properties[c] == found_anew && contacts.group[c] == 0 &&
               model.clock.cycle == 0 && ContactLoad(model, static_cast<Row>(c)).normal == 0;
    };
    std::vector<char> cut(model.blocks.size(), 0);
    for (const Row b : blocks) cut[b] = 1;
    std::vector<WholeJoint> whole;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const Row one = contacts.block1[c], two = contacts.block2[c];
        if ((cut[one] || cut[two]) && !is_new(c))
            whole.push_back({contacts.id[c], model.blocks.id[one], model.blocks.id[two], model.blocks.centroid[one],
                             PlaneMotion(model, static_cast<Row>(c))});
    }
    return whole;
}

void share_joints(Model& model, JointRegistry& joints, const std::vector<WholeJoint>& whole,
                  const std::vector<BlockId>& origin) {
    if (whole.empty()) return;
    const WholeJoints of_pieces(model, whole, origin);
    const std::vector<Share> shares = shares_of(model, of_pieces);
    copy_joints(model, shares);
    for (std::size_t c = 0; c < shares.size(); ++c) give_blocks(model, static_cast<Row>(c), shares[c], of_pieces);
    find_contacts(model, joints);
    const double stored = stored_in(model, of_pieces);
    OverlapScratch scratch;
    for (std::size_t c = 0; c < model.contacts.size(); ++c)
        if (of_pieces.of(model.contacts.block1[c], model.contacts.block2[c]) != nullptr)
            share_overlap(model, joints.get(model.joint_properties[model.contacts.properties[c]].model),
                          static_cast<Row>(c), scratch);
    move_to_places(model, joints, of_pieces);
    book_lost(model, stored - stored_in(model, of_pieces));
    ModelEdit(model, Change::contacts);
}

} // namespace kaya
