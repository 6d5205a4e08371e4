// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/hamiltonian.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/wave/basis/convolution.hpp"
#include "engine/model/wave/split_operator.hpp"

namespace extremal {

namespace {

void requireFinite(double V, double x, const double* y) {
    if (!std::isfinite(V))
        throw InvalidScene("/potential",
                           "is not finite at x = " + formatNumber(x, 6) +
                               (y ? ", y = " + formatNumber(*y, 6) : std::string()) + ": " + formatNumber(V),
                           "a potential that is finite on the whole domain");
}

std::variant<FourierBasis, DirichletBasis> basisOf(WaveBasis form, const wave::Grid& grid, double hbar,
                                                   double mass) {
    if (form == WaveBasis::dirichlet) return DirichletBasis(grid.x, grid.size(), hbar, mass);
    return FourierBasis(grid, hbar, mass, form == WaveBasis::convolution);
}

}  // namespace

Hamiltonian::Hamiltonian(const wave::Grid& grid, double hbar, double mass, wave::Potential potential,
                         WaveBasis form)
    : grid_(grid),
      hbar_(hbar),
      mass_(mass),
      potential_(std::move(potential)),
      form_(form),
      basis_(basisOf(form, grid, hbar, mass)) {
    V_.resize(static_cast<std::size_t>(size()));
    if (form == WaveBasis::dirichlet)
        onInterval();
    else
        onGrid();
}

void Hamiltonian::onGrid() {
    potential_.values(0, x(), y(), V_.data());
    for (std::size_t i = 0; i < V_.size(); ++i)
        requireFinite(V_[i], x()[i % x().size()], dimension() == 2 ? &y()[i / x().size()] : nullptr);
    if (dimension() == 1) harmonics_ = PotentialHarmonics::of(V_, fourier());
    const double fastest = *std::max_element(kinetic().begin(), kinetic().end());
    if (form_ == WaveBasis::convolution) {
        matrix_ = extremal::realMatrix(convolutionGalerkin(fourierBasis(), harmonics_), fourier());
        // The convolution is a mean of V's trigonometric interpolant, which its harmonics bound.
        const std::vector<Complex>& V = harmonics_.coefficients;
        double spread = 0;
        for (std::size_t i = 1; i < V.size(); ++i) spread += std::abs(V[i]);
        lowest_ = V[0].real() - spread;
        highest_ = V[0].real() + spread + fastest;
        return;
    }
    const auto [low, high] = std::minmax_element(V_.begin(), V_.end());
    lowest_ = *low;
    highest_ = *high + fastest;
}

void Hamiltonian::onInterval() {
    const std::vector<double> points = dirichletBasis().points();
    Eigen::VectorXd V(static_cast<Eigen::Index>(points.size()));
    for (std::size_t k = 0; k < points.size(); ++k) {
        const double value = potential_.function.value(points[k], 0, 0);
        requireFinite(value, points[k], nullptr);
        V(static_cast<Eigen::Index>(k)) = value;
    }
    for (std::size_t j = 0; j < V_.size(); ++j) V_[j] = V(static_cast<Eigen::Index>(2 * j + 2));
    matrix_ = dirichletBasis().matrix(V);
    lowest_ = V.minCoeff();
    highest_ = matrix_.cwiseAbs().rowwise().sum().maxCoeff();
}

std::shared_ptr<const Hamiltonian> Hamiltonian::withModes(int nx, int ny) const {
    return std::make_shared<const Hamiltonian>(wave::Grid{grid_.x, nx, grid_.y, ny}, hbar_, mass_, potential_,
                                               form_);
}

bool Hamiltonian::isSameAs(const Hamiltonian& other) const {
    return grid_ == other.grid_ && form_ == other.form_ && matrix_ == other.matrix_ && V_ == other.V_ &&
           (!isPeriodic() || kinetic() == other.kinetic());
}

const std::vector<double>& Hamiltonian::x() const {
    return *inBasis([](const auto& basis) { return &basis.x(); });
}
const std::vector<double>& Hamiltonian::y() const {
    return *inBasis([](const auto& basis) { return &basis.y(); });
}
void Hamiltonian::toNodes(const Complex* c, Complex* psi) const {
    inBasis([&](const auto& basis) { basis.toNodes(c, psi); });
}
void Hamiltonian::toCoefficients(const Complex* psi, Complex* c) const {
    inBasis([&](const auto& basis) { basis.toCoefficients(psi, c); });
}
void Hamiltonian::toReal(const Complex* c, Complex* v) const {
    inBasis([&](const auto& basis) { basis.toReal(c, v); });
}
void Hamiltonian::fromReal(Complex* v, Complex* c) const {
    inBasis([&](const auto& basis) { basis.fromReal(v, c); });
}

Eigen::MatrixXd Hamiltonian::realMatrix() const {
    return isSplit() ? split::matrix(fourierBasis(), V_.data()) : matrix_;
}

void Hamiltonian::potentialAt(double t, double* V) const {
    if (isTimeDependent())
        potential_.values(t, x(), y(), V);
    else
        std::copy(V_.begin(), V_.end(), V);
}

void Hamiltonian::apply(const double* V, const Complex* c, Complex* out, Complex* work) const {
    if (isSplit()) return split::apply(fourierBasis(), V, c, out, work);
    toReal(c, out);
    multiply(matrix_, out, work);
    fromReal(work, out);
}

double Hamiltonian::energy(double t, const Complex* c) const {
    if (isSplit() && !isTimeDependent()) return split::energy(fourierBasis(), V_.data(), c);
    const auto n = static_cast<std::size_t>(size());
    if (isSplit()) {
        std::vector<double> V(n);
        potentialAt(t, V.data());
        return split::energy(fourierBasis(), V.data(), c);
    }
    std::vector<Complex> image(n), work(n);
    apply(nullptr, c, image.data(), work.data());
    return innerProduct(c, image.data(), size()).real() / squaredNorm(c, size());
}

EvenSamples evenSamples(const Hamiltonian& h, const double* values, int rows) {
    const Eigen::MatrixXd parts =
        h.dirichletBasis().resampling(rows) * Eigen::Map<const Eigen::MatrixXd>(values, h.size(), 2);
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
