// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/asynchronous/element_forces.hpp"

#include <utility>

namespace extremal {

BarForces::BarForces(std::shared_ptr<const FieldProblem> problem)
    : problem_(std::move(problem)),
      hasPotential_(problem_->potential.kind() != FieldPotential::Kind::none),
      inverse_(static_cast<std::size_t>(problem_->size()), 0) {
    const Mesh& mesh = problem_->mesh;
    for (int e = 0; e < mesh.elements(); ++e) size_.push_back(mesh.size(e));
    for (int e = 0; e < mesh.elements(); ++e)
        for (const int a : nodesOf(e)) inverse_[static_cast<std::size_t>(a)] += mesh.size(e) / 2;
    for (int a = 0; a < nodes(); ++a) {
        double& m = inverse_[static_cast<std::size_t>(a)];
        m = problem_->isFixed(a) ? 0 : 1 / m;
    }
}

MembraneForces::MembraneForces(std::shared_ptr<const MembraneProblem> problem)
    : problem_(std::move(problem)) {
    for (int a = 0; a < problem_->size(); ++a)
        inverse_.push_back(problem_->isFixed(a) ? 0 : 1 / problem_->mass[static_cast<std::size_t>(a)]);
}

}  // namespace extremal
