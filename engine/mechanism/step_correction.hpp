// SPDX-License-Identifier: GPL-3.0-or-later
/// How large a correction of Newton's method is in the step of a mechanism (mechanism_step.hpp): against the
/// increments of each coordinate (solve/correction_size.hpp), and of all together in the metric of the
/// masses.
///
/// Impulses of reactions count as well, by what they move in a step, h g_q^T dLambda / m against the
/// increments or against h g_q^T Lambda / m: the momenta at the end have them, whatever the curve has of
/// them, and a curve that goes on from the last one may be right before they are.
#pragma once

#include <Eigen/Core>

#include <algorithm>

#include "engine/mechanism/mechanism_equations.hpp"
#include "engine/solve/correction_size.hpp"

namespace extremal {

class StepCorrection {
public:
    using Vector = Eigen::VectorXd;

    StepCorrection(int dimension, int functions, int constraints);

    /// A new step: nothing is known of what reactions hold.
    void begin() { held_.setZero(); }
    /// A correction (dY, dLambda) at z = (q_0, Y) and Lambda, of a step of length h from the momenta p.
    struct Of {
        double h;
        const Vector &z, &p, &impulses, &correction;
    };
    void take(const MechanismEquations& equations, const Of& of);

    /// The largest relative correction, and that of the curve alone.
    double relative() const;
    double ofCurve() const;
    /// The same with coordinates apart whose increments are round-off.
    CorrectionSize<double> apart() const {
        return measureCorrection<double>(d_, [this](int k) { return ofCoordinate(k); });
    }
    /// The largest change, and that against the increments, all coordinates together: one that turns back has
    /// increments of almost nothing.
    double changeInMassMetric() const;
    double inMassMetric();
    /// Whether a matrix of the place before it belongs to another place.
    bool isElsewhere() const { return changeInMassMetric() > 0.1 * incrementsInMassMetric(); }
    /// From here on what reactions keep coordinates from in a step is a size that rounding is told by: of a
    /// body that they hold at rest in the origin it is the only one.
    void knowReactions() { held_ = pulled_; }

private:
    CoordinateCorrection<double> ofCoordinate(int k) const {
        return {change_(k), increments_(k), value(k), masses_(k), impulse_(k)};
    }
    double incrementsInMassMetric() const;
    double value(int k) const { return std::max(place_(k), held_(k)); }

    int d_, m_, n_;
    Vector change_, increments_, place_, impulse_, masses_;  ///< by coordinate
    Vector moved_, pulled_;  ///< by dLambda and by Lambda; 0 where a mass is 0
    Vector held_;            ///< pulled_, once that is known
};

}  // namespace extremal
