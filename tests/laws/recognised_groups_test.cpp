// SPDX-License-Identifier: GPL-3.0-or-later
/// Laws of algebras that are recognised: so(3) in any basis and representation is found and nothing else is;
/// the three routes of a step (as a rigid body, by closed forms factor by factor, by sweeps of brackets) are
/// one; tangent maps in any basis, against differences, the form and transposed solves.
#include <QTest>

#include <Eigen/LU>

#include <cmath>
#include <string>

#include "engine/core/problem.hpp"
#include "engine/family/scheme.hpp"
#include "engine/model/group/body_form.hpp"
#include "engine/model/symplectic_form.hpp"
#include "tests/laws/matrix_groups.hpp"
#include "tests/tools/tangent.hpp"
#include "tests/tools/test.hpp"

namespace extremal::recognised_groups_test {
namespace {

using namespace laws;
using Vector = MatrixGroup::Vector;

Value rowsOf(const Eigen::MatrixXd& m) {
    Value::Array rows;
    for (Eigen::Index i = 0; i < m.rows(); ++i) {
        Value::Array row;
        for (Eigen::Index j = 0; j < m.cols(); ++j) row.emplace_back(m(i, j));
        rows.emplace_back(row);
    }
    return rows;
}

/// so(3) in the basis E P, and with matrices S X S^-1.
Value rotationsIn(const Eigen::Matrix3d& P, const Eigen::Matrix3d& S) {
    Value::Array basis;
    for (int k = 0; k < 3; ++k) {
        const Eigen::Matrix3d X = so3::hat(so3::Vector<double>(P.col(k)));
        basis.emplace_back(rowsOf(S * X * S.inverse()));
    }
    return Value::Object{{"basis", basis}};
}
Eigen::Matrix3d slant() {
    Eigen::Matrix3d P;
    P << 1, 0.4, -0.2, 0.1, 1.3, 0.3, -0.3, 0.2, 0.8;
    return P;
}
Eigen::Matrix3d exchanged() {
    Eigen::Matrix3d P = Eigen::Matrix3d::Zero();
    P(1, 0) = 2, P(0, 1) = 0.5, P(2, 2) = -3;
    return P;
}

GroupCase free(const Value& group) {
    return {"", group, "(xi1^2 + 2*xi2^2 + 3*xi3^2)/2 + 0.3*xi1*xi3", {}, {0.4, 0.1, 0.3}, 10, 1};
}
GroupCase top(const Value& group) {
    return {"", group,           "(xi1^2 + 2*xi2^2 + 3*xi3^2)/2 + 0.3*xi1*xi3 - 0.3*g31 - g33 - g12*g22/4",
            {}, {0.4, 0.1, 0.3}, 10,
            1};
}
const GroupMechanics& mechanicsOf(const System& system) { return *system.part<LieGroup>().mechanics; }

/// The same with a factor beside it that moves on its own.
GroupCase beside(GroupCase each, const char* other) {
    static std::vector<std::string> texts;
    std::string L;
    const std::string text = each.lagrangian;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if ((text[i] == 'x' || text[i] == 'g') && i + 1 < text.size() &&
            (text.compare(i, 2, "xi") == 0 || std::isdigit(text[i + 1])))
            L += "a_";
        L += text[i];
    }
    const bool isLine = std::string(other) == "u1";
    L += isLine ? " + b_xi1^2/2" : " + (2*b_xi1^2 + b_xi2^2 + b_xi3^2)/2";
    texts.push_back(L);
    each.group = Value::Object{{"product", Value::Object{{"a", each.group}, {"b", other}}}};
    each.lagrangian = texts.back().c_str();
    each.xi.push_back(0.2);
    if (!isLine) each.xi.insert(each.xi.end(), {0.3, -0.1});
    return each;
}

/// g after `steps` steps.
std::vector<double> endOf(const GroupCase& each, int degree, const LieForm& form, int steps) {
    const System system = each.system();
    const auto end =
        after(*makeIntegrator(system, lieFormed(degree, form), {0, 0.1}), each.start(system), steps);
    return end ? end->x : std::vector<double>();
}

/// A state displaced by (zeta, dmu), and the opposite, on a group given as data.
State displaced(const GroupMechanics& on, const State& from, const Eigen::VectorXd& by) {
    const int d = on.dimension(), n = on.group->entries();
    State to = from;
    MatrixGroup::Entries g = Eigen::Map<const MatrixGroup::Entries>(from.x.data(), n);
    const Vector mu = Eigen::Map<const Vector>(from.x.data() + n, d) + by.tail(d);
    g = on.group->product(g, on.group->exponential(Vector(by.head(d))));
    Eigen::Map<MatrixGroup::Entries>(to.x.data(), n) = g;
    Eigen::Map<Vector>(to.x.data() + n, d) = mu;
    Eigen::Map<Vector>(to.x.data() + n + d, d) = on.group->inSpace(g, mu);
    return to;
}
Eigen::VectorXd difference(const GroupMechanics& on, const State& from, const State& to) {
    const int d = on.dimension(), n = on.group->entries();
    const auto entries = [n](const State& s) -> MatrixGroup::Entries {
        return Eigen::Map<const MatrixGroup::Entries>(s.x.data(), n);
    };
    Eigen::VectorXd v(2 * d);
    v.head(d) = on.group->logarithm(on.group->product(on.group->inverse(entries(from)), entries(to)),
                                    Vector::Zero(d));
    v.tail(d) = Eigen::Map<const Vector>(to.x.data() + n, d) - Eigen::Map<const Vector>(from.x.data() + n, d);
    return v;
}

struct TangentDefects {
    double difference = 1e300, form = 1e300, transposed = 1e300;
};
TangentDefects tangentDefects(const GroupCase& each, const Discretization& scheme, double h) {
    const System system = each.system();
    const GroupMechanics& on = mechanicsOf(system);
    const auto integrator = makeIntegrator(system, scheme, {0, h});
    State state = each.start(system);
    for (int k = 0; k < 2; ++k)
        if (advance(*integrator, state).outcome != Outcome::converged) return {};
    const State before = state;
    if (advance(*integrator, state).outcome != Outcome::converged) return {};
    const auto M = tangentMap(*integrator);
    if (!M) return {};
    Eigen::MatrixXd D = Eigen::MatrixXd::Zero(M->rows(), M->cols());
    constexpr double delta = 2e-3;
    for (Eigen::Index j = 0; j < M->cols(); ++j)
        for (int k = 1; k <= 3; ++k)
            for (const int sign : {1, -1}) {
                State moved = displaced(on, before, Eigen::VectorXd::Unit(M->rows(), j) * (sign * k * delta));
                if (advance(*makeIntegrator(system, scheme, {0, h}), moved).outcome != Outcome::converged)
                    return {};
                D.col(j) += difference(on, state, moved) *
                            (sign * centralDifferences[static_cast<std::size_t>(k - 1)] / delta);
            }
    return {(*M - D).cwiseAbs().maxCoeff(),
            formDefect(SymplecticForm(system), before.x.data(), state.x.data(), *M),
            transposedDefect(*integrator, *M)};
}

}  // namespace

class RecognisedGroupsTest : public QObject {
    Q_OBJECT

private slots:
    void recognised() {
        const auto isBody = [](const GroupCase& each) {
            const System system = each.system();
            return BodyForm::of(mechanicsOf(system)).has_value();
        };
        const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
        for (const Value& group : {Value("so3"), rotationsIn(exchanged(), one), rotationsIn(slant(), one),
                                   rotationsIn(slant(), slant())}) {
            QVERIFY(isBody(free(group)));
            QVERIFY(isBody(top(group)));
        }
        QVERIFY(isBody(free("su2")));
        // U may tell q from -q.
        GroupCase odd = free("su2");
        odd.lagrangian = "(xi1^2 + 2*xi2^2 + 3*xi3^2)/2 - g11";
        QVERIFY(!isBody(odd));
        for (const char* other : {"sl2", "so21", "heisenberg", "se2"}) {
            const System system = free(other).system();
            QVERIFY2(!mechanicsOf(system).group->factors()[0].rotations, other);
            QVERIFY2(!isBody(free(other)), other);
        }
        for (const char* L :
             {"(xi1^2 + 2*xi2^2 + 3*xi3^2)/2 + xi1^4", "(xi1^2 + 2*xi2^2 + 3*xi3^2)/2 + 0.1*xi1",
              "(xi1^2 + 2*xi2^2 + (3 + g11/9)*xi3^2)/2"}) {
            GroupCase each = free("so3");
            each.lagrangian = L;
            QVERIFY2(!isBody(each), L);
        }
    }

    /// Alone as a body; beside a circle by closed forms; beside SL(2), which has none, by sweeps.
    void routesAreOne() {
        const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
        for (const Value& group :
             {Value("so3"), rotationsIn(exchanged(), one), rotationsIn(slant(), slant()), Value("su2")})
            for (const GroupCase& each : {free(group), top(group)}) {
                if (group == Value("su2") && std::string(each.lagrangian) != free(group).lagrangian) continue;
                for (const int degree : {1, 2, 3})
                    for (const LieForm& form : lieForms) {
                        const auto alone = endOf(each, degree, form, 40),
                                   closed = endOf(beside(each, "u1"), degree, form, 40),
                                   swept = endOf(beside(each, "sl2"), degree, form, 40);
                        const std::size_t entries = group == Value("su2") ? 16 : 9;
                        QVERIFY(alone.size() > entries && closed.size() > entries && swept.size() > entries);
                        const double far = distance(alone, closed, 0, entries),
                                     further = distance(alone, swept, 0, entries);
                        qInfo("degree %d%s: closed forms %.1e, sweeps %.1e", degree, form.name, far, further);
                        QVERIFY(far < 1e-12);
                        QVERIFY(further < 1e-12);
                    }
            }
    }

    /// SE(3) as data against the compiled rigid motions, free and in a potential.
    void motions() {
        const so3::Quaternion<double> q(0.8, 0.6, 0, 0);
        const so3::Matrix<double> R = so3::matrix(q);
        const so3::Vector<double> w(0.5, 0.1, 0.3), Pi(0.5, 0.2, 0.9), v(0.1, 0.3, 0.2), x(0.3, -0.2, 0.5);
        const double mass = 1.5;
        const so3::Vector<double> pi = R * Pi, eta = R.transpose() * v;
        const State body{0,
                         0,
                         {q(0), q(1), q(2), q(3), Pi(0), Pi(1), Pi(2), pi(0), pi(1), pi(2), x(0), x(1), x(2),
                          mass * v(0), mass * v(1), mass * v(2)}};
        Eigen::Matrix4d g = Eigen::Matrix4d::Identity();
        g.topLeftCorner<3, 3>() = R;
        g.topRightCorner<3, 1>() = x;
        for (const auto& [compiled, typed] :
             {std::pair{"0*x", ""}, {"x^2/2 + y^2 + z*R11 + R23", " - (g14^2/2 + g24^2 + g34*g11 + g23)"}}) {
            const System one = systemNamed(
                "rigid-body-se3",
                {{"inertia", Value::Array{1.0, 2.0, 3.0}}, {"mass", mass}, {"potential", compiled}});
            const std::string L =
                std::string("(xi1^2 + 2*xi2^2 + 3*xi3^2 + 1.5*(xi4^2 + xi5^2 + xi6^2))/2") + typed;
            const System other =
                systemNamed("group", {{"group", "se3"}, {"lagrangian", L}, {"parameters", Value::Object{}}});
            const State start{
                0, 0,
                other.start(Settings{"",
                                     {{"g", rowsOf(g)},
                                      {"xi", Value::Array{w(0), w(1), w(2), eta(0), eta(1), eta(2)}}},
                                     {}},
                            0)};
            for (const int s : {1, 2, 3})
                for (const LieForm& form : lieForms) {
                    const Discretization scheme = lieFormed(s, form);
                    const auto a = after(*makeIntegrator(one, scheme, {0, 0.1}), body, 40),
                               b = after(*makeIntegrator(other, scheme, {0, 0.1}), start, 40);
                    QVERIFY(a && b);
                    const so3::Matrix<double> end = so3::matrixAt(a->x.data());
                    double apart = 0;
                    for (int i = 0; i < 3; ++i) {
                        for (int j = 0; j < 3; ++j)
                            apart = std::max(apart,
                                             std::abs(b->x[static_cast<std::size_t>(4 * i + j)] - end(i, j)));
                        apart = std::max(apart, std::abs(b->x[static_cast<std::size_t>(4 * i + 3)] -
                                                         a->x[static_cast<std::size_t>(10 + i)]));
                    }
                    qInfo("SE(3), degree %d%s: %.1e", s, form.name, apart);
                    QVERIFY(apart < 1e-12);
                }
        }
    }

    /// Starts off the group, and what is claimed to be invariant and is not.
    void starts() {
        const System system = free("so3").system();
        const auto refusalOf = [&](const Eigen::Matrix3d& g) -> std::string {
            try {
                (void)system.start(Settings{"", {{"g", rowsOf(g)}, {"xi", Value::Array{1.0, 0.0, 0.0}}}, {}},
                                   0);
            } catch (const InvalidScene& e) {
                return e.problems()[0].pointer + " " + e.problems()[0].message + "; " + e.problems()[0].hint;
            }
            return "accepted";
        };
        Eigen::Matrix3d off = Eigen::Matrix3d::Identity();
        off(0, 0) = 1 + 1e-6;
        QVERIFY2(refusalOf(off).starts_with(
                     "/g is not on the group: its distance is 2e-06; a matrix of the group"),
                 refusalOf(off).c_str());
        off(0, 0) = 1 + 1e-10;
        QCOMPARE(refusalOf(off), std::string("accepted"));
        off(0, 0) = -1;
        QVERIFY2(refusalOf(off).starts_with("/g is not on the group"), refusalOf(off).c_str());
        const std::string claimed =
            mismatch(liePair(2, {"gauss", {}, {}}, false, false), top("so3").system());
        QVERIFY2(claimed.find("\"reduced\"") != std::string::npos, claimed.c_str());
        QVERIFY(isFor(*namedScheme("quaternion-2"), system));
        const std::string weight = mismatch(*namedScheme("quaternion-2"), top("so3").system());
        QVERIFY2(weight.find("lie-polynomial steps it") != std::string::npos, weight.c_str());
        // Neither is made: a step in quaternions would leave the weight out.
        for (const auto& [made, pointer] :
             {std::pair{*namedScheme("quaternion-2"), "/space/type"},
              {liePair(2, {"gauss", {}, {}}, false, false), "/space/reduced"}}) {
            std::string at = "made";
            try {
                (void)makeIntegrator(top("so3").system(), made, {0, 0.1});
            } catch (const InvalidScene& e) {
                at = e.problems()[0].pointer;
            }
            QCOMPARE(at, std::string(pointer));
        }
        QVERIFY_EXCEPTION_THROWN(
            (void)makeIntegrator(laws::top().system(), *namedScheme("quaternion-2"), {0, 0.1}), InvalidScene);
    }

    /// J of a free body is the same to the last bit in any basis, and g on its group.
    void kept() {
        for (const Value& group : {rotationsIn(slant(), slant()), Value("su2")}) {
            const GroupCase each = free(group);
            const System system = each.system();
            const State start = each.start(system);
            const auto end = after(*makeIntegrator(system, liePair(2), {0, 0.2}), start, 20000);
            QVERIFY(end);
            const auto d = static_cast<std::size_t>(mechanicsOf(system).dimension());
            const std::size_t J = static_cast<std::size_t>(mechanicsOf(system).group->entries()) + d;
            QCOMPARE(distance(end->x, start.x, J, J + d), 0.0);
            double off = 0;
            measureOf(system, "group-distance")->bind(start)(0, end->x.data(), &off);
            qInfo("20000 steps: %.1e from the group", off);
            QVERIFY(off < 1e-14);
        }
    }

    /// Free bodies in quaternions: order 2 s, back and forth, the way of the algebra's steps, and energies.
    void quaternions() {
        const KnownBody& body = standard();
        const System system = body.system();
        const State start = bodyState(body.start);
        for (const auto& [s, n] : {std::pair{1, 160}, {2, 40}, {3, 20}, {4, 10}}) {
            const Discretization scheme = *namedScheme("quaternion-" + std::to_string(s));
            const double coarse = errorsOf(body, 1, scheme, n).attitude,
                         fine = errorsOf(body, 1, scheme, 2 * n).attitude, slope = std::log2(coarse / fine);
            qInfo("degree %d: %.3e %.3e, order %.2f", s, coarse, fine, slope);
            QVERIFY(slope > 2 * s - 0.3 && slope < 2 * s + 0.6);
            const auto there = after(*makeIntegrator(system, scheme, {0, 0.4}), start, 25);
            QVERIFY(there);
            const auto back = after(*makeIntegrator(system, scheme, {0, -0.4}), {0, 0, there->x}, 25);
            QVERIFY(back);
            QVERIFY(distance(back->x, start.x, 0, 10) < 1e-13);
            double quarters[4] = {};
            const auto integrator = makeIntegrator(system, scheme, {0, 0.5});
            State state = start;
            const double energy = system.energy(0, start.x.data());
            for (int k = 0; k < 40000; ++k) {
                QVERIFY(advance(*integrator, state).outcome == Outcome::converged);
                double& worst = quarters[k / 10000];
                worst = std::max(worst, std::abs(system.energy(0, state.x.data()) - energy));
            }
            qInfo("degree %d: energy %.3e %.3e %.3e %.3e", s, quarters[0], quarters[1], quarters[2],
                  quarters[3]);
            for (const double quarter : quarters) QVERIFY(quarter < 1.05 * quarters[0] + 1e-13);
            QCOMPARE(distance(state.x, start.x, 7, 10), 0.0);
        }
        // A body given as data makes the same steps.
        const GroupCase data = freeBodyAsData();
        const System given = data.system();
        const auto one = after(*makeIntegrator(system, *namedScheme("quaternion-3"), {0, 0.2}), start, 50),
                   other = after(*makeIntegrator(given, *namedScheme("quaternion-3"), {0, 0.2}),
                                 data.start(given), 50);
        QVERIFY(one && other);
        QVERIFY(distance(one->x, {other->x.begin() + 5, other->x.end()}, 4, 7) < 1e-13);
    }

    void tangents() {
        const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
        const GroupCase cases[] = {free(rotationsIn(slant(), one)),
                                   top(rotationsIn(slant(), slant())),
                                   free("su2"),
                                   beside(top("so3"), "u1"),
                                   groupCases()[4],
                                   groupCases()[5],
                                   groupCases()[6],
                                   groupCases()[9],
                                   chainOfBodies(3, true)};
        for (const GroupCase& each : cases)
            for (const int degree : {1, 2})
                for (const LieForm& form : lieForms) {
                    const TangentDefects defects = tangentDefects(each, lieFormed(degree, form), 0.1);
                    qInfo("%s, degree %d%s: differences %.1e, form %.1e, transposed %.1e", each.lagrangian,
                          degree, form.name, defects.difference, defects.form, defects.transposed);
                    QVERIFY(defects.difference < 1e-9);
                    QVERIFY(defects.form < 1e-12);
                    QVERIFY(defects.transposed < 1e-13);
                }
        const TangentDefects inQuaternions =
            tangentDefects(free(rotationsIn(slant(), one)), *namedScheme("quaternion-3"), 0.3);
        qInfo("in quaternions: %.1e, form %.1e", inQuaternions.difference, inQuaternions.form);
        QVERIFY(inQuaternions.difference < 1e-9);
        QVERIFY(inQuaternions.form < 1e-12);
    }
};

EXTREMAL_TEST(RecognisedGroupsTest)
}  // namespace extremal::recognised_groups_test

#include "recognised_groups_test.moc"
