#include "engine/wave/hamiltonian.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text.hpp"
#include "engine/wave/interval.hpp"

namespace extremal {

namespace {

void requireFinite(double V, double x) {
    if (!std::isfinite(V))
        throw InvalidScene("/potential", "is not finite at x = " + formatNumber(x, 6) + ": " + formatNumber(V),
                           "a potential that is finite on the whole domain");
}

}  // namespace

Hamiltonian::Hamiltonian(int n, const wave::Domain& domain, double hbar, double mass, wave::Potential potential,
                         Boundary boundary)
    : domain_(domain), hbar_(hbar), mass_(mass), potential_(std::move(potential)) {
    x_.resize(static_cast<std::size_t>(n));
    V_.resize(x_.size());
    if (boundary == Boundary::periodic)
        onCircle(n);
    else
        onInterval(n);
}

void Hamiltonian::onCircle(int n) {
    const auto size = static_cast<std::size_t>(n);
    fourier_.emplace(n, domain_.length);
    kinetic_.resize(size);
    Vhat_.resize(size);
    for (int j = 0; j < n; ++j) {
        const auto i = static_cast<std::size_t>(j);
        x_[i] = domain_.left + domain_.length * j / n;
        const double p = hbar_ * fourier_->waveNumber(j);
        kinetic_[i] = p * p / (2 * mass_);
    }
    potential_.values(0, x_, V_.data());
    std::vector<Complex> samples(size);
    for (std::size_t i = 0; i < size; ++i) {
        requireFinite(V_[i], x_[i]);
        samples[i] = V_[i];
    }
    fourier_->rawToCoefficients(samples.data(), Vhat_.data());
    double largest = 0;
    for (Complex& v : Vhat_) {
        v /= n;
        largest = std::max(largest, std::abs(v));
    }
    for (int i = 0; i < n; ++i)
        if (std::abs(Vhat_[static_cast<std::size_t>(i)]) > 2e-15 * largest)
            harmonics_ = std::max(harmonics_, std::abs(fourier_->number(i)));
    const auto [low, high] = std::minmax_element(V_.begin(), V_.end());
    lowest_ = *low;
    highest_ = *high + *std::max_element(kinetic_.begin(), kinetic_.end());
}

void Hamiltonian::onInterval(int n) {
    interval_ = Interval::of(n);
    const Interval& I = *interval_;
    const double half = domain_.length / 2, middle = domain_.left + half;
    Eigen::VectorXd V(I.points.size());
    for (Eigen::Index k = 0; k < V.size(); ++k) {
        const double x = middle + half * I.points(k);
        V(k) = potential_.function.value(x, 0);
        requireFinite(V(k), x);
    }
    for (int j = 0; j < n; ++j) {
        x_[static_cast<std::size_t>(j)] = middle + half * I.nodes(j);
        V_[static_cast<std::size_t>(j)] = V(2 * j + 2);
    }
    const Eigen::MatrixXd inPotential = I.values * I.weights.cwiseProduct(V).asDiagonal() * I.values.transpose();
    matrix_ = hbar_ * hbar_ / (2 * mass_ * half * half) * I.kinetic + (inPotential + inPotential.transpose()) / 2;
    lowest_ = V.minCoeff();
    highest_ = matrix_.cwiseAbs().rowwise().sum().maxCoeff();
}

void Hamiltonian::toNodes(const Complex* c, Complex* psi) const {
    if (fourier_) return fourier_->toNodes(c, psi);
    multiply(interval_->inverse, c, psi);
    const double factor = 1 / std::sqrt(domain_.length / 2);
    for (int j = 0; j < size(); ++j) psi[j] *= factor;
}

void Hamiltonian::toCoefficients(const Complex* psi, Complex* c) const {
    if (fourier_) return fourier_->toCoefficients(psi, c);
    multiply(interval_->factor, psi, c);
    const double factor = std::sqrt(domain_.length / 2);
    for (int i = 0; i < size(); ++i) c[i] *= factor;
}

void Hamiltonian::toReal(const Complex* c, Complex* v) const {
    if (interval_) {
        std::copy_n(c, size(), v);
        return;
    }
    fourier_->rawToNodes(c, v);
    const double root = std::sqrt(static_cast<double>(size()));
    for (int j = 0; j < size(); ++j) v[j] /= root;
}

void Hamiltonian::fromReal(Complex* v, Complex* c) const {
    if (interval_) {
        std::copy_n(v, size(), c);
        return;
    }
    const double root = std::sqrt(static_cast<double>(size()));
    for (int j = 0; j < size(); ++j) v[j] /= root;
    fourier_->rawToCoefficients(v, c);
}

Eigen::MatrixXd Hamiltonian::resampling(int rows) const {
    Eigen::VectorXd at(rows);
    for (int row = 0; row < rows; ++row) at(row) = (2 * row + 1.0) / rows - 1;
    return chebyshev::cardinals(at, chebyshev::extrema(size() + 1)).middleCols(1, size());
}

void Hamiltonian::potentialAt(double t, double* V) const {
    if (isTimeDependent())
        potential_.values(t, x_, V);
    else
        std::copy(V_.begin(), V_.end(), V);
}

void Hamiltonian::apply(const double* V, const Complex* c, Complex* out, Complex* work) const {
    if (interval_) return multiply(matrix_, c, out);
    const int n = size();
    const double inverse = 1.0 / n;
    fourier_->rawToNodes(c, work);
    double* w = reinterpret_cast<double*>(work);
    for (int j = 0; j < n; ++j) {
        const double v = V[j] * inverse;
        w[2 * j] *= v;
        w[2 * j + 1] *= v;
    }
    fourier_->rawToCoefficients(work, out);
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
    if (interval_) {
        multiply(matrix_, c, psi.data());
        return innerProduct(c, psi.data(), size()).real() / squaredNorm(c, size());
    }
    fourier_->rawToNodes(c, psi.data());
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

EvenSamples evenSamples(const Hamiltonian& h, const double* values, int rows) {
    const Eigen::MatrixXd parts = h.resampling(rows) * Eigen::Map<const Eigen::MatrixXd>(values, h.size(), 2);
    const double left = h.domain().left, length = h.domain().length;
    EvenSamples samples{{left}, {0}, {0}};
    for (int row = 0; row < rows; ++row) {
        samples.x.push_back(left + length * (row + 0.5) / rows);
        samples.re.push_back(parts(row, 0));
        samples.im.push_back(parts(row, 1));
    }
    samples.x.push_back(left + length);
    samples.re.push_back(0);
    samples.im.push_back(0);
    return samples;
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
