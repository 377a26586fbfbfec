// A load that is scaled such that its bodies move at a given speed.
#pragma once

#include "commands/session/session.hpp"
#include "commands/stability/load_pattern.hpp"
#include "commands/stability/push.hpp"
#include "lang/commands/commands.hpp"

namespace kaya {

/// Scales a part of gravity, the loads of a variable of scripts, or both, by one factor: the load.
class PushedLoad : public Push {
public:
    PushedLoad(Session& session, const lang::SolveControl& command);

    double velocity() const override { return pattern_.velocity(model_); }
    double load() const override { return factor_; }
    double force() const override { return pattern_.force(); }
    Vec3 reaction() const override;
    bool is_boundary() const override { return false; }
    void renew() override;
    bool is_outdated() const override { return !pattern_.is_of(model_); }
    void advance(double velocity, double wanted) override;
    void end() override {}
    bool turns() const override { return pattern_.turns(); }
    std::string load_name() const override;
    std::string end_of_load() const override { return "a load of 0: it falls by itself"; }

private:
    /// Splits gravity; returns the present factor.
    double take_gravity(const lang::SolveControl& command);
    void set(double factor);
    LoadPattern pattern() const { return {model_, along_ * rest_.norm(), variable_}; }

    Session& session_;
    Model& model_;
    std::string variable_;
    Vec3 along_ = Vec3::Zero(), rest_ = Vec3::Zero(); ///< of gravity: direction that is scaled; what stays
    double factor_ = 0;
    LoadPattern pattern_;
    double answer_, before_; ///< of the pattern; its velocity a cycle ago
};

} // namespace kaya
