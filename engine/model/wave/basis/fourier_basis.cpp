// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/basis/fourier_basis.hpp"

#include <cmath>
#include <numbers>

namespace extremal {
namespace {

std::vector<double> equallySpaced(const wave::Domain& domain, int n) {
    std::vector<double> nodes;
    for (int j = 0; j < n; ++j) nodes.push_back(domain.left + domain.length * j / n);
    return nodes;
}

}  // namespace

FourierBasis::FourierBasis(const wave::Grid& grid, double hbar, double mass, bool hasCosine)
    : grid_(grid),
      hbar_(hbar),
      mass_(mass),
      hasCosine_(hasCosine),
      fourier_(grid),
      x_(equallySpaced(grid.x, grid.nx)),
      y_(equallySpaced(grid.y, grid.ny)) {
    for (int i = 0; i < size(); ++i) {
        const double px = hbar_ * fourier_.waveNumber(i), py = hbar_ * fourier_.waveNumberY(i);
        kinetic_.push_back((px * px + py * py) / (2 * mass_));
    }
}

void FourierBasis::toNodes(const Complex* c, Complex* psi) const {
    fourier_.toNodes(c, psi);
    if (!hasCosine_) return;
    const Complex more = (std::numbers::sqrt2 - 1) / std::sqrt(grid_.measure()) * c[size() / 2];
    for (int j = 0; j < size(); ++j) psi[j] += j % 2 == 0 ? more : -more;
}

void FourierBasis::toCoefficients(const Complex* psi, Complex* c) const {
    fourier_.toCoefficients(psi, c);
    if (hasCosine_) c[size() / 2] /= std::numbers::sqrt2;
}

void FourierBasis::toReal(const Complex* c, Complex* v) const {
    fourier_.rawToNodes(c, v);
    const double root = std::sqrt(static_cast<double>(size()));
    for (int j = 0; j < size(); ++j) v[j] /= root;
}

void FourierBasis::fromReal(Complex* v, Complex* c) const {
    const double root = std::sqrt(static_cast<double>(size()));
    for (int j = 0; j < size(); ++j) v[j] /= root;
    fourier_.rawToCoefficients(v, c);
}

std::pair<double, double> FourierBasis::tail(const Complex* c) const {
    double upper = 0, all = 0;
    for (int i = 0; i < size(); ++i) {
        const double weight = std::norm(c[i]);
        all += weight;
        if (16 * std::abs(fourier_.number(i)) > 7 * grid_.nx ||
            16 * std::abs(fourier_.numberY(i)) > 7 * grid_.ny)
            upper += weight;
    }
    return {upper, all};
}

MeanMomentum FourierBasis::momentum(const Complex* c) const {
    double x = 0, y = 0, all = 0;
    for (int i = 0; i < size(); ++i) {
        const double weight = std::norm(c[i]);
        all += weight;
        if (2 * fourier_.number(i) != -grid_.nx) x += weight * fourier_.waveNumber(i);
        if (2 * fourier_.numberY(i) != -grid_.ny) y += weight * fourier_.waveNumberY(i);
    }
    return {hbar_ * x / all, hbar_ * y / all};
}

NodeMeans FourierBasis::means(const Complex* c, Complex* work) const {
    const double k = 2 * std::numbers::pi / grid_.x.length, left = grid_.x.left;
    NodeMeans means;
    double all = 0;
    toNodes(c, work);
    for (const double y : y_)
        for (const double x : x_) {
            const double weight = std::norm(*work++);
            all += weight;
            means.x += weight * x;
            means.y += weight * y;
            means.cosine += weight * std::cos(k * (x - left) + left);
        }
    means.x /= all;
    means.y /= all;
    means.cosine /= all;
    return means;
}

double FourierBasis::currentInTheMiddle(const Complex* c, Complex* work, Complex* slope) const {
    for (int i = 0; i < size(); ++i)
        slope[i] =
            2 * fourier_.number(i) == -grid_.nx ? Complex(0) : Complex(0, fourier_.waveNumber(i)) * c[i];
    fourier_.toNodes(slope, work);
    // The slopes on the line make room for the values.
    for (int j = 0; j < grid_.ny; ++j) slope[j] = work[grid_.nx / 2 + j * grid_.nx];
    toNodes(c, work);
    double sum = 0;
    for (int j = 0; j < grid_.ny; ++j)
        sum += (std::conj(work[grid_.nx / 2 + j * grid_.nx]) * slope[j]).imag();
    return hbar_ / mass_ * sum * grid_.y.length / grid_.ny;
}

}  // namespace extremal
