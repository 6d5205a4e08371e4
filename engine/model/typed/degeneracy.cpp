// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <random>

#include "engine/core/text/text.hpp"
#include "engine/model/typed/typed_mechanics.hpp"

namespace extremal::typed {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Sample {
    bool isFinite = false;
    Matrix mass;
};

Sample sampleAt(const Mechanics<double>& m, double t, const double* q, const double* v) {
    const int d = m.dimension;
    Eigen::VectorXd gradient(2 * d);
    Matrix hessian(2 * d, 2 * d);
    double value = 0;
    m.jet(m.model.get(), t, q, v, &value, gradient.data(), hessian.data());
    return {std::isfinite(value) && gradient.allFinite() && hessian.allFinite(),
            hessian.bottomRightCorner(d, d)};
}

/// Rank after scaling rows and columns to size 1: masses of any size are regular.
bool isSingular(const Matrix& mass) {
    const Eigen::VectorXd largest = mass.cwiseAbs().rowwise().maxCoeff();
    if ((largest.array() == 0).any()) return true;
    if (mass.isDiagonal(0)) return false;
    const Eigen::VectorXd scale = largest.cwiseSqrt().cwiseInverse();
    Eigen::FullPivLU<Eigen::MatrixXd> lu(scale.asDiagonal() * mass * scale.asDiagonal());
    lu.setThreshold(1e-12);
    return !lu.isInvertible();
}

/// The first velocity that no entry of the mass matrix knows, or empty.
std::string missingVelocity(const Formula& formula, const Matrix& mass) {
    for (Eigen::Index i = 0; i < mass.rows(); ++i)
        if (mass.row(i).isZero(0)) return formula.coordinates[static_cast<std::size_t>(i)] + "_t";
    return {};
}

constexpr const char* singularMatrix =
    "the second derivatives with respect to the velocities form a singular matrix";
constexpr const char* consequence = ", so momenta do not determine velocities";

/// Of a Lagrangian that is degenerate everywhere.
std::string degenerateText(const Formula& formula, const Matrix& mass) {
    const std::string missing = missingVelocity(formula, mass);
    return "is degenerate: " +
           (missing.empty() ? singularMatrix
                            : "there is no square of " + missing + " or other curvature in it") +
           consequence;
}

/// Of one that is so at the initial data alone: the factor of a velocity's square vanishes there, as that of
/// the azimuth does at the pole of spherical coordinates.
std::string singularText(const Formula& formula, const Matrix& mass) {
    const std::string missing = missingVelocity(formula, mass);
    return "is degenerate at the initial data: " +
           (missing.empty() ? singularMatrix
                            : "its second derivative with respect to " + missing + " vanishes there") +
           consequence;
}

/// "x = 1, y = 2, ..."
std::string stateText(const Formula& formula, const double* q) {
    std::string state;
    for (std::size_t i = 0; i < formula.coordinates.size() && i < 4; ++i)
        state += (i ? ", " : "") + formula.coordinates[i] + " = " + formatNumber(q[i]);
    return state + (formula.coordinates.size() > 4 ? ", ..." : "");
}

/// Where no velocity belongs to the momenta: at velocities of several sizes, a regular one if there is one,
/// else a finite one.
Sample anySample(const Mechanics<double>& mechanics, double t, const double* q) {
    std::vector<double> v(static_cast<std::size_t>(mechanics.dimension));
    Sample found;
    for (const double speed : {0.0, 0.3, 0.05, 2.0}) {
        for (std::size_t k = 0; k < v.size(); ++k) v[k] = speed * (1 + 0.1 * static_cast<double>(k));
        const Sample sample = sampleAt(mechanics, t, q, v.data());
        if (!sample.isFinite) continue;
        if (!isSingular(sample.mass)) return sample;
        found = sample;
    }
    return found;
}

}  // namespace

std::optional<std::string> degeneracy(const Formula& formula, const Mechanics<double>& mechanics) {
    // States of several sizes: a formula may have a meaning only for large, small or positive values.
    std::mt19937 random(20040501);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
    const auto d = static_cast<std::size_t>(mechanics.dimension);
    std::vector<double> q(d), v(d);
    std::optional<Matrix> singular;
    for (int i = 0; i < 48; ++i) {
        const double size = std::pow(10, i % 4 - 1);
        const bool hasSigns = i % 3 != 0;
        for (std::size_t k = 0; k < d; ++k) {
            q[k] = size * (hasSigns ? 2 * uniform() - 1 : uniform());
            v[k] = 2 * uniform() - 1;
        }
        const Sample sample = sampleAt(mechanics, uniform(), q.data(), v.data());
        if (!sample.isFinite) continue;
        if (!isSingular(sample.mass)) return {};
        singular = sample.mass;
    }
    if (!singular) return {};
    return degenerateText(formula, *singular);
}

std::optional<std::string> faultAt(const Formula& formula, const Mechanics<double>& mechanics, double t,
                                   const double* q, const double* p) {
    const auto d = static_cast<std::size_t>(mechanics.dimension);
    std::vector<double> v(d, 0);
    const bool hasVelocity = mechanics.velocity(mechanics.model.get(), t, q, p, v.data());
    const Sample sample = hasVelocity ? sampleAt(mechanics, t, q, v.data()) : anySample(mechanics, t, q);
    if (!sample.isFinite)
        return "is not finite, or has no finite derivatives, at the initial data (" + stateText(formula, q) +
               ")";
    if (isSingular(sample.mass)) return singularText(formula, sample.mass);
    if (!hasVelocity)
        return "has no velocity that belongs to the momenta of the initial data (" + stateText(formula, q) +
               ")";
    return {};
}

}  // namespace extremal::typed
