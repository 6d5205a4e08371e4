// SPDX-License-Identifier: GPL-3.0-or-later
/// Phase portraits: what is about as wide as it is high has equal scales.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/figure/figure.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::phase_test {
namespace {

Figure phaseOf(const char* preset, const std::vector<Override>& overrides, const View& view) {
    const ReadScene read = readScene(findPreset(preset)->json, overrides);
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    const System system = makeSystem(read.scene);
    RunOptions options;
    options.products = {Product::denseOutput};
    Run run(read.scene, options);
    run.start();
    run.wait();
    return makeFigure(run.latest(), view, &system);
}

const View phase{"phase", "", ""};

double lengthOf(const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return *high - *low;
}

}  // namespace

class PhaseTest : public QObject {
    Q_OBJECT
private slots:
    void theCircleOfTheOscillatorIsRound() {
        const Figure figure = phaseOf("harmonic-oscillator", {}, phase);
        QVERIFY(figure.aspect == Aspect::equal);
        const Series& s = figure.series().front();
        QVERIFY(std::abs(lengthOf(s.x) / lengthOf(s.y) - 1) < 0.02);
    }
    void ellipsesAreEllipsesWhileBothAxesHaveRoom() {
        QVERIFY(phaseOf("harmonic-oscillator", {{"/initial/q/0", 0.01}}, phase).aspect == Aspect::equal);
        // Extension and momentum of a stiff spring: 0.1 m and 10 kg m/s.
        QVERIFY(phaseOf("spring-pendulum", {}, phase).aspect == Aspect::free);
    }
    void timeAndPlacesHaveScalesOfTheirOwn() {
        const View against{"phase", "t", "q.x"};
        for (const char* end : {"2", "3"})
            QVERIFY(phaseOf("harmonic-oscillator", {{"/time/end", std::string(end)}}, against).aspect ==
                    Aspect::free);
    }
};

EXTREMAL_TEST(PhaseTest)
}  // namespace extremal::phase_test

#include "phase_test.moc"
