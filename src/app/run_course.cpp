#include "app/run_course.hpp"

#include "app/thinned.hpp"

#include "model/fields/field.hpp"
#include "model/measure/overlap_rows.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

constexpr std::size_t most_samples = 600;

double global(const Model& model, const char* name) {
    return std::get<double>(find_field(ObjectKind::global, name)->get(model, 0));
}

} // namespace

void RunCourse::sample(const Model& model) {
    const std::int64_t cycle = model.clock.cycle;
    if (!samples_.empty() && cycle <= samples_.back().cycle)
        samples_.clear(), interval_ = 1; // another model, or this one from before
    if (!samples_.empty() && cycle - samples_.back().cycle < interval_) return;
    const auto& sub = model.sub_contacts;
    double area = 0, open = 0, with_state = 0;
    for (Row c = 0; c < static_cast<Row>(model.contacts.size()); ++c) {
        area += common_area(model, c);
        open += idle_area(model, c);
    }
    for (std::size_t i = 0; i < sub.size(); ++i) with_state += sub.state[i] != 0 ? 1 : 0;
    const double count = std::max<double>(1, static_cast<double>(sub.size()));
    samples_.push_back({cycle, model.clock.average_ratio, global(model, "kinetic_energy"),
                        area > 0 ? 100 * open / area : 0, 100 * with_state / count});
    if (samples_.size() <= most_samples) return;
    samples_ = thinned(std::move(samples_));
    interval_ *= 2;
}

std::vector<ReportCurve> RunCourse::curves() const {
    if (samples_.size() < 2) return {};
    std::vector<ReportCurve> all{{"average ratio of forces, as a power of ten", {}, {}},
                                 {"kinetic energy [energy]", {}, {}},
                                 {"part of the contact area that carries nothing [%]", {}, {}},
                                 {"sub-contacts with a state, such as slip [%]", {}, {}}};
    for (const Sample& sample : samples_) {
        for (auto& curve : all) curve.cycles.push_back(static_cast<double>(sample.cycle));
        all[0].values.push_back(sample.ratio > 0 ? std::log10(sample.ratio) : std::nan(""));
        all[1].values.push_back(sample.kinetic_energy);
        all[2].values.push_back(sample.open);
        all[3].values.push_back(sample.slipping);
    }
    return all;
}

} // namespace kaya
