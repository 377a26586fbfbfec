// One sub-contact that belongs to no model, as a joint model sees it when it is tried.
#pragma once

#include "laws/batch.hpp"
#include "laws/joint_model.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace kaya {

/// The columns of a batch of one row that the rest of the model provides: unset fields, a position at the origin with its normal along z,
/// between blocks 1 and 2.
struct LoneColumns {
    std::array<double*, KAYA_JMODEL_MAX_HISTORY> history{};
    std::array<double, KAYA_JMODEL_MAX_FIELDS> field{};
    std::array<const double*, KAYA_JMODEL_MAX_FIELDS> fields{};
    std::array<double, 3> position{}, normal{0, 0, 1};
    std::array<std::int32_t, 2> block{1, 2};

    /// Points the batch at them; they must outlive the batch.
    void add_to(kaya_jbatch& batch, const JointModel& model);
};

/// The state of one sub-contact as values: a copy is another one in the same state. The increments are those of the next step.
struct LoneRow {
    double area = 1, normal_disp = 0, normal_disp_inc = 0, normal_force = 0, pore_pressure = 0;
    std::array<double, 3> shear_disp{}, shear_disp_inc{}, shear_force{};
    double normal_stiffness = 0, shear_stiffness = 0, frictional_work = 0;
    std::uint32_t state = 0;
    std::array<double, KAYA_JMODEL_MAX_HISTORY> history{};
    JointObject object; ///< of a model that has one; a copy is a clone

    /// Points at the row, the values and `others`; they must outlive the batch.
    kaya_jbatch batch(const JointModel& model, const std::vector<double>& values, double time_step,
                      LoneColumns& others);
};

} // namespace kaya
