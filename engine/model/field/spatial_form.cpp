// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/field/spatial_form.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"

namespace extremal {
namespace {

/// Elements whose values of W are found together, at most, and their points.
constexpr int chunk = 64;
constexpr int mostPoints = 1024;

}  // namespace

SpatialForm::SpatialForm(std::shared_ptr<const FieldProblem> problem, const Rule<double>& rule)
    : problem_(std::move(problem)), width_(problem_->nodes.degree + 1) {
    const Mesh& mesh = problem_->mesh;
    for (int e = 0; e < mesh.elements(); ++e) size_.push_back(mesh.size(e));
    // On a uniform mesh all elements are equal, not just to round-off: sums over them then cancel.
    if (mesh.isUniform()) std::fill(size_.begin(), size_.end(), mesh.length() / mesh.elements());
    if (problem_->functions)
        useFunctions(*problem_->functions, rule);
    else
        usePolynomials(rule);
    if (points() > mostPoints)
        throw InvalidScene("/quadrature", "has " + std::to_string(points()) + " points on an element",
                           "at most " + std::to_string(mostPoints));
    const auto A = static_cast<std::size_t>(width_), Q = weight_.size();
    const std::size_t tables = hasOwnTables() ? size_.size() : 1;
    mass_.assign(tables * A * A, 0);
    for (std::size_t t = 0; t < tables; ++t)
        for (std::size_t q = 0; q < Q; ++q) {
            const double* value = &value_[(t * Q + q) * A];
            for (std::size_t a = 0; a < A; ++a)
                for (std::size_t b = 0; b < A; ++b)
                    mass_[(t * A + a) * A + b] += weight_[q] * value[a] * value[b];
        }
    isLumped_ = tables == 1;
    for (std::size_t a = 0; a < A; ++a)
        for (std::size_t b = 0; b < A; ++b)
            if (a != b && std::abs(mass_[a * A + b]) > 1e-15) isLumped_ = false;
    if (isLumped_)
        for (std::size_t a = 0; a < A; ++a) isLumped_ = isLumped_ && mass_[a * A + a] > 1e-15;
}

void SpatialForm::usePolynomials(const Rule<double>& rule) {
    const auto A = static_cast<std::size_t>(width_);
    weight_ = rule.b;
    value_.resize(A * weight_.size());
    slope_.resize(A * weight_.size());
    for (std::size_t q = 0; q < weight_.size(); ++q)
        problem_->nodes.basis.at(rule.c[q], value_.data() + q * A, slope_.data() + q * A);
    const Mesh& mesh = problem_->mesh;
    if (!problem_->coefficient) return;
    for (int e = 0; e < mesh.elements(); ++e)
        for (std::size_t q = 0; q < weight_.size(); ++q)
            coefficient_.push_back(problem_->coefficient(mesh.x[static_cast<std::size_t>(e)] +
                                                         size_[static_cast<std::size_t>(e)] * rule.c[q]));
}

/// The rule on each part, where phi is linear and a its harmonic mean: a phi' is then what it is with a
/// itself.
void SpatialForm::useFunctions(const ElementFunctions& functions, const Rule<double>& rule) {
    const int parts = functions.parts;
    for (int k = 0; k < parts; ++k)
        for (const double b : rule.b) weight_.push_back(b / parts);
    for (int e = 0; e < problem_->mesh.elements(); ++e)
        for (int k = 0; k < parts; ++k)
            for (const double c : rule.c) {
                const double from = functions.at(e, k), to = functions.at(e, k + 1),
                             phi = from + c * (to - from), slope = (to - from) * parts;
                value_.insert(value_.end(), {1 - phi, phi});
                slope_.insert(slope_.end(), {-slope, slope});
                coefficient_.push_back(functions.coefficient[static_cast<std::size_t>(e * parts + k)]);
            }
}

std::vector<double> SpatialForm::lumpedMass() const {
    std::vector<double> m(static_cast<std::size_t>(size()), 0);
    for (int e = 0; e < problem_->mesh.elements(); ++e)
        for (int a = 0; a < width_; ++a)
            m[static_cast<std::size_t>(problem_->nodes.node(e, a))] +=
                size_[static_cast<std::size_t>(e)] * elementMass(e)[a * width_ + a];
    return m;
}

void SpatialForm::applyMass(const double* v, double* out) const {
    std::fill_n(out, size(), 0.0);
    const FieldNodes& nodes = problem_->nodes;
    for (int e = 0; e < nodes.elements; ++e) {
        const double h = size_[static_cast<std::size_t>(e)];
        for (int a = 0; a < width_; ++a) {
            double sum = 0;
            for (int b = 0; b < width_; ++b) sum += elementMass(e)[a * width_ + b] * v[nodes.node(e, b)];
            out[nodes.node(e, a)] += h * sum;
        }
    }
}

double SpatialForm::kineticEnergy(const double* v) const {
    const FieldNodes& nodes = problem_->nodes;
    double energy = 0;
    for (int e = 0; e < nodes.elements; ++e)
        for (int a = 0; a < width_; ++a)
            for (int b = 0; b < width_; ++b)
                energy += size_[static_cast<std::size_t>(e)] * elementMass(e)[a * width_ + b] *
                          v[nodes.node(e, a)] * v[nodes.node(e, b)];
    return energy / 2;
}

/// Takes the elements chunk by chunk: use(first, count, values of u at the points, local values).
template <int A, class Use>
void SpatialForm::sweep(const double* u, Use&& use) const {
    const FieldNodes& nodes = problem_->nodes;
    const int N = nodes.elements, Q = points(), together = std::min(chunk, mostPoints / Q);
    double local[chunk * A], at[mostPoints];
    for (int first = 0; first < N; first += together) {
        const int count = std::min(together, N - first);
        for (int k = 0; k < count; ++k) {
            const double* value = valueOf(first + k);
            double* mine = local + k * A;
            for (int a = 0; a < A; ++a) mine[a] = u[nodes.node(first + k, a)];
            for (int q = 0; q < Q; ++q) {
                double sum = 0;
                for (int a = 0; a < A; ++a) sum += value[q * A + a] * mine[a];
                at[k * Q + q] = sum;
            }
        }
        use(first, count, at, local);
    }
}

template <int A>
double SpatialForm::energyOf(const double* u) const {
    const int Q = points();
    double sum = 0, W[mostPoints];
    sweep<A>(u, [&](int first, int count, const double* at, const double* local) {
        problem_->potential.evaluate(at, static_cast<std::size_t>(count * Q), W, nullptr, nullptr);
        for (int k = 0; k < count; ++k) {
            const double h = size_[static_cast<std::size_t>(first + k)];
            const double* slopes = slopeOf(first + k);
            for (int q = 0; q < Q; ++q) {
                double e = 0;
                for (int a = 0; a < A; ++a) e += slopes[q * A + a] * local[k * A + a];
                const auto p = static_cast<std::size_t>(q);
                sum += h * weight_[p] *
                       (coefficient(first + k, p) * problem_->elastic.at(e / h).energy + W[k * Q + q]);
            }
        }
    });
    return sum;
}

template <int A>
void SpatialForm::addForceOf(const double* u, double scale, double* f) const {
    const FieldNodes& nodes = problem_->nodes;
    const int Q = points();
    double slope[mostPoints];
    sweep<A>(u, [&](int first, int count, const double* at, const double* local) {
        problem_->potential.evaluate(at, static_cast<std::size_t>(count * Q), nullptr, slope, nullptr);
        for (int k = 0; k < count; ++k) {
            const double h = size_[static_cast<std::size_t>(first + k)];
            const double *values = valueOf(first + k), *slopes = slopeOf(first + k);
            double force[A] = {};
            for (int q = 0; q < Q; ++q) {
                double e = 0;
                for (int a = 0; a < A; ++a) e += slopes[q * A + a] * local[k * A + a];
                const auto p = static_cast<std::size_t>(q);
                const double w = scale * weight_[p],
                             stress = w * coefficient(first + k, p) * problem_->elastic.stress(e / h),
                             push = w * h * slope[k * Q + q];
                for (int a = 0; a < A; ++a) force[a] += stress * slopes[q * A + a] + push * values[q * A + a];
            }
            for (int a = 0; a < A; ++a) f[nodes.node(first + k, a)] -= force[a];
        }
    });
}

template <int A>
void SpatialForm::hessiansOf(const double* u, double* H) const {
    const int Q = points();
    double curvature[mostPoints];
    sweep<A>(u, [&](int first, int count, const double* at, const double* local) {
        problem_->potential.evaluate(at, static_cast<std::size_t>(count * Q), nullptr, nullptr, curvature);
        for (int k = 0; k < count; ++k) {
            const double h = size_[static_cast<std::size_t>(first + k)];
            double* mine = H + static_cast<std::ptrdiff_t>(first + k) * A * A;
            std::fill_n(mine, A * A, 0.0);
            for (int q = 0; q < Q; ++q) {
                const auto p = static_cast<std::size_t>(q);
                const double* value = valueOf(first + k) + q * A;
                const double* slope = slopeOf(first + k) + q * A;
                double e = 0;
                for (int a = 0; a < A; ++a) e += slope[a] * local[k * A + a];
                const double stiff = weight_[p] * coefficient(first + k, p) *
                                     problem_->elastic.at(e / h).modulus / h,
                             push = weight_[p] * h * curvature[k * Q + q];
                for (int a = 0; a < A; ++a)
                    for (int b = 0; b < A; ++b)
                        mine[a * A + b] += stiff * slope[a] * slope[b] + push * value[a] * value[b];
            }
        }
    });
}

double SpatialForm::energy(const double* u) const {
    return width_ == 2 ? energyOf<2>(u) : width_ == 3 ? energyOf<3>(u) : energyOf<4>(u);
}

void SpatialForm::addForce(const double* u, double scale, double* f) const {
    if (width_ == 2) return addForceOf<2>(u, scale, f);
    if (width_ == 3) return addForceOf<3>(u, scale, f);
    addForceOf<4>(u, scale, f);
}

void SpatialForm::hessians(const double* u, double* H) const {
    if (width_ == 2) return hessiansOf<2>(u, H);
    if (width_ == 3) return hessiansOf<3>(u, H);
    hessiansOf<4>(u, H);
}

double SpatialForm::largestEigenvalue(const double* u) const {
    const int A = width_;
    std::vector<double> H(static_cast<std::size_t>(problem_->mesh.elements() * A * A));
    hessians(u, H.data());
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>;
    double most = 0, last = -1;
    const double *previous = nullptr, *previousMass = nullptr;
    Matrix scaled;
    for (int e = 0; e < problem_->mesh.elements(); ++e) {
        const double *mine = H.data() + static_cast<std::ptrdiff_t>(e) * A * A, *mass = elementMass(e);
        const double h = size_[static_cast<std::size_t>(e)];
        const bool isSameMass = previousMass && std::equal(mass, mass + A * A, previousMass);
        // Equal neighbours have equal eigenvalues.
        if (isSameMass && h == last && std::equal(mine, mine + A * A, previous)) continue;
        if (!isSameMass) {
            // In coordinates where M is the identity; a mode without mass has an infinite eigenvalue.
            const auto parts = dense::symmetricEigen<double>(Matrix(Eigen::Map<const Matrix>(mass, A, A)));
            if (parts.values(0) < 1e-12 * parts.values(A - 1)) return std::numeric_limits<double>::infinity();
            scaled = parts.vectors * parts.values.cwiseSqrt().cwiseInverse().asDiagonal();
        }
        const Matrix K = scaled.transpose() * Eigen::Map<const Matrix>(mine, A, A) * scaled;
        most = std::max(most, dense::symmetricEigen<double>(K).values(A - 1) / h);
        previous = mine;
        previousMass = mass;
        last = h;
    }
    return most;
}

}  // namespace extremal
