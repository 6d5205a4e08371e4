// SPDX-License-Identifier: GPL-3.0-or-later
/// Kicks of wave functions by a potential and their density, against numbers of twice the precision.
#include <QTest>

#include <boost/multiprecision/float128.hpp>

#include <algorithm>
#include <complex>
#include <cstring>
#include <random>
#include <vector>

#include "engine/step/wave_kick.hpp"
#include "tests/tools/test.hpp"

namespace extremal::wave_kick_test {
namespace {

using Quadruple = boost::multiprecision::float128;

struct Places {
    std::vector<double> V, psi;
    Places(std::size_t n, double range) : V(n), psi(2 * n) {
        std::mt19937_64 generator(7);
        std::uniform_real_distribution<double> any(-1, 1);
        for (double& v : V) v = range * any(generator);
        for (double& p : psi) p = any(generator);
    }
    /// The largest error of a kick, in parts of |psi|.
    double worstOf(double density, double factor, double scale) const {
        std::vector<double> kicked = psi;
        kickByDensity(V.data(), density, factor, scale, V.size(), kicked.data());
        double worst = 0;
        for (std::size_t j = 0; j < V.size(); ++j) {
            const double x = psi[2 * j], y = psi[2 * j + 1],
                         angle = factor * (V[j] + density * (x * x + y * y));
            const Quadruple c = cos(Quadruple(angle)) * scale, s = sin(Quadruple(angle)) * scale;
            const auto re = static_cast<double>(Quadruple(kicked[2 * j]) - (x * c - y * s)),
                       im = static_cast<double>(Quadruple(kicked[2 * j + 1]) - (x * s + y * c));
            worst = std::max(worst, std::hypot(re, im) / (scale * std::hypot(x, y)));
        }
        return worst;
    }
};

}  // namespace

class WaveKickTest : public QObject {
    Q_OBJECT
private slots:
    /// Angles below pi/4, of all quadrants, and some beyond what is reduced; numbers that fill registers and
    /// some more.
    void turnsByTheAngle_data() {
        QTest::addColumn<double>("range");
        QTest::newRow("small") << 0.5;
        QTest::newRow("about pi/4") << 1.4;
        QTest::newRow("quadrants") << 40.0;
        QTest::newRow("huge") << 3e5;
    }
    void turnsByTheAngle() {
        QFETCH(const double, range);
        for (const std::size_t n : {1, 7, 8, 64, 101}) {
            const double worst = Places(n, range).worstOf(0.2, -0.7, 1.0 / 64);
            QVERIFY2(worst < 1e-15, qPrintable(QString::number(worst)));
        }
    }
    /// Whatever its neighbours are: with them a place is in another pack, of other angles.
    void ofAPlaceDoesNotDependOnOthers() {
        Places all(40, 0.5);
        for (std::size_t j = 3; j < 40; j += 11) all.V[j] = j % 2 ? 3e5 : 50;
        std::vector<double> together = all.psi;
        kickByDensity(all.V.data(), 0.3, 1, 0.5, 40, together.data());
        for (std::size_t j = 0; j < 40; ++j) {
            double alone[2] = {all.psi[2 * j], all.psi[2 * j + 1]};
            kickByDensity(&all.V[j], 0.3, 1, 0.5, 1, alone);
            QVERIFY(std::memcmp(alone, &together[2 * j], sizeof(alone)) == 0);
        }
    }
};

EXTREMAL_TEST(WaveKickTest)

}  // namespace extremal::wave_kick_test

#include "wave_kick_test.moc"
