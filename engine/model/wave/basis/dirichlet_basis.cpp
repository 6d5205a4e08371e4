// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/basis/dirichlet_basis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace extremal {
namespace {

/// sum_i row_i c_i.
Complex combined(const double* row, Eigen::Index stride, const Complex* c, int n) {
    double re = 0, im = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
        re += row[i * stride] * c[i].real();
        im += row[i * stride] * c[i].imag();
    }
    return {re, im};
}
Complex atPoint(const Eigen::MatrixXd& basis, Eigen::Index k, const Complex* c) {
    return combined(basis.data() + k * basis.rows(), 1, c, static_cast<int>(basis.rows()));
}
double squared(const Complex* c, int n) {
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += std::norm(c[i]);
    return sum;
}

}  // namespace

DirichletBasis::DirichletBasis(const wave::Domain& domain, int n, double hbar, double mass)
    : domain_(domain), hbar_(hbar), mass_(mass), interval_(Interval::of(n)) {
    const double half = domain_.length / 2, middle = domain_.left + half;
    for (Eigen::Index j = 0; j < n; ++j) x_.push_back(middle + half * interval_->nodes(j));
}

std::vector<double> DirichletBasis::points() const {
    const double half = domain_.length / 2, middle = domain_.left + half;
    std::vector<double> points;
    for (const double at : interval_->points) points.push_back(middle + half * at);
    return points;
}

Eigen::MatrixXd DirichletBasis::matrix(const Eigen::VectorXd& V) const {
    const Interval& I = *interval_;
    const double half = domain_.length / 2;
    const Eigen::MatrixXd inPotential =
        I.values * I.weights.cwiseProduct(V).asDiagonal() * I.values.transpose();
    return hbar_ * hbar_ / (2 * mass_ * half * half) * I.kinetic +
           (inPotential + inPotential.transpose()) / 2;
}

void DirichletBasis::toNodes(const Complex* c, Complex* psi) const {
    multiply(interval_->inverse, c, psi);
    const double factor = 1 / std::sqrt(domain_.length / 2);
    for (int j = 0; j < size(); ++j) psi[j] *= factor;
}

void DirichletBasis::toCoefficients(const Complex* psi, Complex* c) const {
    multiply(interval_->factor, psi, c);
    const double factor = std::sqrt(domain_.length / 2);
    for (int i = 0; i < size(); ++i) c[i] *= factor;
}

void DirichletBasis::toReal(const Complex* c, Complex* v) const { std::copy_n(c, size(), v); }
void DirichletBasis::fromReal(Complex* v, Complex* c) const { std::copy_n(v, size(), c); }

Complex DirichletBasis::chebyshevCoefficient(const Complex* c, int k) const {
    const Eigen::MatrixXd& T = interval_->coefficient;
    return combined(T.data() + k, T.rows(), c, size()) / std::sqrt(domain_.length / 2);
}

Eigen::MatrixXd DirichletBasis::resampling(int rows) const {
    Eigen::VectorXd at(rows);
    for (int row = 0; row < rows; ++row) at(row) = (2 * row + 1.0) / rows - 1;
    return chebyshev::cardinals(at, chebyshev::extrema(size() + 1)).middleCols(1, size());
}

std::pair<double, double> DirichletBasis::tail(const Complex* c) const {
    double upper = 0, all = 0;
    const int N = size() + 1;
    for (int k = 0; k <= N; ++k) {
        const double weight = std::norm(chebyshevCoefficient(c, k));
        all += weight;
        if (8 * k > 7 * N) upper += weight;
    }
    return {upper, all};
}

MeanMomentum DirichletBasis::momentum(const Complex* c) const {
    double sum = 0;
    const Interval& I = *interval_;
    for (Eigen::Index k = 0; k < I.points.size(); ++k)
        sum += I.weights(k) * (std::conj(atPoint(I.values, k, c)) * atPoint(I.slopes, k, c)).imag();
    return {hbar_ * sum / (domain_.length / 2) / squared(c, size())};
}

NodeMeans DirichletBasis::means(const Complex* c, Complex*) const {
    const double k = 2 * std::numbers::pi / domain_.length, left = domain_.left;
    NodeMeans means;
    double all = 0;
    const Interval& I = *interval_;
    for (Eigen::Index i = 0; i < I.points.size(); ++i) {
        const double x = left + (1 + I.points(i)) * domain_.length / 2,
                     weight = I.weights(i) * std::norm(atPoint(I.values, i, c));
        all += weight;
        means.x += weight * x;
        means.cosine += weight * std::cos(k * (x - left) + left);
    }
    means.x /= all;
    means.cosine /= all;
    return means;
}

double DirichletBasis::currentInTheMiddle(const Complex* c, Complex*, Complex*) const {
    const double half = domain_.length / 2;
    const Interval& I = *interval_;
    const Eigen::Index middle = size() + 1;
    return hbar_ / (mass_ * half * half) *
           (std::conj(atPoint(I.values, middle, c)) * atPoint(I.slopes, middle, c)).imag();
}

}  // namespace extremal
