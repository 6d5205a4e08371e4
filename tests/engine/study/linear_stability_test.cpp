// SPDX-License-Identifier: GPL-3.0-or-later
/// Limits of linear stability are those of theory, and of what schemes claim.
#include <QTest>

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "engine/scene/write/codec.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/stability/linear_study.hpp"
#include "tests/tools/test.hpp"

namespace extremal::linear_stability_test {
namespace {

Scene sceneWith(const std::string& schemes, const std::string& model = R"("pendulum"},"initial":{"q":[1]})") {
    const ReadScene read = readScene(R"({"extremal":1,"model":{"type":)" + model +
                                     R"(,"time":{"end":1},"reference":"none","schemes":[)" + schemes + "]}");
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return read.scene;
}

using Complex = std::complex<double>;

LinearRegion regionOf(const std::string& scheme) { return linearStability(sceneWith(scheme), 0, {}).region; }

/// sum_k c_k z^k
Complex polynomial(const std::vector<double>& c, Complex z) {
    Complex sum = 0;
    for (auto each = c.rbegin(); each != c.rend(); ++each) sum = sum * z + *each;
    return sum;
}

/// The stability function of an explicit method of order p with p stages, and of Dormand-Prince 5.
const std::vector<double> rk4{1, 1, 1.0 / 2, 1.0 / 6, 1.0 / 24},
    dopri5{1, 1, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120, 1.0 / 600};

const std::string wave =
    R"json("schrodinger","modes":32,"potential":"cos(x)"},"initial":{"psi":{"packet":"gaussian","centre":3,
       "width":0.5,"wave_number":0}})json";

}  // namespace

class LinearStabilityTest : public QObject {
    Q_OBJECT
private slots:
    void limitsAreThoseOfTheory_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<double>("limit");
        const double none = HUGE_VAL;
        QTest::newRow("Störmer-Verlet") << R"("baseline":"stormer-verlet")" << 2.0;
        QTest::newRow("symplectic Euler") << R"("baseline":"symplectic-euler")" << 2.0;
        QTest::newRow("RK4") << R"("baseline":"rk4")" << 2 * std::numbers::sqrt2;
        QTest::newRow("midpoint") << R"("scheme":"midpoint")" << none;
        QTest::newRow("Gauss 3") << R"("scheme":"galerkin-gauss-3")" << none;
        // |tr/2| = |12 - 5 z^2 + z^4/4| / (12 + z^2) at 1 (Lobatto IIIA-IIIB of order 4).
        QTest::newRow("Lobatto 2") << R"("scheme":"galerkin-lobatto-2")" << 2 * std::numbers::sqrt2;
    }
    void limitsAreThoseOfTheory() {
        QFETCH(QString, scheme);
        QFETCH(double, limit);
        const LinearStability r =
            linearStability(sceneWith("{\"step\":0.01," + scheme.toStdString() + "}"), 0, {});
        QCOMPARE(r.reason, "");
        qInfo("%.12g", r.limit());
        QCOMPARE(r.hasLimit, std::isfinite(limit));
        if (r.hasLimit) QVERIFY(std::abs(r.limit() / limit - 1) < 1e-6);
    }
    void thePrintedWaveSchemeIsStableToTheRootOfThree() {
        const LinearStability r =
            linearStability(sceneWith(R"({"step":0.001,"scheme":"schrodinger-three-level"})", wave), 0, {});
        QCOMPARE(r.reason, "");
        qInfo("%.12g", r.limit());
        QVERIFY(std::abs(r.limit() - std::numbers::sqrt3) < 1e-5);
    }
    void gaussStepsOfWavesHaveNoLimit() {
        const LinearStability r =
            linearStability(sceneWith(R"({"step":0.001,"scheme":"schrodinger-gauss-2"})", wave), 0, {});
        QCOMPARE(r.reason, "");
        QVERIFY(!r.hasLimit);
    }
    void phaseErrorsAreThoseOfTheScheme() {
        const LinearStability r = linearStability(sceneWith(R"({"step":0.01,"scheme":"midpoint"})"), 0, {});
        for (const LinearStability::Point& p : r.points) {
            QVERIFY(std::abs(p.amplification - 1) < 1e-12);
            // tan(phase/2) = z/2
            QVERIFY(std::abs(p.phaseError - (2 * std::atan(p.z / 2) - p.z) / p.z) < 1e-12);
            if (p.z > 3) break;
        }
        const LinearStability rk = linearStability(sceneWith(R"({"step":0.01,"baseline":"rk4"})"), 0, {});
        const double z = rk.points[9].z, square = z * z;  // |R(iz)|^2 = 1 - z^6/72 + z^8/576
        QVERIFY(std::abs(rk.points[9].amplification - std::sqrt(1 - square * square * square / 72 +
                                                                square * square * square * square / 576)) <
                1e-13);
    }
    void regionsAreThoseOfTheory() {
        const std::pair<const char*, std::function<Complex(Complex)>> cases[] = {
            {R"({"step":0.01,"baseline":"rk4"})", [](Complex z) { return polynomial(rk4, z); }},
            {R"({"tolerance":1e-6,"baseline":"dopri5"})", [](Complex z) { return polynomial(dopri5, z); }},
            {R"({"step":0.01,"scheme":"midpoint"})",
             [](Complex z) { return (1.0 + z / 2.0) / (1.0 - z / 2.0); }},
            {R"({"step":0.01,"scheme":"galerkin-gauss-2"})",
             [](Complex z) { return (1.0 + z / 2.0 + z * z / 12.0) / (1.0 - z / 2.0 + z * z / 12.0); }},
        };
        for (const auto& [scheme, r] : cases) {
            const LinearRegion region = regionOf(scheme);
            QCOMPARE(region.points.size(), static_cast<std::size_t>(region.columns * region.rows));
            double worst = 0;
            for (int column = 0; column < region.columns; ++column)
                for (int row = 0; row < region.rows; ++row) {
                    const Complex z{region.re(column), region.im(row)};
                    const LinearRegion::Point& p = region.at(column, row);
                    QVERIFY(!p.isOnCut);
                    // Round-off is that of the eigenvalue exp(-z) that stands beside it.
                    const double size = std::abs(r(z)), other = std::abs(r(-z));
                    worst = std::max(worst, std::abs(p.amplification - size) / std::max({size, other, 1.0}));
                    if (z != 0.0 && size > 0.1)
                        QVERIFY(std::abs(std::polar(1.0, p.phaseError * std::abs(z) + z.imag()) -
                                         r(z) / size) < 1e-9 * std::max(1.0, other / size));
                }
            qInfo("%s: %.2g", scheme, worst);
            QVERIFY(worst < 5e-14);  // 7.6e-15
        }
    }
    void splittingsKeepAnInterval() {
        // r + 1/r = 2 + z^2: inside on the left, and on the imaginary axis up to 2.
        const LinearRegion region = regionOf(R"({"step":0.01,"baseline":"stormer-verlet"})");
        for (int column = 0; column < region.columns; ++column)
            for (int row = 0; row < region.rows; ++row) {
                const LinearRegion::Point& p = region.at(column, row);
                const double re = region.re(column), im = region.im(row);
                QCOMPARE(p.isOnCut, re == 0 && im > 2);
                if (re == 0 && im < 2)
                    QVERIFY(std::abs(p.amplification - 1) < 1e-12);
                else
                    QVERIFY(re < 0 ? p.amplification < 1 : p.amplification > 1);
            }
    }
    void formulasWithAnErrorControlHaveALimit() {
        const LinearStability r =
            linearStability(sceneWith(R"({"tolerance":1e-6,"baseline":"dopri5"})"), 0, {});
        QCOMPARE(r.reason, "");
        const auto size = [](double z) { return std::abs(polynomial(dopri5, {0, z})); };
        qInfo("%.9g", r.limit());
        QVERIFY(size(r.low) <= 1 + 1e-6 && size(r.high) > 1 + 1e-6 - 1e-14);
    }
    void whatHasNoLinearStepSaysWhy() {
        const auto reasonOf = [](const std::string& scheme) {
            return linearStability(sceneWith(scheme), 0, {}).reason;
        };
        QVERIFY(!reasonOf(R"({"tolerance":1e-6,"baseline":"bulirsch-stoer"})").empty());
        QVERIFY(!reasonOf(R"({"step":0.1,"scheme":"sem-1"})").empty());
        const LinearStability waves =
            linearStability(sceneWith(R"({"step":0.001,"scheme":"schrodinger-gauss-2"})", wave), 0, {});
        QVERIFY(waves.region.points.empty() && !waves.region.reason.empty());
    }
    void aStudyIsReadBackFromItsLines() {
        const ReadScene read = readScene(toValue(
            sceneWith(R"({"step":0.01,"baseline":"rk4"},{"tolerance":1e-6,"baseline":"bulirsch-stoer"})")));
        LinearStudy study(*read.resolved, {}), again(*read.resolved, {});
        runLines(study, [&](const std::string& line) { QVERIFY(takeLine(line, again)); }, {});
        QVERIFY(study.isComplete() && again.isComplete());
        const StudyEntry& entry = *findStudy("linear-stability");
        const auto texts = [&](const LinearStudy& s) {
            std::string text;
            for (const StudyTable& table : tablesOf(entry, s)) text += csvText(table);
            return text;
        };
        QCOMPARE(texts(again), texts(study));
        QVERIFY(texts(study).find("rk4") != std::string::npos);
    }
};

EXTREMAL_TEST(LinearStabilityTest)
}  // namespace extremal::linear_stability_test
#include "linear_stability_test.moc"
