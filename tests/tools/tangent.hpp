// SPDX-License-Identifier: GPL-3.0-or-later
/// Tangent maps of steps, as the scheme gives them (Integrator::applyTangent) and by central differences of
/// order 6, in the same coordinates.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "engine/family/lie/lie_groups.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/integrator/variation/transposed_step.hpp"
#include "engine/model/symplectic_form.hpp"
#include "tests/tools/jacobian.hpp"

namespace extremal {

/// From one state to another near it, in the coordinates of variations.
class NearbyStates {
public:
    explicit NearbyStates(const System& system) : system_(system) {}

    State displaced(const State& from, const Eigen::VectorXd& by) const {
        State to = from;
        const auto n = static_cast<std::size_t>(by.size());
        if (system_.parts.find<Body>()) {
            if (n == 6) place<RotationGroup<double>>(to, by);
            if (n == 12) place<MotionGroup<double>>(to, by);
        } else {
            for (std::size_t i = 0; i < n; ++i) to.x[at(i, n)] += by(static_cast<Eigen::Index>(i));
        }
        return to;
    }
    Eigen::VectorXd difference(const State& from, const State& to, std::size_t n) const {
        Eigen::VectorXd v(static_cast<Eigen::Index>(n));
        if (system_.parts.find<Body>()) {
            if (n == 6) v = between<RotationGroup<double>>(from, to);
            if (n == 12) v = between<MotionGroup<double>>(from, to);
        } else {
            for (std::size_t i = 0; i < n; ++i)
                v(static_cast<Eigen::Index>(i)) = to.x[at(i, n)] - from.x[at(i, n)];
        }
        return v;
    }

private:
    /// Of wave functions real and imaginary parts take turns in a state.
    std::size_t at(std::size_t i, std::size_t n) const {
        if (!system_.parts.find<Wave>()) return i;
        return i < n / 2 ? 2 * i : 2 * (i - n / 2) + 1;
    }
    template <class G>
    static void place(State& state, const Eigen::VectorXd& by) {
        const Pose<double> pose = G::read(state.x.data());
        const typename G::Vector mu =
            G::bodyMomentum(G::element(pose), pose) + typename G::Vector(by.tail(G::n));
        Pose<double> moved = G::place(pose, G::element(pose), typename G::Vector(by.head(G::n)));
        const so3::Matrix<double> R = so3::matrix(moved.attitude);
        moved.momentum = R * mu.template head<3>();
        if constexpr (G::n == 6) moved.linear = R * mu.template tail<3>();
        G::write(moved, state.x.data());
    }
    /// (log(g^{-1} g'), mu' - mu), the logarithm to first order beyond its quadratic part: exp is that of the
    /// chart, and differences of order 6 see its other terms.
    template <class G>
    static Eigen::VectorXd between(const State& from, const State& to) {
        const Pose<double> a = G::read(from.x.data()), b = G::read(to.x.data());
        so3::Quaternion<double> turn = so3::product(so3::conjugate(a.attitude), b.attitude);
        if (turn(0) < 0) turn = -turn;
        const double sine = turn.tail<3>().norm();
        const so3::Vector<double> omega =
            sine > 0 ? so3::Vector<double>(turn.tail<3>() * (2 * std::atan2(sine, turn(0)) / sine))
                     : so3::Vector<double>::Zero();
        Eigen::VectorXd v(2 * G::n);
        v << G::coordinates(a, b, omega),
            G::bodyMomentum(G::element(b), b) - G::bodyMomentum(G::element(a), a);
        return v;
    }

    const System& system_;
};

/// M of the last step.
inline std::optional<Eigen::MatrixXd> tangentMap(Integrator& integrator) {
    const auto n = static_cast<Eigen::Index>(integrator.tangentSize());
    Eigen::MatrixXd M = Eigen::MatrixXd::Identity(n, n);
    if (!integrator.applyTangent({M.data(), static_cast<std::size_t>(n * n)})) return {};
    return M;
}

/// max |M^T J M - J| for the canonical form of (q, p).
inline double canonicalDefect(const Eigen::MatrixXd& M) {
    const Eigen::Index d = M.rows() / 2;
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2 * d, 2 * d);
    J.topRightCorner(d, d).setIdentity();
    J.bottomLeftCorner(d, d) = -Eigen::MatrixXd::Identity(d, d);
    return (M.transpose() * J * M - J).cwiseAbs().maxCoeff();
}

/// The largest entry of M^T - (what the step makes of the unit vectors as covectors).
inline double transposedDefect(Integrator& integrator, const Eigen::MatrixXd& M) {
    Eigen::MatrixXd T = Eigen::MatrixXd::Identity(M.rows(), M.cols());
    if (!applyTransposed(integrator, {T.data(), static_cast<std::size_t>(T.size())})) return 1e300;
    return (T - M.transpose()).cwiseAbs().maxCoeff();
}

/// M of `step` from a state by differences with displacements delta * own.
template <class Step>
std::optional<Eigen::MatrixXd> differencedMap(const System& system, const Step& step, const State& start,
                                              std::size_t n, double delta, double own = 1) {
    const NearbyStates nearby(system);
    const std::optional<State> end = step(start);
    if (!end) return {};
    const auto size = static_cast<Eigen::Index>(n);
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(size, size);
    for (Eigen::Index j = 0; j < size; ++j)
        for (int k = 1; k <= 3; ++k)
            for (const int sign : {1, -1}) {
                const auto moved =
                    step(nearby.displaced(start, Eigen::VectorXd::Unit(size, j) * (sign * k * delta * own)));
                if (!moved) return {};
                M.col(j) += nearby.difference(*end, *moved, n) *
                            (sign * centralDifferences[static_cast<std::size_t>(k - 1)] / (delta * own));
            }
    return M;
}

/// max |M^T Om_1 M - Om_0| between two states.
inline double formDefect(const SymplecticForm& form, const double* x0, const double* x1,
                         const Eigen::MatrixXd& M) {
    const auto n = static_cast<std::size_t>(M.rows());
    double largest = 0;
    for (Eigen::Index i = 0; i < M.cols(); ++i)
        for (Eigen::Index j = 0; j < i; ++j) {
            const Eigen::VectorXd a = Eigen::VectorXd::Unit(M.rows(), i),
                                  b = Eigen::VectorXd::Unit(M.rows(), j);
            const double defect = std::abs(form(x1, M.col(i).eval().data(), M.col(j).eval().data(), n) -
                                           form(x0, a.data(), b.data(), n));
            if (!(defect <= largest)) largest = defect;
        }
    return largest;
}

}  // namespace extremal
