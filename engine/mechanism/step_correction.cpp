// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/step_correction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace extremal {

StepCorrection::StepCorrection(int dimension, int functions, int constraints)
    : d_(dimension), m_(functions), n_(constraints) {
    change_ = increments_ = place_ = impulse_ = masses_ = moved_ = pulled_ = held_ = Vector::Zero(d_);
}

void StepCorrection::take(const MechanismEquations& equations, const Of& of) {
    masses_ = equations.masses();
    place_ = of.z.head(d_).cwiseAbs();
    impulse_ = of.h * of.p;
    change_ = of.correction.head(d_).cwiseAbs();
    increments_ = of.z.segment(d_, d_).cwiseAbs();
    for (int a = 1; a < m_; ++a) {
        change_ = change_.cwiseMax(of.correction.segment(a * d_, d_).cwiseAbs());
        increments_ = increments_.cwiseMax(of.z.segment((a + 1) * d_, d_).cwiseAbs());
    }
    if (n_ == 0) return;
    equations.reactions(of.correction.data() + m_ * d_, moved_);
    equations.reactions(of.impulses.data(), pulled_);
    for (int k = 0; k < d_; ++k) {
        const double byImpulse = masses_(k) > 0 ? std::abs(of.h) / masses_(k) : 0;
        moved_(k) = byImpulse * std::abs(moved_(k));
        pulled_(k) = byImpulse * std::abs(pulled_(k));
    }
}

double StepCorrection::relative() const {
    double size = ofCurve();
    for (int k = 0; n_ > 0 && k < d_; ++k)
        size = std::max(size, relativeCorrection(moved_(k), std::max(increments_(k), pulled_(k)), value(k)));
    return size;
}

double StepCorrection::ofCurve() const {
    double size = 0;
    for (int k = 0; k < d_; ++k)
        size = std::max(size, relativeCorrection(change_(k), increments_(k), value(k)));
    return size;
}

double StepCorrection::changeInMassMetric() const {
    double change = 0;
    for (int k = 0; k < d_; ++k) change = std::max(change, std::sqrt(masses_(k)) * change_(k));
    return change;
}

double StepCorrection::incrementsInMassMetric() const {
    constexpr double roundOff = 100 * std::numeric_limits<double>::epsilon();
    double size = 0;
    for (int k = 0; k < d_; ++k)
        size = std::max(size, std::sqrt(masses_(k)) * std::max(increments_(k), roundOff * value(k)));
    return size;
}

double StepCorrection::inMassMetric() {
    const double change = changeInMassMetric();
    if (n_ > 0 && change > incrementsInMassMetric() / 4) knowReactions();
    return change > 0 ? change / incrementsInMassMetric() : 0;
}

}  // namespace extremal
