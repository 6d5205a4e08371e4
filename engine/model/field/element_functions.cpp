// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/field/element_functions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {
namespace {

/// The integral of 1/a over part k of element e, per length, by the Gauss rule of 4 nodes.
double meanResistance(const Mesh& mesh, const MediumCoefficient& a, int parts, int e, int k) {
    static const Rule<double> rule = gauss<double>(4);
    double sum = 0;
    for (std::size_t q = 0; q < rule.c.size(); ++q)
        sum += rule.b[q] / a(mesh.x[static_cast<std::size_t>(e)] + mesh.size(e) * (k + rule.c[q]) / parts);
    return sum;
}

ElementFunctions withCoefficients(const Mesh& mesh, const MediumCoefficient& a, int parts) {
    ElementFunctions f;
    f.parts = parts;
    for (int e = 0; e < mesh.elements(); ++e)
        for (int k = 0; k < parts; ++k) f.coefficient.push_back(1 / meanResistance(mesh, a, parts, e, k));
    return f;
}

/// The wave equation with masses at the nodes of a uniform mesh, by leapfrog.
class ResolvedWave {
public:
    ResolvedWave(const Mesh& coarse, const ElementFunctions& f, double speed)
        : isPeriodic_(coarse.isPeriodic()), isFixed_(coarse.boundary == Boundary::dirichlet) {
        dx_ = coarse.length() / static_cast<double>(f.coefficient.size());
        stiff_ = f.coefficient;
        for (double& s : stiff_) s *= speed * speed / (dx_ * dx_);
        const double most = *std::max_element(stiff_.begin(), stiff_.end());
        step_ = 0.5 / std::sqrt(most);
        const std::size_t n = stiff_.size() + (isPeriodic_ ? 0 : 1);
        for (std::size_t i = 0; i < n; ++i) {
            const double part = static_cast<double>(i) / static_cast<double>(stiff_.size());
            u_.push_back(isPeriodic_ ? std::cos(2 * std::numbers::pi * part)
                         : isFixed_  ? std::sin(std::numbers::pi * part)
                                     : std::cos(std::numbers::pi * part));
        }
        before_ = u_;  // to second order: at rest
        for (std::size_t i = 0; i < n; ++i) before_[i] += step_ * step_ / 2 * force(i);
    }
    double step() const { return step_; }
    /// At the end of fine element i, going around.
    double at(std::size_t i) const { return u_[i % u_.size()]; }
    void advance() {
        const std::size_t last = u_.size() - 1;
        next_.resize(u_.size());
        for (const std::size_t i : {std::size_t{0}, last})
            next_[i] = isHeld(i) ? u_[i] : 2 * u_[i] - before_[i] + step_ * step_ * force(i);
        // Inside, where most of the time goes, the force needs no choices.
        const double square = step_ * step_;
        const double *const u = u_.data(), *const before = before_.data(), *const stiff = stiff_.data();
        double* const next = next_.data();
        for (std::size_t i = 1; i < last; ++i)
            next[i] = 2 * u[i] - before[i] +
                      square * (stiff[i] * (u[i + 1] - u[i]) + stiff[i - 1] * (u[i - 1] - u[i]));
        before_.swap(u_);
        u_.swap(next_);
    }

private:
    bool isHeld(std::size_t i) const { return isFixed_ && (i == 0 || i + 1 == u_.size()); }
    double force(std::size_t i) const {
        const std::size_t n = u_.size(), N = stiff_.size();
        double f = 0, mass = 0;
        if (isPeriodic_ || i < N) {
            f += stiff_[i] * (u_[(i + 1) % n] - u_[i]);
            mass += 0.5;
        }
        if (isPeriodic_ || i > 0) {
            const std::size_t left = (i + N - 1) % N;
            f += stiff_[left] * (u_[(i + n - 1) % n] - u_[i]);
            mass += 0.5;
        }
        return f / mass;
    }

    bool isPeriodic_, isFixed_;
    double dx_ = 0, step_ = 0;
    std::vector<double> stiff_, u_, before_, next_;
};

}  // namespace

double ElementFunctions::value(int e, double xi) const {
    const int k = std::clamp(static_cast<int>(xi * parts), 0, parts - 1);
    const double part = xi * parts - k;
    return (1 - part) * at(e, k) + part * at(e, k + 1);
}

ElementFunctions cellFunctions(const Mesh& mesh, const MediumCoefficient& a, int parts) {
    ElementFunctions f = withCoefficients(mesh, a, parts);
    for (int e = 0; e < mesh.elements(); ++e) {
        const double* coefficient = &f.coefficient[static_cast<std::size_t>(e * parts)];
        double all = 0, sum = 0;
        for (int k = 0; k < parts; ++k) all += 1 / coefficient[k];
        for (int k = 0; k < parts; ++k) {
            f.phi.push_back(sum / all);
            sum += 1 / coefficient[k];
        }
        f.phi.push_back(1);
    }
    return f;
}

ElementFunctions snapshotFunctions(const Mesh& mesh, const MediumCoefficient& a, double speed, int parts) {
    constexpr int snapshots = 32;
    constexpr double mostUpdates = 3e8;
    ElementFunctions f = withCoefficients(mesh, a, parts);
    ResolvedWave wave(mesh, f, speed);
    // For the time in which the slowest wave crosses the domain at most.
    double resistance = 0;
    for (const double c : f.coefficient) resistance += 1 / c / static_cast<double>(f.coefficient.size());
    const double needed = mesh.length() * std::sqrt(resistance) / speed / wave.step();
    const double work = needed * static_cast<double>(f.coefficient.size());
    if (!(needed >= snapshots && work < mostUpdates))
        throw InvalidScene("",
                           "takes its snapshots from a resolved run, which would have " +
                               formatNumber(needed, 3) + " steps of " + std::to_string(f.coefficient.size()) +
                               " parts, the limits are " + std::to_string(snapshots) + " steps and " +
                               formatNumber(mostUpdates) + " parts in all",
                           "fewer elements or parts, or the functions of the cell problem");
    const auto steps = static_cast<long long>(needed);
    const long long every = std::max(1LL, steps / snapshots);
    dense::Matrix<double> correlation = dense::Matrix<double>::Zero(parts, parts);
    Eigen::VectorXd increment(parts);
    for (long long k = 1; k <= every * snapshots; ++k) {
        wave.advance();
        if (k % every != 0) continue;
        for (int e = 0; e < mesh.elements(); ++e) {
            const auto left = static_cast<std::size_t>(e) * static_cast<std::size_t>(parts);
            for (int i = 0; i < parts; ++i)
                increment(i) = wave.at(left + static_cast<std::size_t>(i) + 1) - wave.at(left);
            correlation += increment * increment.transpose();
        }
    }
    if (!correlation.allFinite())
        throw InvalidScene("", "has snapshots that are not finite", "the functions of the cell problem");
    const auto modes = dense::symmetricEigen<double>(correlation);
    const auto leading = modes.vectors.col(parts - 1);
    for (int e = 0; e < mesh.elements(); ++e) {
        f.phi.push_back(0);
        for (int i = 0; i < parts; ++i) f.phi.push_back(leading(i) / leading(parts - 1));
    }
    return f;
}

}  // namespace extremal
