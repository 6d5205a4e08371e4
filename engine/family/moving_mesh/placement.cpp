// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/moving_mesh/placement.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "engine/family/moving_mesh/constraint.hpp"
#include "engine/family/moving_mesh/dyadic_mesh.hpp"
#include "engine/solve/band_lu.hpp"

namespace extremal {
namespace {

constexpr int tableCells = 20000;

void setNodes(const FieldProfile& profile, double t, const std::vector<double>& X, std::vector<double>& z) {
    double u_t;
    for (std::size_t i = 0; i < X.size(); ++i) {
        profile.at(X[i], t, &z[2 * i], &u_t);
        z[2 * i + 1] = X[i];
    }
}

/// u_x at the nodes, by differences over a small part of the shorter neighbour.
double slopeAt(const FieldProfile& profile, double t, double x, double d) {
    double left, right, u_t;
    profile.at(x - d, t, &left, &u_t);
    profile.at(x + d, t, &right, &u_t);
    return (right - left) / (2 * d);
}

/// The matrix of d/dX g(u(X), X), not factorised; slopes: u_x at the nodes.
BandLu alongProfile(const MeshConstraint& constraint, const FieldProfile& profile, double t,
                    const std::vector<double>& X, const std::vector<MeshConstraint::Row>& Dg,
                    std::vector<double>& slopes) {
    const std::size_t n = X.size(), width = constraint.width(), most = MeshConstraint::mostWidth;
    slopes.assign(n, 0);
    for (std::size_t i = 1; i + 1 < n; ++i)
        slopes[i] = slopeAt(profile, t, X[i], 1e-5 * std::min(X[i + 1] - X[i], X[i] - X[i - 1]));
    BandLu lu(static_cast<int>(n), static_cast<int>(width));
    lu.clear();
    for (std::size_t i = 1; i + 1 < n; ++i)
        for (std::size_t k = most - width; k <= most + width; ++k)
            if (i + k > most && i + k - most + 1 < n) {
                const std::size_t j = i + k - most;
                lu.add(static_cast<int>(i), static_cast<int>(j), Dg[i][2 * k] * slopes[j] + Dg[i][2 * k + 1]);
            }
    lu.fix(0);
    lu.fix(static_cast<int>(n) - 1);
    return lu;
}

/// That of an element's length, relative to it: shares cannot be equal to less.
double roundOffOf(const std::vector<double>& X) {
    double smallest = X.back() - X.front();
    for (std::size_t e = 0; e + 1 < X.size(); ++e) smallest = std::min(smallest, X[e + 1] - X[e]);
    return std::numeric_limits<double>::epsilon() * std::max(std::abs(X.front()), std::abs(X.back())) /
           smallest;
}

/// Newton's method for g(u(X), X) = 0 in X. False: it does not get there.
bool improve(const NodeSpace& space, const Monitor& monitor, const FieldProfile& profile, double t,
             std::vector<double>& X) {
    const std::size_t n = space.n;
    MeshConstraint constraint(monitor, n);
    std::vector<double> z(2 * n), g(n), slopes;
    std::vector<MeshConstraint::Row> Dg(n);
    setNodes(profile, t, X, z);
    double residual = constraint.residual(z.data());
    for (int iteration = 0; iteration < 50; ++iteration) {
        if (residual < 1e-14) return true;
        constraint.evaluate(z.data(), g, Dg);
        BandLu lu = alongProfile(constraint, profile, t, X, Dg, slopes);
        if (!lu.factorise()) return false;
        lu.solve(g.data());
        const std::vector<double> before = X;
        double next = residual;
        for (double part = 1; part > 1e-3; part /= 2) {
            for (std::size_t i = 1; i + 1 < n; ++i) X[i] = before[i] - part * g[i];
            if (!std::is_sorted(X.begin(), X.end(), std::less_equal<>())) continue;
            setNodes(profile, t, X, z);
            next = constraint.residual(z.data());
            if (next < residual) break;
        }
        if (!(next < residual)) {  // round-off, or no way down
            X = before;
            return residual < std::max(1e-11, 16 * roundOffOf(X));
        }
        residual = next;
    }
    return false;
}

std::vector<double> densityOf(const Monitor& monitor, const ProfileTable& table) {
    std::vector<double> u_xx, M;
    curvatures(table.x.data(), table.u.data(), table.x.size(), u_xx);
    for (std::size_t e = 0; e + 1 < table.x.size(); ++e)
        M.push_back(monitor((table.u[e + 1] - table.u[e]) / (table.x[e + 1] - table.x[e]),
                            (u_xx[e] + u_xx[e + 1]) / 2, (table.u_t[e] + table.u_t[e + 1]) / 2, 0));
    return M;
}

std::vector<double> placeNodes(const NodeSpace& space, const Monitor& monitor, const ProfileTable& table) {
    std::vector<double> X(space.n);
    equidistribute(table.x, densityOf(monitor, table), X);
    return X;
}

/// Places that the explicit step (explicit_step.hpp) would leave as they are: X equidistributes the smoothed
/// monitor of its own elements, with u_t of the profile in their middles. From any other mesh the first steps
/// would carry the nodes away from the front and back, and their speed spoils the solution: a kink and an
/// antikink on 31 nodes end with an error of 0.7 in place of 0.5, a steep front of 63 with 0.017 in place of
/// 0.012.
std::vector<double> placeFollowingNodes(const NodeSpace& space, const Monitor& monitor,
                                        const FieldProfile& profile, const ProfileTable& table, double t) {
    constexpr double tolerance = 1e-12, mostWork = 2e6;
    const std::size_t n = space.n;
    const int most = std::clamp(static_cast<int>(mostWork / static_cast<double>(n)), 1, 100);
    std::vector<double> X = placeNodes(space, monitor, table), y(n), M(n - 1), next(n), u_xx;
    for (int iteration = 0; iteration < most; ++iteration) {
        double u, u_t;
        for (std::size_t i = 0; i < n; ++i) profile.at(X[i], t, &y[i], &u_t);
        curvatures(X.data(), y.data(), n, u_xx);
        for (std::size_t e = 0; e + 1 < n; ++e) {
            profile.at((X[e] + X[e + 1]) / 2, t, &u, &u_t);
            M[e] = monitor((y[e + 1] - y[e]) / (X[e + 1] - X[e]), (u_xx[e] + u_xx[e + 1]) / 2, u_t, 0);
        }
        smoothDensity(M);
        equidistribute(X, M, next);
        double farthest = 0;
        for (std::size_t i = 0; i < n; ++i) farthest = std::max(farthest, std::abs(next[i] - X[i]));
        X.swap(next);
        if (!(farthest > tolerance * space.problem->mesh.length())) break;
    }
    return X;
}

/// Of nodes at X that move with `rates` along a profile of these slopes.
std::vector<double> stateAt(const NodeSpace& space, const FieldProfile& profile, double t,
                            const std::vector<double>& X, const std::vector<double>& slopes,
                            const std::vector<double>& rates) {
    const std::size_t n = space.n;
    std::vector<double> x(4 * n);
    for (std::size_t i = 0; i < n; ++i) {
        profile.at(X[i], t, &x[i], &x[n + i]);
        x[n + i] = space.holdsValue(i) ? 0 : x[n + i] + slopes[i] * rates[i];
        x[2 * n + i] = X[i];
        x[3 * n + i] = rates[i];
    }
    return x;
}

}  // namespace

ProfileTable::ProfileTable(const FieldProfile& profile, const Mesh& mesh, double t)
    : x(tableCells + 1), u(x.size()), u_t(x.size()) {
    for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = mesh.left() + mesh.length() * static_cast<double>(i) / tableCells;
        profile.at(x[i], t, &u[i], &u_t[i]);
    }
}

double heldVariation(const ProfileTable& table) {
    double all = 0;
    for (std::size_t i = 0; i + 1 < table.u.size(); ++i) all += std::abs(table.u[i + 1] - table.u[i]);
    return all > 0 ? std::abs(table.u.back() - table.u.front()) / all : 0;
}

std::vector<double> startAtRest(const NodeSpace& space, const Monitor& monitor, const FieldProfile& profile,
                                const ProfileTable& table, double t) {
    const std::vector<double> X = placeFollowingNodes(space, monitor, profile, table, t);
    return stateAt(space, profile, t, X, std::vector<double>(space.n, 0), std::vector<double>(space.n, 0));
}

std::vector<double> startOnDyadicMesh(const NodeSpace& space, const Monitor& monitor,
                                      const FieldProfile& profile, const ProfileTable& table, double t) {
    const Mesh& whole = space.problem->mesh;
    std::vector<double> X;
    DyadicMesh(whole.left(), whole.length(), space.elements()).choose(table.x, densityOf(monitor, table), X);
    return stateAt(space, profile, t, X, std::vector<double>(space.n, 0), std::vector<double>(space.n, 0));
}

std::vector<double> startOnConstraint(const NodeSpace& space, const Monitor& monitor,
                                      const FieldProfile& profile, const ProfileTable& table, double t) {
    Monitor inPlace = monitor;
    inPlace.beta = 0;  // the constraint knows u alone
    const std::size_t n = space.n;
    const std::vector<double> first = placeNodes(space, inPlace, table);
    std::vector<double> X = first, z(2 * n), g(n), slopes, rates(n, 0);
    if (!improve(space, monitor, profile, t, X)) X = first;
    setNodes(profile, t, X, z);
    MeshConstraint constraint(monitor, n);
    std::vector<MeshConstraint::Row> Dg(n);
    constraint.evaluate(z.data(), g, Dg);
    BandLu lu = alongProfile(constraint, profile, t, X, Dg, slopes);
    const std::size_t width = constraint.width(), most = MeshConstraint::mostWidth;
    for (std::size_t i = 1; i + 1 < n; ++i)
        for (std::size_t k = most - width; k <= most + width; ++k)
            if (i + k >= most && i + k - most < n && !space.holdsValue(i + k - most)) {
                double u, u_t;
                profile.at(X[i + k - most], t, &u, &u_t);
                rates[i] -= Dg[i][2 * k] * u_t;
            }
    if (lu.factorise())
        lu.solve(rates.data());
    else
        rates.assign(n, 0);
    return stateAt(space, profile, t, X, slopes, rates);
}

}  // namespace extremal
