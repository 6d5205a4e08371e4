/// The elements of a bar with lumped masses, for schemes that take them one by one.
#pragma once

#include <memory>
#include <vector>

#include "engine/model/field/problem.hpp"

namespace extremal {

class ElementForces {
public:
    explicit ElementForces(std::shared_ptr<const FieldProblem> problem);

    const FieldProblem& problem() const { return *problem_; }
    int elements() const { return static_cast<int>(size_.size()); }
    int nodes() const { return static_cast<int>(inverse_.size()); }
    int right(int e) const { return e + 1 == nodes() ? 0 : e + 1; }  ///< the left node of e is e
    double size(int e) const { return size_[static_cast<std::size_t>(e)]; }

    /// v += h M^{-1} (-dV_K/du) of element e, at values u.
    void kick(int e, double h, const double* u, double* v) const {
        const auto a = static_cast<std::size_t>(e), b = static_cast<std::size_t>(right(e));
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

private:
    std::shared_ptr<const FieldProblem> problem_;
    bool hasPotential_;
    std::vector<double> size_, inverse_;  ///< 1 / m_a; 0 of fixed nodes
};

}  // namespace extremal
