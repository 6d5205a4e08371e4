// SPDX-License-Identifier: GPL-3.0-or-later
/// Systems and spaces of a program that uses the library: added before the first scene is read, then like
/// those that are supplied.
#include <QTest>

#include <cmath>
#include <stdexcept>

#include "extremal/extremal.hpp"
#include "tests/tools/test.hpp"

namespace extremal::own_test {
namespace {

struct HenonHeiles {
    static constexpr int dimension = 2;
    double lambda;
    template <class S>
    S lagrangian(double, const std::array<S, 2>& q, const std::array<S, 2>& v) const {
        const S x2 = square(q[0]), y2 = square(q[1]);
        return (square(v[0]) + square(v[1])) * 0.5 - (x2 + y2) * 0.5 - (x2 - y2 * (1.0 / 3)) * q[1] * lambda;
    }
};

/// Its mass depends on q, and its velocity needs Newton's method.
struct Relativistic {
    static constexpr int dimension = 1;
    template <class S>
    S lagrangian(double, const std::array<S, 1>& q, const std::array<S, 1>& v) const {
        return sqrt(S(1) - square(v[0])) * (-1.0) - square(q[0]) * 0.5;
    }
};

api::Basis trigonometric(const api::Parameters& p) {
    const double z = p["z"];
    return {3, 0, [z](double tau, std::span<double> value, std::span<double> derivative) {
                value[0] = 1;
                value[1] = std::cos(z * tau);
                value[2] = std::sin(z * tau);
                derivative[0] = 0;
                derivative[1] = -z * value[2];
                derivative[2] = z * value[1];
            }};
}

std::string henonHeiles(const std::string& type) {
    std::string text = R"({"extremal": 1, "model": {"type": "TYPE", "lambda": 1}, "time": {"end": 20},
        "initial": {"q": [0, 0.1], "p": [0.5, 0]}, "observe": ["energy"], "reference": "none",
        "schemes": [{"label": "a", "scheme": "galerkin-gauss-2", "step": 0.1}]})";
    return text.replace(text.find("TYPE"), 4, type);
}

}  // namespace

class OwnTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() {
        api::addSystem({"own-henon-heiles", "Hénon-Heiles", {{"x"}, {"y"}}, {{"lambda", 2, "coupling"}}},
                       [](const api::Parameters& p) { return HenonHeiles{p["lambda"]}; });
        api::addSystem({"relativistic", "relativistic oscillator", {{"x"}}},
                       [](const api::Parameters&) { return Relativistic{}; });
        api::addSpace({"own-trigonometric", "trigonometric", {{"z", 1}}}, trigonometric);
        QVERIFY_EXCEPTION_THROWN(api::addSpace({"own-trigonometric", "again"}, trigonometric),
                                 std::logic_error);
        QVERIFY_EXCEPTION_THROWN(api::addSystem({"flat", "no coordinate", {}},
                                                [](const api::Parameters&) { return Relativistic{}; }),
                                 std::logic_error);
    }

    void anOwnSystemMovesAsTheSuppliedOne() {
        const auto own = api::run(api::Scene::parse(henonHeiles("own-henon-heiles")))["a"];
        const auto supplied = api::run(api::Scene::parse(henonHeiles("henon-heiles")))["a"];
        QCOMPARE(own.status(), std::string("done"));
        QCOMPARE(own.columns(), supplied.columns());
        for (const std::string& column : own.columns())
            for (std::size_t r = 0; r < own.rows(); ++r)  // measured: 4e-15 after 200 steps
                QVERIFY2(std::abs(own[column][r] - supplied[column][r]) < 1e-13, column.c_str());
        QVERIFY(std::abs(own["q.x"].back()) > 0.01);
    }

    void aLagrangianThatIsNotQuadraticHasItsVelocities() {
        const auto result = api::run(api::Scene::parse(R"({"extremal": 1, "model": {"type": "relativistic"},
            "initial": {"q": [2]}, "time": {"end": 20}, "observe": ["energy"], "reference": "none",
            "schemes": [{"label": "a", "scheme": "galerkin-gauss-3", "step": 0.05},
                        {"label": "b", "baseline": "dopri5", "tolerance": 1e-11}]})"));
        QCOMPARE(result["a"].status(), std::string("done"));
        QCOMPARE(result["b"].status(), std::string("done"));
        // Both routes end at the same place; measured 1e-9.
        QVERIFY(std::abs(result["a"]["q.x"].back() - result["b"]["q.x"].back()) < 1e-7);
        // H = sqrt(1 + p^2) + q^2 / 2 is 3 at the start.
        const double q = result["a"]["q.x"].back(), p = result["a"]["p.x"].back();
        QVERIFY(std::abs(std::sqrt(1 + p * p) + q * q / 2 - 3) < 1e-8);
    }

    void anOwnSpaceIsExactWhereItHoldsTheMotion() {
        // 1, cos z tau and sin z tau hold the motion of an oscillator with w h = z = 2: as many nodes as the
        // integrals need, and the step is exact.
        const auto result =
            api::run(api::Scene::parse(R"({"extremal": 1, "model": {"type": "harmonic-oscillator"},
            "initial": {"q": [1]}, "time": {"end": 40}, "observe": ["error"], "reference": "exact",
            "schemes": [{"label": "a", "space": {"type": "own-trigonometric", "z": 2},
                         "quadrature": {"type": "gauss", "nodes": 12}, "step": 2}]})"));
        QCOMPARE(result["a"].status(), std::string("done"));
        QVERIFY(result["a"].summary().find("max_error")->asNumber() < 1e-11);
    }

    void ownEntriesAreInTheCatalogues() {
        const Value models = api::catalogue("models");
        bool isThere = false;
        for (const Value& model : models.asArray())
            if (model.find("id")->asString() == "own-henon-heiles") {
                isThere = true;
                QCOMPARE(model.find("parameters")->asArray()[0].find("default")->asNumber(), 2.0);
            }
        QVERIFY(isThere);
        // A wrong key of one is an error that names the nearest, as of the supplied ones.
        try {
            api::Scene::parse(henonHeiles("own-henon-heiles"), {{"/model/lamda=1"}});
            QFAIL("accepted");
        } catch (const InvalidScene& e) {
            QVERIFY(std::string(e.what()).find("lambda") != std::string::npos);
        }
    }

    void whatIsAddedTooLateIsAnError() {
        (void)api::catalogue("models");
        QVERIFY_EXCEPTION_THROWN(
            api::addSystem({"late", "late", {{"x"}}}, [](const api::Parameters&) { return Relativistic{}; }),
            std::logic_error);
        QVERIFY_EXCEPTION_THROWN(api::addSpace({"late", "late"}, trigonometric), std::logic_error);
    }
};

EXTREMAL_TEST(OwnTest)
}  // namespace extremal::own_test

#include "own_test.moc"
