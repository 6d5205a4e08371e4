// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers of any size are measured as they are: squares that leave the range of numbers make no error 0.
#include <QTest>

#include <cmath>
#include <limits>

#include "engine/model/system.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::sizes_test {
namespace {

Summary oscillator(double q, const char* scheme) {
    const ReadScene read =
        readScene(QByteArray(R"json({"extremal":1,"model":{"type":"harmonic-oscillator"},"initial":{"q":[Q]},
            "time":{"end":10},"observe":["error"],"schemes":[{"step":0.1,SCHEME}]})json")
                      .replace("Q]", QByteArray::number(q, 'g', 17) + "]")
                      .replace("SCHEME", scheme)
                      .toStdString());
    return run(read.scene).schemes.front()->summary;
}

}  // namespace

class SizesTest : public QObject {
    Q_OBJECT
private slots:
    void errorsScaleWithTheState() {
        for (const char* scheme : {R"("baseline":"stormer-verlet")", R"("scheme":"midpoint")"}) {
            const Summary one = oscillator(1, scheme);
            for (const double size : {1e200, 1e-200}) {
                const Summary s = oscillator(size, scheme);
                QCOMPARE(s.status, RunStatus::done);
                QVERIFY(std::abs(s.maxError / size / one.maxError - 1) < 1e-9);  // 1e-13
                QVERIFY(std::abs(s.finalError / size / one.finalError - 1) < 1e-9);
            }
        }
    }
    void distancesOfAnySize() {
        const double x[] = {3e200, 0, 4e-200, 0}, zero[] = {0, 4e200, 0, 3e-200};
        double values[4];
        coordinateError(2, x, zero, values);
        QVERIFY(std::abs(values[0] / 5e200 - 1) < 1e-15);
        QVERIFY(std::abs(values[1] / 5e-200 - 1) < 1e-15);
        coordinateError(2, x, x, values);
        QCOMPARE(values[0], 0.0);
        const double unknown[] = {std::nan(""), 0, 0, 0};
        coordinateError(2, unknown, x, values);
        QVERIFY(std::isnan(values[0]) && !std::isnan(values[1]));
    }
};

EXTREMAL_TEST(SizesTest)
}  // namespace extremal::sizes_test
#include "sizes_test.moc"
