// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

namespace extremal {
namespace {

std::vector<double> fromMiddle(const std::vector<double>& nodes, const wave::Domain& domain) {
    std::vector<double> from;
    for (const double x : nodes) from.push_back(x - domain.left - domain.length / 2);
    return from;
}

}  // namespace

AngularMomentum::AngularMomentum(std::shared_ptr<const Hamiltonian> h)
    : h_(std::move(h)),
      fromX_(fromMiddle(h_->x(), h_->grid().x)),
      fromY_(fromMiddle(h_->y(), h_->grid().y)),
      slope_(static_cast<std::size_t>(h_->size())),
      values_(slope_.size()) {}

void AngularMomentum::add(const Complex* c, double factor, Complex* psi) {
    const Fourier& fourier = h_->fourier();
    const std::size_t nx = fromX_.size();
    factor *= h_->hbar();
    for (const bool isAlongY : {true, false}) {
        for (std::size_t i = 0; i < slope_.size(); ++i) {
            const int place = static_cast<int>(i);
            slope_[i] = (isAlongY ? fourier.waveNumberY(place) : -fourier.waveNumber(place)) * c[i];
        }
        fourier.rawToNodes(slope_.data(), values_.data());
        for (std::size_t j = 0; j < values_.size(); ++j)
            psi[j] += factor * (isAlongY ? fromX_[j % nx] : fromY_[j / nx]) * values_[j];
    }
}

double AngularMomentum::mean(const Complex* c) {
    std::vector<Complex> psi(slope_.size()), image(slope_.size());
    h_->fourier().rawToNodes(c, psi.data());
    add(c, 1, image.data());
    return innerProduct(psi.data(), image.data(), h_->size()).real() / squaredNorm(psi.data(), h_->size());
}

PlaneTurn::PlaneTurn(const Hamiltonian& h, double angle) : transforms_(h.grid()) {
    const auto n = static_cast<std::size_t>(h.size());
    const std::size_t nx = h.x().size();
    times_ = std::max(1, static_cast<int>(std::ceil(std::abs(angle) / (std::numbers::pi / 3))));
    angle /= times_;
    const std::vector<double> x = fromMiddle(h.x(), h.grid().x), y = fromMiddle(h.y(), h.grid().y);
    // y goes to its wave numbers and back twice.
    const double scale = 1 / (static_cast<double>(h.grid().nx) * h.grid().ny * h.grid().ny);
    for (std::size_t i = 0; i < n; ++i) {
        const int place = static_cast<int>(i);
        alongX_.push_back(std::polar(1.0, -h.fourier().waveNumber(place) * y[i / nx] * std::tan(angle / 2)));
        alongY_.push_back(std::polar(scale, h.fourier().waveNumberY(place) * x[i % nx] * std::sin(angle)));
    }
}

void PlaneTurn::apply(Complex* c) const {
    const auto multiply = [c](const std::vector<Complex>& phases) {
        double* const x = reinterpret_cast<double*>(c);
        for (std::size_t i = 0; i < phases.size(); ++i) {
            const double re = x[2 * i], im = x[2 * i + 1], p = phases[i].real(), q = phases[i].imag();
            x[2 * i] = re * p - im * q;
            x[2 * i + 1] = re * q + im * p;
        }
    };
    for (int k = 0; k < times_; ++k) {
        transforms_.toNodesAlongY(c);
        multiply(alongX_);
        transforms_.toNodesAlongX(c);
        transforms_.toNumbersAlongY(c);
        multiply(alongY_);
        transforms_.toNodesAlongY(c);
        transforms_.toNumbersAlongX(c);
        multiply(alongX_);
        transforms_.toNumbersAlongY(c);
    }
}

}  // namespace extremal
