// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/first_order/one_form.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "engine/core/algebra/lu.hpp"
#include "engine/core/corrections.hpp"
#include "engine/core/own_buffers.hpp"

namespace extremal {
namespace {

constexpr double singularForm = 1e-13;  // pivots of Om, relative

bool isSingular(const Eigen::PartialPivLU<Eigen::MatrixXd>& lu) {
    const auto pivots = lu.matrixLU().diagonal().cwiseAbs();
    return !(pivots.minCoeff() > singularForm * pivots.maxCoeff());
}

struct FormFlow {
    OneForm of;
    long long id;
};

/// (q, p) -> y and the derivatives of H~.
class Canonical {
public:
    using Vector = Eigen::VectorXd;
    using Matrix = Eigen::MatrixXd;

    explicit Canonical(const OneForm& of)
        : of_(of),
          n_(static_cast<int>(of.places.size())),
          m_(static_cast<std::size_t>(of.variables)),
          lu_(n_),
          schur_(2 * n_) {
        x_ = theta_ = slope_ = Vector::Zero(of.variables);
        guess_ = y_ = V_ = r_ = Vector::Zero(n_);
        slopes_.assign(m_ * m_, 0);
        curvatures_.assign(m_ * m_ * m_, 0);
        Py_ = Pq_ = Matrix::Zero(n_, n_);
        second_ = Matrix::Zero(of.variables, of.variables);
        inner_ = Matrix::Zero(2 * n_, 2 * n_);
        mixed_ = Matrix::Zero(2 * n_, 2 * n_);
    }

    void setGuess(const double* y) { std::copy_n(y, n_, guess_.data()); }

    /// P(q, y) = p for y_, from the guess.
    bool solve(const double* q, const double* p) {
        y_ = guess_;
        StepReport report;
        const CorrectionLimits limits{.last = 2 * CorrectionLimits::epsilon, .roundOff = 1e-12};
        const Outcome outcome = solveByCorrections(limits, {}, report, [&](int, double) {
            place(q);
            of_.form(of_.planeModel(), x_.data(), theta_.data(), slopes_.data(), nullptr);
            split();
            for (int j = 0; j < n_; ++j) r_(j) = theta_(at(of_.places, j)) - p[j];
            lu_.compute(Py_);
            if (!r_.allFinite() || !Py_.allFinite() || isSingular(lu_))
                return Correction{.outcome = Outcome::singular};
            r_ = lu_.solve(r_);
            y_ -= r_;
            double size = 0;  // of each by itself
            for (int j = 0; j < n_; ++j)
                size = std::max(size, std::abs(r_(j)) / std::max(std::abs(y_(j)), 1e-300));
            return Correction{size, 1};
        });
        const bool isNear = outcome == Outcome::diverged && report.residual < 1e-10;
        return isNear || (outcome == Outcome::converged && y_.allFinite());
    }
    const Vector& y() const { return y_; }

    /// (d/dq, d/dp) of H~ at y_.
    void gradient(const double* q, double* g) {
        derivatives(q, nullptr);
        for (int l = 0; l < n_; ++l) {
            double sum = slope_(at(of_.places, l));
            for (int j = 0; j < n_; ++j) sum -= Pq_(j, l) * V_(j);
            g[l] = sum;
            g[n_ + l] = V_(l);
        }
    }
    /// 2n x 2n.
    void hessian(const double* q, double* to) {
        derivatives(q, curvatures_.data());
        // F'' = H'' - sum_j V_j theta_j'', in x.
        for (int j = 0; j < n_; ++j) {
            const auto row = static_cast<std::size_t>(of_.places[static_cast<std::size_t>(j)]);
            for (std::size_t k = 0; k < m_; ++k)
                for (std::size_t l = 0; l < m_; ++l)
                    second_(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l)) -=
                        V_(j) * curvatures_[(row * m_ + k) * m_ + l];
        }
        inner_.setZero();
        mixed_.setZero();  // rows (y, V), columns (q, p)
        for (int a = 0; a < n_; ++a)
            for (int b = 0; b < n_; ++b) {
                inner_(a, b) = second_(at(of_.free, a), at(of_.free, b));
                inner_(a, n_ + b) = -Py_(b, a);
                inner_(n_ + a, b) = -Py_(a, b);
                mixed_(a, b) = second_(at(of_.free, a), at(of_.places, b));
                mixed_(n_ + a, b) = -Pq_(a, b);
            }
        for (int a = 0; a < n_; ++a) mixed_(n_ + a, n_ + a) = 1;
        schur_.compute(inner_);
        Eigen::Map<Matrix> H(to, 2 * n_, 2 * n_);
        H.noalias() = -(mixed_.transpose() * schur_.solve(mixed_));
        for (int a = 0; a < n_; ++a)
            for (int b = 0; b < n_; ++b) H(a, b) += second_(at(of_.places, a), at(of_.places, b));
    }
    double energy(const double* q) {
        place(q);
        double value = 0;
        of_.energy(of_.model.get(), x_.data(), &value, nullptr, nullptr);
        return value;
    }

private:
    static int at(const std::vector<int>& list, int i) { return list[static_cast<std::size_t>(i)]; }

    void place(const double* q) {
        for (int j = 0; j < n_; ++j) {
            x_(at(of_.places, j)) = q[j];
            x_(at(of_.free, j)) = y_(j);
        }
    }
    void split() {
        for (int j = 0; j < n_; ++j)
            for (int k = 0; k < n_; ++k) {
                const auto row = static_cast<std::size_t>(at(of_.places, j)) * m_;
                Pq_(j, k) = slopes_[row + static_cast<std::size_t>(at(of_.places, k))];
                Py_(j, k) = slopes_[row + static_cast<std::size_t>(at(of_.free, k))];
            }
    }
    /// P_y, P_q, V = P_y^{-T} H_y, and the derivatives of H, at (q, y_).
    void derivatives(const double* q, double* curvatures) {
        place(q);
        of_.form(of_.planeModel(), x_.data(), theta_.data(), slopes_.data(), curvatures);
        split();
        double value = 0;
        of_.energy(of_.model.get(), x_.data(), &value, slope_.data(), curvatures ? second_.data() : nullptr);
        lu_.compute(Py_);
        for (int j = 0; j < n_; ++j) r_(j) = slope_(at(of_.free, j));
        V_ = lu_.transpose().solve(r_);
    }

    OneForm of_;
    int n_;
    std::size_t m_;
    Vector x_, theta_, slope_, guess_, y_, V_, r_;
    std::vector<double> slopes_, curvatures_;
    Matrix Py_, Pq_, second_, inner_, mixed_;
    Eigen::PartialPivLU<Matrix> lu_, schur_;
};

Canonical& ownCanonical(const void* model) {
    const auto& flow = *static_cast<const FormFlow*>(model);
    return ownBuffers<Canonical>(flow.id, flow.of);
}

double canonicalEnergy(const void* model, double, const double* q, const double* p) {
    Canonical& own = ownCanonical(model);
    return own.solve(q, p) ? own.energy(q) : std::numeric_limits<double>::quiet_NaN();
}
void canonicalGradient(const void* model, double, const double* q, const double* p, double* gradient) {
    const auto n = 2 * static_cast<const FormFlow*>(model)->of.places.size();
    Canonical& own = ownCanonical(model);
    if (own.solve(q, p))
        own.gradient(q, gradient);
    else
        std::fill_n(gradient, n, std::numeric_limits<double>::quiet_NaN());
}
void canonicalHessian(const void* model, double, const double* q, const double* p, double* hessian) {
    const auto n = 2 * static_cast<const FormFlow*>(model)->of.places.size();
    Canonical& own = ownCanonical(model);
    if (own.solve(q, p))
        own.hessian(q, hessian);
    else
        std::fill_n(hessian, n * n, std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

OneFormEquations::OneFormEquations(const OneForm& of) : of_(of) {
    const auto m = static_cast<std::size_t>(of.variables);
    theta_ = gradient_ = rate_ = Eigen::VectorXd::Zero(of.variables);
    form_ = hessian_ = jacobian_ = Eigen::MatrixXd::Zero(of.variables, of.variables);
    slopes_.assign(m * m, 0);
    curvatures_.assign(m * m * m, 0);
}

const Eigen::MatrixXd& OneFormEquations::form(const double* x) {
    of_.form(of_.model.get(), x, theta_.data(), slopes_.data(), nullptr);
    const Eigen::Map<const Eigen::MatrixXd> byVariable(slopes_.data(), of_.variables, of_.variables);
    form_ = byVariable - byVariable.transpose();  // column i holds the slopes of theta_i
    return form_;
}

bool OneFormEquations::rate(const double* x, double* dx) {
    double value = 0;
    form(x);
    of_.energy(of_.model.get(), x, &value, gradient_.data(), nullptr);
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(form_);
    if (!form_.allFinite() || isSingular(lu)) return false;
    Eigen::Map<Eigen::VectorXd>(dx, of_.variables) = lu.solve(gradient_);
    return true;
}

const Eigen::MatrixXd* OneFormEquations::jacobian(const double* x) {
    const auto m = static_cast<std::size_t>(of_.variables);
    double value = 0;
    of_.form(of_.model.get(), x, theta_.data(), slopes_.data(), curvatures_.data());
    const Eigen::Map<const Eigen::MatrixXd> byVariable(slopes_.data(), of_.variables, of_.variables);
    form_ = byVariable - byVariable.transpose();
    of_.energy(of_.model.get(), x, &value, gradient_.data(), hessian_.data());
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(form_);
    if (!form_.allFinite() || isSingular(lu)) return nullptr;
    rate_ = lu.solve(gradient_);
    // Om f = grad H, differentiated by x_k: Om f_k = H_k - (d_k Om) f.
    for (std::size_t k = 0; k < m; ++k)
        for (std::size_t i = 0; i < m; ++i) {
            double sum = hessian_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
            for (std::size_t j = 0; j < m; ++j)
                sum -= (curvatures_[(j * m + i) * m + k] - curvatures_[(i * m + j) * m + k]) *
                       rate_(static_cast<Eigen::Index>(j));
            jacobian_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = sum;
        }
    jacobian_ = lu.solve(jacobian_).eval();
    return &jacobian_;
}

FirstOrder firstOrderOf(const OneForm& of) { return firstOrderBy<OneFormEquations>(of); }

PhaseMechanics canonicalOf(const OneForm& of) {
    PhaseMechanics made;
    made.dimension = static_cast<int>(of.places.size());
    made.model = std::make_shared<const FormFlow>(FormFlow{of, nextModelId()});
    made.energy = canonicalEnergy;
    made.gradient = canonicalGradient;
    made.hessian = canonicalHessian;
    return made;
}

void setGuess(const PhaseMechanics& canonical, const double* y) {
    ownCanonical(canonical.model.get()).setGuess(y);
}

bool freeVariables(const PhaseMechanics& canonical, const double* q, const double* p, double* y) {
    Canonical& own = ownCanonical(canonical.model.get());
    if (!own.solve(q, p)) return false;
    std::copy(own.y().begin(), own.y().end(), y);
    return true;
}

}  // namespace extremal
