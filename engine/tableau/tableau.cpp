// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/tableau/tableau.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"

namespace extremal {
namespace {

using Matrix = Tableau::Matrix;
using Vector = Tableau::Vector;

Quad largest(const Matrix& m) { return m.size() == 0 ? Quad(0) : Quad(m.cwiseAbs().maxCoeff()); }

Vector rowSums(const Matrix& A) { return A.rowwise().sum(); }

/// Takes what needs nothing that is still to come, until nothing is left; empty where that never is.
std::optional<std::vector<std::pair<bool, Eigen::Index>>> explicitOrder(const Tableau& t) {
    std::vector<std::pair<bool, Eigen::Index>> order;
    std::vector<bool> hasV(static_cast<std::size_t>(t.velocities())),
        hasF(static_cast<std::size_t>(t.forces()));
    const auto take = [&](bool isOfV, const Matrix& of, std::vector<bool>& own,
                          const std::vector<bool>& other) {
        for (Eigen::Index i = 0; i < of.rows(); ++i) {
            bool isReady = !own[static_cast<std::size_t>(i)];
            for (Eigen::Index j = 0; j < of.cols(); ++j)
                isReady = isReady && (abs(of(i, j)) <= t.known || other[static_cast<std::size_t>(j)]);
            if (!isReady) continue;
            own[static_cast<std::size_t>(i)] = true;
            order.emplace_back(isOfV, i);
        }
    };
    const auto total = static_cast<std::size_t>(t.velocities() + t.forces());
    while (order.size() < total) {
        const std::size_t before = order.size();
        take(false, t.A, hasF, hasV);
        take(true, t.Ahat, hasV, hasF);
        if (order.size() == before) return {};
    }
    return order;
}

}  // namespace

bool Tableau::isPlain() const {
    return velocities() == forces() && scope == TableauScope::any && largest(A - Ahat) <= known &&
           largest(b - bHat) <= known;
}

bool Tableau::isExplicit() const {
    // Of a method for every Hamiltonian, stage i needs Q_i and P_i together.
    if (scope != TableauScope::any) return explicitOrder(*this).has_value();
    for (int i = 0; i < velocities(); ++i)
        for (int j = i; j < velocities(); ++j)
            if (abs(A(i, j)) > known || abs(Ahat(i, j)) > known) return false;
    return true;
}

std::vector<std::pair<bool, Eigen::Index>> stageOrder(const Tableau& t) {
    if (const auto order = explicitOrder(t)) return *order;
    std::vector<std::pair<bool, Eigen::Index>> all;
    for (Eigen::Index i = 0; i < t.forces(); ++i) all.emplace_back(false, i);
    for (Eigen::Index j = 0; j < t.velocities(); ++j) all.emplace_back(true, j);
    return all;
}

Tableau plainTableau(const Matrix& A, const Vector& b, Vector c) {
    Tableau t;
    t.A = t.Ahat = A;
    t.b = t.bHat = b;
    t.c = t.cHat = c.size() > 0 ? std::move(c) : rowSums(A);
    return t;
}

Tableau partitionedTableau(const Matrix& A, const Matrix& Ahat, const Vector& b, const Vector& bHat,
                           TableauScope scope) {
    Tableau t;
    t.A = A;
    t.Ahat = Ahat;
    t.b = b;
    t.bHat = bHat;
    t.cHat = rowSums(A);
    t.c = rowSums(Ahat);
    t.scope = scope;
    return t;
}

Tableau splittingTableau(const std::vector<TableauFlow>& given) {
    Tableau t;
    std::vector<TableauFlow> flows;
    for (const TableauFlow& flow : given)
        if (!flows.empty() && flows.back().isKick == flow.isKick)
            flows.back().fraction += flow.fraction;
        else
            flows.push_back(flow);
    const auto kicks = std::count_if(flows.begin(), flows.end(), [](const auto& f) { return f.isKick; });
    const auto drifts = static_cast<Eigen::Index>(flows.size()) - kicks;
    t.A = Matrix::Zero(kicks, drifts);
    t.Ahat = Matrix::Zero(drifts, kicks);
    t.b = Vector::Zero(drifts);
    t.bHat = Vector::Zero(kicks);
    Eigen::Index kick = 0, drift = 0;
    for (const TableauFlow& flow : flows) {
        if (flow.isKick) {
            t.A.row(kick).head(drift) = t.b.head(drift).transpose();
            t.bHat(kick++) = flow.fraction;
        } else {
            t.Ahat.row(drift).head(kick) = t.bHat.head(kick).transpose();
            t.b(drift++) = flow.fraction;
        }
    }
    t.cHat = rowSums(t.A);
    t.c = rowSums(t.Ahat);
    t.scope = TableauScope::separable;
    return t;
}

Tableau galerkinTableau(const Table<Quad>& table) {
    const Eigen::Index n = table.nodes(), m = table.unknowns();
    const Matrix D = table.derivative, Phi = table.value;
    const Vector b = table.weight;
    const Matrix WD = b.asDiagonal() * D;
    const Matrix K = dense::product<Quad>(D.transpose(), WD);
    const dense::Lu<Quad> lu(K);
    const Quad ratio = lu.pivotRatio();
    Tableau t;
    t.b = t.bHat = b;
    t.c = t.cHat = table.node;
    Vector speed;
    if (ratio > 1e-12) {
        t.A = dense::product<Quad>(Phi, lu.solve(WD.transpose()));
        const Matrix back = lu.solve(Phi.transpose() * b.asDiagonal());
        t.Ahat = Vector::Ones(n) * b.transpose() - dense::product<Quad>(D, back);
        Vector last = Vector::Zero(m);
        last(m - 1) = 1;
        speed = dense::product<Quad>(D, lu.solve(last));
    }
    if (!(ratio > 1e-12) || largest(speed - Vector::Ones(n)) > 1e-26)
        throw InvalidScene(
            "/quadrature",
            "does not integrate the slopes of the space exactly, so that the step is not a Runge-Kutta "
            "method",
            "a rule with more nodes");
    t.scope = n == m ? TableauScope::any : TableauScope::quadraticKinetic;
    return t;
}

Tableau composed(const Tableau& of, const std::vector<Quad>& parts) {
    const Eigen::Index n = of.velocities(), m = of.forces(), k = static_cast<Eigen::Index>(parts.size());
    Tableau t;
    t.scope = of.scope;
    t.known = of.known;
    t.A = Matrix::Zero(k * m, k * n);
    t.Ahat = Matrix::Zero(k * n, k * m);
    t.b = t.c = Vector::Zero(k * n);
    t.bHat = t.cHat = Vector::Zero(k * m);
    Quad before(0);
    for (Eigen::Index p = 0; p < k; ++p) {
        const Quad g = parts[static_cast<std::size_t>(p)];
        for (Eigen::Index i = 0; i < m; ++i) t.A.row(p * m + i).head(p * n) = t.b.head(p * n).transpose();
        for (Eigen::Index j = 0; j < n; ++j)
            t.Ahat.row(p * n + j).head(p * m) = t.bHat.head(p * m).transpose();
        t.A.block(p * m, p * n, m, n) = g * of.A;
        t.Ahat.block(p * n, p * m, n, m) = g * of.Ahat;
        t.b.segment(p * n, n) = g * of.b;
        t.bHat.segment(p * m, m) = g * of.bHat;
        t.c.segment(p * n, n) = Vector::Constant(n, before) + g * of.c;
        t.cHat.segment(p * m, m) = Vector::Constant(m, before) + g * of.cHat;
        before += g;
    }
    return t;
}

Quad symplecticityDefect(const Tableau& t) {
    const Matrix BA = t.bHat.asDiagonal() * t.A, BAhat = t.b.asDiagonal() * t.Ahat;
    const Quad defect = largest(BA + BAhat.transpose() - t.bHat * t.b.transpose());
    return t.scope == TableauScope::any ? std::max(defect, largest(t.b - t.bHat)) : defect;
}

Quad symmetryDefect(const Tableau& t) {
    const auto order = [](const Vector& times, bool isSorted) {
        std::vector<Eigen::Index> places(static_cast<std::size_t>(times.size()));
        std::iota(places.begin(), places.end(), 0);
        if (isSorted)
            std::stable_sort(places.begin(), places.end(),
                             [&](Eigen::Index i, Eigen::Index j) { return times(i) < times(j); });
        return places;
    };
    Quad best(0);
    for (const bool isSorted : {false, true}) {
        const auto V = order(t.c, isSorted), F = order(t.cHat, isSorted);
        const std::size_t n = V.size(), m = F.size();
        Quad worst(0);
        const auto see = [&](const Quad& x) { worst = std::max(worst, Quad(abs(x))); };
        for (std::size_t i = 0; i < m; ++i)
            for (std::size_t j = 0; j < n; ++j) {
                const Eigen::Index f = F[i], v = V[j], f2 = F[m - 1 - i], v2 = V[n - 1 - j];
                see(t.A(f, v) + t.A(f2, v2) - t.b(v));
                see(t.Ahat(v, f) + t.Ahat(v2, f2) - t.bHat(f));
                see(t.b(v) - t.b(v2));
                see(t.bHat(f) - t.bHat(f2));
            }
        best = isSorted ? std::min(best, worst) : worst;
    }
    return best;
}

SimplifyingAssumptions simplifyingAssumptions(const Tableau& t) {
    SimplifyingAssumptions found;
    const auto powers = [](const Vector& c, int m) {
        Vector p = Vector::Ones(c.size());
        for (int k = 0; k < m; ++k) p.array() *= c.array();
        return p;
    };
    const double enough = 1e3 * t.known;
    const int most = 2 * std::max(t.velocities(), t.forces()) + 1;
    const auto highest = [&](auto&& defect) {
        int k = 0;
        while (k < most && defect(k + 1) <= enough) ++k;
        return k;
    };
    found.B = highest([&](int m) {
        return std::max(Quad(abs(t.b.dot(powers(t.c, m - 1)) - Quad(1) / m)),
                        Quad(abs(t.bHat.dot(powers(t.cHat, m - 1)) - Quad(1) / m)));
    });
    found.C = highest([&](int m) { return largest(t.A * powers(t.c, m - 1) - powers(t.cHat, m) / Quad(m)); });
    found.D = highest([&](int m) {
        const Vector weighted = t.b.cwiseProduct(powers(t.c, m - 1));
        return largest(t.Ahat.transpose() * weighted -
                       t.bHat.cwiseProduct(Vector::Ones(t.forces()) - powers(t.cHat, m)) / Quad(m));
    });
    return found;
}

}  // namespace extremal
