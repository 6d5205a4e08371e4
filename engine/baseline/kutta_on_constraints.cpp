// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/baseline/kutta_on_constraints.hpp"

#include "engine/baseline/classical_table.hpp"

namespace extremal {

KuttaOnConstraints::KuttaOnConstraints(const System& system, const BaselineOptions& options, Remedy remedy)
    : ConstrainedMethod(system, options.step), remedy_(remedy) {
    q_ = p_ = dq_ = dp_ = sumQ_ = sumP_ = velocity_ = Vector::Zero(d());
}

Outcome KuttaOnConstraints::step() {
    sumQ_.setZero();
    sumP_.setZero();
    for (std::size_t stage = 0; stage < classical::stages; ++stage) {
        const double ahead = classical::node[stage] * h();
        q_ = q0_;
        p_ = p0_;
        if (stage > 0) {
            q_ += ahead * dq_;
            p_ += ahead * dp_;
        }
        ++report_.cost.evaluations;
        if (!mechanism_.flow(start() + ahead, q_.data(), p_.data(), dq_.data(), dp_.data(), remedy_.feedback))
            return q_.allFinite() && p_.allFinite() ? Outcome::singular : Outcome::notFinite;
        sumQ_ += classical::weight[stage] * dq_;
        sumP_ += classical::weight[stage] * dp_;
    }
    q1_ = q0_ + h() * sumQ_;
    p1_ = p0_ + h() * sumP_;
    if (remedy_.projects && !(mechanism_.projectPlace(end(), q1_.data()) &&
                              mechanism_.project(end(), q1_.data(), p1_.data(), velocity_, kappa_)))
        return Outcome::singular;
    return Outcome::converged;
}

}  // namespace extremal
