#include "mechanics/contact/load_before.hpp"

#include "mechanics/contact/contact_work.hpp"
#include "mechanics/contact/curved_closure.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// Scales the forces of a contact, and lets its joint model agree.
ContactLoad scale_springs(Model& model, const JointModel* joint, Row c, double normal, double shear) {
    auto& subs = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[c];
    for (Row s = span.first; s < span.end(); ++s) {
        subs.normal_force[s] *= normal;
        subs.shear_force.set(s, shear * subs.shear_force[s]);
    }
    BatchColumns made;
    if (joint != nullptr) initialise_rows(model, *joint, c, span.count, made);
    return {model, c};
}

/// A geometry update must not create energy. It may return what it has taken from this contact before, and no more (Hannaford and Ryu 2002,
/// IEEE Trans. Robot. Autom. 18, keep a contact passive by such an account). Overlap beyond what the force explains is stored. With
/// `keeps_force` the normal force stays, whatever its energy. Returns the energy lost from the springs.
double keep_passive(Model& model, const JointModel* joint, Row c, const ContactLoad& before, bool keeps_force) {
    // A curved spring has another stiffness at another force.
    constexpr int most_often = 8;
    constexpr double same = 1e-9;
    const ContactLoad after(model, c);
    double& account = model.contacts.withdrawn_energy[c];
    const double gain = after.energy - before.energy, allowed = std::min(gain, account);
    const double most = before.energy + allowed;
    // Energy withdrawn in an impact is not returned to a contact at rest.
    account = std::min(account - allowed, before.energy);
    ContactLoad now = after;
    if (after.shear > before.shear) now = scale_springs(model, joint, c, 1, before.shear / after.shear);
    double normal = 1;
    for (int i = 0; !keeps_force && i < most_often && now.energy > (1 + same) * most; ++i) {
        const double part = std::sqrt(most / now.energy);
        now = scale_springs(model, joint, c, part, 1);
        normal *= part;
    }
    // Mean closure of the force that is missing now.
    if (normal < 1 && after.normal > 0)
        model.contacts.unforced_overlap[c] += (1 - normal) * 2 * after.energy / after.normal;
    return before.stored() - now.stored();
}

/// Limits the shear forces of a joint between rigid blocks to their former size when its places change; its normal force follows its
/// closure before and after. Returns the energy lost from the springs.
double keep_shear(Model& model, Row c, const ContactLoad& before, ContactLoad after) {
    const double scale = after.shear > before.shear ? before.shear / after.shear : 1;
    const Span span = model.contacts.sub_contacts[c];
    if (scale != 1)
        for (Row s = span.first; s < span.end(); ++s)
            model.sub_contacts.shear_force.set(s, scale * Vec3(model.sub_contacts.shear_force[s]));
    return before.stored() - after.energy - scale * scale * after.shear_energy;
}

/// A changed force acts during half of the step. Its work there belongs to the joints, and is subtracted from the returned loss.
double book_change(Model& model, Row c, double work_before) {
    if (!model.settings.energy) return 0;
    const double made = 0.5 * (work_of_step(model, c) - work_before);
    model.energy.joint_work -= made;
    return -made;
}

} // namespace

LoadBefore::LoadBefore(const Model& model, Row draft, Row old)
    : row(draft), load(model, old), overlap_(model.contacts.kind[old] == ContactKind::overlap),
      work_(model.settings.energy ? work_of_step(model, old) : 0) {
    if (!model.settings.large_strain) motion = PlaneMotion(model, old);
}

double LoadBefore::settle(Model& model, const JointRegistry& joints, Row c, bool moving) const {
    double lost = 0;
    if (model.contacts.kind[c] != ContactKind::overlap) {
        ContactLoad after(model, c);
        const JointModel* joint = joints.find(model.joint_properties[model.contacts.properties[c]].model);
        if (overlap_ && model.contacts.curved[c] != 0 && joint != nullptr)
            after.energy = energy_of_rows(model, *joint, c);
        // An overlap at rest, one of whose blocks has got zones, still carries the block.
        const bool keeps_force = overlap_ && !moving;
        lost = between_rigid(model, c) ? keep_shear(model, c, load, after)
                                       : keep_passive(model, joint, c, load, keeps_force);
    }
    return moving ? lost + book_change(model, c, work_) : lost; // of the forces that are left
}

std::vector<LoadBefore> loads_of(const Model& model, const std::vector<ContactDraft>& drafts) {
    std::vector<LoadBefore> loads;
    for (std::size_t c = 0; c < drafts.size(); ++c)
        if (drafts[c].old != no_row && drafts[c].kind == DraftKind::new_geometry)
            loads.emplace_back(model, static_cast<Row>(c), drafts[c].old);
    return loads;
}

double stored_in_parted(const Model& model, const std::vector<char>& kept) {
    double stored = 0;
    for (std::size_t c = 0; c < kept.size(); ++c)
        if (!kept[c]) stored += ContactLoad(model, static_cast<Row>(c)).stored();
    return stored;
}

void lose_joints_of(Model& model, const std::vector<Row>& blocks) {
    if (!model.settings.energy) return;
    const auto& contacts = model.contacts;
    std::vector<char> gone(model.blocks.size(), 0), kept(contacts.size(), 1);
    for (const Row block : blocks) gone[block] = 1;
    for (std::size_t c = 0; c < contacts.size(); ++c)
        kept[c] = gone[contacts.block1[c]] == 0 && gone[contacts.block2[c]] == 0;
    model.energy.joint_lost += stored_in_parted(model, kept);
}

} // namespace kaya
