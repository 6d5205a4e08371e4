#include "engine/family/asynchronous/element_forces.hpp"

#include <utility>

namespace extremal {

ElementForces::ElementForces(std::shared_ptr<const FieldProblem> problem)
    : problem_(std::move(problem)),
      hasPotential_(problem_->potential.kind() != FieldPotential::Kind::none),
      inverse_(static_cast<std::size_t>(problem_->size()), 0) {
    const Mesh& mesh = problem_->mesh;
    for (int e = 0; e < mesh.elements(); ++e) size_.push_back(mesh.size(e));
    for (int e = 0; e < mesh.elements(); ++e)
        for (const int a : {e, right(e)}) inverse_[static_cast<std::size_t>(a)] += size(e) / 2;
    for (int a = 0; a < nodes(); ++a) {
        double& m = inverse_[static_cast<std::size_t>(a)];
        m = problem_->isFixed(a) ? 0 : 1 / m;
    }
}

}  // namespace extremal
