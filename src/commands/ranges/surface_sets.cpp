#include "commands/ranges/surface_sets.hpp"

#include "commands/ranges/saved_text.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <type_traits>
#include <utility>

namespace kaya {

namespace {

constexpr const char* what = "sets of surfaces";

std::string name_text(const std::string& name) { return fmt::format("{} {}", name.size(), name); }

/// The numbers of a disc or of a law, in the order in which they are saved.
template <class D> auto numbers_of(D& d) {
    return std::array{&d.centre[0], &d.centre[1], &d.centre[2], &d.dip, &d.dip_direction, &d.diameter};
}
template <class L> auto law_numbers(L& l) {
    return std::array{&l.dip,      &l.dip_direction, &l.kappa,     &l.dip_deviation,      &l.dip_direction_deviation,
                      &l.dips.low, &l.dips.high,     &l.exponent,  &l.dip_directions.low, &l.dip_directions.high,
                      &l.mean,     &l.deviation,     &l.sizes.low, &l.sizes.high};
}

template <class Numbers> std::string text_of(const Numbers& numbers) {
    std::string text;
    for (const double* number : numbers) text += fmt::format(" {:a}", *number);
    return text + '\n';
}

std::string text_of(const std::map<std::string, PolygonSet>& sets) {
    std::string text = fmt::format("{}\n", sets.size());
    for (const auto& [name, polygons] : sets) {
        text += fmt::format("{} {}\n", name_text(name), polygons.size());
        for (const auto& polygon : polygons) {
            text += fmt::format("{}", polygon.size());
            for (const Vec3& corner : polygon) text += fmt::format(" {:a} {:a} {:a}", corner[0], corner[1], corner[2]);
            text += '\n';
        }
    }
    return text;
}

/// A disc stands where a set has the corners of a polygon, behind a count of none.
std::string text_of(const std::map<std::string, Network>& networks) {
    std::string text = fmt::format("{}\n", networks.size());
    for (const auto& [name, fractures] : networks) {
        text += fmt::format("{} {}\n", name_text(name), fractures.size());
        for (const Fracture& fracture : fractures) text += "0" + text_of(numbers_of(fracture.disc));
    }
    return text;
}

/// What fractures have beside their discs, in the order of the networks.
std::string details_text(const SurfaceSets& sets) {
    std::string text = fmt::format("{}\n", sets.next_fracture);
    for (const auto& [name, fractures] : sets.networks)
        for (const Fracture& fracture : fractures) {
            text += fmt::format("{} {} {} {}", fracture.id, fracture.dominance, fracture.joint_set,
                                fracture.corners.size());
            for (const Vec3& corner : fracture.corners)
                text += fmt::format(" {:a} {:a} {:a}", corner[0], corner[1], corner[2]);
            text += fmt::format(" {}", fracture.groups.size());
            for (const std::string& group : fracture.groups) text += ' ' + name_text(group);
            text += '\n';
        }
    return text;
}

/// Each value of a sample is a number of doubles, behind them stands its sum of weights.
template <class T> auto numbers_of_value(T& value) {
    if constexpr (std::is_same_v<std::remove_const_t<T>, double>) return std::array{&value};
    else return std::array{&value.dip, &value.dip_direction};
}
template <class T> std::string text_of(const Sample<T>& sample) {
    std::string text = fmt::format("{}", sample.values.size());
    for (std::size_t i = 0; i < sample.values.size(); ++i) {
        for (const double* number : numbers_of_value(sample.values[i])) text += fmt::format(" {:a}", *number);
        text += fmt::format(" {:a}", sample.sums[i]);
    }
    return text + '\n';
}

/// Samples stand behind the numbers of the laws that draw from them.
std::string text_of(const std::map<std::string, FractureLaw>& laws) {
    std::string text = fmt::format("{}\n", laws.size());
    for (const auto& [name, law] : laws) {
        text +=
            fmt::format("{} {} {}", name_text(name), static_cast<int>(law.orientation), static_cast<int>(law.size)) +
            text_of(law_numbers(law));
        if (law.orientation == FractureLaw::Orientation::bootstrapped) text += text_of(law.planes);
        if (law.size == FractureLaw::Size::bootstrapped) text += text_of(law.diameters);
    }
    return text;
}

double finite(SavedText& text) {
    const double number = text.number();
    if (!std::isfinite(number)) text.refuse();
    return number;
}

std::vector<Vec3> read_corners(SavedText& text, std::size_t count) {
    std::vector<Vec3> corners;
    for (; count > 0; --count) {
        const double x = finite(text), y = finite(text), z = finite(text);
        corners.emplace_back(x, y, z);
    }
    return corners;
}

std::map<std::string, PolygonSet> read_sets(SavedText& text) {
    std::map<std::string, PolygonSet> sets;
    for (std::size_t left = text.count(); left > 0; --left) {
        PolygonSet& polygons = sets[text.name()];
        for (std::size_t more = text.count(); more > 0; --more) {
            polygons.push_back(read_corners(text, text.count()));
            if (polygons.back().size() < 3) text.refuse();
        }
    }
    return sets;
}

/// Earlier saves have the corners on the rim.
Disc disc_of_rim(SavedText& text, const std::vector<Vec3>& rim) {
    if (rim.size() < 3) text.refuse();
    Disc disc;
    for (const Vec3& corner : rim) disc.centre += corner / static_cast<double>(rim.size());
    const Vec3 normal = (rim[1] - rim[0]).cross(rim[2] - rim[0]).normalized();
    const Vec3 up = normal.z() < 0 ? Vec3(-normal) : normal;
    constexpr double degrees = 57.29577951308232;
    disc.dip = std::acos(std::min(up.z(), 1.0)) * degrees;
    disc.dip_direction = std::atan2(up.x(), up.y()) * degrees;
    disc.diameter = 2 * (rim[0] - disc.centre).norm();
    return disc;
}

std::map<std::string, Network> read_networks(SavedText& text) {
    std::map<std::string, Network> networks;
    for (std::size_t left = text.count(); left > 0; --left) {
        Network& fractures = networks[text.name()];
        for (std::size_t more = text.count(); more > 0; --more) {
            if (const std::size_t corners = text.count(); corners > 0) {
                fractures.push_back({disc_of_rim(text, read_corners(text, corners))});
                continue;
            }
            Disc& disc = fractures.emplace_back().disc;
            for (double* number : numbers_of(disc)) *number = finite(text);
            if (!(disc.diameter > 0)) text.refuse();
        }
    }
    return networks;
}

void read_details(SavedText& text, SurfaceSets& sets) {
    sets.next_fracture = text.whole(1);
    for (auto& [name, fractures] : sets.networks)
        for (Fracture& fracture : fractures) {
            fracture.id = text.whole(1, sets.next_fracture - 1);
            constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
            fracture.dominance = static_cast<std::int32_t>(text.whole(0, most));
            fracture.joint_set = static_cast<std::int32_t>(text.whole(0, most));
            if (const std::size_t corners = text.count(); corners > 0) {
                if (corners < 3) text.refuse();
                fracture.corners = read_corners(text, corners);
            }
            for (std::size_t left = text.count(); left > 0; --left) fracture.groups.push_back(text.name());
        }
}

template <class T> Sample<T> read_sample(SavedText& text) {
    Sample<T> sample;
    for (std::size_t left = text.count(); left > 0; --left) {
        T& value = sample.values.emplace_back();
        for (double* number : numbers_of_value(value)) *number = finite(text);
        const double before = sample.sums.empty() ? 0 : sample.sums.back();
        sample.sums.push_back(finite(text));
        if (sample.sums.back() < before) text.refuse();
    }
    if (sample.values.empty() || !(sample.sums.back() > 0)) text.refuse();
    return sample;
}

std::map<std::string, FractureLaw> read_laws(SavedText& text) {
    std::map<std::string, FractureLaw> laws;
    for (std::size_t left = text.count(); left > 0; --left) {
        FractureLaw& law = laws[text.name()];
        law.orientation = static_cast<FractureLaw::Orientation>(text.whole(0, 3));
        law.size = static_cast<FractureLaw::Size>(text.whole(0, 5));
        for (double* number : law_numbers(law)) {
            *number = text.number();
            if (std::isnan(*number)) text.refuse();
        }
        if (law.orientation == FractureLaw::Orientation::bootstrapped) law.planes = read_sample<MeasuredPlane>(text);
        if (law.size == FractureLaw::Size::bootstrapped) law.diameters = read_sample<double>(text);
        if (std::ranges::any_of(law.diameters.values, [](double d) { return !(d > 0); })) text.refuse();
    }
    return laws;
}

} // namespace

Fracture& add_fracture(SurfaceSets& sets, const std::string& network, Fracture fracture) {
    fracture.id = sets.next_fracture++;
    return sets.networks[network].emplace_back(std::move(fracture));
}

std::string surfaces_text(const SurfaceSets& sets) {
    return text_of(sets.surfaces) + text_of(sets.networks) + name_text(sets.current) + '\n' + text_of(sets.laws) +
           name_text(sets.last_law) + '\n' + (sets.networks.empty() ? "" : details_text(sets));
}

SurfaceSets surfaces_from_text(const std::string& saved) {
    SavedText text(saved, what);
    SurfaceSets sets;
    sets.surfaces = read_sets(text);
    sets.networks = read_networks(text);
    sets.current = text.name();
    for (auto& [name, fractures] : sets.networks)
        for (Fracture& fracture : fractures) fracture.id = sets.next_fracture++;
    if (text.at_end()) return sets; // earlier saves have no laws
    sets.laws = read_laws(text);
    sets.last_law = text.name();
    if (!text.at_end()) read_details(text, sets); // nor ids of fractures
    return sets;
}

} // namespace kaya
