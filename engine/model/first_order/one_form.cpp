// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/first_order/one_form.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/algebra/lu.hpp"
#include "engine/core/corrections.hpp"
#include "engine/core/own_buffers.hpp"
#include "engine/model/typed/tape/node_tape.hpp"

namespace extremal {
namespace {

constexpr double singularForm = 1e-13;  // pivots of Om, relative

bool isSingular(const Eigen::PartialPivLU<Eigen::MatrixXd>& lu) {
    const auto pivots = lu.matrixLU().diagonal().cwiseAbs();
    return !(pivots.minCoeff() > singularForm * pivots.maxCoeff());
}

int at(const std::vector<int>& list, int i) { return list[static_cast<std::size_t>(i)]; }

/// P = c + B q + A y.
struct AffineMomenta {
    Eigen::VectorXd constant;
    Eigen::MatrixXd ofPlaces, ofFree, toFree;  ///< B, A, A^{-1}

    explicit AffineMomenta(const OneForm& of) {
        const int n = static_cast<int>(of.places.size());
        const auto m = static_cast<std::size_t>(of.variables);
        std::vector<double> theta(m), slopes(m * m);
        const std::vector<double> origin(m, 0.0);
        of.form(of.planeModel(), origin.data(), theta.data(), slopes.data(), nullptr);
        constant = Eigen::VectorXd::Zero(n);
        ofPlaces = ofFree = Eigen::MatrixXd::Zero(n, n);
        for (int j = 0; j < n; ++j) {
            const auto row = static_cast<std::size_t>(at(of.places, j));
            constant(j) = theta[row];
            for (int k = 0; k < n; ++k) {
                ofPlaces(j, k) = slopes[row * m + static_cast<std::size_t>(at(of.places, k))];
                ofFree(j, k) = slopes[row * m + static_cast<std::size_t>(at(of.free, k))];
            }
        }
        toFree = dense::inverse<double>(ofFree);
    }
};

struct FormFlow {
    OneForm of;
    std::optional<AffineMomenta> affine;
    long long id;
};

/// (q, p) -> y and the derivatives of H~.
class Canonical {
public:
    using Vector = Eigen::VectorXd;
    using Matrix = Eigen::MatrixXd;

    explicit Canonical(const FormFlow& flow)
        : of_(flow.of),
          affine_(flow.affine),
          n_(static_cast<int>(of_.places.size())),
          m_(static_cast<std::size_t>(of_.variables)),
          lu_(n_),
          schur_(2 * n_) {
        x_ = theta_ = slope_ = Vector::Zero(of_.variables);
        guess_ = y_ = V_ = r_ = Vector::Zero(n_);
        slopes_.assign(m_ * m_, 0);
        curvatures_.assign(m_ * m_ * m_, 0);
        Py_ = Pq_ = Matrix::Zero(n_, n_);
        second_ = Matrix::Zero(of_.variables, of_.variables);
        inner_ = Matrix::Zero(2 * n_, 2 * n_);
        mixed_ = Matrix::Zero(2 * n_, 2 * n_);
        if (!affine_) return;
        Py_ = affine_->ofFree;
        Pq_ = affine_->ofPlaces;
    }

    void setGuess(const double* y) { std::copy_n(y, n_, guess_.data()); }

    /// P(q, y) = p for y_.
    bool solve(const double* q, const double* p) {
        if (!affine_) return solveFromGuess(q, p);
        r_ = Eigen::Map<const Vector>(p, n_) - affine_->constant;
        r_.noalias() -= Pq_.lazyProduct(Eigen::Map<const Vector>(q, n_));
        y_.noalias() = affine_->toFree.lazyProduct(r_);
        return true;
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
    /// By Newton's method.
    bool solveFromGuess(const double* q, const double* p) {
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
        double value = 0;
        of_.energy(of_.model.get(), x_.data(), &value, slope_.data(), curvatures ? second_.data() : nullptr);
        for (int j = 0; j < n_; ++j) r_(j) = slope_(at(of_.free, j));
        if (affine_) {
            V_.noalias() = affine_->toFree.transpose().lazyProduct(r_);
            return;
        }
        of_.form(of_.planeModel(), x_.data(), theta_.data(), slopes_.data(), curvatures);
        split();
        lu_.compute(Py_);
        V_ = lu_.transpose().solve(r_);
    }

    OneForm of_;
    std::optional<AffineMomenta> affine_;
    int n_;
    std::size_t m_;
    Vector x_, theta_, slope_, guess_, y_, V_, r_;
    std::vector<double> slopes_, curvatures_;
    Matrix Py_, Pq_, second_, inner_, mixed_;
    Eigen::PartialPivLU<Matrix> lu_, schur_;
};

Canonical& ownCanonical(const void* model) {
    const auto& flow = *static_cast<const FormFlow*>(model);
    return ownBuffers<Canonical>(flow.id, flow);
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

void canonicalGradients(const void* model, const double*, int nodes, const double* q, const double* p,
                        double* gradients) {
    static_cast<const FormFlow*>(model)->of.together->evaluate(nodes, q, p, gradients);
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
    std::optional<AffineMomenta> affine;
    if (of.isAffine) affine.emplace(of);
    if (affine && of.together) made.gradients = canonicalGradients;
    made.model = std::make_shared<const FormFlow>(FormFlow{of, std::move(affine), nextModelId()});
    made.energy = canonicalEnergy;
    made.gradient = canonicalGradient;
    made.hessian = canonicalHessian;
    return made;
}

std::shared_ptr<const typed::NodeTape> canonicalTape(
    const OneForm& of,
    const std::function<typed::GraphFunction(typed::Graph& to, const std::vector<int>& variables)>& energy) {
    constexpr int few = 32;  // more of them fill the registers of one node alone
    if (!of.isAffine || of.variables > few) return nullptr;
    const AffineMomenta P(of);
    const int n = static_cast<int>(of.places.size());
    typed::Graph graph;
    std::vector<typed::Graph::Operand> terms;
    // y = A^{-1} (p - c - B q)
    std::vector<int> x(static_cast<std::size_t>(of.variables)), rest, roots;
    for (int j = 0; j < n; ++j) {
        terms = {{graph.symbol(n + j)}};
        for (int k = 0; k < n; ++k) terms.push_back({graph.symbol(k), -P.ofPlaces(j, k)});
        rest.push_back(graph.sum(-P.constant(j), terms));
        x[static_cast<std::size_t>(at(of.places, j))] = graph.symbol(j);
    }
    const auto sum = [&](int start, const auto& factor, const std::vector<int>& nodes) {
        terms.clear();
        if (start >= 0) terms.push_back({start});
        for (int k = 0; k < n; ++k) terms.push_back({at(nodes, k), factor(k)});
        return graph.sum(0, terms);
    };
    for (int j = 0; j < n; ++j)
        x[static_cast<std::size_t>(at(of.free, j))] = sum(
            -1, [&](int k) { return P.toFree(j, k); }, rest);
    // V = A^{-T} H_y, and H_q - B^T V
    const std::vector<int> slope = energy(graph, x).gradient;
    std::vector<int> ofFree, V;
    for (int j = 0; j < n; ++j) ofFree.push_back(at(slope, at(of.free, j)));
    for (int j = 0; j < n; ++j)
        V.push_back(sum(
            -1, [&](int k) { return P.toFree(k, j); }, ofFree));
    for (int j = 0; j < n; ++j)
        roots.push_back(sum(
            at(slope, at(of.places, j)), [&](int k) { return -P.ofPlaces(k, j); }, V));
    roots.insert(roots.end(), V.begin(), V.end());
    return std::make_shared<const typed::NodeTape>(graph, roots, n);
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
