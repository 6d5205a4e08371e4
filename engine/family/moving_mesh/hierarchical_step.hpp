// SPDX-License-Identifier: GPL-3.0-or-later
/// One step on a mesh at rest that is chosen before it: hat functions of a hierarchy, refined in some places
/// and coarsened in others (dyadic_mesh.hpp).
///
/// Values and rates go from the old mesh to the new one by their L2 projections, the adjoints of the
/// interpolation from coarse to fine: momentum stays, and what a coarser mesh cannot hold is lost. Then the
/// action is stationary in the values (explicit_step.hpp): symplectic between two changes of the mesh, and
/// not across one, where energy is lost.
#pragma once

#include <stop_token>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/family/moving_mesh/dyadic_mesh.hpp"
#include "engine/family/moving_mesh/explicit_step.hpp"

namespace extremal {

class HierarchicalStep {
public:
    HierarchicalStep(const NodeSpace& space, const Monitor& monitor, double tolerance, int maxIterations);

    /// As MultiplierStep::advance.
    Outcome advance(std::vector<double>& z, std::vector<double>& v, double h, StepReport& report,
                    const std::stop_token& stop);
    double slabEnergy() const { return values_.slabEnergy(); }

private:
    bool choose(const std::vector<double>& z, const std::vector<double>& v);
    void factoriseMass();
    void project(std::vector<double>& f);

    NodeSpace space_;
    Monitor monitor_;
    ExplicitStep values_;
    DyadicMesh mesh_;
    BandLu lu_;
    std::vector<double> X_, y_, M_, own_, u_xx_, nodes_, load_;
};

}  // namespace extremal
