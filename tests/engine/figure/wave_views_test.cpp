// SPDX-License-Identifier: GPL-3.0-or-later
/// Profiles of wave functions: modulus, real and imaginary part, from a plane wave whose parts are known.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "engine/figure/image/digest.hpp"
#include "engine/figure/image/phase_colour.hpp"
#include "engine/figure/sample.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/view/catalog.hpp"
#include "tests/tools/test.hpp"

namespace extremal::wave_views_test {
namespace {

ReadScene waveScene(const std::string& views) {
    return readScene(R"({"extremal": 1, "model": {"type": "schrodinger", "potential": "free", "modes": 32},
        "initial": {"psi": {"packet": "plane-wave", "wave_number": 3}}, "time": {"end": 0.5},
        "schemes": [{"label": "a", "step": 0.05, "scheme": "schrodinger-gauss-8"}, {"label": "b", "step": 0.05, "baseline": "strang"}],
        "observe": ["norm"], "views": )" +
                     views + "}");
}

}  // namespace

class WaveViewsTest : public QObject {
    Q_OBJECT

    static Figure profile(const std::string& part) {
        static const Scene scene = waveScene(R"(["profile"])").scene;
        static const Comparison comparison = run(scene);
        static const System system = makeSystem(scene);
        View view{"profile", "", ""};
        if (!part.empty()) view.keys.keys.emplace_back("part", part);
        return makeFigure(comparison, view, &system);
    }

private slots:
    void thePhaseGoesRoundTheColoursEvenly() {
        for (int k = -20000; k <= 20000; ++k) {
            const double turns = 1e-3 * k / 7;
            const auto colour = phaseColour(turns);
            for (int i = 0; i < 3; ++i) {
                const double exact = 0.52 + 0.4 * std::cos(2 * std::numbers::pi * (turns - i / 3.0));
                QVERIFY(std::abs(colour[static_cast<std::size_t>(i)] - exact) < 2e-5);
            }
        }
        QVERIFY(std::isnan(phaseColour(std::nan("")).front()));
    }
    /// exp(i (3 x - 4.5 t))/sqrt(2 pi) at t = 0.5; Gauss 16 and the splitting, without a potential, are exact
    /// to round-off.
    void partsAreThoseOfThePlaneWave() {
        const auto largest = [](const Series& s, const auto& exact) {
            double worst = 0;
            for (std::size_t j = 0; j < s.x.size(); ++j)
                worst = std::max(worst, std::abs(s.y[j] - exact(3 * s.x[j] - 2.25)));
            return worst;
        };
        const double size = 1 / std::sqrt(2 * M_PI);
        const auto cosine = [&](double phase) { return size * std::cos(phase); };
        const auto sine = [&](double phase) { return size * std::sin(phase); };
        for (std::size_t scheme = 0; scheme < 2; ++scheme) {
            QVERIFY(largest(profile("real").series().at(scheme), cosine) < 1e-13);  // measured 5.1e-15
            QVERIFY(largest(profile("imaginary").series().at(scheme), sine) < 1e-13);
            QVERIFY(largest(profile("modulus").series().at(scheme), [&](double) { return size; }) < 1e-13);
            QVERIFY(largest(profile("imaginary").series().at(scheme), cosine) >
                    0.3);  // parts are not exchanged
            QVERIFY(largest(profile("imaginary").series().at(scheme), [&](double p) { return -sine(p); }) >
                    0.3);
        }
        QCOMPARE(profile("real").y.title, std::string("Re ψ"));
        QCOMPARE(profile("imaginary").y.title, std::string("Im ψ"));
        QCOMPARE(profile("").y.title, std::string("|ψ|"));
        QCOMPARE(digest(profile("")), digest(profile("modulus")));
    }
    void bothPartsBelongToTheirScheme() {
        const Figure both = profile("both");
        QCOMPARE(both.series().size(), std::size_t(4));
        for (std::size_t i = 0; i < 4; ++i) {
            const Series& s = both.series()[i];
            QCOMPARE(s.label, std::string(i < 2 ? "a" : "b"));
            QCOMPARE(s.style, i < 2 ? 0 : 1);
            QCOMPARE(s.tone == Tone::pale, i % 2 == 1);
            QVERIFY(s.y == profile(i % 2 == 0 ? "real" : "imaginary").series().at(i / 2).y);
        }
        QCOMPARE(both.y.title, std::string("ψ"));
        QCOMPARE(both.subtitle, std::string("at t = 0.5, Im ψ is pale"));
        const std::string csv = figureCsv(both, false);
        QVERIFY(csv.find("\n\"a, Re ψ\",0,") != std::string::npos &&
                csv.find("\n\"b, Im ψ\",0,") != std::string::npos);
    }
    void theKeyIsReadAndChecked() {
        const auto read = waveScene(
            R"([{"view": "profile", "part": "both"}, {"view": "profile", "part": "modulus"}, "profile"])");
        QVERIFY(read.errors.empty());
        QCOMPARE(read.scene.views.at(0).keys.text("part"), std::string("both"));
        QVERIFY(read.scene.views.at(1) == read.scene.views.at(2));
        const auto wrong = waveScene(R"([{"view": "profile", "part": "phase"}])");
        QCOMPARE(wrong.errors.at(0).pointer, std::string("/views/0/part"));
        QVERIFY(!waveScene(R"([{"view": "carpet", "part": "real"}])").errors.empty());
    }

    /// A plane wave exp(i (2 x - 3 y)): one size everywhere, phases known; 16 x 8 nodes.
    void viewsOfARectangle() {
        const ReadScene read = readScene(std::string_view(
            R"({"extremal": 1, "model": {"type": "schrodinger-2d", "modes": 16, "modes_y": 8, "domain_y": [1, 3]},
            "initial": {"psi": {"packet": "plane-wave", "wave_number": 2, "wave_number_y": "-pi"}}, "time": {"end": 0.5},
            "schemes": [{"label": "a", "step": 0.25, "baseline": "strang"}, {"label": "b", "step": 0.05, "baseline": "strang"}],
            "observe": ["norm"], "views": [{"view": "profile", "scheme": "b"}, "carpet", "spectrum"]})"));
        QVERIFY(read.errors.empty());
        const System system = makeSystem(read.scene);
        const Comparison comparison = run(read.scene);
        const Figure profile = makeFigure(comparison, read.scene.views[0], &system);
        QCOMPARE(profile.title, std::string("Profile of b"));
        QVERIFY(profile.heat() && profile.heat()->columns == 16 && profile.heat()->rows == 8);
        const double size = 1 / std::sqrt(4 * M_PI), E = (4 + M_PI * M_PI) / 2;
        for (int column = 0; column < 16; ++column)
            for (int row = 0; row < 8; ++row) {
                const auto k = static_cast<std::size_t>(column * 8 + row);
                const double x = 2 * M_PI * column / 16, y = 1 + 2.0 * row / 8,
                             phase = 2 * x - M_PI * y - 0.5 * E;
                QVERIFY(std::abs(profile.heat()->values[k] - size) < 1e-13);
                QVERIFY(std::abs(std::remainder(profile.heat()->hues[k] - phase / (2 * M_PI), 1)) < 1e-12);
            }
        // A node is in the middle of its cell.
        QVERIFY(std::abs(profile.heat()->left + M_PI / 16) < 1e-14 &&
                std::abs(profile.heat()->bottom - 0.875) < 1e-14);
        View real = read.scene.views[0];
        real.keys.keys.emplace_back("part", "real");
        const Figure parts = makeFigure(comparison, real, &system);
        QVERIFY(parts.heat()->hues.empty());
        QVERIFY(std::abs(parts.heat()->values[3] - size * std::cos(-M_PI * 1.75 - 0.5 * E)) < 1e-13);
        // The density along x is 1/(2 pi).
        const Figure carpet = makeFigure(comparison, read.scene.views[1], &system);
        QCOMPARE(carpet.heat()->rows, 16);
        for (const double v : carpet.heat()->values) QVERIFY(std::abs(v - 1 / std::sqrt(2 * M_PI)) < 1e-13);
        // One wave number along each.
        const Figure spectrum = makeFigure(comparison, read.scene.views[2], &system);
        QCOMPARE(spectrum.series().size(), std::size_t{4});
        for (const auto& [series, number, modes] : {std::tuple{0, 2, 16}, {1, -1, 8}}) {
            const Series& s = spectrum.series()[static_cast<std::size_t>(series)];
            for (std::size_t i = 0; i < s.x.size(); ++i)
                if (std::isfinite(s.y[i])) QVERIFY(std::abs(s.y[i] - (s.x[i] == number ? 1 : 0)) < 1e-13);
            QCOMPARE(s.x.size(), static_cast<std::size_t>(modes));
        }
        QCOMPARE(missingFor({"levels", "", ""}, system), std::string("a wave function over one dimension"));
        // A profile over a line shows every scheme, and names none.
        QCOMPARE(waveScene(R"([{"view": "profile", "scheme": "b"}])").errors.at(0).pointer,
                 std::string("/views/0/scheme"));
    }
};

EXTREMAL_TEST(WaveViewsTest)
}  // namespace extremal::wave_views_test

#include "wave_views_test.moc"
