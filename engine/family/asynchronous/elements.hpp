// SPDX-License-Identifier: GPL-3.0-or-later
/// The elements of a bar or a membrane with masses at the nodes, for schemes that take them one by one.
///
/// Both have the same members, and nothing else of the family knows which of the two it has:
///     elements(), nodes(), nodesOf(e)   the nodes that element e kicks
///     kick(e, h, u, v)                  v += h M^{-1} (-dV_e/du) at values u
///     vary(e, h, u, du, dv)             the same of a variation: dv += h M^{-1} (-d^2V_e/du^2) du
///     inverseMass(a)                    1/m_a; 0 of nodes that are held
///     criticalStep(e)                   the longest stable step of the element alone, at rest
///     levels(C, isBalanced)             dyadic levels for steps of C times that
///     place(e), energy(e, u, v)         where it is in plots of elements, and its energy
///     stiffening(u)                     the largest local wave speed at u, relative to that at rest
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "engine/mesh/levels.hpp"
#include "engine/model/field/problem.hpp"
#include "engine/model/membrane/problem.hpp"

namespace extremal {

class BarElements {
public:
    explicit BarElements(std::shared_ptr<const FieldProblem> problem);

    int elements() const { return static_cast<int>(size_.size()); }
    int nodes() const { return static_cast<int>(inverse_.size()); }
    std::array<int, 2> nodesOf(int e) const { return {e, e + 1 == nodes() ? 0 : e + 1}; }
    double criticalStep(int e) const { return size_[static_cast<std::size_t>(e)] / problem_->speed(); }

    void kick(int e, double h, const double* u, double* v) const {
        const auto a = static_cast<std::size_t>(e), b = static_cast<std::size_t>(nodesOf(e)[1]);
        const double L = size_[a];
        const double stress = h * problem_->elastic.stress((u[b] - u[a]) / L);
        v[a] += stress * inverse_[a];
        v[b] -= stress * inverse_[b];
        if (!hasPotential_) return;
        double slope[2];
        const double at[2] = {u[a], u[b]};
        problem_->potential.evaluate(at, 2, nullptr, slope, nullptr);
        v[a] -= h * L / 2 * slope[0] * inverse_[a];
        v[b] -= h * L / 2 * slope[1] * inverse_[b];
    }
    void vary(int e, double h, const double* u, const double* du, double* dv) const {
        const auto a = static_cast<std::size_t>(e), b = static_cast<std::size_t>(nodesOf(e)[1]);
        const double L = size_[a];
        const double stress = h * problem_->elastic.at((u[b] - u[a]) / L).modulus * (du[b] - du[a]) / L;
        dv[a] += stress * inverse_[a];
        dv[b] -= stress * inverse_[b];
        if (!hasPotential_) return;
        double curvature[2];
        const double at[2] = {u[a], u[b]};
        problem_->potential.evaluate(at, 2, nullptr, nullptr, curvature);
        dv[a] -= h * L / 2 * curvature[0] * du[a] * inverse_[a];
        dv[b] -= h * L / 2 * curvature[1] * du[b] * inverse_[b];
    }
    double inverseMass(std::size_t a) const { return inverse_[a]; }

    Levels levels(double courant, bool isBalanced) const {
        return dyadicLevels(problem_->mesh, courant, problem_->speed(), isBalanced);
    }
    double place(int e) const {
        return problem_->mesh.x[static_cast<std::size_t>(e)] + size_[static_cast<std::size_t>(e)] / 2;
    }
    double energy(int e, const double* u, const double* v) const;
    double stiffening(const double* u) const;

private:
    std::shared_ptr<const FieldProblem> problem_;
    bool hasPotential_;
    std::vector<double> size_, inverse_;  ///< 1 / m_a; 0 of fixed nodes
};

class MembraneElements {
public:
    explicit MembraneElements(std::shared_ptr<const MembraneProblem> problem);

    int elements() const { return static_cast<int>(problem_->elements.size()); }
    int nodes() const { return static_cast<int>(inverse_.size()); }
    const std::array<int, 3>& nodesOf(int e) const { return element(e).nodes; }
    double criticalStep(int e) const { return problem_->criticalStep(element(e)); }

    void kick(int e, double h, const double* u, double* v) const {
        const MembraneProblem::Element& K = element(e);
        const auto g = MembraneProblem::slope(K, u);
        const double force = -h * K.area * problem_->tension(g[0] * g[0] + g[1] * g[1]);
        for (std::size_t i = 0; i < 3; ++i) {
            const auto a = static_cast<std::size_t>(K.nodes[i]);
            v[a] += force * inverse_[a] * (K.gradients[i][0] * g[0] + K.gradients[i][1] * g[1]);
        }
    }
    void vary(int e, double h, const double* u, const double* du, double* dv) const {
        const MembraneProblem::Element& K = element(e);
        const auto g = MembraneProblem::slope(K, u), dg = MembraneProblem::slope(K, du);
        const double p = g[0] * g[0] + g[1] * g[1], along = 2 * (g[0] * dg[0] + g[1] * dg[1]);
        const double tension = problem_->tension(p), change = problem_->tensionSlope(p) * along;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto a = static_cast<std::size_t>(K.nodes[i]);
            dv[a] -= h * K.area * inverse_[a] *
                     (K.gradients[i][0] * (tension * dg[0] + change * g[0]) +
                      K.gradients[i][1] * (tension * dg[1] + change * g[1]));
        }
    }
    double inverseMass(std::size_t a) const { return inverse_[a]; }

    Levels levels(double courant, bool isBalanced) const;
    double place(int e) const;  ///< its distance from the centre
    double energy(int e, const double* u, const double* v) const;
    double stiffening(const double*) const { return 1; }  ///< no material of a membrane becomes stiffer

private:
    const MembraneProblem::Element& element(int e) const {
        return problem_->elements[static_cast<std::size_t>(e)];
    }
    std::shared_ptr<const MembraneProblem> problem_;
    std::vector<double> inverse_;
};

}  // namespace extremal
