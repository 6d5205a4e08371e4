// SPDX-License-Identifier: GPL-3.0-or-later
/// Random states at which a Lagrangian is looked at, of the sizes that its own terms suggest.
///
/// Places are of sizes 0.3 to 10; each velocity is such that its kinetic energy is as large as the work of
/// the force along the size, m v^2 = |L_q| size, whatever the units. In half of the states most velocities
/// are zero, so that light bodies are seen beside heavy ones. What a typed formula has elsewhere, such as a
/// pulse at t = 50, is seen at further states near its landmarks (model/typed/landmarks.hpp). Evaluations
/// spend work (core/work.hpp).
#pragma once

#include <random>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/model/typed/landmarks.hpp"

namespace extremal {

struct SampledState {
    double t = 0;
    std::vector<double> q, v;
    double L = 0, Lt = 0;
    std::vector<double> gradient;  ///< L_q, then L_v
};

class StateSampler {
public:
    explicit StateSampler(const Mechanical& mechanics, unsigned seed = 1918);

    /// The next state where L and its derivatives are finite; false after many that are not.
    bool next(SampledState& state);
    /// How many states near landmarks are worth looking at; 0 where the Lagrangian has no landmarks.
    int statesAtLandmarks() const;
    /// A state near landmarks; false where L or its derivatives are not finite.
    bool nextAtLandmarks(SampledState& state);
    /// Sets L, L_t and the gradient from t, q and v; false where one of them is not finite.
    bool evaluate(SampledState& state);
    /// L_t by central differences of order 8, at the step where those of two steps agree best.
    double timeDerivative(double t, const double* q, const double* v) const;

private:
    void draw(SampledState& state);
    /// L, with its derivatives in gradient and hessian_.
    double jet(double t, const double* q, const double* v, double* gradient) const;
    double value(double t, const double* q, const double* v) const;
    double uniform() { return 2 * static_cast<double>(random_()) / 4294967295.0 - 1; }

    const Mechanical* mechanics_;
    double work_;  ///< of one evaluation
    std::mt19937 random_;
    double period_ = 1;  ///< typical size over velocity
    long long drawn_ = 0;
    const typed::Landmarks* landmarks_ = nullptr;  ///< belongs to the model
    mutable std::vector<double> gradient_, hessian_;
};

}  // namespace extremal
