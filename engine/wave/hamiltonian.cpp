#include "engine/wave/hamiltonian.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text.hpp"

namespace extremal {

Hamiltonian::Hamiltonian(int n, const wave::Domain& domain, double hbar, double mass, wave::Potential potential)
    : domain_(domain), hbar_(hbar), mass_(mass), potential_(std::move(potential)), fourier_(n, domain.length) {
    const auto size = static_cast<std::size_t>(n);
    x_.resize(size);
    kinetic_.resize(size);
    V_.resize(size);
    Vhat_.resize(size);
    for (int j = 0; j < n; ++j) {
        const auto i = static_cast<std::size_t>(j);
        x_[i] = domain.left + domain.length * j / n;
        const double p = hbar * fourier_.waveNumber(j);
        kinetic_[i] = p * p / (2 * mass);
    }
    potential_.values(0, x_, V_.data());
    std::vector<Complex> samples(size);
    for (std::size_t i = 0; i < size; ++i) {
        if (!std::isfinite(V_[i]))
            throw InvalidScene("/potential",
                               "is not finite at x = " + formatNumber(x_[i], 6) + ": " + formatNumber(V_[i]),
                               "a potential that is finite on the whole domain");
        samples[i] = V_[i];
    }
    fourier_.rawToCoefficients(samples.data(), Vhat_.data());
    double largest = 0;
    for (Complex& v : Vhat_) {
        v /= n;
        largest = std::max(largest, std::abs(v));
    }
    for (int i = 0; i < n; ++i)
        if (std::abs(Vhat_[static_cast<std::size_t>(i)]) > 2e-15 * largest)
            harmonics_ = std::max(harmonics_, std::abs(fourier_.number(i)));
    const auto [low, high] = std::minmax_element(V_.begin(), V_.end());
    lowest_ = *low;
    highest_ = *high + *std::max_element(kinetic_.begin(), kinetic_.end());
}

void Hamiltonian::potentialAt(double t, double* V) const {
    if (isTimeDependent())
        potential_.values(t, x_, V);
    else
        std::copy(V_.begin(), V_.end(), V);
}

void Hamiltonian::apply(const double* V, const Complex* c, Complex* out, Complex* work) const {
    const int n = size();
    const double inverse = 1.0 / n;
    fourier_.rawToNodes(c, work);
    double* w = reinterpret_cast<double*>(work);
    for (int j = 0; j < n; ++j) {
        const double v = V[j] * inverse;
        w[2 * j] *= v;
        w[2 * j + 1] *= v;
    }
    fourier_.rawToCoefficients(work, out);
    double* o = reinterpret_cast<double*>(out);
    const double* from = reinterpret_cast<const double*>(c);
    for (int i = 0; i < n; ++i) {
        const double T = kinetic_[static_cast<std::size_t>(i)];
        o[2 * i] += T * from[2 * i];
        o[2 * i + 1] += T * from[2 * i + 1];
    }
}

double Hamiltonian::energy(double t, const Complex* c) const {
    const auto n = static_cast<std::size_t>(size());
    std::vector<Complex> psi(n);
    fourier_.rawToNodes(c, psi.data());
    double sum = 0, norm = 0, inPotential = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double weight = std::norm(c[i]);
        sum += weight * kinetic_[i];
        norm += weight;
    }
    for (std::size_t j = 0; j < n; ++j)
        inPotential += std::norm(psi[j]) * (isTimeDependent() ? potential_.function.value(x_[j], t) : V_[j]);
    return (sum + inPotential / static_cast<double>(n)) / norm;
}

double squaredNorm(const Complex* c, int n) {
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += std::norm(c[i]);
    return sum;
}

Complex innerProduct(const Complex* a, const Complex* b, int n) {
    double re = 0, im = 0;
    for (int i = 0; i < n; ++i) {
        re += a[i].real() * b[i].real() + a[i].imag() * b[i].imag();
        im += a[i].real() * b[i].imag() - a[i].imag() * b[i].real();
    }
    return {re, im};
}

}  // namespace extremal
