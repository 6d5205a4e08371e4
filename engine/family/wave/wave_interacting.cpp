// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/wave/wave_interacting.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/core/algebra/add_scaled.hpp"
#include "engine/core/algebra/complex_vectors.hpp"
#include "engine/core/algebra/dense.hpp"
#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/lanes.hpp"
#include "engine/model/wave/interaction.hpp"
#include "engine/quadrature/collocation.hpp"

namespace extremal {
namespace {

constexpr std::size_t lanes = Lanes::size;

/// out_i = a_i v + sum_j B_ij R_j, complex, for `rows` outputs. A row is its real parts, then its imaginary
/// parts, `width` numbers each. `table`: in blocks of eight modes, of each output a and B, real part first.
inline void combineLanes(const double* table, std::size_t rows, std::size_t stages, std::size_t width,
                         const double* v, const double* R, double* out) {
    for (std::size_t m = 0; m < width; m += lanes) {
        const Lanes re = Lanes::load(v + m), im = Lanes::load(v + width + m);
        for (std::size_t i = 0; i < rows; ++i) {
            const Lanes p = Lanes::load(table), q = Lanes::load(table + lanes);
            Lanes x = p * re - q * im, y = p * im + q * re;
            table += 2 * lanes;
            for (std::size_t j = 0; j < stages; ++j, table += 2 * lanes) {
                const double* const row = R + 2 * j * width + m;
                const Lanes a = Lanes::load(row), b = Lanes::load(row + width), s = Lanes::load(table),
                            t = Lanes::load(table + lanes);
                x += s * a - t * b;
                y += s * b + t * a;
            }
            x.store(out + 2 * i * width + m);
            y.store(out + (2 * i + 1) * width + m);
        }
    }
}

/// Real and imaginary parts in turn from `width` real parts followed by imaginary ones, and back.
inline void joinParts(const double* row, std::size_t width, std::size_t n, double* to) {
    for (std::size_t k = 0; k < n; ++k) {
        to[2 * k] = row[k];
        to[2 * k + 1] = row[width + k];
    }
}
inline void splitParts(const double* from, std::size_t width, std::size_t n, double* row) {
    for (std::size_t k = 0; k < n; ++k) {
        row[k] = from[2 * k];
        row[width + k] = from[2 * k + 1];
    }
}

/// What acts at the nodes beside the kinetic part: rest_j + density |psi_j|^2.
struct AtNodes {
    const double* rest;
    double density, scale;
    std::size_t n;
};
/// psi <- scale (rest + density |psi|^2) psi; `before`: psi of the last time, and then of this one. squares:
/// of the change, in eight sums.
inline void applyAtNodes(AtNodes h, double* psi, double* before, double* squares) {
    std::fill_n(squares, lanes, 0.0);
    for (std::size_t i = 0; i < 2 * h.n / lanes * lanes; i += lanes)
        for (std::size_t k = 0; k < lanes; ++k) {
            const double change = psi[i + k] - before[i + k];
            squares[k] += change * change;
        }
    for (std::size_t i = 2 * h.n / lanes * lanes; i < 2 * h.n; ++i)
        squares[0] += (psi[i] - before[i]) * (psi[i] - before[i]);
    for (std::size_t j = 0; j < h.n; ++j) {
        const double re = psi[2 * j], im = psi[2 * j + 1],
                     factor = h.scale * (h.rest[j] + h.density * (re * re + im * im));
        before[2 * j] = re;
        before[2 * j + 1] = im;
        psi[2 * j] = factor * re;
        psi[2 * j + 1] = factor * im;
    }
}

/// 2s nodes of Gauss beside the s of a rule, for the exact integral over time.
class FineNodes {
public:
    explicit FineNodes(const Rule<double>& rule) : rule_(gauss<double>(2 * rule.size())) {
        std::vector<double> knots{0};
        knots.insert(knots.end(), rule.c.begin(), rule.c.end());
        width_ = knots.size();
        values_ = lagrangeTable(knots, rule_.c);
        // The Lagrange polynomials of Gauss nodes are orthogonal, with the weights as their squares.
        const std::vector<double> basis = lagrangeTable(rule.c, rule_.c);
        for (std::size_t j = 0; j < rule.c.size(); ++j)
            for (std::size_t i = 0; i < size(); ++i)
                projection_.push_back(rule_.b[i] * basis[i * rule.c.size() + j] / rule.b[j]);
    }
    std::size_t size() const { return rule_.c.size(); }
    /// At node i of the polynomial through the start (j = 0) and the s nodes.
    double values(std::size_t i, std::size_t j) const { return values_[i * width_ + j]; }
    /// At node j of the rule, of the projection on degree s - 1 of what has values at the nodes i.
    double projection(std::size_t j, std::size_t i) const { return projection_[j * size() + i]; }

private:
    Rule<double> rule_;
    std::size_t width_ = 0;
    std::vector<double> values_, projection_;
};

class InteractingWave final : public WaveStep {
public:
    InteractingWave(std::shared_ptr<const Hamiltonian> hamiltonian, Coupling coupling, double step,
                    double shift, int degree, double tolerance, int maxIterations, InTime inTime)
        : WaveStep(std::move(hamiltonian), step, shift),
          coupling_(coupling),
          rule_(gauss<double>(degree)),
          ahead_(extrapolationTable(rule_)),
          tolerance_(tolerance > 0 ? tolerance : 1e-14),
          maxIterations_(maxIterations > 0 ? maxIterations : 200),
          stages_(static_cast<std::size_t>(degree)),
          size_(static_cast<std::size_t>(n())),
          width_((size_ + lanes - 1) / lanes * lanes) {
        v_.resize(2 * width_);
        for (auto* rows : {&R_, &last_, &Psi_}) rows->resize(2 * width_ * stages_);
        if (inTime == InTime::exact) {
            fine_.emplace(rule_);
            for (auto* rows : {&fineR_, &finePsi_}) rows->resize(2 * width_ * fine_->size());
        }
        nodes_.resize(size_ * (fine_ ? fine_->size() : stages_));
        psi_.resize(size_);
        modes_.resize(size_);
        rest_.resize(size_);
        if (coupling_.omega != 0) turn_.emplace(shared());
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<InteractingWave>(*this); }
    bool checkpoint(Archive& archive) override {
        const bool isWhole = WaveStep::checkpoint(archive);
        archive(hasLast_, R_);
        return isWhole;
    }

private:
    bool isLinear() const override { return coupling_.g == 0; }
    double shiftFrom(const State& state) const override {
        return chemicalPotential(shared(), coupling_, state.t, coefficients(state.x.data()));
    }
    void forget() override { hasLast_ = false; }

    void prepare() override {
        constexpr double mostOutside = 2;
        const auto s = static_cast<Eigen::Index>(stages_);
        const double unit = dt() / hamiltonian().hbar();
        const auto& V = hamiltonian().potential();
        const auto [low, high] = std::minmax_element(V.begin(), V.end());
        const double most = std::max(std::abs(*low - shift()), std::abs(*high - shift())),
                     inside = std::abs(unit) * most > mostOutside ? (*low + *high) / 2 - shift() : 0;
        for (std::size_t j = 0; j < size_; ++j) rest_[j] = V[j] - shift() - inside;
        const Eigen::MatrixXd A = collocationMatrix(rule_);
        const Eigen::Map<const Eigen::RowVectorXd> b(rule_.b.data(), s);
        stageTable_.assign(2 * width_ * stages_ * (stages_ + 1), 0);
        endTable_.assign(2 * width_ * (stages_ + 1), 0);
        Eigen::MatrixXcd right(s, s + 1), all(s, s + 1), end(1, s + 1);
        right.col(0).setOnes();
        right.rightCols(s) = Complex(0, -unit) * A.cast<Complex>();
        const auto nx = static_cast<std::size_t>(hamiltonian().grid().nx);
        for (std::size_t k = 0; k < size_; ++k) {
            if (k % 512 == 0 && stop().stop_requested()) return;
            // Waves that run to the right and to the left have the same rows.
            const std::size_t column = k % nx, mirrored = k - column + (nx - column) % nx;
            if (mirrored < k && hamiltonian().kinetic()[mirrored] == hamiltonian().kinetic()[k]) {
                copyMode(mirrored, k, stages_, stageTable_);
                copyMode(mirrored, k, 1, endTable_);
                continue;
            }
            const Complex y(0, unit * (hamiltonian().kinetic()[k] + inside));
            const Eigen::MatrixXcd P = Eigen::MatrixXcd::Identity(s, s) + y * A.cast<Complex>();
            all = dense::inverse<Complex>(P) * right;
            end = -y * b.cast<Complex>() * all;
            end(0, 0) += 1.0;
            end.rightCols(s) += Complex(0, -unit) * b.cast<Complex>();
            write(all, k, stageTable_);
            write(end, k, endTable_);
        }
    }
    void write(const Eigen::MatrixXcd& rows, std::size_t mode, std::vector<double>& table) const {
        const std::size_t lane = mode % lanes;
        double* at = table.data() + (mode - lane) * 2 * static_cast<std::size_t>(rows.size()) + lane;
        for (Eigen::Index i = 0; i < rows.rows(); ++i)
            for (Eigen::Index j = 0; j < rows.cols(); ++j, at += 2 * lanes) {
                at[0] = rows(i, j).real();
                at[lanes] = rows(i, j).imag();
            }
    }
    void copyMode(std::size_t from, std::size_t to, std::size_t rows, std::vector<double>& table) const {
        const std::size_t numbers = 2 * rows * (stages_ + 1);  // of a mode
        const double* const source = table.data() + from / lanes * lanes * numbers + from % lanes;
        double* const target = table.data() + to / lanes * lanes * numbers + to % lanes;
        for (std::size_t i = 0; i < numbers * lanes; i += lanes) target[i] = source[i];
    }
    /// R of the next step by the polynomial through that of the last one.
    void guess() {
        if (!hasLast_) {
            std::fill(R_.begin(), R_.end(), 0.0);
            return;
        }
        last_.swap(R_);
        const std::size_t row = 2 * width_;
        for (std::size_t i = 0; i < stages_; ++i) {
            double* const to = R_.data() + i * row;
            std::fill_n(to, row, 0.0);
            for (std::size_t j = 0; j < stages_; ++j)
                addScaled(to, ahead_[i * stages_ + j], last_.data() + j * row, row);
        }
    }
    void step(double, Complex* v, std::vector<double>&, StepReport& report) override {
        static const auto combine = ForThisMachine<&combineLanes>::call();
        constexpr double stagnation = 1e-11;
        apart(v, v_.data());
        double norm = 0;
        ComplexVectors::ofThisMachine().square(v, size_, &norm);
        guess();
        hasLast_ = false;
        report.outcome = Outcome::diverged;
        double last = 0;
        for (int k = 0; k < maxIterations_; ++k) {
            if (stop().stop_requested()) {
                report.outcome = Outcome::stopped;
                return;
            }
            ++report.cost.iterations;
            combine(stageTable_.data(), stages_, stages_, width_, v_.data(), R_.data(), Psi_.data());
            const std::size_t nodes = fine_ ? fine_->size() : stages_;
            const double squares = evaluate();
            report.cost.evaluations += static_cast<long long>(nodes);
            const double change = std::sqrt(squares / (static_cast<double>(nodes) * norm));
            report.residual = change;
            if (!std::isfinite(change)) {
                report.outcome = Outcome::notFinite;
                return;
            }
            const bool stands = k > 1 && change >= last && change <= stagnation;
            if ((k > 0 && change <= tolerance_) || stands) {
                report.outcome = Outcome::converged;
                break;
            }
            last = change;
        }
        if (report.outcome != Outcome::converged) return;
        combine(endTable_.data(), 1, stages_, width_, v_.data(), R_.data(), Psi_.data());
        together(Psi_.data(), v);
        hasLast_ = true;
    }
    /// R of all stages from Psi; the square of the change of psi at the nodes, in the measure of
    /// coefficients.
    double evaluate() {
        double squares = 0;
        if (!fine_) {
            for (std::size_t i = 0; i < stages_; ++i)
                squares += evaluate(i, Psi_.data() + 2 * i * width_, R_.data() + 2 * i * width_);
            return squares;
        }
        const std::size_t row = 2 * width_;
        const auto mix = [&](std::vector<double>& out, std::size_t i, const double* from, std::size_t j,
                             double weight) {
            double* const to = out.data() + i * row;
            for (std::size_t m = 0; m < row; ++m) to[m] = (j == 0 ? 0 : to[m]) + weight * from[m];
        };
        for (std::size_t i = 0; i < fine_->size(); ++i) {
            for (std::size_t j = 0; j <= stages_; ++j)
                mix(finePsi_, i, j == 0 ? v_.data() : Psi_.data() + (j - 1) * row, j, fine_->values(i, j));
            squares += evaluate(i, finePsi_.data() + i * row, fineR_.data() + i * row);
        }
        for (std::size_t j = 0; j < stages_; ++j)
            for (std::size_t i = 0; i < fine_->size(); ++i)
                mix(R_, j, fineR_.data() + i * row, i, fine_->projection(j, i));
        return squares;
    }
    /// R at node i from psi there.
    double evaluate(std::size_t i, const double* Psi, double* R) {
        together(Psi, modes_.data());
        hamiltonian().fourier().rawToNodes(modes_.data(), psi_.data());
        const double scale = 1 / static_cast<double>(size_),
                     density = coupling_.g / hamiltonian().grid().measure();
        std::array<double, lanes> squares{};
        static const auto apply = ForThisMachine<&applyAtNodes>::call();
        apply({rest_.data(), density, scale, size_}, reinterpret_cast<double*>(psi_.data()),
              reinterpret_cast<double*>(nodes_.data() + i * size_), squares.data());
        if (turn_) turn_->add(modes_.data(), -coupling_.omega * scale, psi_.data());
        hamiltonian().fourier().rawToCoefficients(psi_.data(), modes_.data());
        apart(modes_.data(), R);
        return scale * std::accumulate(squares.begin(), squares.end(), 0.0);
    }
    void apart(const Complex* from, double* row) const {
        static const auto split = ForThisMachine<&splitParts>::call();
        split(reinterpret_cast<const double*>(from), width_, size_, row);
    }
    void together(const double* row, Complex* to) const {
        static const auto join = ForThisMachine<&joinParts>::call();
        join(row, width_, size_, reinterpret_cast<double*>(to));
    }

    Coupling coupling_;
    std::optional<AngularMomentum> turn_;
    Rule<double> rule_;
    std::vector<double> ahead_;  ///< from R at the nodes of a step to those of the next
    double tolerance_;
    int maxIterations_;
    std::size_t stages_, size_, width_;
    bool hasLast_ = false;
    std::optional<FineNodes> fine_;
    std::vector<double> fineR_, finePsi_;
    std::vector<double> stageTable_, endTable_;
    std::vector<double> v_, R_, last_, Psi_;
    std::vector<double> rest_;  ///< V - Ec - w at the nodes
    std::vector<Complex> nodes_, psi_, modes_;
};

}  // namespace

std::unique_ptr<WaveStep> makeInteractingWave(std::shared_ptr<const Hamiltonian> hamiltonian,
                                              Coupling coupling, double step, double shift, int degree,
                                              double tolerance, int maxIterations, InTime inTime) {
    return std::make_unique<InteractingWave>(std::move(hamiltonian), coupling, step, shift, degree, tolerance,
                                             maxIterations, inTime);
}

}  // namespace extremal
