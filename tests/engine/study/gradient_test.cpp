// SPDX-License-Identifier: GPL-3.0-or-later
/// Gradients of runs by a sweep backwards (study/gradient): of integrals, through tables of controls and over
/// many segments, against closed forms and differences. That the sweep is the transpose of the columns of
/// derivatives is a law (tests/laws/sensitivity_test.cpp).
#include <QTest>

#include <array>
#include <cmath>

#include "engine/scene/write/codec.hpp"
#include "engine/study/gradient/gradient.hpp"
#include "engine/study/gradient/run_derivative.hpp"
#include "tests/tools/pointer_of.hpp"
#include "tests/tools/test.hpp"

namespace extremal::gradient_test {
namespace {

ResolvedScene sceneOf(const std::string& text, const std::vector<Override>& changes = {}) {
    const ReadScene read = readScene(text, changes);
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return *read.resolved;
}

std::string textOf(const std::string& model, const std::string& initial, const std::string& end,
                   const std::string& scheme) {
    return R"({"extremal":1,"model":)" + model + R"(,"initial":)" + initial + R"(,"time":{"end":)" + end +
           R"(},"schemes":[)" + scheme + R"(],"reference":{"type":"none"}})";
}
const std::string pendulum = R"({"type":"lagrangian","coordinates":["x"],"parameters":{"m":1.5,"k":2},
    "lagrangian":"m*x_t^2/2+k*cos(x) "})",
                  start = R"({"q":[1.2],"v":[0.3]})";

double derivative(const GradientAnswer& answer, std::size_t i) { return answer.rows.at(i).derivative; }

/// By differences of order 8 of the value of the same run.
double differenced(const std::string& text, const std::string& pointer, double mu,
                   const GradientRequest& request) {
    constexpr std::array<double, 4> weights{4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    const double e = (mu == 0 ? 1 : std::abs(mu)) / 128;
    double sum = 0;
    for (int k = 1; k <= 4; ++k)
        for (const int side : {1, -1})
            sum += side * weights[static_cast<std::size_t>(k - 1)] / e *
                   gradient(sceneOf(text, {{pointer, Value(mu + side * k * e)}}), request).value;
    return sum;
}

}  // namespace

class GradientTest : public QObject {
    Q_OBJECT
private slots:
    /// Steps that begin with the force at the end of the last one: it was another control's. Against
    /// differences of the run, with controls that jump from step to step.
    void controlsThatJump_data() {
        QTest::addColumn<QString>("scheme");
        for (const char* scheme : {"stormer-verlet", "galerkin-lobatto-1", "galerkin-lobatto-3"})
            QTest::newRow(scheme) << scheme;
    }
    void controlsThatJump() {
        QFETCH(QString, scheme);
        const std::string kind = scheme == "stormer-verlet" ? "baseline" : "scheme";
        const ResolvedScene scene = sceneOf(textOf(
            R"({"type":"lagrangian","coordinates":["x"],"lagrangian":"x_t^2/2+cos(x)+u*x","controls":{"u":"0"}})",
            start, "1", "{\"" + kind + "\":\"" + scheme.toStdString() + "\",\"step\":0.1}"));
        RunDerivative run(scene, {.controls = {{"u", 2}}});
        Eigen::MatrixXd c(2, run.steps());
        for (Eigen::Index k = 0; k < c.cols(); ++k)
            c.col(k) << std::cos(3.0 * static_cast<double>(k)), std::sin(5.0 * static_cast<double>(k));
        const auto endOf = [&](const Eigen::MatrixXd& at) {
            if (run.run(run.start(), at) != Outcome::converged) qFatal("no run");
            return run.end()(0);
        };
        constexpr double delta = 1e-3, weights[] = {45, -9, 1};
        Eigen::MatrixXd differences = Eigen::MatrixXd::Zero(c.rows(), c.cols());
        for (Eigen::Index i = 0; i < c.size(); ++i)
            for (int k = 1; k <= 3; ++k)
                for (const int side : {1, -1}) {
                    Eigen::MatrixXd moved = c;
                    moved(i) += side * k * delta;
                    differences(i) += side * weights[k - 1] * endOf(moved) / (60 * delta);
                }
        endOf(c);
        RunDerivative::Derivatives by;
        QVERIFY(run.differentiate(run.columnOf(Eigen::Vector2d(1, 0), 0), by) == Outcome::converged);
        const double apart = (by.byCoefficients.front() - differences).cwiseAbs().maxCoeff();
        qInfo("%.1e of %.2g", apart, differences.cwiseAbs().maxCoeff());
        QVERIFY(apart < 1e-11);
    }

    /// Of x = cos(w t) int x^2 dt = T/2 + sin(2 w T)/(4 w), and its derivative by w.
    void integralsHaveTheOrderOfTheScheme_data() {
        QTest::addColumn<int>("degree");
        for (const int degree : {1, 2, 3}) QTest::addRow("Gauss %d", degree) << degree;
    }
    void integralsHaveTheOrderOfTheScheme() {
        QFETCH(int, degree);
        const double T = 4;
        const auto run = [&](const std::string& step) {
            return gradient(sceneOf(textOf(pendulum, start, "4",
                                           R"({"scheme":"galerkin-gauss-)" + std::to_string(degree) +
                                               R"(","step":)" + step + "}")),
                            {"", "x^2*cos(x_t) ", {"/model/parameters/k", "/initial/q/0"}, ""});
        };
        const GradientAnswer exact =
            gradient(sceneOf(textOf(pendulum, start, "4", R"({"scheme":"galerkin-gauss-6","step":0.05})")),
                     {"", "x^2*cos(x_t) ", {"/model/parameters/k", "/initial/q/0"}, ""});
        QVERIFY(exact.isFound() && T == 4);
        const GradientAnswer coarse = run("0.2"), fine = run("0.1");
        const auto order = [](double a, double b, double x) {
            return std::log2(std::abs(a - x) / std::abs(b - x));
        };
        const double ofValue = order(coarse.value, fine.value, exact.value),
                     byNumber = order(derivative(coarse, 0), derivative(fine, 0), derivative(exact, 0)),
                     byStart = order(derivative(coarse, 1), derivative(fine, 1), derivative(exact, 1));
        qInfo("orders: %.2f, by k %.2f, by the start %.2f", ofValue, byNumber, byStart);
        for (const double each : {ofValue, byNumber, byStart}) QVERIFY(std::abs(each - 2 * degree) < 0.2);
    }
    void integralsAreDifferentiatedExactly() {
        const std::string hamiltonian =
            R"({"type":"hamiltonian","coordinates":["x"],"parameters":{"a":1.1,"k":2},
                "hamiltonian":{"kinetic":"p_x^2/2*(1+a*x^2/4) ","potential":"-k*cos(x) "}})";
        for (const auto& [model, initial, of, over, scheme] :
             {std::tuple{pendulum, start, "m*x^2*p_x", "k*x^2*x_t^2", "galerkin-gauss-2"},
              std::tuple{pendulum, start, "t*sin(x) ", "x_t^4+t*x", "galerkin-lobatto-3"},
              std::tuple{hamiltonian, std::string(R"({"q":[1],"p":[0.4]})"), "a*x", "k*x*p_x^2+a",
                         "galerkin-gauss-2"}}) {
            const std::string text =
                textOf(model, initial, "3", std::string(R"({"step":0.1,"scheme":")") + scheme + "\"}");
            const std::string first = text.find("\"m\"") != std::string::npos ? "m" : "a";
            const GradientRequest request{
                of, over, {"/model/parameters/" + first, "/model/parameters/k", "/initial/q/0"}, ""};
            const GradientAnswer answer = gradient(sceneOf(text), request);
            QVERIFY2(answer.isFound(), answer.problem.c_str());
            for (std::size_t i = 0; i < request.with.size(); ++i) {
                const double other = differenced(text, request.with[i], answer.rows[i].value, request);
                const double off = std::abs(other - derivative(answer, i));
                qInfo("%s: %s off by %.1e of %.2g", scheme, request.with[i].c_str(), off, other);
                QVERIFY(off <= 1e-10 * std::max(1.0, std::abs(other)));
            }
        }
    }
    /// Segments of states that are computed again give what keeping all of them gives.
    void longRunsKeepFewStates() {
        const std::vector<std::string> with{"/model/parameters/k", "/initial/q/0"};
        const auto run = [&](const std::string& end) {
            return gradient(
                sceneOf(textOf(pendulum, start, end, R"({"scheme":"galerkin-gauss-2","step":0.05})")),
                {"x*p_x", "x^2", with, ""});
        };
        const GradientAnswer shorter = run("200"), longer = run("250");
        QCOMPARE(shorter.steps, 4000);
        QVERIFY(shorter.statesKept >= 4000);
        QCOMPARE(longer.steps, 5000);
        QVERIFY2(longer.statesKept <= 150, std::to_string(longer.statesKept).c_str());
        // The same run by parts: what begins at 200 continues it, so that derivatives by k are differences.
        for (std::size_t i = 0; i < with.size(); ++i) {
            const double mu = i == 0 ? 2 : 1.2, e = 1e-5;
            double sides[2];
            for (const int side : {0, 1})
                sides[side] = gradient(sceneOf(textOf(pendulum, start, "250",
                                                      R"({"scheme":"galerkin-gauss-2","step":0.05})"),
                                               {{with[i], Value(mu + (side ? e : -e))}}),
                                       {"x*p_x", "x^2", {with[1 - i]}, ""})
                                  .value;
            const double other = (sides[1] - sides[0]) / (2 * e), off = other - derivative(longer, i);
            qInfo("%s: %.8g, differences %.8g", with[i].c_str(), derivative(longer, i), other);
            QVERIFY(std::abs(off) < 1e-5 * std::abs(other));
        }
    }
    /// All rows of a table at once, in a Lagrangian and in a force.
    void rowsOfATableAreControls_data() {
        QTest::addColumn<QString>("model");
        QTest::newRow("Lagrangian") << R"("lagrangian":"x_t^2/2+cos(x)+u*x")";
        QTest::newRow("force") << R"J("lagrangian":"x_t^2/2+cos(x)","forces":{"x":"u-0.1*x_t"})J";
    }
    void rowsOfATableAreControls() {
        QFETCH(QString, model);
        std::string rows;
        for (int k = 0; k <= 8; ++k)
            rows += (k ? ",[" : "[") + std::to_string(k / 4.) + "," + std::to_string(std::sin(k)) + "]";
        const std::string text =
            textOf(R"({"type":"lagrangian","coordinates":["x"],)" + model.toStdString() +
                       R"(,"controls":{"u":{"table":[)" + rows + "]}}}",
                   R"({"q":[0.4],"p":[0]})", "2", R"({"scheme":"galerkin-gauss-2","step":0.125})");
        const GradientRequest request{"x^2+p_x", "u^2/2+x*u", {"/initial/q/0", "/model/controls/u"}, ""};
        const GradientAnswer answer = gradient(sceneOf(text), request);
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        QCOMPARE(answer.rows.size(), std::size_t(10));
        for (const std::size_t i : {std::size_t(1), std::size_t(2), std::size_t(6), std::size_t(9)}) {
            const GradientRow& row = answer.rows[i];
            const double other = differenced(text, row.pointer, row.value, request);
            qInfo("%s: off by %.1e of %.3g", row.name.c_str(), std::abs(other - row.derivative), other);
            QVERIFY(std::abs(other - row.derivative) <= 1e-10 * std::max(1.0, std::abs(other)));
        }
    }
    void whatCannotBeMetIsRefused() {
        const ResolvedScene scene =
            sceneOf(textOf(pendulum, start, "1", R"({"scheme":"galerkin-gauss-2","step":0.1})"));
        const auto refused = [&](const GradientRequest& request) {
            return pointerOf([&] { (void)gradient(scene, request); });
        };
        QCOMPARE(refused({"", "", {"/model/parameters/k"}, ""}), std::string("--of"));
        QCOMPARE(refused({"y", "", {"/model/parameters/k"}, ""}), std::string("--of"));
        QCOMPARE(refused({"", "y", {"/model/parameters/k"}, ""}), std::string("--over"));
        QCOMPARE(refused({"x", "", {}, ""}), std::string("--with"));
        QCOMPARE(refused({"x", "", {"/model/parameters/q"}, ""}), std::string("--with"));
        QCOMPARE(refused({"x", "", {"/model/controls/u"}, ""}), std::string("--with"));
        QCOMPARE(refused({"x", "", {"/initial/q/0", "/initial/q/0"}, ""}), std::string("--with"));
        QCOMPARE(refused({"x", "", {"/initial/q/0"}, "missing"}), std::string("--scheme"));
        const ResolvedScene between =
            sceneOf(textOf(R"({"type":"lagrangian","coordinates":["x"],"lagrangian":"x_t^2/2+u*x",
                "controls":{"u":{"table":[[0,1],[0.25,2],[1,0]]}}})",
                           R"({"q":[0.4],"p":[0]})", "1", R"({"scheme":"galerkin-gauss-2","step":0.1})"));
        QCOMPARE(pointerOf([&] {
                     (void)gradient(between, {"x", "", {"/model/controls/u"}, ""});
                 }),
                 std::string("--with"));
    }
};

EXTREMAL_TEST(GradientTest)

}  // namespace extremal::gradient_test

#include "gradient_test.moc"
