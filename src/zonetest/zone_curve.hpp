// The response of a zone along a path.
#pragma once

#include "zonetest/zone_path.hpp"

#include <string>
#include <vector>

namespace kaya {

struct ZoneCurveSettings {
    int steps = 1000;    ///< between two points of the path
    double volume = 1;   ///< of the zone
    SixNumbers stress{}; ///< initial; replaced by what the path prescribes at its first point
};

/// Something that a zone model should not do.
struct ZoneFinding {
    std::size_t step;
    std::string text;
};

struct ZoneCurve {
    std::vector<SingleZone> points; ///< the zone after each step; the first is that of the beginning
    std::vector<double> time;
    std::vector<ZoneFinding> findings; ///< the first of each kind
};

/// Drives a zone along a path. Throws Diagnostic where the model fails or cannot carry a stress, with the point.
ZoneCurve follow_zone_path(const ZoneModel& model, const std::vector<double>& values, const ZonePath& path,
                           const ZoneCurveSettings& settings);

/// The curve in columns: strains, stresses, mean stress, deviator, volume strain, work, states and history of the model.
CsvTable zone_curve_table(const ZoneCurve& curve);

/// A gnuplot script of deviator and volume strain over the strain that grows most.
std::string zone_curve_figure(const ZoneCurve& curve, const std::string& title);

} // namespace kaya
