// SPDX-License-Identifier: GPL-3.0-or-later
/// One step on a mesh that follows a monitor with a lag, from data at the start of the step alone:
///
///     X_{k+1} = X_k + theta (X_eq - X_k),  X_eq equidistributes M(u_x, u_xx, u_t), smoothed,
///     theta = min(1, h / tau, h v / max |X_eq - X_k|),   v the largest speed that nodes may have,
///     p_k + D_1 L_d(y_k, y_{k+1}) = 0,   p_{k+1} = D_2 L_d(y_k, y_{k+1})   in the values y alone.
/// The mesh is prescribed: the action then depends on time, its values are integrated symplectically, and
/// energy is not protected. What it cannot do is tangle, as X is a mean of two ordered meshes.
#pragma once

#include <stop_token>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/family/moving_mesh/monitor.hpp"
#include "engine/family/moving_mesh/slab_action.hpp"
#include "engine/solve/band_lu.hpp"

namespace extremal {

class ExplicitStep {
public:
    ExplicitStep(const NodeSpace& space, const Monitor& monitor, double relaxation, double speedLimit,
                 double tolerance, int maxIterations);

    /// As MultiplierStep::advance.
    Outcome advance(std::vector<double>& z, std::vector<double>& v, double h, StepReport& report,
                    const std::stop_token& stop);
    /// The same with the nodes where they are.
    Outcome advanceAtRest(std::vector<double>& z, std::vector<double>& v, double h, StepReport& report,
                          const std::stop_token& stop);
    double slabEnergy() const { return slabEnergy_; }

private:
    Outcome advanceValues(std::vector<double>& z, std::vector<double>& v, double h, StepReport& report,
                          const std::stop_token& stop);
    void moveMesh(const std::vector<double>& z, const std::vector<double>& v, double h);
    void guess(const std::vector<double>& z, const std::vector<double>& v, double h);
    Outcome solve(const std::vector<double>& z0, double h, StepReport& report, const std::stop_token& stop);
    void evaluate(const std::vector<double>& z0, double h, bool withJacobian, Cost& cost);

    NodeSpace space_;
    Monitor monitor_;
    double relaxation_, speedLimit_, tolerance_;
    int maxIterations_;
    SlabAction action_;
    BandLu lu_;
    std::vector<double> z1_, v1_, p0_, residual_;
    std::vector<double> y_, X_, equal_, M_, u_xx_;
    double slabEnergy_ = 0;
};

}  // namespace extremal
