// SPDX-License-Identifier: GPL-3.0-or-later
/// The tangent map of a step of a mechanism (mechanism_step.hpp), transposed, as far as the projection at its
/// end. With the factors of the last Newton matrix J = d(R, C)/d(Y, Lambda),
///
///     J^T (w, mu) = d(l_p . A + l_q . Y_{m-1})/d(Y, Lambda),    Phi = l_p . A - w . R - mu . C,
///     l_q <- l_q + dPhi/dq_0,    l_p <- l_p - w_{m-1},
///
/// where Phi is the sum of integrator/variation/transposed_step.hpp along the test curve
///     eta = l_p - w_{m-1} - sum_{a < m-1} phi_a w_a + phi_{m-1} w_{m-1},
/// with sum_{j<m} eta(e_j) . Gamma_j - mu . C besides.
#pragma once

#include <Eigen/Core>

#include <functional>

#include "engine/integrator/variation/transposed_step.hpp"
#include "engine/mechanism/mechanism.hpp"
#include "engine/mechanism/mechanism_curve.hpp"
#include "engine/mechanism/mechanism_equations.hpp"

namespace extremal {

class StepAdjoint {
public:
    using Vector = Eigen::VectorXd;

    StepAdjoint(const Mechanism& mechanism, SharedCurve curve);

    /// A step of length h from t along z = (q_0, Y), with the impulses Lambda.
    struct Step {
        double t, h;
        const Vector &z, &impulses;
    };
    void visit(const Step& step, const std::function<void(const NodePull::Node&)>& to);
    /// l <- M^T l for columns (l_q, l_p); `equations` are factored at the solution.
    bool apply(const Step& step, const MechanismEquations& equations, NodePull& pull,
               Eigen::Map<Eigen::MatrixXd> columns);

private:
    struct Place {
        const MechanismCurve::Nodes& nodes;
        int i;
        bool isOfForce;
    };
    int nodes() const { return curve_.table.nodes() + (mechanism_.force() ? curve_.atForces.nodes() : 0); }
    Place placeOf(int node) const;
    NodePull::Node nodeAt(const Step& step, int node);
    void pullBack(const Step& step, NodePull& pull);
    /// The multipliers of one node, from `first` on, which act at this place.
    struct Multipliers {
        int first, count, node;
        double place;
        const Eigen::MatrixXd& at;  ///< functions there, in row `node`
    };
    template <class Part>
    void pullImpulses(const Step& step, const Part& part, const Multipliers& of);
    void pullConditions(const Step& step);
    void pullRolling(const Step& step, int node);
    void spread(const Eigen::MatrixXd& at, int row);

    Mechanism mechanism_;
    SharedCurve shared_;
    const MechanismCurve& curve_;
    Vector test_, pulled_;  ///< test_: eta, as z
    Vector solution_;       ///< (w, mu)
    Vector byImpulses_, value_, byTime_;
    Mechanism::Rows byPlace_, curvature_, byState_;
    Vector motion_, eta_, derivatives_;  ///< (q, v) and (eta, eta') of one node, and derivatives by (q, v)
};

}  // namespace extremal
