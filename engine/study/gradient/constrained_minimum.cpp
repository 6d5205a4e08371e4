// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/gradient/constrained_minimum.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace extremal {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr int mostIterations = 200, mostProducts = 200;

class Search {
public:
    Search(const MinimumProblem& problem, const Minimum& from)
        : problem_(problem), u_(from.u), lambda_(from.multipliers) {}

    Minimum solve(const std::stop_token& stop) {
        if (!look()) return ended("the motion with the first controls cannot be computed");
        double slopeBefore = HUGE_VAL;
        for (made_.iterations = 0; made_.iterations < mostIterations; ++made_.iterations) {
            if (stop.stop_requested()) return ended("interrupted");
            if (!linearise())
                return ended(made_.atBounds > 0
                                 ? "no controls between these bounds are found that meet the end conditions"
                                 : "the end conditions cannot be met: their derivatives by "
                                   "the controls depend on each other");
            // Newton's steps go down by themselves until round-off of the gradient holds them.
            const bool isDone = isFound();
            if (isDone || (isNearlyFound() && made_.slope > slopeBefore / 2)) return ended({});
            slopeBefore = made_.slope;
            const Vector normal = toBounds_ - scaled(C_.transpose() * solveNormal(r_ + C_ * toBounds_));
            const Vector d = normal + tangential(normal);
            // Those of the quadratic programme, with which d lowers the sum that is searched along it.
            lambda_ -= solveNormal(C_ * scaled(slopeThere_));
            if (!(hasBounds() ? wholeStep(d) : lineSearch(d)))
                return ended(isNearlyFound() ? "" : "no lower cost can be found nearby");
        }
        return ended("no minimum after " + std::to_string(mostIterations) + " iterations");
    }

private:
    Minimum ended(const std::string& problem) {
        if (hasBounds()) u_ = u_.cwiseMax(problem_.lower).cwiseMin(problem_.upper);  // to round-off
        made_.u = u_;
        made_.multipliers = lambda_;
        made_.J = J_;
        made_.miss = r_.norm();
        made_.problem = problem;
        return made_;
    }
    bool look() {
        const bool isKnown = problem_.evaluate(u_, J_, r_) && std::isfinite(J_) && r_.allFinite();
        if (lambda_.size() != r_.size()) lambda_ = Vector::Zero(r_.size());
        return isKnown;
    }
    /// W^-1 v, of entries that are free.
    Vector scaled(const Vector& v) const { return free_.cwiseProduct(v.cwiseQuotient(problem_.metric)); }
    Vector solveNormal(const Vector& b) const { return b.size() > 0 ? Vector(factor_.solve(b)) : Vector(b); }
    /// v without its part along C^T, in W^-1.
    Vector projected(const Vector& v) const {
        Vector z = scaled(v);
        // Twice: what rounding leaves along C^T grows over many products.
        for (int i = 0; i < 2 && r_.size() > 0; ++i) z -= scaled(C_.transpose() * factor_.solve(C_ * z));
        return z;
    }
    bool linearise() {
        Matrix all;
        const Eigen::Index n = r_.size();
        if (!problem_.differentiate(Matrix::Identity(n + 1, n + 1), all)) return false;
        g_ = all.col(0);
        C_ = all.rightCols(n).transpose();
        findFree(g_ + C_.transpose() * lambda_);
        if (n == 0) return true;
        const Matrix normal = C_ * free_.cwiseQuotient(problem_.metric).asDiagonal() * C_.transpose();
        factor_.compute(normal);
        const Vector pivots = factor_.vectorD();
        constexpr double leastPart = 1e-14;
        if (!(pivots.minCoeff() > leastPart * pivots.maxCoeff())) return false;
        lambda_ = -factor_.solve(C_ * scaled(g_));
        return true;
    }
    bool hasBounds() const { return problem_.lower.size() > 0; }
    /// Entries that a step against the slope takes to a bound go there, whatever they are.
    void findFree(const Vector& slope) {
        free_ = Vector::Ones(u_.size());
        toBounds_ = Vector::Zero(u_.size());
        made_.atBounds = 0;
        if (!hasBounds()) return;
        for (Eigen::Index i = 0; i < u_.size(); ++i) {
            const double to = u_(i) - slope(i) / problem_.metric(i);
            if (to > problem_.lower(i) && to < problem_.upper(i)) continue;
            free_(i) = 0;
            toBounds_(i) = (to >= problem_.upper(i) ? problem_.upper(i) : problem_.lower(i)) - u_(i);
            ++made_.atBounds;
        }
    }
    bool isFound() {
        const Vector slope = g_ + C_.transpose() * lambda_;
        made_.slope = std::sqrt(std::max(0.0, slope.dot(scaled(slope))));
        const double size = std::sqrt(g_.dot(scaled(g_))) + 1e-300;
        // Where the cost itself is at its least, its slope is round-off: a step along it leads nowhere.
        const bool isStill = scaled(slope).cwiseAbs().maxCoeff() <= 1e-14 * (1 + u_.cwiseAbs().maxCoeff());
        return (made_.slope <= 1e-12 * size || isStill) && r_.norm() <= 1e-13 * (1 + rSize_) &&
               toBounds_.cwiseAbs().maxCoeff() <= 1e-12 * (1 + u_.cwiseAbs().maxCoeff());
    }
    bool isNearlyFound() const {
        const double size = std::sqrt(g_.dot(scaled(g_))) + 1e-300;
        return made_.slope <= 1e-7 * size && r_.norm() <= 1e-10 * (1 + rSize_) &&
               toBounds_.cwiseAbs().maxCoeff() <= 1e-10 * (1 + u_.cwiseAbs().maxCoeff());
    }
    /// d of the Lagrange function's gradient along d, by differences of order 2.
    bool product(const Vector& d, Vector& Hd) {
        constexpr double part = 1e-5;
        const double e = part * (1 + u_.cwiseAbs().maxCoeff()) / d.cwiseAbs().maxCoeff();
        Matrix weights(1 + lambda_.size(), 1), above, below;
        weights << 1, lambda_;
        double J = 0;
        Vector r;
        ++made_.products;
        if (!problem_.evaluate(u_ + e * d, J, r) || !problem_.differentiate(weights, above)) return false;
        if (!problem_.evaluate(u_ - e * d, J, r) || !problem_.differentiate(weights, below)) return false;
        Hd = (above - below) / (2 * e);
        return true;
    }
    /// Conjugate gradients on C d = 0 for (g + H n).d + d.H d / 2; as far as curvature is positive. Leaves
    /// g + C^T lambda + H (n + d) in slopeThere_.
    Vector tangential(const Vector& normal) {
        // Products with H are differences: what is smaller than their errors is not sought.
        constexpr double ofProducts = 1e-18;
        Vector d = Vector::Zero(u_.size()), Hp;
        Vector& residual = slopeThere_ = g_ + C_.transpose() * lambda_;
        double unseen = 0;
        if (normal.cwiseAbs().maxCoeff() > 0 && product(normal, Hp)) {
            residual += Hp;
            unseen = ofProducts * Hp.dot(scaled(Hp));
        }
        Vector z = projected(residual), p = -z;
        double rz = residual.dot(z);
        const double first = rz;
        // As exact as the step is near: Newton's method in the end, no waste before.
        const double wanted = std::max(first * std::min(1e-4, first), unseen);
        for (int i = 0; i < mostProducts && rz > std::max(wanted, 1e-28 * first) && rz > 0; ++i) {
            if (!product(p, Hp)) break;
            const double curvature = p.dot(Hp);
            if (!(curvature > 1e-10 * p.dot(p.cwiseProduct(problem_.metric)))) return i == 0 ? p : d;
            const double length = rz / curvature;
            d += length * p;
            residual += length * Hp;
            z = projected(residual);
            const double next = residual.dot(z);
            p = -z + next / rz * p;
            rz = next;
        }
        return d;
    }
    /// Between bounds: which entries are at them changes from step to step, and a sum that is to fall would
    /// not let it. Shortened only where there is no motion.
    bool wholeStep(const Vector& d) {
        constexpr double shortest = 1e-8;
        const Vector before = u_;
        rSize_ = std::max(rSize_, r_.norm());
        for (double length = 1; length >= shortest; length /= 2) {
            u_ = before + length * d;
            if (look()) return (u_ - before).cwiseAbs().maxCoeff() > 1e-15 * (1 + u_.cwiseAbs().maxCoeff());
        }
        u_ = before;
        look();
        return false;
    }
    bool lineSearch(const Vector& d) {
        constexpr double shortest = 1e-8;
        const Vector before = u_, missBefore = r_;
        const double JBefore = J_;
        rSize_ = std::max(rSize_, r_.norm());
        // The penalty for which d lowers the sum: its slope along d is -rho |r|^2 + (g + C^T lambda).d.
        const double slope = (g_ + C_.transpose() * lambda_).dot(d), miss = r_.squaredNorm();
        if (miss > 0) penalty_ = std::max(penalty_, 2 * std::max(0.0, slope) / miss);
        const auto merit = [&](double J, const Vector& r) {
            return J + lambda_.dot(r) + penalty_ / 2 * r.squaredNorm();
        };
        const double from = merit(JBefore, missBefore),
                     rounding = 1e-14 * (std::abs(JBefore) + std::abs(lambda_.dot(missBefore)) + 1e-300);
        for (double length = 1; length >= shortest; length /= 2) {
            u_ = before + length * d;
            if (look() && merit(J_, r_) <= from - 1e-4 * length * (penalty_ * miss - slope) + rounding) {
                const double change = (u_ - before).cwiseAbs().maxCoeff();
                return change > 1e-15 * (1 + before.cwiseAbs().maxCoeff());
            }
        }
        u_ = before;
        look();
        return false;
    }

    const MinimumProblem& problem_;
    Vector u_, lambda_, r_, g_, free_, toBounds_, slopeThere_;
    Matrix C_;
    Eigen::LDLT<Matrix> factor_;
    double J_ = 0, penalty_ = 1, rSize_ = 0;
    Minimum made_;
};

}  // namespace

Minimum constrainedMinimum(const MinimumProblem& problem, const Minimum& from, const std::stop_token& stop) {
    return Search(problem, from).solve(stop);
}

}  // namespace extremal
