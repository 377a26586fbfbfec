#include "slopes/slices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace kaya {

namespace {

constexpr double least_factor = 1e-3, largest_factor = 1e3;
/// A base that is steeper against the sliding direction than its friction allows would push the body up: below this cosine the answer is
/// meaningless.
constexpr double least_m_alpha = 0.05;

/// Zero of a function between two places where its signs differ, by regula falsi with the Illinois rule.
template <class Function> double zero_between(Function&& f, double a, double fa, double b, double fb) {
    for (int i = 0; i < 200; ++i) {
        const double c = (a * fb - b * fa) / (fb - fa);
        const double fc = f(c);
        if (fc == 0 || std::abs(b - a) < 1e-12 * std::max(std::abs(a), std::abs(b))) return c;
        if (std::signbit(fc) == std::signbit(fb)) fa *= 0.5;
        else a = b, fa = fb;
        b = c, fb = fc;
        if (std::abs(b - a) < 1e-12 * std::max(std::abs(a), std::abs(b))) return b;
    }
    return b;
}

class Statics {
public:
    explicit Statics(const SlipBody& body);

    std::optional<SliceAnswer> solve(SliceMethod method);

private:
    double sine(std::size_t i) const { return sine_[i]; }
    double cosine(std::size_t i) const { return cosine_[i]; }
    double down(std::size_t i) const { return body_.slices[i].weight + body_.slices[i].downward; }
    double right(std::size_t i) const { return body_.seismic * body_.slices[i].weight + body_.slices[i].rightward; }
    /// Cohesion on the base less the friction lost to pore pressure: force, for F = 1.
    double held(std::size_t i) const {
        const Slice& slice = body_.slices[i];
        return slice.width / cosine_[i] * (lines_[i].cohesion - slice.pore_pressure * lines_[i].tan_friction);
    }

    bool contact_envelopes(); ///< lines at the normal stresses of the moment; false where no strength is
    std::optional<double> ordinary();
    std::optional<double> bishop();
    std::optional<double> balanced(double lambda); ///< horizontal forces
    std::optional<double> rigorous();
    std::optional<double> end_force(double factor, double lambda);
    /// f of Morgenstern and Price at a boundary between slices; no shear force at the ends.
    double between(std::size_t boundary) const { return shapes_[boundary]; }
    void shape(bool half_sine);
    void find_normal_forces(double factor, double lambda);
    double end_moment(double lambda);
    double janbu_correction() const;

    const SlipBody& body_;
    std::vector<Coulomb> lines_;
    std::vector<double> normal_;        ///< on the bases, force/length
    std::vector<double> thrust_;        ///< between slices, positive in compression
    std::vector<double> heights_;       ///< of the line of thrust above the slip surface
    std::vector<double> sine_, cosine_; ///< of the base angles
    std::vector<double> shapes_;
    double lambda_ = 0;
    double guess_ = 1; ///< the factor that was found last
};

Statics::Statics(const SlipBody& body) : body_(body), lines_(body.slices.size()), normal_(body.slices.size()) {
    for (const Slice& slice : body.slices) {
        sine_.push_back(std::sin(slice.base_angle));
        cosine_.push_back(std::cos(slice.base_angle));
    }
}

void Statics::shape(bool half_sine) {
    double total = 0, before = 0;
    for (const Slice& slice : body_.slices) total += slice.width;
    shapes_.assign(1, 0.0);
    for (const Slice& slice : body_.slices) {
        before += slice.width;
        shapes_.push_back(half_sine ? std::sin(std::numbers::pi * before / total) : 1);
    }
    shapes_.back() = 0;
}

bool Statics::contact_envelopes() {
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        const Slice& slice = body_.slices[i];
        if (slice.strength == nullptr || !slice.strength->fails()) return false;
        lines_[i] = slice.strength->tangent(normal_[i] / slice.base_length() - slice.pore_pressure);
    }
    return true;
}

std::optional<double> Statics::ordinary() {
    double holding = 0, driving = 0;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        const Slice& slice = body_.slices[i];
        // Water at rest carries itself: its pressure on the sides of a slice, which the method leaves out, balances what it pushes.
        const double still = slice.still_pressure * slice.width;
        normal_[i] = (down(i) - still) * cosine(i) - (right(i) - slice.water_push) * sine(i) + still / cosine(i);
        holding += held(i) + normal_[i] * lines_[i].tan_friction;
        driving += slice.weight * sine(i) + slice.downward * sine(i);
        driving += body_.radius ? (body_.seismic * slice.weight * (body_.centre_heights[i] - slice.centroid_arm) +
                                   slice.rightward * body_.centre_heights[i] - slice.load_moment) /
                                      *body_.radius
                                : right(i) * cosine(i);
    }
    driving += body_.radius ? body_.water_force * body_.water_height / *body_.radius : body_.water_force;
    if (!(driving > 0)) return std::nullopt;
    return holding / driving;
}

std::optional<double> Statics::bishop() {
    double driving = body_.water_force * body_.water_height / *body_.radius;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        const Slice& slice = body_.slices[i];
        driving += down(i) * sine(i) + (body_.seismic * slice.weight * (body_.centre_heights[i] - slice.centroid_arm) +
                                        slice.rightward * body_.centre_heights[i] - slice.load_moment) /
                                           *body_.radius;
    }
    if (!(driving > 0)) return std::nullopt;
    double factor = 1;
    for (int round = 0; round < 200; ++round) {
        double holding = 0;
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            const double t = lines_[i].tan_friction / factor;
            const double m_alpha = cosine(i) + sine(i) * t;
            if (m_alpha < least_m_alpha) return std::nullopt;
            normal_[i] = (down(i) - held(i) * sine(i) / factor) / m_alpha;
            holding += held(i) + normal_[i] * lines_[i].tan_friction;
        }
        const double next = holding / driving;
        if (!(next > least_factor && next < largest_factor)) return std::nullopt;
        if (std::abs(next - factor) < 1e-12 * factor) return next;
        factor = next;
    }
    return factor;
}

/// The residual thrust at the right end; fills thrust_. Grows with the factor. None where a base would wedge.
std::optional<double> Statics::end_force(double factor, double lambda) {
    thrust_.assign(lines_.size() + 1, 0.0);
    thrust_[0] = body_.water_force;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        const double t = lines_[i].tan_friction / factor, c = held(i) / factor;
        const double along = cosine(i) + t * sine(i), across = sine(i) - t * cosine(i);
        const double left = lambda * between(i), at_right = lambda * between(i + 1);
        const double divisor = along + at_right * across;
        if (along < least_m_alpha || divisor < least_m_alpha) return std::nullopt;
        thrust_[i + 1] = (thrust_[i] * (along + left * across) + right(i) * along + down(i) * across - c) / divisor;
    }
    return thrust_.back();
}

/// The factor without residual thrust.
std::optional<double> Statics::balanced(double lambda) {
    const auto left_over = [&](double factor) { return end_force(factor, lambda); };
    const auto found = [&](double factor) { return guess_ = factor; };
    // With weak bases the end force is positive; with increasing strength its first change of sign is the answer.
    double above = 1.2 * guess_;
    std::optional<double> upper = left_over(above);
    while (!upper || !(*upper > 0)) {
        if (above > largest_factor) return std::nullopt;
        upper = left_over(above *= 2);
    }
    for (double factor = above / 1.5; factor > least_factor; factor /= 1.5) {
        const std::optional<double> value = left_over(factor);
        if (!value) {
            // The pole is reached first, unless the answer is between it and the last factor that worked.
            double good = above, bad = factor;
            for (int i = 0; i < 60; ++i) {
                const double middle = 0.5 * (good + bad);
                const std::optional<double> there = left_over(middle);
                if (!there) bad = middle;
                else if (*there > 0) good = middle, upper = there;
                else
                    return found(
                        zero_between([&](double f) { return left_over(f).value_or(0); }, good, *upper, middle, *there));
            }
            return std::nullopt;
        }
        if (*value <= 0)
            return found(
                zero_between([&](double f) { return left_over(f).value_or(0); }, above, *upper, factor, *value));
        above = factor;
        upper = value;
    }
    return std::nullopt;
}

void Statics::find_normal_forces(double factor, double lambda) {
    lambda_ = lambda;
    if (!end_force(factor, lambda)) return;
    const std::size_t n = lines_.size();
    for (std::size_t i = 0; i < n; ++i) {
        const double t = lines_[i].tan_friction / factor, c = held(i) / factor;
        const double left = lambda * between(i) * thrust_[i], at_right = lambda * between(i + 1) * thrust_[i + 1];
        normal_[i] = (down(i) + left - at_right - c * sine(i)) / (cosine(i) + t * sine(i));
    }
}

/// The residual moment at the right end, with thrust_ balanced.
double Statics::end_moment(double lambda) {
    const std::size_t n = lines_.size();
    heights_.assign(n + 1, 0.0);
    double moment = body_.water_force * body_.water_arm;
    heights_[0] = body_.water_arm;
    for (std::size_t i = 0; i < n; ++i) {
        const Slice& slice = body_.slices[i];
        const double left = lambda * between(i) * thrust_[i], at_right = lambda * between(i + 1) * thrust_[i + 1];
        const double half = 0.5 * slice.width;
        moment += (thrust_[i] + thrust_[i + 1]) * half * std::tan(slice.base_angle) - (left + at_right) * half +
                  body_.seismic * slice.weight * slice.centroid_arm + slice.load_moment;
        heights_[i + 1] = thrust_[i + 1] != 0 ? moment / thrust_[i + 1] : 0;
    }
    return moment;
}

/// Horizontal forces and moments. The residual moment decreases as lambda grows: shear forces between slices rotate the body back.
std::optional<double> Statics::rigorous() {
    struct Try {
        double lambda, factor, moment;
    };
    const auto attempt = [&](double lambda) -> std::optional<Try> {
        const std::optional<double> factor = balanced(lambda);
        if (!factor || !end_force(*factor, lambda)) return std::nullopt;
        return Try{lambda, *factor, end_moment(lambda)};
    };
    std::optional<Try> last;
    for (const double lambda : {0.0, 0.1, 0.2, 0.3, 0.4,  0.5,  0.65,  0.8,  1.0,   1.25, 1.5, 2.0,
                                2.5, 3.5, 5.0, 0.0, -0.1, -0.2, -0.35, -0.5, -0.75, -1.0, -1.5}) {
        const std::optional<Try> now = attempt(lambda);
        if (lambda == 0) last.reset(); // starts again in the other direction
        if (now && last && std::signbit(now->moment) != std::signbit(last->moment)) {
            Try a = *last, b = *now;
            for (int i = 0; i < 100 && std::abs(a.lambda - b.lambda) > 1e-10; ++i) {
                double middle = (a.lambda * b.moment - b.lambda * a.moment) / (b.moment - a.moment);
                if (i % 3 == 2) middle = 0.5 * (a.lambda + b.lambda);
                const std::optional<Try> there = attempt(middle);
                if (!there) return std::nullopt;
                (std::signbit(there->moment) == std::signbit(a.moment) ? a : b) = *there;
                if (std::abs(a.factor - b.factor) < 1e-10 * b.factor) break;
            }
            find_normal_forces(b.factor, b.lambda);
            end_moment(b.lambda);
            return b.factor;
        }
        last = now;
    }
    return std::nullopt;
}

/// Janbu, Bjerrum and Kjaernsli 1956: for the shear forces between slices that the method leaves out.
double Statics::janbu_correction() const {
    bool cohesion = false, friction = false;
    for (const Coulomb& line : lines_)
        cohesion = cohesion || line.cohesion > 0, friction = friction || line.tan_friction > 0;
    const double b = cohesion && friction ? 0.5 : cohesion ? 0.69 : 0.31;
    return 1 + b * (body_.depth_ratio - 1.4 * body_.depth_ratio * body_.depth_ratio);
}

std::optional<SliceAnswer> Statics::solve(SliceMethod method) {
    double driving = body_.water_force;
    for (std::size_t i = 0; i < normal_.size(); ++i) {
        normal_[i] = body_.slices[i].weight * cosine(i);
        driving += down(i) * sine(i) + right(i) * cosine(i);
    }
    if (!(driving > 0)) return std::nullopt; // nothing pulls it to the right
    const bool linear = std::ranges::all_of(
        body_.slices, [](const Slice& slice) { return slice.strength != nullptr && slice.strength->is_linear(); });
    shape(method == SliceMethod::morgenstern_price);
    std::optional<double> factor;
    for (int round = 0; round < (linear ? 1 : 100); ++round) {
        if (!contact_envelopes()) return std::nullopt;
        const std::optional<double> before = factor;
        switch (method) {
        case SliceMethod::ordinary: factor = ordinary(); break;
        case SliceMethod::bishop: factor = bishop(); break;
        case SliceMethod::janbu:
            factor = balanced(0);
            if (factor) find_normal_forces(*factor, 0);
            break;
        case SliceMethod::spencer:
        case SliceMethod::morgenstern_price: factor = rigorous(); break;
        }
        if (!factor || !std::isfinite(*factor) || !(*factor > 0)) return std::nullopt;
        if (before && std::abs(*factor - *before) < 1e-9 * *factor) break;
    }
    SliceAnswer answer;
    answer.factor = *factor * (method == SliceMethod::janbu ? janbu_correction() : 1);
    answer.lambda = lambda_;
    for (std::size_t i = 0; i < normal_.size(); ++i)
        answer.pulled += normal_[i] < body_.slices[i].pore_pressure * body_.slices[i].base_length() ? 1 : 0;
    if (method == SliceMethod::spencer || method == SliceMethod::morgenstern_price) {
        const double most = *std::ranges::max_element(thrust_);
        for (std::size_t i = 1; i + 1 < heights_.size(); ++i) {
            if (!(thrust_[i] > 0.02 * most)) continue; // the quotient of two small numbers
            const double height = body_.slices[i].centroid_arm + body_.slices[i - 1].centroid_arm; // of the body, about
            answer.thrust_inside = answer.thrust_inside && heights_[i] > -height / 3 && heights_[i] < height * 4 / 3;
        }
    }
    return answer;
}

} // namespace

double Slice::base_length() const { return width / std::cos(base_angle); }

std::string_view name_of(SliceMethod method) {
    static constexpr std::array<std::string_view, 5> names{"ordinary", "bishop", "janbu", "spencer",
                                                           "morgenstern-price"};
    return names[static_cast<std::size_t>(method)];
}

bool needs_circle(SliceMethod method) { return method == SliceMethod::bishop || method == SliceMethod::ordinary; }

std::optional<SliceAnswer> factor_of_safety(const SlipBody& body, SliceMethod method) {
    if (body.slices.empty() || (needs_circle(method) && !body.radius)) return std::nullopt;
    return Statics(body).solve(method);
}

} // namespace kaya
