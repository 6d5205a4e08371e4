// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/asynchronous/elements.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace extremal {

BarElements::BarElements(std::shared_ptr<const FieldProblem> problem)
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

double BarElements::energy(int e, const double* u, const double* v) const {
    const auto a = static_cast<std::size_t>(e), b = static_cast<std::size_t>(nodesOf(e)[1]);
    const double L = size_[a];
    return L * problem_->elastic.at((u[b] - u[a]) / L).energy +
           L / 2 * (problem_->potential(u[a]) + problem_->potential(u[b])) +
           L / 4 * (v[a] * v[a] + v[b] * v[b]);
}

double BarElements::stiffening(const double* u) const {
    double most = 1;
    for (int e = 0; e < elements(); ++e) {
        const auto a = static_cast<std::size_t>(e), b = static_cast<std::size_t>(nodesOf(e)[1]);
        const double strain = (u[b] - u[a]) / size_[a];
        most = std::max(most, problem_->elastic.at(strain).modulus / problem_->elastic.k);
    }
    return std::sqrt(most);
}

MembraneElements::MembraneElements(std::shared_ptr<const MembraneProblem> problem)
    : problem_(std::move(problem)) {
    for (int a = 0; a < problem_->size(); ++a)
        inverse_.push_back(problem_->isFixed(a) ? 0 : 1 / problem_->mass[static_cast<std::size_t>(a)]);
}

Levels MembraneElements::levels(double courant, bool isBalanced) const {
    std::vector<double> steps;
    for (int e = 0; e < elements(); ++e) steps.push_back(courant * criticalStep(e));
    return dyadicLevels(problem_->mesh, steps, isBalanced);
}

double MembraneElements::place(int e) const {
    double middle[2] = {0, 0};
    for (const int node : nodesOf(e))
        for (int k = 0; k < 2; ++k)
            middle[k] +=
                problem_->mesh.nodes[static_cast<std::size_t>(node)][static_cast<std::size_t>(k)] / 3;
    return std::hypot(middle[0], middle[1]);
}

double MembraneElements::energy(int e, const double* u, const double* v) const {
    double energy = problem_->elementEnergy(element(e), u);
    for (const int node : nodesOf(e)) {
        const double rate = v[static_cast<std::size_t>(node)];
        energy += element(e).area / 6 * rate * rate;
    }
    return energy;
}

}  // namespace extremal
