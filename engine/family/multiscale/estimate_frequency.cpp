// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <limits>
#include <vector>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/family/multiscale/oscillatory.hpp"
#include "engine/family/parts/references.hpp"

namespace extremal {
namespace {

constexpr int periods = 6, stepsPerPeriod = 4, samplesPerStep = 10;

/// The coordinate whose own oscillation, the others held, is fastest.
int fastestCoordinate(const System& system, const State& start) {
    const int d = system.dimension();
    const auto& m = system.mechanics();
    const double* q = start.x.data();
    std::vector<double> v(static_cast<std::size_t>(d)), gradient(static_cast<std::size_t>(2 * d));
    std::vector<double> H(static_cast<std::size_t>(4 * d * d));
    double value = 0;
    if (!m.velocity(m.model.get(), start.t, q, q + d, v.data())) return 0;
    m.jet(m.model.get(), start.t, q, v.data(), &value, gradient.data(), H.data());
    int best = 0;
    double largest = -std::numeric_limits<double>::infinity();
    for (int k = 0; k < d; ++k) {
        const auto entry = [&](int i) { return H[static_cast<std::size_t>(i * 2 * d + i)]; };
        const double square = -entry(k) / entry(d + k);
        if (square > largest) {
            largest = square;
            best = k;
        }
    }
    return best;
}

/// What is left of the samples after the fit at a frequency.
double residual(const std::vector<double>& t, const Eigen::VectorXd& q, double w) {
    Eigen::MatrixXd A(q.size(), w > 0 ? 6 : 4);
    for (Eigen::Index i = 0; i < q.size(); ++i) {
        const double s = t[static_cast<std::size_t>(i)] / t.back();
        A.row(i).head(4) << 1, s, s * s, s * s * s;
        if (w > 0)
            A.row(i).tail(2) << std::cos(w * t[static_cast<std::size_t>(i)]),
                std::sin(w * t[static_cast<std::size_t>(i)]);
    }
    return (A * dense::leastSquares<double>(A, q) - q).norm();
}

}  // namespace

double estimateFrequency(const System& system, const State& start) {
    const double linear = highestFrequency(system, start);
    const auto none = [] {
        return InvalidScene("/space/omega", "nothing oscillates at the start: no frequency can be estimated",
                            "give a number");
    };
    if (!(linear > 0)) throw none();
    const double step = 2 * std::acos(-1.0) / (linear * stepsPerPeriod);
    const auto integrator = trustedIntegrator(system, start, step);
    const int k = fastestCoordinate(system, start);
    State state = start;
    state.node = 0;
    std::vector<double> t, values, x(start.x.size());
    for (int n = 0; n < periods * stepsPerPeriod; ++n) {
        const double before = state.t - start.t;
        if (advance(*integrator, state).outcome != Outcome::converged) throw none();
        for (int i = 1; i <= samplesPerStep; ++i) {
            const double tau = static_cast<double>(i) / samplesPerStep;
            integrator->denseOutput(tau, x);
            t.push_back(before + tau * step);
            values.push_back(x[static_cast<std::size_t>(k)]);
        }
    }
    const Eigen::VectorXd q =
        Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
    const auto miss = [&](double w) { return residual(t, q, w); };
    // A coarse scan, then the golden section around its best.
    double best = linear, least = miss(linear);
    const double grid = 0.01 * linear;
    for (int i = -30; i <= 30; ++i) {
        const double w = linear + i * grid;
        if (const double r = miss(w); r < least) {
            least = r;
            best = w;
        }
    }
    const double golden = (std::sqrt(5.0) - 1) / 2;
    double low = best - grid, high = best + grid;
    while (high - low > 1e-10 * linear) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        if (miss(a) < miss(b))
            high = b;
        else
            low = a;
    }
    const double found = (low + high) / 2;
    // Motion without a fast part fits as well at any frequency.
    return miss(found) < 0.1 * residual(t, q, 0) ? found : linear;
}

}  // namespace extremal
