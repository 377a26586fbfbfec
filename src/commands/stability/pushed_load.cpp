#include "commands/stability/pushed_load.hpp"

#include "commands/list/reactions.hpp"

#include <fmt/format.h>

namespace kaya {

PushedLoad::PushedLoad(Session& session, const lang::SolveControl& command)
    : session_(session), model_(session.engine.model), variable_(command.variable), factor_(take_gravity(command)),
      pattern_(pattern()), answer_(pattern_.answer(model_)), before_(pattern_.velocity(model_)) {
    if (!command.gravity) factor_ = session.engine.scripts->number(variable_, command.place);
    set(factor_);
}

double PushedLoad::take_gravity(const lang::SolveControl& command) {
    if (!command.gravity) return 0;
    const Vec3& gravity = model_.settings.gravity;
    along_ = command.gravity->normalized();
    rest_ = gravity - along_ * gravity.dot(along_);
    if (!(rest_.norm() > 1e-9 * gravity.norm()))
        throw Diagnostic("there is no gravity normal to this direction, and the load is a share of it",
                         "give it first: gravity 0 0 -9.81")
            .at(command.place);
    return gravity.dot(along_) / rest_.norm();
}

void PushedLoad::set(double factor) {
    factor_ = factor;
    if (!along_.isZero()) model_.settings.gravity = rest_ + along_ * (factor * rest_.norm());
    if (!variable_.empty()) session_.engine.scripts->set(variable_, factor);
}

Vec3 PushedLoad::reaction() const {
    return reactions_of(model_, [](Row) { return false; }).reaction;
}

void PushedLoad::renew() {
    if (is_outdated()) pattern_ = pattern();
    answer_ = pattern_.answer(model_);
}

void PushedLoad::advance(double velocity, double wanted) {
    constexpr double part = 0.2; // a variable acts one step later than gravity, and damping changes the answer
    const double missing = part * part / 4 * (wanted - velocity) - part * (velocity - before_); // equation (2)
    before_ = velocity;
    set(factor_ + missing / (model_.clock.time_step * answer_));
}

std::string PushedLoad::load_name() const {
    if (variable_.empty()) return "load / rest of gravity";
    return along_.isZero() ? "@" + variable_ : "load / rest of gravity, @" + variable_;
}

} // namespace kaya
