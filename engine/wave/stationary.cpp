#include "engine/wave/stationary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/dense.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/wave/eigen.hpp"
#include "engine/wave/interval.hpp"

namespace extremal {
namespace {

using Matrix = Eigen::MatrixXcd;
using Vector = Eigen::VectorXcd;

}  // namespace

std::vector<StationaryState> lowestStates(const StationaryProblem& problem, int n) {
    const auto [values, vectors] = dense::hermitianEigen<Complex>(problem.H, problem.W);
    std::vector<StationaryState> states;
    for (int k = 0; k < std::min<int>(n, static_cast<int>(problem.H.rows())); ++k)
        states.push_back({values(k), vectors.col(k), {}, true});
    return states;
}

StationaryState refineState(const StationaryProblem& problem, const Vector& guess, double energy) {
    const Eigen::Index n = problem.H.rows();
    StationaryState s{energy, guess, {energy}, false};
    for (int iteration = 0; iteration < 12 && !s.isConverged; ++iteration) {
        const Vector Wv = problem.W * s.v;
        Matrix K = Matrix::Zero(n + 1, n + 1);
        K.topLeftCorner(n, n) = problem.H - s.energy * problem.W;
        K.topRightCorner(n, 1) = -Wv;
        K.bottomLeftCorner(1, n) = -Wv.adjoint();
        Vector rhs(n + 1);
        rhs.head(n) = -(problem.H * s.v - s.energy * Wv);
        rhs(n) = -(1.0 - s.v.dot(Wv).real()) / 2;
        const Vector d = dense::solve<Complex>(K, rhs);
        if (!d.allFinite()) break;
        s.v += d.head(n);
        s.energy += d(n).real();
        s.history.push_back(s.energy);
        s.isConverged = std::abs(d(n).real()) <= 1e-15 * std::max(1.0, std::abs(s.energy));
    }
    return s;
}

StationaryProblem pseudoSpectral(const Hamiltonian& h) {
    const int n = h.size();
    return {nodalMatrix(h).cast<Complex>(), Matrix::Identity(n, n)};
}

StationaryProblem convolutionGalerkin(const Hamiltonian& h) {
    const int n = h.size(), half = n / 2;
    const auto weight = [half](int a) { return std::abs(a) == half ? 0.5 : 1.0; };
    const auto place = [n](int a) { return (a + n) % n; };  // identifies N/2 with -N/2
    StationaryProblem p{Matrix::Zero(n, n), Matrix::Zero(n, n)};
    for (int a = -half; a <= half; ++a) {
        for (int b = std::max(-half, a - half); b <= std::min(half, a + half); ++b)
            p.H(place(a), place(b)) +=
                weight(a) * weight(b) * weight(a - b) * h.potentialHarmonics()[static_cast<std::size_t>(place(a - b))];
        p.H(place(a), place(a)) += weight(a) * weight(a) * h.kinetic()[static_cast<std::size_t>(place(a))];
        p.W(place(a), place(a)) += weight(a) * weight(a);
    }
    return p;
}

Eigen::MatrixXd realMatrix(const StationaryProblem& problem, const Fourier& fourier) {
    const Eigen::Index n = problem.H.rows();
    const Eigen::VectorXd root = problem.W.diagonal().real().cwiseSqrt().cwiseInverse();
    Matrix H = root.asDiagonal() * problem.H * root.asDiagonal();
    // F^{-1} H F, a column at a time; F* is F^{-1}, so the rows of H F are those of the columns of (F^{-1} H*)*.
    for (int pass = 0; pass < 2; ++pass) {
        Vector column(n);
        for (Eigen::Index k = 0; k < n; ++k) {
            fourier.rawToNodes(H.col(k).data(), column.data());
            H.col(k) = column / std::sqrt(static_cast<double>(n));
        }
        H.adjointInPlace();
    }
    return (H.real() + H.real().transpose()) / 2;
}

StationaryProblem chebyshevInterval(int N, const wave::Domain& domain, double hbar, double mass, const wave::Potential& potential) {
    const Rule<double> rule = clenshawCurtis<double>(2 * N + 1);
    const Eigen::VectorXd nodes = chebyshev::extrema(N);
    Eigen::VectorXd points(rule.size()), weights(rule.size()), inPotential(rule.size());
    for (int i = 0; i < rule.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        // The rule's nodes are those of degree 2N: every second is one of ours, to the bit.
        points(i) = std::sin(std::numbers::pi * (i - N) / (2.0 * N));
        weights(i) = rule.b[k] * domain.length;
        inPotential(i) = potential.function.value(domain.left + domain.length * rule.c[k], 0, 0) * weights(i);
    }
    const Eigen::MatrixXd all = chebyshev::cardinals(points, nodes),
                          slope = all * chebyshev::differentiation(nodes) * (2 / domain.length);
    // psi vanishes at both ends: the inner nodes alone.
    const Eigen::MatrixXd phi = all.middleCols(1, N - 1), dphi = slope.middleCols(1, N - 1);
    const Eigen::MatrixXd M = phi.transpose() * weights.asDiagonal() * phi;
    const Eigen::MatrixXd H = hbar * hbar / (2 * mass) * dphi.transpose() * weights.asDiagonal() * dphi +
                              phi.transpose() * inPotential.asDiagonal() * phi;
    StationaryProblem p;
    p.H = ((H + H.transpose()) / 2).cast<std::complex<double>>();
    p.W = ((M + M.transpose()) / 2).cast<std::complex<double>>();
    return p;
}

}  // namespace extremal
