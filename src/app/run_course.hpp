// The course of a run by cycles: convergence, and the behaviour of its joints.
#pragma once

#include "model/tables/model.hpp"
#include "report/report.hpp"

#include <cstdint>
#include <vector>

namespace kaya {

class RunCourse {
public:
    /// Call after each cycle. Keeps some hundreds of samples, however long the run is.
    void sample(const Model& model);
    std::vector<ReportCurve> curves() const;

private:
    struct Sample {
        std::int64_t cycle;
        double ratio, kinetic_energy, open, slipping;
    };
    std::vector<Sample> samples_;
    std::int64_t interval_ = 1; ///< cycles between two samples
};

} // namespace kaya
