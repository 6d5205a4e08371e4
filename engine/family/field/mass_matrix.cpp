// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/field/mass_matrix.hpp"

#include <algorithm>
#include <limits>

namespace extremal {

MassMatrix::MassMatrix(const SpatialForm& form) : order_(form.problem().nodes) {
    const FieldProblem& problem = form.problem();
    const int n = form.size();
    if (form.isLumped()) {
        inverse_ = form.lumpedMass();
        for (int i = 0; i < n; ++i) {
            double& m = inverse_[static_cast<std::size_t>(i)];
            m = problem.isFixed(i) ? 0 : 1 / m;
        }
        return;
    }
    const auto place = [&](int i) { return order_.place[static_cast<std::size_t>(i)]; };
    lu_ = BandLu(n, order_.reach);
    const int width = form.width();
    forEachPair(problem.nodes, [&](int i, int j, int a, int b, int e) {
        lu_.add(place(i), place(j), form.elementSize(e) * form.elementMass(e)[a * width + b]);
    });
    for (int i = 0; i < n; ++i) {
        isFixed_.push_back(problem.isFixed(i));
        if (isFixed_.back()) lu_.fix(place(i));
    }
    isSingular_ = !lu_.factorise();
    work_.resize(static_cast<std::size_t>(n));
}

void MassMatrix::solve(double* f) {
    if (!inverse_.empty()) {
        for (std::size_t i = 0; i < inverse_.size(); ++i) f[i] *= inverse_[i];
        return;
    }
    if (isSingular_) {
        std::fill_n(f, work_.size(), std::numeric_limits<double>::quiet_NaN());
        return;
    }
    for (std::size_t i = 0; i < work_.size(); ++i)
        work_[static_cast<std::size_t>(order_.place[i])] = isFixed_[i] ? 0 : f[i];
    lu_.solve(work_.data());
    for (std::size_t i = 0; i < work_.size(); ++i) f[i] = work_[static_cast<std::size_t>(order_.place[i])];
}

}  // namespace extremal
