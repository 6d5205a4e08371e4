// SPDX-License-Identifier: GPL-3.0-or-later
/// What the laws on rigid bodies share: bodies by their numbers, reference solutions, distances of attitudes
/// and momenta.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "engine/group/so3.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/jacobian.hpp"

namespace extremal::laws {

using Three = std::array<double, 3>;
using Four = std::array<double, 4>;

inline Value listOf(const Three& v) { return Value::Array{v[0], v[1], v[2]}; }

inline System freeBody(const Three& inertia) {
    return systemNamed("rigid-body", {{"inertia", listOf(inertia)}});
}
inline System heavyTop(const Three& inertia, const Three& centre, double weight = 1) {
    return systemNamed("heavy-top",
                       {{"inertia", listOf(inertia)}, {"weight", weight}, {"centre", listOf(centre)}});
}

/// The state at an attitude, with a momentum in body axes.
inline State bodyState(const Three& Pi, const Four& q = {1, 0, 0, 0}) {
    const so3::Vector<double> pi = so3::matrix(so3::Quaternion<double>(q[0], q[1], q[2], q[3])) *
                                   so3::Vector<double>(Pi[0], Pi[1], Pi[2]);
    return {0, 0, {q[0], q[1], q[2], q[3], Pi[0], Pi[1], Pi[2], pi(0), pi(1), pi(2)}};
}

/// Angle between two attitudes, rad.
inline double attitudeError(const std::vector<double>& x, const Four& q) {
    const so3::Quaternion<double> d =
        so3::product(so3::conjugate(so3::Quaternion<double>(q[0], q[1], q[2], q[3])),
                     so3::Quaternion<double>(x[0], x[1], x[2], x[3]));
    return 2 * std::atan2(std::hypot(d(1), d(2), d(3)), std::abs(d(0)));
}
inline double momentumError(const std::vector<double>& x, const Three& Pi) {
    return std::hypot(x[4] - Pi[0], x[5] - Pi[1], x[6] - Pi[2]);
}

/// A state that is known to 1e-16: mpmath's Taylor series with 32 digits, two orders agreeing to 4e-22.
struct Known {
    double t;
    Three Pi;
    Four q;
};
struct KnownBody {
    std::string name;
    Three inertia, start;  ///< momentum at the start, in the body; the attitude is 1
    Three centre;          ///< of a top of weight 1; zero: free
    std::vector<Known> at;

    System system() const { return centre == Three{0, 0, 0} ? freeBody(inertia) : heavyTop(inertia, centre); }
};

inline const KnownBody& standard() {
    static const KnownBody body{
        "standard",
        {1, 2, 3},
        {std::cos(1.1), 0, std::sin(1.1)},
        {0, 0, 0},
        {{1,
          {0.43416710589707017, 0.26266606578916434, 0.86168756637182868},
          {0.9639005574011593, 0.21918043387373902, 0.032798291003346254, 0.14758023226676988}},
         {10,
          {-0.17114991996632033, 0.84013605152463084, 0.51466408445132926},
          {-0.51486535434169371, -0.14573926209833307, 0.25289162481753544, 0.8060518348585173}},
         {100,
          {-0.23032113272615657, 0.78154108578389483, 0.5797807404971908},
          {-0.49025715988838217, -0.13389674873481979, 0.21513076727427639, 0.83392945194926588}}}};
    return body;
}
inline const KnownBody& separatrix() {
    static const KnownBody body{
        "near the separatrix",
        {1, 2, 3},
        {1e-6, 1, 1e-6},
        {0, 0, 0},
        {{10,
          {3.83407518335611e-6, 0.99999999997259973, -6.4884819129655872e-6},
          {-0.80114361554405296, -1.5531450675057274e-6, 0.59847214409935182, -2.7776023887483614e-6}},
         {50,
          {0.33988193019029114, 0.73343104251489672, -0.58869277166246387},
          {0.92892577656899153, 0.30336769435185684, -0.06174431974401798, 0.20310731800868932}},
         {100,
          {1.4954759147797605e-6, -0.9999999999975271, -2.1701024480561014e-6},
          {1.224892064248265e-6, 0.79223094034735093, -7.7096647626834455e-7, 0.61022138372418362}}}};
    return body;
}
inline const KnownBody& nearlySymmetric() {
    static const KnownBody body{
        "nearly symmetric",
        {1, 1 + 1e-8, 2},
        {std::cos(1.1), 0, std::sin(1.1)},
        {0, 0, 0},
        {{10,
          {-0.11501096629481641, -0.43877320206992834, 0.89120735790119823},
          {-0.84987548240799437, 0.26572838265305479, -0.34435795466751315, 0.29751922645700985}},
         {100,
          {0.37989518236591642, 0.24784893184372633, 0.89120735937215588},
          {-0.85829035335295146, 0.11407561243867611, 0.033921792771361159, 0.49917305212038792}}}};
    return body;
}
inline const KnownBody& thinRod() {
    static const KnownBody body{
        "thin rod",
        {1e-4, 1, 1},
        {1e-4 * std::cos(1.1), 0, std::sin(1.1)},
        {0, 0, 0},
        {{1,
          {4.5359612142557739e-5, 0.39049146909023682, 0.80110359579483943},
          {0.87924234999169217, 0.20290286183648632, 0.096905196808283283, 0.41996750049402431}},
         {10,
          {4.5359612142557739e-5, -0.87730206184891612, -0.15681725320676104},
          {0.16279069741584946, -0.1943929861513533, -0.74174072679546475, 0.62091162815891669}}}};
    return body;
}
inline const KnownBody& fastThinRod() {
    static const KnownBody body{
        "fast thin rod",
        {1e-4, 1, 1},
        {std::cos(1.1), 0.1, std::sin(1.1)},
        {0, 0, 0},
        {{0.1,
          {0.45359612142557739, 0.85736987114191925, 0.26299707733311721},
          {0.82258080046073073, 0.56687908060220465, 0.028614921842006557, 0.034498129470429431}}}};
    return body;
}
inline const KnownBody& top() {
    static const KnownBody body{
        "heavy top",
        {1, 1, 0.5},
        {0.1, 0.2, 2},
        {0.3, 0, 1},
        {{1,
          {0.39317128797400593, -0.16327656359071061, 1.9726527655263938},
          {-0.4105035870274816, 0.11264634304949976, 0.070459784354978821, 0.902126945182215}},
         {10,
          {0.48193708250574894, 0.24938303667066906, 1.9732308328934762},
          {0.023546895824301273, 0.11563160375082604, 0.1654100426114524, 0.97913961911176332}}}};
    return body;
}

/// A tangent vector of T*SO(3) or T*SE(3) at x: the attitude rotated by zeta in the body, the change of Pi,
/// and of a body that moves those of its position and linear momentum in space.
inline State moved(const State& s, const Eigen::VectorXd& v) {
    const so3::Quaternion<double> q = so3::product(so3::Quaternion<double>(s.x[0], s.x[1], s.x[2], s.x[3]),
                                                   so3::quaternionExp(so3::Vector<double>(v.head<3>())));
    State m = bodyState({s.x[4] + v(3), s.x[5] + v(4), s.x[6] + v(5)}, {q(0), q(1), q(2), q(3)});
    m.t = s.t;
    for (std::size_t i = 10; i < s.x.size(); ++i) m.x.push_back(s.x[i] + v(static_cast<Eigen::Index>(i - 4)));
    return m;
}
/// The opposite: how far x is from s.
inline Eigen::VectorXd between(const State& s, const State& x) {
    const so3::Quaternion<double> d =
        so3::product(so3::conjugate(so3::Quaternion<double>(s.x[0], s.x[1], s.x[2], s.x[3])),
                     so3::Quaternion<double>(x.x[0], x.x[1], x.x[2], x.x[3]));
    Eigen::VectorXd v(static_cast<Eigen::Index>(s.x.size() - 4));
    v.head<3>() = so3::log(so3::normalised(d));
    for (std::size_t i = 4; i < 7; ++i) v(static_cast<Eigen::Index>(i - 1)) = x.x[i] - s.x[i];
    for (std::size_t i = 10; i < s.x.size(); ++i) v(static_cast<Eigen::Index>(i - 4)) = x.x[i] - s.x[i];
    return v;
}
/// The canonical form in the left trivialisation, w(u, v) = u_z . v_Pi - u_Pi . v_z + sign Pi . [u_z, v_z]
/// and the usual one of positions, as a matrix; the sign is 1.
inline Eigen::MatrixXd canonicalForm(const State& s, double sign = 1) {
    const auto n = static_cast<Eigen::Index>(s.x.size() - 4);
    Eigen::MatrixXd w = Eigen::MatrixXd::Zero(n, n);
    w.topLeftCorner<3, 3>() = -sign * so3::hat(so3::Vector<double>(s.x[4], s.x[5], s.x[6]));
    for (Eigen::Index at = 0; at < n; at += 6) {
        w.block<3, 3>(at, at + 3).setIdentity();
        w.block<3, 3>(at + 3, at) = -Eigen::Matrix3d::Identity();
    }
    return w;
}
/// Size of M^T w M - w for a step, whose derivative M is by central differences of order 6 in units `own` of
/// each tangent direction; every entry (i, j) in the root of the actions of i and j, which are 1 where `own`
/// is left out. Not a number where a step fails. `sign`: of the bracket, to see the law fail.
template <class Step>  // State -> std::optional<State>
double bodySymplecticDefect(Step&& step, const State& start, double sign = 1, Eigen::VectorXd own = {}) {
    constexpr double delta = 2e-3;
    constexpr std::array<double, 3> c = centralDifferences;
    const auto n = static_cast<Eigen::Index>(start.x.size() - 4);
    if (own.size() == 0) own = Eigen::VectorXd::Ones(n);
    const std::optional<State> end = step(start);
    if (!end) return std::nan("");
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index j = 0; j < n; ++j)
        for (int k = 1; k <= 3; ++k)
            for (const int side : {1, -1}) {
                Eigen::VectorXd v = Eigen::VectorXd::Zero(n);
                v(j) = side * k * delta * own(j);
                const std::optional<State> other = step(moved(start, v));
                if (!other) return std::nan("");
                M.col(j) += side * c[static_cast<std::size_t>(k - 1)] / delta *
                            between(*end, *other).cwiseQuotient(own);
            }
    const auto form = [&](const State& s) -> Eigen::MatrixXd {
        return own.asDiagonal() * canonicalForm(s, sign) * own.asDiagonal();
    };
    Eigen::VectorXd action(n);
    for (Eigen::Index i = 0; i < n; ++i) action(i) = own(i) * own(i % 6 < 3 ? i + 3 : i - 3);
    const Eigen::VectorXd root = action.cwiseSqrt().cwiseInverse();
    return (root.asDiagonal() * (M.transpose() * form(*end) * M - form(start)) * root.asDiagonal()).norm();
}

inline Discretization liePair(int degree, Settings quadrature = {"gauss", {}, {}}, bool isSymmetric = false,
                              bool isReduced = true, double base = 0) {
    Discretization discretization;
    discretization.space = {"lie-polynomial",
                            {{"degree", static_cast<double>(degree)},
                             {"symmetric", isSymmetric},
                             {"base", base},
                             {"reduced", isReduced}},
                            {}};
    discretization.quadrature = completeQuadrature(discretization.space, quadrature);
    return discretization;
}
/// How a step is made of a chart.
struct LieForm {
    const char* name;
    bool isSymmetric;
    double base;
    bool isSelfAdjoint() const { return isSymmetric || base == 0.5; }
};
inline constexpr LieForm lieForms[] = {
    {"", false, 0}, {", symmetric", true, 0}, {", centred", false, 0.5}, {", symmetric from .3", true, 0.3}};
inline Discretization lieFormed(int degree, const LieForm& form, Settings quadrature = {"gauss", {}, {}}) {
    return liePair(degree, std::move(quadrature), form.isSymmetric, true, form.base);
}
inline Discretization lieFormed(int degree, const LieForm& form, bool isReduced) {
    return liePair(degree, {"gauss", {}, {}}, form.isSymmetric, isReduced, form.base);
}

struct BodyErrors {
    double attitude = 1e300, momentum = 1e300;
};
/// Errors of n steps to a known state.
inline BodyErrors errorsAt(const KnownBody& body, const Known& known, Integrator& integrator, long long n) {
    const auto end = after(integrator, bodyState(body.start), n);
    if (!end) return {};
    return {attitudeError(end->x, known.q), momentumError(end->x, known.Pi)};
}
inline BodyErrors errorsOf(const KnownBody& body, std::size_t index, const Discretization& discretization,
                           long long n) {
    const Known& known = body.at[index];
    const auto integrator =
        makeIntegrator(body.system(), discretization, {0, known.t / static_cast<double>(n)});
    return errorsAt(body, known, *integrator, n);
}

}  // namespace extremal::laws
