#include "base/diagnostic.hpp"
#include "base/parallel.hpp"
#include "mechanics/phases.hpp"

#include <array>
#include <atomic>

namespace kaya {

bool run_joint_models(Model& model, const std::vector<Batch>& batches) {
    auto& subs = model.sub_contacts;
    std::atomic<bool> stiffness_changed = false;
    for_chunks(batches.size(), 1, [&](std::size_t first, std::size_t last) {
        std::array<double*, KAYA_JMODEL_MAX_HISTORY> history;
        for (std::size_t i = first; i < last; ++i) {
            const Batch& batch = batches[i];
            auto columns = columns_of(model, batch, model.clock.time_step, history.data());
            if (const auto failure = run_batch(*batch.model, columns)) throw joint_failure(model, batch, *failure);
            if (columns.stiffness_changed) stiffness_changed.store(true, std::memory_order_relaxed);
            // A model sees displacements at the start of the step; now they are those of its end.
            const Row end = batch.first + batch.count;
            for (Row s = batch.first; s < end; ++s)
                subs.normal_displacement[s] += subs.normal_displacement_increment[s];
            for (int k = 0; k < 3; ++k) {
                auto& displacement = subs.shear_displacement.component[k];
                const auto& increment = subs.shear_displacement_increment.component[k];
                for (Row s = batch.first; s < end; ++s) displacement[s] += increment[s];
            }
        }
    });
    return stiffness_changed;
}

} // namespace kaya
