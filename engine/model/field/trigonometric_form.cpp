// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/field/trigonometric_form.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace extremal {

TrigonometricForm::TrigonometricForm(std::shared_ptr<const FieldProblem> problem)
    : problem_(std::move(problem)),
      n_(static_cast<std::size_t>(problem_->size())),
      nodes_(problem_->size()),
      fine_(2 * problem_->size()),
      base_(2 * std::numbers::pi / problem_->mesh.length()) {}

TrigonometricForm::Modes TrigonometricForm::modesOf(const double* values) const {
    Modes modes(static_cast<std::size_t>(nodes_.modes()));
    const std::vector<double> aligned(values, values + n_);
    nodes_.toModes(aligned.data(), modes.data());
    for (auto& each : modes) each /= static_cast<double>(n_);
    return modes;
}

std::vector<double> TrigonometricForm::onFineNodes(const Modes& modes) const {
    Modes padded(static_cast<std::size_t>(fine_.modes()));
    std::copy(modes.begin(), modes.end(), padded.begin());
    // The alternating wave counts for +N/2 and -N/2, which are two modes on the fine nodes.
    if (n_ % 2 == 0) padded[n_ / 2] /= 2;
    std::vector<double> values(2 * n_);
    fine_.toNodes(padded.data(), values.data());
    return values;
}

double TrigonometricForm::energy(const double* x) const {
    const Modes u = modesOf(x);
    const double length = problem_->mesh.length();
    double kinetic = 0, gradient = 0, potential = 0;
    for (std::size_t i = 0; i < n_; ++i) kinetic += x[n_ + i] * x[n_ + i];
    for (std::size_t k = 1; k < u.size(); ++k) {
        const double K = base_ * static_cast<double>(k);
        gradient += K * K * std::norm(u[k]) * (2 * k == n_ ? 1 : 2);
    }
    const std::vector<double> fine = onFineNodes(u);
    std::vector<double> W(fine.size());
    problem_->potential.evaluate(fine.data(), fine.size(), W.data(), nullptr, nullptr);
    for (const double each : W) potential += each;
    return length * (kinetic / (2 * static_cast<double>(n_)) + problem_->elastic.k * gradient / 2 +
                     potential / (2 * static_cast<double>(n_)));
}

double TrigonometricForm::momentum(const double* x) const {
    const Modes u = modesOf(x), v = modesOf(x + n_);
    double sum = 0;
    for (std::size_t k = 1; 2 * k < n_; ++k)
        sum += base_ * static_cast<double>(k) * std::imag(u[k] * std::conj(v[k]));
    return 2 * problem_->mesh.length() * sum;
}

double TrigonometricForm::tail(const double* x) const {
    const Modes u = modesOf(x);
    double upper = 0, all = 0;
    for (std::size_t k = 0; k < u.size(); ++k) {
        const double share = std::norm(u[k]) * (k == 0 || 2 * k == n_ ? 1 : 2);
        all += share;
        if (16 * k >= 7 * n_) upper += share;
    }
    return all > 0 ? std::sqrt(upper / all) : 0;
}

void TrigonometricForm::evaluateAt(const double* x, std::span<const double> places, double* values) const {
    for (const std::size_t part : {std::size_t{0}, std::size_t{1}}) {
        const Modes modes = modesOf(x + part * n_);
        for (std::size_t i = 0; i < places.size(); ++i) {
            // Horner's scheme in z = exp(i base (x - left)).
            const double angle = base_ * (places[i] - problem_->mesh.left());
            const double re = std::cos(angle), im = std::sin(angle);
            const std::size_t last = (n_ - 1) / 2;
            double a = 0, b = 0;
            for (std::size_t k = last; k > 0; --k) {
                const double p = a + modes[k].real(), q = b + modes[k].imag();
                a = p * re - q * im;
                b = p * im + q * re;
            }
            const double alternating =
                n_ % 2 == 0 ? modes[n_ / 2].real() * std::cos(angle * static_cast<double>(n_) / 2) : 0;
            values[part * places.size() + i] = modes[0].real() + 2 * a + alternating;
        }
    }
}

double TrigonometricForm::distance(double t, const double* x, const ExactSolution& exact) const {
    const std::vector<double> fine = onFineNodes(modesOf(x));
    std::vector<double> places(fine.size()), known(2 * fine.size());
    const double dx = problem_->mesh.length() / static_cast<double>(fine.size());
    for (std::size_t i = 0; i < places.size(); ++i)
        places[i] = problem_->mesh.left() + dx * static_cast<double>(i);
    exact.atPlaces()(t, places, known.data());
    double sum = 0;
    for (std::size_t i = 0; i < fine.size(); ++i) sum += (fine[i] - known[i]) * (fine[i] - known[i]);
    return std::sqrt(dx * sum);
}

void TrigonometricForm::withoutAlternation(std::span<double> x) {
    const std::size_t n = x.size() / 2;
    if (n % 2 != 0) return;
    for (const std::size_t first : {std::size_t{0}, n}) {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) sum += (i % 2 == 0 ? 1 : -1) * x[first + i];
        const double part = sum / static_cast<double>(n);
        for (std::size_t i = 0; i < n; ++i) x[first + i] -= (i % 2 == 0 ? 1 : -1) * part;
    }
}

}  // namespace extremal
