#include "engine/model/wave/hamiltonian.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text.hpp"
#include "engine/model/wave/interval.hpp"
#include "engine/model/wave/convolution.hpp"

namespace extremal {

namespace {

void requireFinite(double V, double x, const double* y) {
    if (!std::isfinite(V))
        throw InvalidScene("/potential",
                           "is not finite at x = " + formatNumber(x, 6) +
                               (y ? ", y = " + formatNumber(*y, 6) : std::string()) + ": " + formatNumber(V),
                           "a potential that is finite on the whole domain");
}

std::vector<double> nodesOf(const wave::Domain& domain, int n) {
    std::vector<double> nodes;
    for (int j = 0; j < n; ++j) nodes.push_back(domain.left + domain.length * j / n);
    return nodes;
}

}  // namespace

Hamiltonian::Hamiltonian(const wave::Grid& grid, double hbar, double mass, wave::Potential potential,
                         WaveBasis basis)
    : grid_(grid), hbar_(hbar), mass_(mass), potential_(std::move(potential)), basis_(basis) {
    V_.resize(static_cast<std::size_t>(size()));
    if (basis == WaveBasis::walls)
        onInterval();
    else
        onGrid();
    if (basis == WaveBasis::convolution) convolve();
}

void Hamiltonian::onGrid() {
    fourier_.emplace(grid_);
    x_ = nodesOf(grid_.x, grid_.nx);
    y_ = nodesOf(grid_.y, grid_.ny);
    for (int i = 0; i < size(); ++i) {
        const double px = hbar_ * fourier_->waveNumber(i), py = hbar_ * fourier_->waveNumberY(i);
        kinetic_.push_back((px * px + py * py) / (2 * mass_));
    }
    potential_.values(0, x_, y_, V_.data());
    for (std::size_t i = 0; i < V_.size(); ++i)
        requireFinite(V_[i], x_[i % x_.size()], isPlane() ? &y_[i / x_.size()] : nullptr);
    const auto [low, high] = std::minmax_element(V_.begin(), V_.end());
    lowest_ = *low;
    highest_ = *high + *std::max_element(kinetic_.begin(), kinetic_.end());
    if (!isPlane()) findHarmonics();
}

void Hamiltonian::findHarmonics() {
    const std::vector<Complex> samples(V_.begin(), V_.end());
    Vhat_.resize(V_.size());
    fourier_->rawToCoefficients(samples.data(), Vhat_.data());
    double largest = 0;
    for (Complex& v : Vhat_) {
        v /= size();
        largest = std::max(largest, std::abs(v));
    }
    for (int i = 0; i < size(); ++i)
        if (std::abs(Vhat_[static_cast<std::size_t>(i)]) > 2e-15 * largest)
            harmonics_ = std::max(harmonics_, std::abs(fourier_->number(i)));
}

void Hamiltonian::convolve() {
    matrix_ = realMatrix(convolutionGalerkin(*this), *fourier_);
    // The convolution is a mean of V's trigonometric interpolant, which its harmonics bound.
    double spread = 0;
    for (std::size_t i = 1; i < Vhat_.size(); ++i) spread += std::abs(Vhat_[i]);
    lowest_ = Vhat_[0].real() - spread;
    highest_ = Vhat_[0].real() + spread + *std::max_element(kinetic_.begin(), kinetic_.end());
}

std::shared_ptr<const Hamiltonian> Hamiltonian::withModes(int nx, int ny) const {
    return std::make_shared<const Hamiltonian>(wave::Grid{grid_.x, nx, grid_.y, ny}, hbar_, mass_, potential_,
                                               basis_);
}

void Hamiltonian::onInterval() {
    const int n = size();
    x_.resize(V_.size());
    y_ = {0};
    interval_ = Interval::of(n);
    const Interval& I = *interval_;
    const double half = domain().length / 2, middle = domain().left + half;
    Eigen::VectorXd V(I.points.size());
    for (Eigen::Index k = 0; k < V.size(); ++k) {
        const double x = middle + half * I.points(k);
        V(k) = potential_.function.value(x, 0, 0);
        requireFinite(V(k), x, nullptr);
    }
    for (int j = 0; j < n; ++j) {
        x_[static_cast<std::size_t>(j)] = middle + half * I.nodes(j);
        V_[static_cast<std::size_t>(j)] = V(2 * j + 2);
    }
    const Eigen::MatrixXd inPotential =
        I.values * I.weights.cwiseProduct(V).asDiagonal() * I.values.transpose();
    matrix_ =
        hbar_ * hbar_ / (2 * mass_ * half * half) * I.kinetic + (inPotential + inPotential.transpose()) / 2;
    lowest_ = V.minCoeff();
    highest_ = matrix_.cwiseAbs().rowwise().sum().maxCoeff();
}

void Hamiltonian::toNodes(const Complex* c, Complex* psi) const {
    if (basis_ == WaveBasis::walls) {
        multiply(interval_->inverse, c, psi);
        const double factor = 1 / std::sqrt(domain().length / 2);
        for (int j = 0; j < size(); ++j) psi[j] *= factor;
        return;
    }
    fourier_->toNodes(c, psi);
    if (basis_ == WaveBasis::fourier) return;
    // The cosine at k = -N/2 has the mean square 1/2.
    const Complex more = (std::numbers::sqrt2 - 1) / std::sqrt(grid_.measure()) * c[size() / 2];
    for (int j = 0; j < size(); ++j) psi[j] += j % 2 == 0 ? more : -more;
}

void Hamiltonian::toCoefficients(const Complex* psi, Complex* c) const {
    if (basis_ == WaveBasis::walls) {
        multiply(interval_->factor, psi, c);
        const double factor = std::sqrt(domain().length / 2);
        for (int i = 0; i < size(); ++i) c[i] *= factor;
        return;
    }
    fourier_->toCoefficients(psi, c);
    if (basis_ == WaveBasis::convolution) c[size() / 2] /= std::numbers::sqrt2;
}

void Hamiltonian::toReal(const Complex* c, Complex* v) const {
    if (!fourier_) {
        std::copy_n(c, size(), v);
        return;
    }
    fourier_->rawToNodes(c, v);
    const double root = std::sqrt(static_cast<double>(size()));
    for (int j = 0; j < size(); ++j) v[j] /= root;
}

void Hamiltonian::fromReal(Complex* v, Complex* c) const {
    if (!fourier_) {
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
        potential_.values(t, x_, y_, V);
    else
        std::copy(V_.begin(), V_.end(), V);
}

void Hamiltonian::apply(const double* V, const Complex* c, Complex* out, Complex* work) const {
    const int n = size();
    if (basis_ == WaveBasis::walls) return multiply(matrix_, c, out);
    if (basis_ == WaveBasis::convolution) {
        toReal(c, out);
        multiply(matrix_, out, work);
        return fromReal(work, out);
    }
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
    if (!isSplit()) {
        std::vector<Complex> work(n);
        apply(nullptr, c, psi.data(), work.data());
        return innerProduct(c, psi.data(), size()).real() / squaredNorm(c, size());
    }
    fourier_->rawToNodes(c, psi.data());
    std::vector<double> moved(isTimeDependent() ? n : 0);
    if (isTimeDependent()) potentialAt(t, moved.data());
    const std::vector<double>& V = isTimeDependent() ? moved : V_;
    double sum = 0, norm = 0, inPotential = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double weight = std::norm(c[i]);
        sum += weight * kinetic_[i];
        norm += weight;
        inPotential += std::norm(psi[i]) * V[i];
    }
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
