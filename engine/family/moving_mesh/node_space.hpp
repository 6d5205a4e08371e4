// SPDX-License-Identifier: GPL-3.0-or-later
/// What the steps of a moving mesh share: nodes z = (y_i, X_i) and rates v = (y'_i, X'_i), i = 0 .. N + 1,
/// one after the other; which of them are held; mass, momentum and energies.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "engine/model/field/moving_element.hpp"
#include "engine/model/field/problem.hpp"

namespace extremal {

struct NodeSpace {
    std::shared_ptr<const FieldProblem> problem;
    std::size_t n;  ///< nodes, both ends included
    double c2;

    explicit NodeSpace(std::shared_ptr<const FieldProblem> problem_)
        : problem(std::move(problem_)),
          n(static_cast<std::size_t>(problem->size())),
          c2(problem->elastic.k) {}

    std::size_t elements() const { return n - 1; }
    bool isEnd(std::size_t i) const { return i == 0 || i + 1 == n; }
    bool holdsValue(std::size_t i) const { return problem->isFixed(static_cast<int>(i)); }

    /// p = M(z) v.
    void momentum(const double* z, const double* v, std::vector<double>& p) const {
        p.assign(2 * n, 0);
        ElementDerivatives::Matrix mass;
        for (std::size_t e = 0; e + 1 < n; ++e) {
            elementMass(z + 2 * e, mass);
            for (std::size_t a = 0; a < 4; ++a)
                for (std::size_t b = 0; b < 4; ++b) p[2 * e + a] += mass[a][b] * v[2 * e + b];
        }
    }
    double energy(const double* z, const double* v) const {
        std::vector<double> y(n);
        for (std::size_t i = 0; i < n; ++i) y[i] = z[2 * i];
        PotentialMomentsOf W(problem->potential, elements());
        W.evaluate(y.data(), false);
        double sum = 0;
        for (std::size_t e = 0; e + 1 < n; ++e) {
            const ElementEnergy own = elementEnergy(z + 2 * e, v + 2 * e, c2, W[e].W);
            sum += own.kinetic + own.potential;
        }
        return sum;
    }
    /// Whether all elements are longer than 0.
    bool isOrdered(const double* z) const {
        for (std::size_t e = 0; e + 1 < n; ++e)
            if (!(z[2 * e + 3] > z[2 * e + 1])) return false;
        return true;
    }
    double smallestElement(const double* z) const {
        double least = z[3] - z[1];
        for (std::size_t e = 1; e + 1 < n; ++e) least = std::min(least, z[2 * e + 3] - z[2 * e + 1]);
        return least;
    }
};

}  // namespace extremal
