#include "engine/family/multiscale/resonance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/dense.hpp"
#include "engine/core/text.hpp"
#include "engine/family/multiscale/oscillatory.hpp"

namespace extremal {
namespace {

/// Singular values of the step's system on L = (v^2 - z^2 q^2)/2 with h = 1, rows and columns scaled.
double conditioningOf(const Table<double>& t, double z) {
    const Eigen::MatrixXd weighted = t.weight.asDiagonal() * t.testValue;
    Eigen::MatrixXd A = t.testDerivative.transpose() * t.weight.asDiagonal() * t.derivative;
    A -= z * z * weighted.transpose() * t.value;
    for (int pass = 0; pass < 3; ++pass) {
        const Eigen::VectorXd rows = A.rowwise().norm().cwiseInverse();
        A = rows.asDiagonal() * A;
        const Eigen::VectorXd columns = A.colwise().norm().cwiseInverse();
        A = A * columns.asDiagonal();
    }
    const Eigen::VectorXd s = dense::singularValues(A);
    return s(0) / s(s.size() - 1);
}

/// Distance into the next integer of z/pi, and whether it is safe.
double fraction(double z) {
    const double x = std::abs(z) / std::numbers::pi;
    return x - std::floor(x);
}
bool isSafe(const Phases<double>& z) {
    return std::all_of(z.begin(), z.end(),
                       [](double x) { return x == 0 || (fraction(x) >= 0.1 && fraction(x) <= 0.5); });
}
Phases<double> scaled(const Phases<double>& z, double factor) { return {z[0] * factor, z[1] * factor}; }

/// The factor of the step next to 1 that makes it safe for all frequencies, in the middle of the safe part
/// for one.
double nearestSafe(const Phases<double>& z) {
    const double faster = std::max(std::abs(z[0]), std::abs(z[1])) / std::numbers::pi;
    if (z[1] == 0) {
        const double base = std::floor(faster) + 0.3;
        double best = base;
        for (const double other : {base - 1, base + 1})
            if (other > 0 && std::abs(faster - other) < std::abs(faster - best)) best = other;
        return best / faster;
    }
    for (int n = 1; n < 4000; ++n)
        for (const double factor : {1 - 0.01 * n / faster, 1 + 0.01 * n / faster})
            if (factor > 0 && isSafe(scaled(z, factor))) return factor;
    return 1;
}

/// The shortest decimal that is still safe.
double fewDigits(double step, const Phases<double>& frequency) {
    for (int digits = 2; digits < 17; ++digits)
        if (const auto rounded = parseNumber(formatNumber(step, digits));
            rounded && isSafe(scaled(frequency, *rounded)))
            return *rounded;
    return step;
}

}  // namespace

double stepConditioning(const System& system, const Discretization& discretization, double step) {
    if (!isOscillatory(discretization.space)) return 0;
    // Coordinates that follow the fast ones are no oscillators; where none is known to be fast, all may be.
    const std::vector<Table<double>> tables = oscillatoryTables(system, discretization, step);
    double worst = 0;
    for (const double z : oscillatoryPhases(system, discretization.space, step)) {
        if (z == 0) continue;
        for (const int k : system.fast.coordinates)
            worst = std::max(worst, conditioningOf(tables[static_cast<std::size_t>(k)], z));
        if (system.fast.coordinates.empty())
            for (const Table<double>& t : tables) worst = std::max(worst, conditioningOf(t, z));
    }
    return worst;
}

std::optional<Resonance> resonanceOf(const System& system, const Discretization& discretization,
                                     double step) {
    if (!isOscillatory(discretization.space)) return {};
    const Phases<double> z = oscillatoryPhases(system, discretization.space, step);
    if (isSafe(z)) return {};
    Resonance r;
    r.periods = std::max(std::abs(z[0]), std::abs(z[1])) / (2 * std::numbers::pi);
    r.near = fewDigits(step * nearestSafe(z), scaled(z, 1 / step));
    r.conditioning = stepConditioning(system, discretization, step);
    r.usual = stepConditioning(system, discretization, r.near);
    return r;
}

}  // namespace extremal
