#include "engine/integrator/resonance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/dense.hpp"
#include "engine/core/text.hpp"
#include "engine/integrator/oscillatory.hpp"

namespace extremal {
namespace {

/// Singular values of the step's system on L = (v^2 - z^2 q^2)/2 with h = 1, rows and columns scaled.
double conditioningOf(const Table<double>& t) {
    const double z = t.frequency;
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
bool isSafe(double z) { return fraction(z) >= 0.1 && fraction(z) <= 0.5; }

/// The nearest z of the same sign whose fraction is in the middle of the safe part.
double nearestSafe(double z) {
    const double x = std::abs(z) / std::numbers::pi, base = std::floor(x) + 0.3;
    const double best = base - 1 > 0 && x - (base - 1) < base - x ? base - 1 : base + 1 - x < std::abs(base - x) ? base + 1 : base;
    return std::copysign(best * std::numbers::pi, z);
}

/// The shortest decimal that is still safe.
double fewDigits(double step, double frequency) {
    for (int digits = 2; digits < 17; ++digits)
        if (const auto rounded = parseNumber(formatNumber(step, digits)); rounded && isSafe(*rounded * frequency)) return *rounded;
    return step;
}

}  // namespace

double stepConditioning(const System& system, const Discretization& pair, double step) {
    if (!isOscillatory(pair.space)) return 0;
    // Coordinates that follow the fast ones are no oscillators; where none is known to be fast, all may be.
    const std::vector<Table<double>> tables = oscillatoryTables(system, pair, step);
    double worst = 0;
    for (const int k : system.fast.coordinates) worst = std::max(worst, conditioningOf(tables[static_cast<std::size_t>(k)]));
    if (system.fast.coordinates.empty())
        for (const Table<double>& t : tables) worst = std::max(worst, conditioningOf(t));
    return worst;
}

std::optional<Resonance> resonanceOf(const System& system, const Discretization& pair, double step) {
    if (!isOscillatory(pair.space)) return {};
    const double z = oscillatoryTables(system, pair, step).front().frequency;
    if (isSafe(z)) return {};
    Resonance r;
    r.periods = std::abs(z) / (2 * std::numbers::pi);
    r.near = fewDigits(step * nearestSafe(z) / z, z / step);
    r.conditioning = stepConditioning(system, pair, step);
    r.usual = stepConditioning(system, pair, r.near);
    return r;
}

}  // namespace extremal
