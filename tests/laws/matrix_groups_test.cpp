// SPDX-License-Identifier: GPL-3.0-or-later
/// Laws of groups given as data: orders on eleven problems against another route, the compiled rigid bodies
/// to round-off, momenta, changes of basis and of the start, products, and the way back to the group.
#include <QTest>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/core/problem.hpp"
#include "engine/group/group_invariants.hpp"
#include "tests/laws/matrix_groups.hpp"
#include "tests/tools/test.hpp"

namespace extremal::matrix_groups_test {
namespace {

using namespace laws;

/// The body or top of math's tables after n steps of a degree, by the compiled group and by data.
double distanceOfRoutes(const GroupCase& data, const KnownBody& body, int degree, const LieForm& form,
                        int n) {
    const Discretization scheme = lieFormed(degree, form);
    const Clock clock{0, data.duration / n};
    const System given = data.system();
    const auto compiled = after(*makeIntegrator(body.system(), scheme, clock), bodyState(body.start), n);
    const auto end = after(*makeIntegrator(given, scheme, clock), data.start(given), n);
    if (!compiled || !end) return 1e300;
    const so3::Matrix<double> R = so3::matrixAt(compiled->x.data());
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            largest = std::max(largest, std::abs(end->x[3 * i + j] - R(static_cast<Eigen::Index>(i),
                                                                       static_cast<Eigen::Index>(j))));
        largest = std::max(largest, std::abs(end->x[9 + i] - compiled->x[4 + i]));
    }
    return largest;
}

Value matrixOf(const MatrixGroup::Square& m) {
    Value::Array rows;
    for (Eigen::Index i = 0; i < m.rows(); ++i) {
        Value::Array row;
        for (Eigen::Index j = 0; j < m.cols(); ++j) row.emplace_back(m(i, j));
        rows.emplace_back(row);
    }
    return rows;
}

std::string refusalOf(const Value& group, const char* lagrangian) {
    try {
        const GroupCase each{"", group, lagrangian, {}, {1, 1, 1}, 1, 1};
        const System system = each.system();
        const State start = each.start(system);
        findModel("group")->checkInitial({}, system, start);
    } catch (const InvalidScene& e) {
        return e.problems()[0].pointer + " " + e.problems()[0].message;
    }
    return "accepted";
}

}  // namespace

class MatrixGroupsTest : public QObject {
    Q_OBJECT

private slots:
    /// In the chart at the start, and in the middle.
    void orders() {
        for (const GroupCase& each : groupCases()) {
            const System system = each.system();
            const State start = each.start(system);
            const std::vector<double> reference = referenceOf(system, start, each.duration);
            for (int k = 2; k <= 7; ++k) {
                const int s = k / 2;
                const LieForm& form = lieForms[k % 2 == 0 ? 0 : 2];
                // The pair before the last one above round-off.
                double slope = 0, slopeMu = 0;
                GroupErrors before;
                std::string row;
                for (int n = each.coarsest; n <= 8 * each.coarsest; n *= 2) {
                    const GroupErrors now =
                        errorsOf(system, start, reference, lieFormed(s, form), each.duration, n);
                    if (std::min(now.g, now.mu) < 1e-11) break;
                    slope = std::log2(before.g / now.g);
                    slopeMu = std::log2(before.mu / now.mu);
                    row += QString::asprintf(" %.3e/%.3e", now.g, now.mu).toStdString();
                    before = now;
                }
                qInfo("%s, s = %d%s: g/mu%s, slopes %.2f, %.2f", each.name, s, form.name, row.c_str(), slope,
                      slopeMu);
                QVERIFY2(slope > 2 * s - 0.15 && slope < 2 * s + 0.2, each.name);
                // Momenta may be more accurate than they must be.
                QVERIFY2(slopeMu > 2 * s - 0.15, each.name);
            }
        }
    }

    void compiledAndGiven() {
        for (const int s : {1, 2, 3, 4})
            for (const LieForm& form : lieForms) {
                const double body = distanceOfRoutes(freeBodyAsData(), standard(), s, form, 40),
                             top = distanceOfRoutes(heavyTopAsData(), laws::top(), s, form, 80);
                qInfo("s = %d%s: body %.1e, top %.1e", s, form.name, body, top);
                QVERIFY(body < 1e-12);
                QVERIFY(top < 1e-12);
            }
    }

    /// The row of the free body: attitude error at T = 10.
    void table() {
        constexpr double known[] = {1.25e-2, 6.99e-6, 2.23e-9};
        for (int s = 1; s <= 3; ++s) {
            const GroupCase data = freeBodyAsData();
            const System system = data.system();
            const State start = data.start(system);
            const auto end = after(*makeIntegrator(system, liePair(s), {0, 0.5}), start, 20);
            QVERIFY(end);
            const Known& at = standard().at[1];
            const so3::Matrix<double> R =
                so3::matrix(so3::Quaternion<double>(at.q[0], at.q[1], at.q[2], at.q[3]));
            Eigen::Matrix3d g;
            for (int i = 0; i < 9; ++i) g(i / 3, i % 3) = end->x[static_cast<std::size_t>(i)];
            const double error = so3::log(so3::Matrix<double>(R.transpose() * g)).norm();
            QVERIFY2(std::abs(error / known[s - 1] - 1) < 0.02, qPrintable(QString::number(error)));
        }
    }

    void momentumInSpace() {
        for (const GroupCase& each : {groupCases()[0], groupCases()[3], groupCases()[7]}) {
            const System system = each.system();
            Discretization rough = liePair(2);
            const State start = each.start(system);
            const auto end = after(*makeIntegrator(system, rough, {0, 0.2}), start, 20000);
            QVERIFY(end);
            const auto d = static_cast<std::size_t>(system.part<LieGroup>().mechanics->dimension());
            const auto J = static_cast<std::size_t>(system.part<LieGroup>().mechanics->group->entries()) + d;
            const double moved = distance(end->x, start.x, J, J + d);
            const double energy =
                std::abs(system.energy(0, end->x.data()) - system.energy(0, start.x.data()));
            qInfo("%s: J moves by %.1e, the energy by %.1e", each.name, moved, energy);
            QVERIFY(moved == 0);
            QVERIFY(energy < 1e-6);
        }
    }

    void changeOfBasis() {
        // xi = P xi': the inertia becomes P^T I P.
        Eigen::Matrix3d P;
        P << 1, 0.4, -0.2, 0.1, 1.3, 0.3, -0.3, 0.2, 0.8;
        const Eigen::Matrix3d I = P.transpose() * Eigen::Vector3d(1, 2, 3).asDiagonal() * P;
        const GroupCase plain = freeBodyAsData();
        const System one = plain.system();
        const auto basis = one.part<LieGroup>().mechanics->group->factors()[0].basis;
        Value::Array matrices;
        for (int k = 0; k < 3; ++k) {
            MatrixGroup::Square E = MatrixGroup::Square::Zero(3, 3);
            for (int a = 0; a < 3; ++a) E += P(a, k) * basis[static_cast<std::size_t>(a)];
            matrices.push_back(matrixOf(E));
        }
        std::string L;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                L += QString::asprintf("+(%.17g)*xi%d*xi%d/2", I(i, j), i + 1, j + 1).toStdString();
        const Eigen::Vector3d xi = P.inverse() * Eigen::Vector3d(0.4, 0.1, 0.3);
        const GroupCase turned{
            "", Value::Object{{"basis", matrices}}, L.c_str(), {}, {xi(0), xi(1), xi(2)}, 10, 1};
        const System other = turned.system();
        GroupCase same = plain;
        same.isMu = false;
        same.xi = {0.4, 0.1, 0.3};
        const auto a = after(*makeIntegrator(one, liePair(2), {0, 0.1}), same.start(one), 400),
                   b = after(*makeIntegrator(other, liePair(2), {0, 0.1}), turned.start(other), 400);
        QVERIFY(a && b);
        const double apart = distance(a->x, b->x, 0, 9);
        qInfo("400 steps in another basis: %.1e", apart);
        QVERIFY(apart < 1e-12);
    }

    void products() {
        const GroupCase both{"",
                             twoOf("so3", "so3", "a", "b"),
                             "(a_xi1^2 + 2*a_xi2^2 + 3*a_xi3^2)/2 + (b_xi1^2 + 2*b_xi2^2 + 3*b_xi3^2)/2",
                             {},
                             {0.4, 0.1, 0.3, -0.2, 0.5, 0.1},
                             10,
                             1};
        // Each beside a circle, and so by the same route: alone it is stepped as a rigid body.
        const char* const L = "(a_xi1^2 + 2*a_xi2^2 + 3*a_xi3^2)/2 + b_xi1^2/2";
        const Value beside = twoOf("so3", "u1", "a", "b");
        const GroupCase first{"", beside, L, {}, {0.4, 0.1, 0.3, 1}, 10, 1},
            second{"", beside, L, {}, {-0.2, 0.5, 0.1, 1}, 10, 1};
        const System two = both.system(), one = first.system();
        const auto end = after(*makeIntegrator(two, liePair(2), {0, 0.1}), both.start(two), 400),
                   a = after(*makeIntegrator(one, liePair(2), {0, 0.1}), first.start(one), 400),
                   b = after(*makeIntegrator(one, liePair(2), {0, 0.1}), second.start(one), 400);
        QVERIFY(end && a && b);
        std::vector<double> parts(a->x.begin(), a->x.begin() + 9);
        parts.insert(parts.end(), b->x.begin(), b->x.begin() + 9);
        QVERIFY(distance(end->x, parts, 0, 18) < 1e-13);
    }

    /// Methods that know no group are of their order, and leave it.
    void baselines() {
        const auto endOf = [](const System& system, const State& start, const char* id, int stages, double h,
                              int n) {
            BaselineOptions options;
            options.step = h;
            options.settings = defaultsOf(findBaseline(id)->item);
            for (auto& [key, value] : options.settings.keys)
                if (key == "stages") value = stages;
            return after(*findBaseline(id)->make(system, options), start, n);
        };
        for (const GroupCase& each : {groupCases()[1], groupCases()[2], groupCases()[4], groupCases()[9]}) {
            const System system = each.system();
            const State start = each.start(system);
            const std::vector<double> reference = referenceOf(system, start, each.duration);
            for (const auto& [id, stages, order] :
                 {std::tuple{"rk4", 0, 4}, {"gauss-collocation", 1, 2}, {"gauss-collocation", 2, 4}}) {
                const Claims claims =
                    claimsOf(*findBaseline(id), {id, {{"stages", static_cast<double>(stages)}}, {}}, &system);
                QCOMPARE(claims.order, order);
                QVERIFY(!claims.isSymplectic);
                std::vector<double> errors;
                for (const int n : {8 * each.coarsest, 16 * each.coarsest}) {
                    const auto end = endOf(system, start, id, stages, each.duration / n, n);
                    QVERIFY(end);
                    errors.push_back(distance(end->x, reference, 0, reference.size()));
                }
                const double slope = std::log2(errors[0] / errors[1]);
                qInfo("%s, %s %d: %.2e %.2e, slope %.2f", each.name, id, stages, errors[0], errors[1], slope);
                QVERIFY2(slope > order - 0.2 && slope < order + 0.5, each.name);
            }
        }
        const GroupCase top = heavyTopAsData();
        const System system = top.system();
        const State start = top.start(system);
        const auto off = [&](const State& state) {
            double value = 0;
            measureOf(system, "group-distance")->bind(start)(0, state.x.data(), &value);
            return value;
        };
        const auto left = endOf(system, start, "rk4", 0, 0.1, 200),
                   stays = after(*makeIntegrator(system, liePair(2), {0, 0.1}), start, 200);
        QVERIFY(left && stays);
        qInfo("200 steps: rk4 %.1e from the group, lie-2 %.1e", off(*left), off(*stays));
        QVERIFY(off(*left) > 1e-6);
        QVERIFY(off(*stays) < 1e-13);
        const auto rk4 = findBaseline("rk4")->make(system, {0.1, {}, 0, {}});
        QCOMPARE(rk4->tangentSize(), std::size_t{0});
    }

    void wayBack() {
        constexpr std::pair<const char*, int> dimensions[] = {{"so3", 3},        {"so4", 6}, {"su2", 3},
                                                              {"sl2", 3},        {"se2", 3}, {"se3", 6},
                                                              {"heisenberg", 3}, {"so21", 3}};
        std::mt19937 random(7);
        std::normal_distribution<double> normal;
        for (const auto& [name, d] : dimensions) {
            const System system = systemNamed(
                "group", {{"group", name}, {"lagrangian", "xi1^2"}, {"parameters", Value::Object{}}});
            const GroupMechanics& on = *system.part<LieGroup>().mechanics;
            QCOMPARE(on.invariants->dimension(), d);
            MatrixGroup::Vector xi(on.dimension());
            for (int i = 0; i < on.dimension(); ++i) xi(i) = normal(random);
            MatrixGroup::Entries g = on.group->exponential(xi);
            QVERIFY(on.invariants->distance(g) < 1e-13);
            for (Eigen::Index i = 0; i < g.size(); ++i) g(i) += 1e-6 * normal(random);
            const MatrixGroup::Entries off = g;
            on.invariants->cure(g);
            const double once = on.invariants->distance(g);
            on.invariants->cure(g);
            const double twice = on.invariants->distance(g);
            qInfo("%s: %.1e, %.1e, %.1e", name, on.invariants->distance(off), once, twice);
            QVERIFY(once < 1e-9);
            QVERIFY(twice < 1e-14);
            // It does not go along the group further than it must.
            QVERIFY((g - off).norm() < 1e-4);
        }
        // A dense line in a torus: what is invariant is the whole torus.
        MatrixGroup::Square E = MatrixGroup::Square::Zero(4, 4);
        E(0, 1) = -1, E(1, 0) = 1, E(2, 3) = -std::sqrt(2), E(3, 2) = std::sqrt(2);
        QCOMPARE(GroupInvariants(MatrixGroup({{"", {E}, ""}})).dimension(), 2);
    }

    void refusals() {
        const Value::Array open{matrixOf(MatrixGroup::Square{{0, 1}, {0, 0}}),
                                matrixOf(MatrixGroup::Square{{0, 0}, {1, 0}})};
        const std::string notClosed = refusalOf(Value::Object{{"basis", open}}, "xi1^2 + xi2^2");
        QVERIFY2(notClosed.starts_with("/group/basis is not closed: [E_1, E_2]"), notClosed.c_str());
        const Value same = matrixOf(MatrixGroup::Square{{0, -1}, {1, 0}});
        const std::string dependent = refusalOf(Value::Object{{"basis", Value::Array{same, same}}}, "xi1^2");
        QVERIFY2(dependent.starts_with("/group/basis is not a basis"), dependent.c_str());
        const std::string degenerate = refusalOf("so3", "xi1^2 + xi2^2");
        QVERIFY2(degenerate.starts_with("/lagrangian is degenerate") &&
                     degenerate.find("xi3: 1") != std::string::npos,
                 degenerate.c_str());
        QVERIFY(
            refusalOf("so3", "xi1^2 + xi2^2 + xi4^2").starts_with("/lagrangian has an unknown name \"xi4\""));
        QVERIFY(refusalOf("so7", "xi1^2").starts_with("/group there is no group \"so7\""));
        QCOMPARE(refusalOf("so3", "xi1^2 + xi2^2 + xi3^2"), std::string("accepted"));
    }

    void kept() {
        const auto namesOf = [](const GroupCase& each) {
            std::string names;
            for (const MomentumMap& m : each.system().momenta) names += m.name + " ";
            return names;
        };
        QCOMPARE(namesOf(heavyTopAsData()), std::string("space.3 "));
        QCOMPARE(namesOf(groupCases()[9]), std::string("combination.1 "));  // both bodies about the vertical
        QCOMPARE(namesOf(groupCases()[3]), std::string("space.1 space.2 space.3 space.4 space.5 space.6 "));
        for (const auto& [name, count] : {std::pair{"so3", 1}, {"so4", 2}, {"se3", 2}, {"heisenberg", 1}}) {
            const System system = systemNamed(
                "group", {{"group", name}, {"lagrangian", "xi1^2"}, {"parameters", Value::Object{}}});
            const Measure* const casimir = measureOf(system, "casimir");
            QVERIFY(casimir);
            QCOMPARE(static_cast<int>(casimir->columns.size()), count + 1);  // and their change
        }
    }
};

EXTREMAL_TEST(MatrixGroupsTest)
}  // namespace extremal::matrix_groups_test

#include "matrix_groups_test.moc"
