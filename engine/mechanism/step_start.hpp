// SPDX-License-Identifier: GPL-3.0-or-later
/// What the iterations for a step of a mechanism (mechanism_step.hpp) start from: the motion at its start,
/// q_0 + t v + t^2 a / 2 with the multipliers of this state, or the curve of the last step, which goes on.
#pragma once

#include <Eigen/Core>

#include "engine/core/outcome.hpp"
#include "engine/core/text/archive.hpp"
#include "engine/mechanism/mechanism.hpp"
#include "engine/mechanism/mechanism_curve.hpp"
#include "engine/solve/fixed_point_policy.hpp"

namespace extremal {

struct StartMotion {
    Eigen::VectorXd velocity, acceleration, multipliers;

    /// At (t, q, p); false where it is not determined.
    bool take(Mechanism& mechanism, double t, const double* q, const double* p, StepReport& report) {
        const auto& L = mechanism.mechanics();
        velocity.setZero(mechanism.dimension());
        if (!L.velocity(L.model.get(), t, q, p, velocity.data())) return false;
        ++report.cost.evaluations;
        ++report.cost.linearSolves;
        return mechanism.accelerate(t, q, velocity.data(), acceleration, multipliers);
    }
    /// Y of a step of length h.
    void curve(const MechanismCurve& of, double h, Eigen::VectorXd& Y) const {
        const int m = of.unknowns();
        for (int a = 0; a < m; ++a) {
            auto own = Y.segment(a * of.d, of.d);
            own.setZero();
            for (int j = 0; j < m; ++j) {
                const double t = of.place(j + 1) * h;
                own += of.fit(a, j) * (t * velocity + t * t / 2 * acceleration);
            }
        }
    }
    /// The impulses Lambda of such a step, of which the first ones are those of constraints.
    void impulses(const MechanismCurve& of, double h, int constraints, Eigen::VectorXd& Lambda) const {
        const auto n = multipliers.size(), g = static_cast<Eigen::Index>(constraints);
        for (int j = 0; j < of.unknowns(); ++j) {
            Lambda.segment(j * n, g) = h * of.weight(j) * multipliers.head(g);
            Lambda.segment(j * n + g, n - g) =
                h * of.rolling.b[static_cast<std::size_t>(j)] * multipliers.tail(n - g);
        }
    }
};

/// The curve of the last step, its impulses, and the masses there.
struct LastCurve {
    Eigen::VectorXd Y, impulses, masses;

    /// The curve goes on; what acts on it is taken to be what has acted. False where its increments would
    /// differ from the last ones by a quarter, as in front of a turning point: a root near such a curve may
    /// be any.
    bool goOn(const MechanismCurve& of, Eigen::VectorXd& toY, Eigen::VectorXd& toImpulses) const {
        const Eigen::Map<const Mechanism::Rows> previous(Y.data(), of.unknowns(), of.d);
        Eigen::Map<Mechanism::Rows>(toY.data(), of.unknowns(), of.d) =
            of.table.extrapolation.lazyProduct(previous);
        toImpulses = impulses;
        const auto last = Y.tail(of.d).array();
        const auto next = toY.tail(of.d).array();
        return (masses.array() * (next - last).square()).sum() <=
               farFromRoot * farFromRoot * (masses.array() * last.square()).sum();
    }
    void take(const Eigen::VectorXd& ofY, const Eigen::VectorXd& ofImpulses,
              const Eigen::VectorXd& ofMasses) {
        Y = ofY;
        impulses = ofImpulses;
        masses = ofMasses;
    }
    void checkpoint(Archive& archive) { archive(Y, impulses, masses); }
};

}  // namespace extremal
