// Bodies whose velocity is prescribed by a variable of scripts, as one force on one displacement.
#pragma once

#include "commands/session/session.hpp"
#include "commands/stability/push.hpp"
#include "lang/commands/commands.hpp"

#include <vector>

namespace kaya {

/// The displacement is that of the fastest body: of its centroid, or its rotation when none is moved along. The load is the force, or
/// moment, that does the work of all reactions of the driven bodies on it: docs/push-over.md, equation (3).
class MovedBoundary : public Push {
public:
    MovedBoundary(Session& session, const lang::SolveControl& command);

    double velocity() const override { return factor_ * size_; }
    double load() const override;
    double force() const override { return 1; }
    Vec3 reaction() const override;
    bool is_boundary() const override { return true; }
    void renew() override;
    bool is_outdated() const override;
    void advance(double velocity, double wanted) override;
    void end() override;
    bool turns() const override { return turns_; }
    std::string load_name() const override { return turns_ ? "moment [moment]" : "force [force]"; }
    std::string end_of_load() const override { return "a load of 0: nothing resists"; }

private:
    void set(double factor);

    Session& session_;
    const Model& model_;
    const std::string variable_;
    std::vector<std::vector<Row>> bodies_;        ///< rigid: the blocks of each
    std::vector<Row> gridpoints_;                 ///< of blocks with zones
    std::size_t blocks_ = 0, all_gridpoints_ = 0; ///< of the model
    double size_ = 0;                             ///< velocity of the displacement for a variable of 1
    bool turns_ = false;                          ///< the displacement is a rotation
    double factor_ = 0;
};

} // namespace kaya
