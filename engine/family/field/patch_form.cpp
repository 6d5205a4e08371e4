// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/field/patch_form.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace extremal {

PatchForm::PatchForm(std::shared_ptr<const FieldProblem> problem, int timeDegree, const Rule<double>& space,
                     const Rule<double>& time, double h, int first, int last, unsigned seed)
    : problem_(std::move(problem)),
      cell_(*problem_, timeDegree, space, time),
      order_(problem_->nodes),
      h_(h),
      first_(first),
      last_(last) {
    const auto n = static_cast<std::size_t>(problem_->size()), m = static_cast<std::size_t>(cell_.unknowns());
    levels_.resize(n * static_cast<std::size_t>(timeDegree + 1));
    hessians_.resize(m * m * static_cast<std::size_t>(problem_->mesh.elements()));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (Tangent* tangent : {&V_, &W_}) {
        tangent->levels.resize(levels_.size());
        for (std::size_t i = 0; i < n; ++i) {
            const bool isFixed = problem_->isFixed(static_cast<int>(i));
            const double u = uniform(random), p = uniform(random) * problem_->nodes.weight[i];
            tangent->u.push_back(isFixed ? 0 : u);
            tangent->p.push_back(isFixed ? 0 : p);
        }
    }
}

/// Inner levels make the action of the slab stationary between its ends.
void PatchForm::findLevels(const double* u0, const double* u1) {
    const FieldNodes& nodes = problem_->nodes;
    const int s = cell_.timeDegree(), width = nodes.degree + 1, inner = s - 1;
    const auto n = static_cast<std::size_t>(nodes.size());
    const LobattoBasis basis(s);
    for (int l = 0; l <= s; ++l) {
        const double tau = basis.reference[static_cast<std::size_t>(l)];
        for (std::size_t i = 0; i < n; ++i)
            levels_[static_cast<std::size_t>(l) * n + i] = l == s ? u1[i] : (1 - tau) * u0[i] + tau * u1[i];
    }
    const auto m = static_cast<std::size_t>(cell_.unknowns());
    std::vector<double> z(m), gradient(m), hessian(m * m), rhs;
    double last = 1;
    for (int iteration = 0; iteration < 30 && inner > 0; ++iteration) {
        BandLu lu(nodes.size() * inner, order_.reach * inner + inner - 1);
        rhs.assign(n * static_cast<std::size_t>(inner), 0);
        const auto row = [&](int node, int l) {
            return order_.place[static_cast<std::size_t>(node)] * inner + l - 1;
        };
        for (int e = 0; e < nodes.elements; ++e) {
            for (int l = 0; l <= s; ++l)
                for (int a = 0; a < width; ++a)
                    z[static_cast<std::size_t>(cell_.unknown(a, l))] =
                        levels_[static_cast<std::size_t>(l) * n + static_cast<std::size_t>(nodes.node(e, a))];
            (void)cell_.evaluate(e, h_, z.data(), gradient.data(), hessian.data());
            for (int l = 1; l < s; ++l)
                for (int a = 0; a < width; ++a) {
                    const auto k = static_cast<std::size_t>(cell_.unknown(a, l));
                    const int i = row(nodes.node(e, a), l);
                    rhs[static_cast<std::size_t>(i)] -= gradient[k];
                    for (int j = 1; j < s; ++j)
                        for (int b = 0; b < width; ++b)
                            lu.add(i, row(nodes.node(e, b), j),
                                   hessian[k * m + static_cast<std::size_t>(cell_.unknown(b, j))]);
                }
        }
        for (int i = 0; i < nodes.size(); ++i)
            for (int l = 1; l < s && problem_->isFixed(i); ++l) {
                lu.fix(row(i, l));
                rhs[static_cast<std::size_t>(row(i, l))] = 0;
            }
        if (!lu.factorise()) return;
        lu.solve(rhs.data());
        double size = 0;
        for (int l = 1; l < s; ++l)
            for (int i = 0; i < nodes.size(); ++i) {
                const double delta = rhs[static_cast<std::size_t>(row(i, l))];
                levels_[static_cast<std::size_t>(l) * n + static_cast<std::size_t>(i)] += delta;
                size = std::max(size, std::abs(delta));
            }
        if (size < 1e-15 || (size < 1e-12 && size > last / 4)) break;
        last = size;
    }
}

void PatchForm::makeHessians() {
    const FieldNodes& nodes = problem_->nodes;
    const auto n = static_cast<std::size_t>(nodes.size()), m = static_cast<std::size_t>(cell_.unknowns());
    std::vector<double> z(m);
    for (int e = 0; e < nodes.elements; ++e) {
        for (int l = 0; l <= cell_.timeDegree(); ++l)
            for (int a = 0; a <= nodes.degree; ++a)
                z[static_cast<std::size_t>(cell_.unknown(a, l))] =
                    levels_[static_cast<std::size_t>(l) * n + static_cast<std::size_t>(nodes.node(e, a))];
        (void)cell_.evaluate(e, h_, z.data(), nullptr, &hessians_[static_cast<std::size_t>(e) * m * m]);
    }
}

/// sum_m H_lm V_m = -[l = 0] p for the levels l < s; then p at the end is sum_m H_sm V_m.
void PatchForm::solve(Tangent& tangent) {
    const FieldNodes& nodes = problem_->nodes;
    const int s = cell_.timeDegree(), width = nodes.degree + 1;
    const auto n = static_cast<std::size_t>(nodes.size()), m = static_cast<std::size_t>(cell_.unknowns());
    BandLu lu(nodes.size() * s, order_.reach * s + s - 1);
    std::vector<double> rhs(n * static_cast<std::size_t>(s), 0);
    const auto row = [&](int node, int l) { return order_.place[static_cast<std::size_t>(node)] * s + l; };
    const auto entry = [&](int e, int a, int l, int b, int j) {
        return hessians_[(static_cast<std::size_t>(e) * m + static_cast<std::size_t>(cell_.unknown(a, l))) *
                             m +
                         static_cast<std::size_t>(cell_.unknown(b, j))];
    };
    forEachPair(nodes, [&](int i, int k, int a, int b, int e) {
        for (int l = 0; l < s; ++l) {
            for (int j = 1; j <= s; ++j) lu.add(row(i, l), row(k, j - 1), entry(e, a, l, b, j));
            rhs[static_cast<std::size_t>(row(i, l))] -=
                entry(e, a, l, b, 0) * tangent.u[static_cast<std::size_t>(k)];
        }
    });
    for (int i = 0; i < nodes.size(); ++i) {
        rhs[static_cast<std::size_t>(row(i, 0))] -= tangent.p[static_cast<std::size_t>(i)];
        for (int l = 0; l < s && problem_->isFixed(i); ++l) {
            lu.fix(row(i, l));
            rhs[static_cast<std::size_t>(row(i, l))] = 0;
        }
    }
    if (!lu.factorise()) return;
    lu.solve(rhs.data());
    std::copy(tangent.u.begin(), tangent.u.end(), tangent.levels.begin());
    for (int l = 1; l <= s; ++l)
        for (int i = 0; i < nodes.size(); ++i)
            tangent.levels[static_cast<std::size_t>(l) * n + static_cast<std::size_t>(i)] =
                rhs[static_cast<std::size_t>(row(i, l - 1))];
    std::fill(tangent.p.begin(), tangent.p.end(), 0.0);
    for (int e = 0; e < nodes.elements; ++e)
        for (int a = 0; a < width; ++a)
            for (int j = 0; j <= s; ++j)
                for (int b = 0; b < width; ++b)
                    tangent.p[static_cast<std::size_t>(nodes.node(e, a))] +=
                        entry(e, a, s, b, j) * tangent.levels[static_cast<std::size_t>(j) * n +
                                                              static_cast<std::size_t>(nodes.node(e, b))];
    std::copy_n(tangent.levels.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(s) * n), n,
                tangent.u.begin());
    for (int i = 0; i < nodes.size(); ++i)
        if (problem_->isFixed(i)) tangent.p[static_cast<std::size_t>(i)] = 0;
}

/// Omega of cell e at its node (a, l).
void PatchForm::add(Sum& to, int e, int a, int l) const {
    const FieldNodes& nodes = problem_->nodes;
    const auto n = static_cast<std::size_t>(nodes.size()), m = static_cast<std::size_t>(cell_.unknowns());
    const double* H = &hessians_[static_cast<std::size_t>(e) * m * m];
    const auto at = [&](const Tangent& tangent, int b, int j) {
        return tangent.levels[static_cast<std::size_t>(j) * n + static_cast<std::size_t>(nodes.node(e, b))];
    };
    for (int j = 0; j <= cell_.timeDegree(); ++j)
        for (int b = 0; b <= nodes.degree; ++b) {
            const double h = H[static_cast<std::size_t>(cell_.unknown(a, l)) * m +
                               static_cast<std::size_t>(cell_.unknown(b, j))],
                         one = h * at(V_, b, j) * at(W_, a, l), two = h * at(W_, b, j) * at(V_, a, l);
            to.sum += one - two;
            to.magnitude += std::abs(one) + std::abs(two);
        }
}

void PatchForm::advance(const double* u0, const double* u1) {
    findLevels(u0, u1);
    makeHessians();
    solve(V_);
    solve(W_);
    const int s = cell_.timeDegree(), r = problem_->nodes.degree;
    if (!hasStarted_)
        for (int e = first_; e < last_; ++e)
            for (int a = e == first_ ? 1 : 0; a <= (e == last_ - 1 ? r - 1 : r); ++a) add(fixed_, e, a, 0);
    hasStarted_ = true;
    for (int l = 0; l <= s; ++l) {
        add(fixed_, first_, 0, l);
        add(fixed_, last_ - 1, r, l);
    }
    top_ = {};
    for (int e = first_; e < last_; ++e)
        for (int a = e == first_ ? 1 : 0; a <= (e == last_ - 1 ? r - 1 : r); ++a) add(top_, e, a, s);
}

PatchForm::Sum PatchForm::boundary() const {
    return {fixed_.sum + top_.sum, fixed_.magnitude + top_.magnitude};
}

}  // namespace extremal
