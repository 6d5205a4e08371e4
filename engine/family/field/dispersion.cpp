// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/field/dispersion.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>

#include "engine/core/algebra/dense.hpp"
#include "engine/integrator/oscillator_step.hpp"

namespace extremal {

namespace {

/// The eigenvalues of K over M, ascending; nothing where a function has no mass.
std::optional<Eigen::VectorXd> relativeEigenvalues(const dense::Matrix<double>& K,
                                                   const dense::Matrix<double>& M) {
    const auto parts = dense::symmetricEigen<double>(M);
    if (parts.values(0) < 1e-13 * parts.values(M.rows() - 1)) return {};
    const dense::Matrix<double> scale = parts.vectors * parts.values.cwiseSqrt().cwiseInverse().asDiagonal();
    return dense::symmetricEigen<double>(scale.transpose() * K * scale).values;
}

}  // namespace

double spatialEigenvalue(int degree, const Rule<double>& rule, double kdx) {
    using Matrix = dense::Matrix<double>;
    const int r = degree, n = r + 1;
    const ElementMatrices element = elementMatrices(degree, rule);
    // Bloch waves: the last node is exp(i kdx) times the first. A Hermitian problem of r unknowns as a real
    // symmetric one of 2 r, each eigenvalue twice.
    const std::complex<double> turn = std::polar(1.0, kdx);
    const auto reduced = [&](const Matrix& A) {
        dense::Matrix<std::complex<double>> B = dense::Matrix<std::complex<double>>::Zero(r, r);
        for (int a = 0; a < n; ++a)
            for (int b = 0; b < n; ++b) {
                const std::complex<double> left = a == r ? std::conj(turn) : 1.0, right = b == r ? turn : 1.0;
                B(a % r, b % r) += left * A(a, b) * right;
            }
        Matrix real(2 * r, 2 * r);
        real << B.real(), -B.imag(), B.imag(), B.real();
        return real;
    };
    const auto values = relativeEigenvalues(reduced(element.stiffness), reduced(element.mass));
    if (!values) return std::numeric_limits<double>::infinity();
    // Branch b of the mesh belongs to wave numbers from b pi to (b + 1) pi.
    const int branch = std::clamp(static_cast<int>(kdx / std::numbers::pi), 0, r - 1);
    return (*values)(2 * branch);
}

double largestSpatialEigenvalue(int degree, const Rule<double>& rule) {
    const ElementMatrices element = elementMatrices(degree, rule);
    const auto values = relativeEigenvalues(element.stiffness, element.mass);
    return values ? (*values)(degree) : std::numeric_limits<double>::infinity();
}

double halfTrace(const TimeTable& time, double z) {
    const int s = time.degree();
    // S = sum_lm A_lm U_l U_m / 2 with h = 1; p = -dS/dU_0, p' = dS/dU_s.
    dense::Matrix<double> A = dense::Matrix<double>::Zero(s + 1, s + 1);
    for (int l = 0; l <= s; ++l)
        for (int m = 0; m <= s; ++m) {
            A(l, m) = time.mass(l, m);
            for (int q = 0; q < time.points(); ++q)
                A(l, m) -= z * z * time.weight(q) * time.value(q, l) * time.value(q, m);
        }
    dense::Matrix<double> rhs = dense::Matrix<double>::Zero(s, 2);
    rhs.col(0) = -A.block(0, 0, s, 1);
    rhs(0, 1) = -1;
    const dense::Matrix<double> U = dense::solve<double>(A.block(0, 1, s, s), rhs);
    const double q = U(s - 1, 0);
    const double p = A.block(s, 1, 1, s).row(0).dot(U.col(1));
    return (q + p) / 2;
}

std::vector<UnstableInterval> timeIntervals(const TimeTable& time) {
    const int n = time.degree() + 1;
    OscillatorAction action{Eigen::MatrixXd(n, n), Eigen::MatrixXd::Zero(n, n)};
    for (int l = 0; l < n; ++l)
        for (int m = 0; m < n; ++m) {
            action.stiffness(l, m) = time.mass(l, m);
            for (int q = 0; q < time.points(); ++q)
                action.mass(l, m) += time.weight(q) * time.value(q, l) * time.value(q, m);
        }
    // The functions of the levels sum to 1: those inside are added to the first.
    Eigen::MatrixXd change = Eigen::MatrixXd::Identity(n, n);
    change.col(0).segment(1, n - 2).setOnes();
    action.stiffness = (change.transpose() * action.stiffness * change).eval();
    action.mass = (change.transpose() * action.mass * change).eval();
    return OscillatorStep(action).intervals();
}

double timeLimit(const TimeTable& time, double steps) {
    for (const UnstableInterval& interval : timeIntervals(time))
        if (interval.growth * steps > 1) return interval.low;
    return std::numeric_limits<double>::infinity();
}

/// Of the branches of arccos the one nearest to the field equation.
DispersionCurve dispersionCurve(const FieldProblem& problem, const Rule<double>& rule, const TimeTable& time,
                                double step) {
    const int r = problem.nodes.degree;
    const double dx = problem.mesh.length() / problem.mesh.elements(), k = problem.elastic.k,
                 turn = 2 * std::acos(-1.0);
    const double curvature = problem.potential.isLinear() ? problem.potential.largestCurvature(0, 0) : 0;
    constexpr int points = 300;
    DispersionCurve curve;
    for (int i = 1; i <= points; ++i) {
        const double kdx = r * turn / 2 * i / points * (1 - 1e-12), K = kdx / dx;
        const double exact = std::sqrt(k * K * K + curvature), wanted = step * exact;
        const double z = step * std::sqrt(k * spatialEigenvalue(r, rule, kdx) / (dx * dx) + curvature);
        const double half = std::isfinite(z) ? halfTrace(time, z) : std::nan("");
        double best = std::nan("");
        if (std::abs(half) <= 1 + 1e-12) {
            const double angle = std::acos(std::clamp(half, -1.0, 1.0)),
                         turns = turn * std::round(wanted / turn);
            for (const double candidate : {turns + angle, turns - angle})
                if (!(std::abs(candidate - wanted) >= std::abs(best - wanted))) best = candidate;
        }
        curve.waveNumber.push_back(K);
        curve.frequency.push_back(best / step);
        curve.exact.push_back(exact);
    }
    return curve;
}

}  // namespace extremal
