// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/oscillator_step.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/memo_cache.hpp"
#include "engine/core/work.hpp"

namespace extremal {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
/// Half the trace is known to this much in quadruple precision; a growth of 4e-13.
constexpr double traceSlack = 1e-25;
/// Edges that touch are opened by rounding: of entries in double precision to about the root of it.
constexpr double leastOfQuadruple = 1e-12, leastOfRounded = 1e-7;
/// Where M is singular, as with s Gauss nodes, rounding its entries moves the roots at infinity to about 1e7.
constexpr double farthest = 1e4;

using Index = Eigen::Index;
using Real = Eigen::MatrixXd;

/// 1/z^2 of all eigenvalues; those that are not real are no stationary functions, but two that lie closer
/// than round-off may come out as a complex pair, and what is between candidates is looked at anyway.
void collectRoots(const Real& inverseSquares, std::vector<double>& roots) {
    if (inverseSquares.size() == 0 || !inverseSquares.allFinite()) return;
    for (const std::complex<double>& value : dense::eigenvalues(inverseSquares)) {
        if (!(value.real() > 0) || std::abs(value.imag()) > 1e-5 * value.real()) continue;
        const double z = 1 / std::sqrt(value.real());
        if (z < farthest) roots.push_back(z);
    }
}

/// Functions with q_1 = -q_0, in place of the first and the last.
Real antiperiodic(const Real& A) {
    const Index m = A.rows() - 1;
    Real closed = A.topLeftCorner(m, m);
    closed.row(0) -= A.row(m).head(m);
    closed.col(0) -= A.col(m).head(m);
    closed(0, 0) += A(m, m);
    return closed;
}

/// Stationary functions of an action. A periodic one is a constant, with the coefficients e, times c and a
/// function y that starts at 0; varying c gives c = -e^T M y / e^T M e, and leaves M - (M e)(M e)^T / e^T M
/// e. The stiffness of a constant is 0.
std::vector<double> rootsOf(const OscillatorAction& action, const Eigen::VectorXd& constant) {
    std::vector<double> roots;
    collectRoots(dense::solve<double>(antiperiodic(action.stiffness), antiperiodic(action.mass)), roots);
    const Index inside = action.stiffness.rows() - 2;
    if (inside == 0) return roots;
    const Eigen::VectorXd ofConstant = action.mass * constant;
    const Eigen::VectorXd mean = ofConstant.segment(1, inside);
    const Real K = action.stiffness.block(1, 1, inside, inside);
    const Real M =
        action.mass.block(1, 1, inside, inside) - mean * mean.transpose() / constant.dot(ofConstant);
    collectRoots(dense::solve<double>(K, M), roots);
    return roots;
}

/// The function 1: 1 where parts meet and at the ends, 0 in the functions inside.
Eigen::VectorXd nodesOf(Index perPart, std::size_t parts) {
    Eigen::VectorXd one = Eigen::VectorXd::Zero(perPart * static_cast<Index>(parts) + 1);
    for (std::size_t i = 0; i <= parts; ++i) one(perPart * static_cast<Index>(i)) = 1;
    return one;
}

std::vector<double> rootsOf(const Tableau& t) {
    const Real A = t.A.cast<double>(), Ahat = t.Ahat.cast<double>();
    const Eigen::VectorXd b = t.b.cast<double>(), bHat = t.bHat.cast<double>();
    const Eigen::VectorXd ofV = Eigen::VectorXd::Ones(b.size()), ofF = Eigen::VectorXd::Ones(bHat.size());
    std::vector<double> roots;
    const Real forth = A - ofF * (bHat.transpose() * A);
    const Real back = Ahat - ofV * (b.transpose() * Ahat);
    collectRoots(-(forth * back), roots);
    const Real halfForth = A - ofF * b.transpose() / 2, halfBack = Ahat - ofV * bHat.transpose() / 2;
    collectRoots(-(halfForth * halfBack), roots);
    return roots;
}

}  // namespace

OscillatorStep::OscillatorStep(const OscillatorAction& action)
    : stiffness_(action.stiffness.cast<Quad>()), mass_(action.mass.cast<Quad>()), isRounded_(true) {}

OscillatorStep::OscillatorStep(Matrix stiffness, Matrix mass)
    : stiffness_(std::move(stiffness)), mass_(std::move(mass)) {}

OscillatorStep::OscillatorStep(std::shared_ptr<const Tableau> tableau)
    : tableau_(std::move(tableau)), forth_(tableau_->A * tableau_->Ahat) {
    const auto stages = static_cast<double>(forth_.rows());
    work::spend(work::quadruple * stages * stages * stages);
}

OscillatorStep OscillatorStep::composed(std::vector<double> parts) const {
    OscillatorStep whole = *this;
    whole.parts_ = std::move(parts);
    return whole;
}

/// Of (q, p), over one part as a step of length 1.
Eigen::Matrix<Quad, 2, 2> OscillatorStep::partMap(const Quad& square) const {
    Eigen::Matrix<Quad, 2, 2> map;
    if (tableau_) {
        const Index n = forth_.rows();
        const auto stages = static_cast<double>(n);
        work::spend(work::quadruple * stages * stages * stages / 3);
        Matrix rhs(n, 2);
        rhs.col(0).setOnes();
        rhs.col(1) = tableau_->A.rowwise().sum();
        const Matrix Q = dense::solve<Quad>(Matrix::Identity(n, n) + square * forth_, rhs);
        Matrix P = -square * (tableau_->Ahat * Q);
        P.col(1).array() += Quad(1);
        map.row(0) = tableau_->b.transpose() * P;
        map.row(1) = -square * (tableau_->bHat.transpose() * Q);
        map(0, 0) += 1;
        map(1, 1) += 1;
        return map;
    }
    const Index m = stiffness_.rows() - 1;
    const auto size = static_cast<double>(m);
    work::spend(work::quadruple * size * size * size / 3);
    const Matrix A = stiffness_ - square * mass_;
    Matrix rhs = Matrix::Zero(m, 2);
    rhs.col(0) = -A.col(0).head(m);
    rhs(0, 1) = -1;
    const Matrix y = dense::solve<Quad>(A.topRightCorner(m, m), rhs);
    map.row(0) = y.row(m - 1);
    map.row(1) = A.row(m).tail(m) * y;
    map(1, 0) += A(m, 0);
    return map;
}

Quad OscillatorStep::halfTrace(double z) const {
    Eigen::Matrix<Quad, 2, 2> whole = Eigen::Matrix<Quad, 2, 2>::Identity();
    for (const double part : parts_) {
        const Quad g(part), length = g * Quad(z);
        Eigen::Matrix<Quad, 2, 2> map = partMap(length * length);
        map(0, 1) *= g;
        map(1, 0) /= g;
        whole = (map * whole).eval();
    }
    return (whole(0, 0) + whole(1, 1)) / 2;
}

double OscillatorStep::growth(double z) const {
    const Quad half = halfTrace(z);
    if (!(abs(half) <= 1e300)) return unbounded;
    const Quad beyond = abs(half) - 1;
    if (beyond <= traceSlack) return 0;
    const double x = static_cast<double>(beyond);
    return std::log1p(x + std::sqrt(x) * std::sqrt(x + 2));
}

Eigen::Index OscillatorStep::unknowns() const {
    return static_cast<Index>(parts_.size()) * (tableau_ ? tableau_->forces() : stiffness_.rows() - 1);
}

/// Parts share the value where they meet; a part of length g has the stiffness K / g and the mass g M.
OscillatorAction OscillatorStep::assembled() const {
    const Real K = stiffness_.cast<double>(), M = mass_.cast<double>();
    const Index m = K.rows() - 1, size = m * static_cast<Index>(parts_.size()) + 1;
    OscillatorAction whole{Real::Zero(size, size), Real::Zero(size, size)};
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const Index at = m * static_cast<Index>(i);
        whole.stiffness.block(at, at, m + 1, m + 1) += K / parts_[i];
        whole.mass.block(at, at, m + 1, m + 1) += M * parts_[i];
    }
    return whole;
}

std::vector<double> OscillatorStep::candidates() const {
    std::vector<double> roots;
    if (!tableau_)
        roots = rootsOf(assembled(), nodesOf(stiffness_.rows() - 1, parts_.size()));
    else if (parts_.size() == 1)
        roots = rootsOf(*tableau_);
    else
        roots = rootsOf(extremal::composed(*tableau_, {parts_.begin(), parts_.end()}));
    std::sort(roots.begin(), roots.end());
    roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
    return roots;
}

namespace {

/// |half trace| - 1, whose sign decides; infinity where the step is singular.
double excess(const OscillatorStep& step, double z) {
    const Quad half = step.halfTrace(z);
    return abs(half) <= 1e300 ? static_cast<double>(abs(half) - 1) : unbounded;
}

/// Between a stable and an unstable place, to round-off: by false position (Illinois), and by bisection where
/// that gains nothing. `near`: the eigenvalue.
double edgeBetween(const OscillatorStep& step, double stable, double unstable, double near) {
    for (const double margin : {1e-12, 1e-9, 1e-6}) {
        const double side = stable < unstable ? 1 - margin : 1 + margin, other = 2 - side;
        const double s = near * side, u = near * other;
        if ((s - stable) * (unstable - s) <= 0 || (u - stable) * (unstable - u) <= 0) continue;
        if (step.growth(s) > 0 || !(step.growth(u) > 0)) continue;
        stable = s;
        unstable = u;
        break;
    }
    double atStable = std::min(excess(step, stable), -traceSlack), atUnstable = excess(step, unstable);
    for (int turn = 0;; ++turn) {
        const double middle = stable + (unstable - stable) / 2;
        if (middle == stable || middle == unstable) return stable;
        double next = unstable - atUnstable * (unstable - stable) / (atUnstable - atStable);
        if (turn % 4 == 3 || !((next - stable) * (unstable - next) > 0)) next = middle;
        const double here = excess(step, next);
        if (here > traceSlack) {
            unstable = next;
            atUnstable = here;
            atStable /= 2;
        } else {
            stable = next;
            atStable = std::min(here, -traceSlack);
            atUnstable /= 2;
        }
    }
}

/// Its maximum, where half the trace keeps its sign and has no pole.
double largestGrowth(const OscillatorStep& step, double low, double high) {
    constexpr int parts = 12;
    const auto at = [&](double i) { return low + (high - low) * i / parts; };
    double best = 0, place = parts / 2.0;
    bool isPositive = false;
    for (int i = 1; i < parts; ++i) {
        const Quad half = step.halfTrace(at(i));
        if (!(abs(half) <= 1e300) || (i > 1 && (half > 0) != isPositive)) return unbounded;
        isPositive = half > 0;
        if (const double g = step.growth(at(i)); g > best) {
            best = g;
            place = i;
        }
    }
    constexpr double golden = 0.6180339887498949;
    double a = place - 1, b = place + 1;
    double left = b - golden * (b - a), right = a + golden * (b - a);
    double ofLeft = step.growth(at(left)), ofRight = step.growth(at(right));
    for (int i = 0; i < 16; ++i) {
        if (ofLeft > ofRight) {
            b = right;
            right = left;
            ofRight = ofLeft;
            left = b - golden * (b - a);
            ofLeft = step.growth(at(left));
        } else {
            a = left;
            left = right;
            ofLeft = ofRight;
            right = a + golden * (b - a);
            ofRight = step.growth(at(right));
        }
    }
    return std::max({best, ofLeft, ofRight});
}

}  // namespace

std::vector<UnstableInterval> OscillatorStep::intervals() const {
    const double leastGrowth = isRounded_ ? leastOfRounded : leastOfQuadruple;
    const std::vector<double> roots = candidates();
    std::vector<double> middle;
    for (std::size_t i = 0; i <= roots.size(); ++i) {
        const double below = i == 0 ? 0 : roots[i - 1];
        middle.push_back(i < roots.size() ? below + (roots[i] - below) / 2 : 2 * below + 1);
    }
    std::vector<UnstableInterval> found;
    for (std::size_t i = 0; i < middle.size();) {
        if (!(growth(middle[i]) > 0)) {
            ++i;
            continue;
        }
        std::size_t last = i;
        while (last + 1 < middle.size() && growth(middle[last + 1]) > 0) ++last;
        // Both ends within round-off of each other, and nothing to be seen in the middle.
        if (last == i && growth(middle[i]) < leastGrowth / 8) {
            ++i;
            continue;
        }
        UnstableInterval interval{0, unbounded, unbounded};
        if (i > 0) interval.low = edgeBetween(*this, middle[i - 1], middle[i], roots[i - 1]);
        if (last + 1 < middle.size()) {
            interval.high = edgeBetween(*this, middle[last + 1], middle[last], roots[last]);
            interval.growth = largestGrowth(*this, interval.low, interval.high);
        }
        if (interval.growth >= leastGrowth) found.push_back(interval);
        i = last + 1;
    }
    return found;
}

double firstEdge(const std::vector<UnstableInterval>& intervals) {
    return intervals.empty() ? unbounded : intervals.front().low;
}

double stabilityLimit(const Splitting& splitting) {
    static MemoCache<std::vector<SplittingStage>, double> known(64);
    return known.get(splitting.stages, [&] {
        // Fractions are printed to 15 digits.
        return firstEdge(OscillatorStep(tableauOf(splitting.stages, 1e-15)).intervals());
    });
}

}  // namespace extremal
