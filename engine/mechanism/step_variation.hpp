// SPDX-License-Identifier: GPL-3.0-or-later
/// The equations of a step of a mechanism (mechanism_step.hpp), differentiated in given directions: of its
/// curve, of its impulses, of its start and of its length.
///
///     d(R, C) = (R, C)_z dz + (R, C)_Lambda dLambda + (R, C)_t dt + (R, C)_h dh,      dA likewise,
/// for z = (q_0, Y). With dY and dLambda from the factors of the step's own last Newton matrix this is its
/// tangent map: J (dY, dLambda) = -d(R, C) for dz = (dq_0, 0), plus dp_0 in the last rows of R.
///
/// What depends on time is differentiated by it with central differences (relative errors of 1e-10); the rest
/// is exact. Columns are independent directions.
#pragma once

#include <Eigen/Core>

#include <optional>

#include "engine/mechanism/mechanism.hpp"
#include "engine/mechanism/mechanism_curve.hpp"

namespace extremal {

class StepVariation {
public:
    using Vector = Eigen::VectorXd;
    using Matrix = Eigen::MatrixXd;
    using Row = Eigen::RowVectorXd;
    using Rows = Mechanism::Rows;

    /// Where the derivatives are taken: a step of length h from t.
    struct Step {
        double t, h;
        const Vector& z;
        const Vector& impulses;
    };
    struct Directions {
        const Matrix& z;         ///< (m + 1) d rows
        const Matrix& impulses;  ///< m n rows
        const Row& start;        ///< dt
        const Row& length;       ///< dh
    };

    StepVariation(const Mechanism& mechanism, const MechanismCurve& curve);

    void evaluate(const Step& step, const Directions& along);
    /// d(R, C) without p_0, and dA, where evaluate() was asked last.
    const Matrix& residual() const { return residual_; }
    const Matrix& impulse() const { return impulse_; }

private:
    void addLagrangian(const Step& step, const Directions& along, int node);
    void addForces(const Step& step, const Directions& along, int node);
    void addConditions(const Step& step, const Directions& along, int node);
    /// Rows of the conditions whose multipliers of one node act at one place.
    struct Multipliers {
        int first, count, node;
        double place;
        const Matrix& at;  ///< functions there, in row `node`
    };
    template <class Part>
    void addImpulses(const Step& step, const Directions& along, const Part& part, const Multipliers& of);
    void addRolling(const Step& step, const Directions& along, int node);
    /// (q, v) into motion_, (dq, dv) into moved_, dt into later_, of a node with these functions.
    template <class Value, class Slope>
    void moveTo(const Step& step, const Directions& along, double tau, const Value& value,
                const Slope& slope);

    Mechanism mechanism_;
    const MechanismCurve curve_;
    Matrix residual_, impulse_, moved_, change_, byLength_;
    Row later_;
    Vector motion_, gradient_, ahead_, value_, byTime_, forces_;
    Rows hessian_, byState_, byPlace_, ahead2_, curvature_;
};

}  // namespace extremal
