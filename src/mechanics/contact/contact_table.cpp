#include "mechanics/contact/contact_table.hpp"

#include "mechanics/contact/batches.hpp"
#include "mechanics/contact/load_before.hpp"
#include "mechanics/contact/overlap_contact.hpp"
#include "mechanics/shape/overlap_scratch.hpp"
#include "mechanics/common/property_sets.hpp"
#include "model/tables/lanes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace kaya {

namespace {

/// The sub-contact of an old contact nearest to a point. On faces of cells there may be two in one place: then that on the same gridpoints.
Row nearest(const Model& model, Row contact, const ContactPoint& point) {
    constexpr double one_place = 1e-4; // of the contact's size
    const SubContacts& s = model.sub_contacts;
    const Span span = contact == no_row ? Span{} : model.contacts.sub_contacts[contact];
    const Lanes3 to = four_times(point.position);
    Row best = no_row;
    double least = std::numeric_limits<double>::infinity();
    for (Row row = span.first; row < span.end(); row += lane_count) {
        const LaneGroup group(span.end() - row);
        const Lanes3 shift = group.load(s.position, row) - to;
        const Lanes d = shift.dot(shift);
        for (Row i = 0; i < group.rows(); ++i)
            if (d[i] < least) {
                least = d[i];
                best = row + i;
            }
    }
    const auto same = [&](Row row) {
        return on_same_gridpoints(s.side1[row], point.side1) && on_same_gridpoints(s.side2[row], point.side2);
    };
    if (best == no_row || same(best)) return best;
    const Vec3 at = s.position[best];
    for (Row row = span.first; row < span.end(); ++row)
        if ((Vec3(s.position[row]) - at).squaredNorm() <= one_place * one_place * model.contacts.area[contact] &&
            same(row))
            return row;
    return best;
}

bool any_of(const std::vector<char>& marks) { return std::find(marks.begin(), marks.end(), 1) != marks.end(); }

template <class Call>
void call_on_marked(Model& model, JointRegistry& joints, const std::vector<char>& marked, Call call) {
    BatchColumns made;
    for (const Batch& batch : make_batches(model, joints)) {
        // Skip incomplete property sets; the command that completes one initialises its contacts.
        if (!batch.model->missing(model.joint_properties[batch.properties].values).empty()) continue;
        const Row last = batch.first + batch.count;
        for (Row row = batch.first; row < last;) {
            Row end = row;
            while (end < last && marked[end]) ++end;
            if (end == row) {
                ++row;
                continue;
            }
            Batch part = batch;
            part.first = row;
            part.count = end - row;
            auto columns = columns_of(model, part, model.clock.time_step, made);
            if (const auto failure = call(*part.model, columns, model.sub_contacts.number.data() + part.first))
                throw joint_failure(model, part, *failure);
            row = end;
        }
    }
}

/// Changed sub-contacts that joint models do not know of yet.
struct Changes {
    std::vector<char> fresh; ///< that were not there before
    std::vector<char> moved; ///< with a normal displacement increment that they have not seen

    explicit Changes(std::size_t rows) : fresh(rows, 0), moved(rows, 0) {}
};

/// Initial overlap of blocks carries no force; overlap made by motion since the last search is closed in one step.
void tell_joint_models(Model& model, JointRegistry& joints, Changes& changes, bool moving) {
    auto& s = model.sub_contacts;
    for (std::size_t row = 0; row < s.size(); ++row) {
        if (!changes.fresh[row] || s.normal_displacement[row] >= 0) continue;
        if (model.contacts.kind[s.contact[row]] == ContactKind::overlap) {
            s.normal_displacement[row] = 0; // the overlap defines the depth
            continue;
        }
        changes.moved[row] = moving;
        s.normal_displacement_increment[row] = moving ? s.normal_displacement[row] : 0;
        s.normal_displacement[row] = 0;
    }
    if (any_of(changes.fresh)) initialise_sub_contacts(model, joints, changes.fresh);
    if (!any_of(changes.moved)) return;
    for (std::size_t row = 0; row < s.size(); ++row)
        if (changes.moved[row]) s.shear_displacement_increment.set(row, Vec3::Zero());
    move_sub_contacts(model, joints, changes.moved);
}

/// Writes the geometry of a draft to its row.
void write_contact(Model& model, Row c, const ContactPlane& g) {
    auto& contacts = model.contacts;
    contacts.kind[c] = g.kind;
    contacts.least_area[c] = g.least_area;
    contacts.stiffness_area[c] = contacts.shear_area[c] = contacts.grip[c] = contacts.depth[c] = contacts.twist[c] =
        contacts.offset[c] = 0;
    contacts.offset_tilt[c].setZero();
    contacts.axis[c].setZero();
    contacts.face1[c] = g.face1;
    contacts.face2[c] = g.face2;
    contacts.type[c] = g.type;
    contacts.reference[c] = g.reference;
    contacts.normal[c] = contacts.offset_normal[c] = g.normal;
    contacts.position[c] = g.position;
    contacts.area[c] = g.area;
    contacts.energy_length[c] = contacts.energy_taken[c] = contacts.withheld[c] = 0;
    contacts.energy_deep[c] = contacts.energy_shallow[c] = 0;
    contacts.whole_area[c] = g.whole_area;
    contacts.water_pressure[c] = contacts.slip_since_update[c] = 0;
    contacts.water_slope[c].setZero();
    contacts.joint_set[c] = g.face1 != no_row   ? model.faces.joint_set[g.face1]
                            : g.face2 != no_row ? model.faces.joint_set[g.face2]
                                                : 0;
}

/// A plane that has turned by more than this (25 degrees) is another contact: a force in one direction says nothing about the other.
constexpr double cos_of_other_type = 0.906;

/// Gaps that differ by less than this part of a sub-contact's size are equal.
constexpr double same_gap = 1e-9;

/// Whether the same corner, or the same two edges, are in contact as before.
bool same_features(const SubContacts& subs, Row s, const ContactPoint& point) {
    if (subs.type[s] != point.type) return false;
    const bool of_first = point.type == SubContactType::vertex_face || point.type == SubContactType::edge_edge;
    const bool of_second = point.type == SubContactType::face_vertex || point.type == SubContactType::edge_edge;
    return (!of_first || subs.side1[s].gridpoints == point.side1.gridpoints) &&
           (!of_second || subs.side2[s].gridpoints == point.side2.gridpoints);
}

/// By how much more the sides of a point have moved apart than those of its row, at another place; 0 where that is unknown, since the shape
/// of a block changed meanwhile.
double opened_more(const Model& model, Row s, const ContactPoint& point, const Vec3& n, const PlaneMotion& motion) {
    const auto& subs = model.sub_contacts;
    const Attachment &side1 = subs.side1[s], &side2 = subs.side2[s];
    if (side1 == point.side1 && side2 == point.side2) return 0; // more often than not
    if (!side1.attached() || !side2.attached()) return 0;
    const double apart = point.gap - n.dot(attached_position(model, side2) - attached_position(model, side1));
    return motion.along_normal() ? apart + motion.at(point.position)[0] - motion.at(subs.position[s])[0] : apart;
}

/// Writes a point to a row that holds the data of its old sub-contact, or is empty.
void write_sub_contact(Model& model, Row s, const ContactPoint& point, const Vec3& n, const PlaneMotion& motion,
                       bool fresh, bool flat, Changes& changes) {
    auto& subs = model.sub_contacts;
    double area = point.area;
    if (fresh) {
        changes.fresh[s] = 1;
        subs.normal_displacement[s] = point.gap;
        subs.normal_displacement_increment[s] = 0;
    } else {
        // Traction is passed on, not force: the new sub-contact has another area. A loaded corner or edge keeps its share: if its spring
        // changed as the block turns, loading and unloading would do different work.
        if (!flat && subs.normal_force[s] > 0 && same_features(subs, s, point)) area = subs.area[s];
        const double scale = subs.area[s] > 0 ? area / subs.area[s] : 0;
        subs.normal_force[s] *= scale;
        const Vec3 shear = subs.shear_force[s];
        subs.shear_force.set(s, scale * (shear - shear.dot(n) * n));
        // The law gets the difference as a displacement.
        const double more = opened_more(model, s, point, n, motion);
        if (more != 0 && std::abs(more) > same_gap * std::sqrt(area)) {
            changes.moved[s] = 1;
            subs.normal_displacement_increment[s] = more;
        }
    }
    subs.type[s] = point.type;
    subs.side1[s] = point.side1;
    subs.side2[s] = point.side2;
    subs.position.set(s, point.position);
    subs.shear_arm.set(s, Vec3::Zero());
    if (subs.keeps_load_arms) {
        const bool rigid = between_rigid(model, subs.contact[s]);
        subs.load_arm.set(s, flat && !rigid ? Vec3(point.centre - point.position) : Vec3(Vec3::Zero()));
    }
    subs.area[s] = area;
}

/// State of a sub-contact without history.
void clear_sub_contact(SubContacts& subs, Row s) {
    subs.normal_force[s] = subs.normal_displacement[s] = subs.frictional_work[s] = 0;
    subs.shear_force.set(s, Vec3::Zero());
    subs.shear_displacement.set(s, Vec3::Zero());
    subs.state[s] = 0;
    subs.forget(s);
}

/// A contact detected when its blocks overlap already carries no force for that overlap: no work was done on its springs, and they would
/// throw the blocks apart. Moving blocks get their contacts before they meet.
void begin_found_late(Model& model, Row c) {
    auto& subs = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[c];
    for (Row s = span.first; s < span.end(); ++s) {
        double& opening = subs.normal_displacement[s];
        model.contacts.unforced_overlap[c] = std::max(model.contacts.unforced_overlap[c], -opening);
        opening = std::max(opening, 0.0);
    }
}

/// Whether an overlap becomes a joint.
bool closes(const Model& model, const ContactDraft& draft) {
    return draft.kind == DraftKind::new_geometry && draft.old != no_row &&
           model.contacts.kind[draft.old] == ContactKind::overlap;
}

/// Which contacts remain.
std::vector<char> kept_contacts(const Model& model, const std::vector<ContactDraft>& drafts) {
    std::vector<char> kept(model.contacts.size(), 0);
    for (const auto& draft : drafts)
        if (draft.old != no_row) kept[draft.old] = 1;
    return kept;
}

/// Whether the contact keeps its number of points and each point is nearest to the sub-contact of its row.
bool keeps_places(const Model& model, const ContactDraft& draft) {
    if (draft.kind == DraftKind::as_it_was) return true;
    if (draft.kind == DraftKind::overlap) return draft.old != no_row;
    if (closes(model, draft))
        return static_cast<Row>(draft.points.size()) == model.contacts.sub_contacts[draft.old].count;
    if (draft.plane.normal.dot(model.contacts.normal[draft.old]) < cos_of_other_type) return false;
    const Span span = model.contacts.sub_contacts[draft.old];
    if (static_cast<Row>(draft.points.size()) != span.count) return false;
    const auto& subs = model.sub_contacts;
    for (Row i = 0; i < span.count; ++i) {
        const ContactPoint& point = draft.points[i];
        const Row s = span.first + i;
        const bool same_places = subs.side1[s] == point.side1 && subs.side2[s] == point.side2;
        if (!same_places && nearest(model, draft.old, point) != s) return false;
    }
    return true;
}

bool all_keep_places(const Model& model, const std::vector<ContactDraft>& drafts) {
    return std::all_of(drafts.begin(), drafts.end(), [&](const auto& d) { return keeps_places(model, d); });
}

/// Overlaps whose blocks have come to lie on other faces have these from now on.
void take_faces(Contacts& contacts, const std::vector<ContactDraft>& drafts) {
    constexpr double lying = 1 - nearly_parallel; // the pressure is across these faces
    for (const auto& draft : drafts) {
        const ContactPlane& g = draft.plane;
        const bool on_faces = g.kind == ContactKind::joint && g.face1 != no_row && g.face2 != no_row;
        if (draft.kind != DraftKind::as_it_was || !on_faces) continue;
        if (contacts.kind[draft.old] != ContactKind::overlap || contacts.normal[draft.old].dot(g.normal) < lying)
            continue;
        contacts.face1[draft.old] = g.face1;
        contacts.face2[draft.old] = g.face2;
    }
}

/// Whether the tables keep their rows.
bool same_rows(const Model& model, const std::vector<ContactDraft>& drafts) {
    if (drafts.size() != model.contacts.size()) return false;
    for (std::size_t c = 0; c < drafts.size(); ++c)
        if (drafts[c].old != static_cast<Row>(c)) return false;
    return true;
}

const JointModel& joint_of(const Model& model, JointRegistry& joints, Row c) {
    return joints.get(model.joint_properties[model.contacts.properties[c]].model);
}

/// Returns the energy in springs that is lost where joints become overlaps.
double refresh_in_place(Model& model, JointRegistry& joints, const std::vector<ContactDraft>& drafts,
                        const std::vector<LoadBefore>& loads, Changes& changes, OverlapScratch& scratch) {
    const auto& blocks = model.blocks;
    double lost = 0;
    auto before = loads.begin(); // of the next draft with new geometry
    for (const auto& draft : drafts) {
        if (draft.kind == DraftKind::as_it_was) continue;
        if (draft.kind == DraftKind::overlap) {
            lost += follow_overlap(model, joint_of(model, joints, draft.old), draft.old, scratch);
            continue;
        }
        const auto& g = draft.plane;
        const bool from_overlap = closes(model, draft);
        const ClosureOffset offset{model.contacts.offset[draft.old], model.contacts.offset_tilt[draft.old]};
        const Span span = model.contacts.sub_contacts[draft.old];
        const LoadBefore& was = *before++;
        write_contact(model, draft.old, g);
        if (from_overlap) {
            close_joint(model, joint_of(model, joints, draft.old), draft, draft.old, was.load, offset, changes.moved);
            continue;
        }
        for (Row i = 0; i < span.count; ++i)
            write_sub_contact(model, span.first + i, draft.points[i], g.normal, was.motion, false,
                              g.type == ContactType::face_face, changes);
        // Weights of gridpoints are in the lists.
        if (blocks.deformable[draft.block1] || blocks.deformable[draft.block2]) ModelEdit(model, Change::lists);
    }
    return lost;
}

/// The source row of each row of the new tables; no_row for new ones.
struct RowSources {
    std::vector<Row> contacts, subs;
    std::vector<Span> spans; ///< sub-contacts of each contact
};

RowSources sources_of(const Model& model, const std::vector<ContactDraft>& drafts) {
    const auto& contacts = model.contacts;
    RowSources from;
    for (const auto& draft : drafts) {
        from.contacts.push_back(draft.old);
        const Span old = draft.old == no_row ? Span{} : contacts.sub_contacts[draft.old];
        const Row first = static_cast<Row>(from.subs.size());
        if (draft.kind == DraftKind::as_it_was || (draft.kind == DraftKind::overlap && draft.old != no_row)) {
            for (Row row = old.first; row < old.end(); ++row) from.subs.push_back(row);
        } else {
            for (const auto& point : draft.points) {
                // In an overlap, only loaded sub-contacts are a source.
                const bool overlap = draft.old != no_row && contacts.kind[draft.old] == ContactKind::overlap;
                from.subs.push_back(overlap ? old.first : nearest(model, draft.old, point));
            }
        }
        from.spans.push_back({first, static_cast<Row>(from.subs.size()) - first});
    }
    return from;
}

/// Fills the tables row by row when they have been gathered from the old ones.
class ContactWriter {
public:
    ContactWriter(Model& model, JointRegistry& joints, const RowSources& from, Changes& changes, std::size_t old_subs,
                  bool moving, OverlapScratch& scratch)
        : model_(model), joints_(joints), from_(from), changes_(changes), sub_kept_(old_subs, 0), moving_(moving),
          scratch_(scratch) {}

    /// `properties` and `material` are those of new contacts; `before` is there for contacts that get new geometry.
    void write(const ContactDraft& draft, Row c, Row properties, std::int32_t material, const LoadBefore* before) {
        auto& contacts = model_.contacts;
        const bool was_there = draft.old != no_row;
        contacts.block1[c] = draft.block1;
        contacts.block2[c] = draft.block2;
        contacts.sub_contacts[c] = from_.spans[c];
        if (!was_there) {
            contacts.id[c] = contacts.ids.create(c);
            contacts.number[c] = model_.next_contact_number++;
            contacts.material[c] = material;
            contacts.properties[c] = properties;
        } else {
            contacts.ids.move(contacts.id[c], c);
        }
        const bool closing =
            draft.kind == DraftKind::new_geometry && was_there && contacts.kind[c] == ContactKind::overlap;
        const bool is_new = draft.kind == DraftKind::new_geometry || (draft.kind == DraftKind::overlap && !was_there);
        const ClosureOffset offset{contacts.offset[c], contacts.offset_tilt[c]};
        const bool other_type =
            is_new && !closing && was_there && draft.plane.normal.dot(contacts.normal[c]) < cos_of_other_type;
        if (is_new) write_contact(model_, c, draft.plane);
        // Initial overlaps and contacts detected late start with zero force.
        if (draft.kind == DraftKind::overlap && !was_there) begin_without_force(model_, c, scratch_);
        for (Row i = 0; i < from_.spans[c].count; ++i) {
            const Row s = from_.spans[c].first + i;
            name(s, c);
            if (!is_new || closing) continue;
            if (other_type) clear_sub_contact(model_.sub_contacts, s);
            write_sub_contact(model_, s, draft.points[i], draft.plane.normal,
                              was_there ? before->motion : PlaneMotion(), other_type || from_.subs[s] == no_row,
                              draft.plane.type == ContactType::face_face, changes_);
        }
        if (!was_there && moving_ && draft.kind == DraftKind::new_geometry) begin_found_late(model_, c);
        if (!closing) return;
        close_joint(model_, joint_of(model_, joints_, c), draft, c, before->load, offset, changes_.moved);
    }
    /// Which of the old sub-contacts remain.
    const std::vector<char>& sub_kept() const { return sub_kept_; }

private:
    /// The first sub-contact with a given source keeps its number; the others are new.
    void name(Row s, Row c) {
        auto& subs = model_.sub_contacts;
        const Row source = from_.subs[s];
        subs.contact[s] = c;
        if (source != no_row && !sub_kept_[source]) {
            sub_kept_[source] = 1;
            subs.ids.move(subs.id[s], s);
        } else {
            subs.id[s] = subs.ids.create(s);
            subs.number[s] = model_.next_sub_contact_number++;
        }
    }

    Model& model_;
    JointRegistry& joints_;
    const RowSources& from_;
    Changes& changes_;
    std::vector<char> sub_kept_;
    bool moving_;
    OverlapScratch& scratch_;
};

} // namespace

void initialise_sub_contacts(Model& model, JointRegistry& joints, const std::vector<char>& marked) {
    call_on_marked(model, joints, marked, initialise_batch);
}

void move_sub_contacts(Model& model, JointRegistry& joints, const std::vector<char>& marked) {
    auto& s = model.sub_contacts;
    call_on_marked(model, joints, marked, [](const JointModel& joint, kaya_jbatch& rows, const std::int32_t* numbers) {
        return run_batch(joint, rows, numbers, Guard::fenced);
    });
    for (std::size_t row = 0; row < s.size(); ++row) {
        if (!marked[row]) continue;
        s.normal_displacement[row] += s.normal_displacement_increment[row];
        s.shear_displacement.set(row, Vec3(s.shear_displacement[row]) + Vec3(s.shear_displacement_increment[row]));
        s.normal_displacement_increment[row] = 0;
        s.shear_displacement_increment.set(row, Vec3::Zero());
    }
}

bool refresh_contacts(Model& model, JointRegistry& joints, const std::vector<ContactDraft>& drafts,
                      OverlapScratch& scratch) {
    take_faces(model.contacts, drafts);
    if (!all_keep_places(model, drafts)) return false;
    const auto loads = loads_of(model, drafts);
    Changes changes(model.sub_contacts.size());
    double lost = refresh_in_place(model, joints, drafts, loads, changes, scratch);
    tell_joint_models(model, joints, changes, true);
    for (const auto& before : loads) {
        const Row c = drafts[before.row].old;
        lost += before.settle(model, joints, c, true);
    }
    if (model.settings.energy) model.energy.joint_lost += lost;
    return true;
}

ContactChange replace_contacts(Model& model, JointRegistry& joints, const std::vector<ContactDraft>& drafts,
                               bool moving, OverlapScratch& scratch) {
    if (moving && same_rows(model, drafts) && refresh_contacts(model, joints, drafts, scratch))
        return ContactChange::refreshed;
    const bool zoned = std::ranges::any_of(model.blocks.deformable, [](auto soft) { return soft != 0; });
    if (zoned && !model.sub_contacts.keeps_load_arms) model.sub_contacts.keep_load_arms();
    take_faces(model.contacts, drafts);
    const auto loads = loads_of(model, drafts);
    const std::vector<char> contact_kept = kept_contacts(model, drafts);
    double lost = stored_in_parted(model, contact_kept);
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const RowSources from = sources_of(model, drafts);

    // A missing joint model is reported before any table changes.
    const bool any_new = std::any_of(drafts.begin(), drafts.end(), [](const auto& d) { return d.old == no_row; });
    const std::int32_t material = model.settings.default_joint_material;
    const Row properties = any_new ? property_set(model, joints, default_joint_model(model), material, "") : no_row;

    const auto old_contact_ids = contacts.id;
    const auto old_sub_ids = subs.id;
    contacts.gather(from.contacts);
    subs.gather(from.subs);

    Changes changes(subs.size());
    ContactWriter writer(model, joints, from, changes, old_sub_ids.size(), moving, scratch);
    auto load = loads.begin();
    for (std::size_t c = 0; c < drafts.size(); ++c) {
        const bool has_load = load != loads.end() && load->row == static_cast<Row>(c);
        writer.write(drafts[c], static_cast<Row>(c), properties, material, has_load ? &*load++ : nullptr);
    }
    for (std::size_t c = 0; c < contact_kept.size(); ++c)
        if (!contact_kept[c]) contacts.ids.destroy(old_contact_ids[c]);
    for (std::size_t s = 0; s < old_sub_ids.size(); ++s)
        if (!writer.sub_kept()[s]) subs.ids.destroy(old_sub_ids[s]);

    ModelEdit(model, Change::lists);                // even if a joint model throws below
    for (std::size_t c = 0; c < drafts.size(); ++c) // joints that become overlaps
        if (drafts[c].kind == DraftKind::overlap && drafts[c].old != no_row)
            lost += follow_overlap(model, joint_of(model, joints, static_cast<Row>(c)), static_cast<Row>(c), scratch);
    tell_joint_models(model, joints, changes, moving);
    for (const auto& before : loads) lost += before.settle(model, joints, before.row, moving);
    for (std::size_t c = 0; c < drafts.size(); ++c)
        if (drafts[c].old == no_row) lost -= ContactLoad(model, static_cast<Row>(c)).stored();
    if (model.settings.energy) model.energy.joint_lost += lost;
    return ContactChange::replaced;
}

} // namespace kaya
