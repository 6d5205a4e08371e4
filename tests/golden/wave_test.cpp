// SPDX-License-Identifier: GPL-3.0-or-later
/// Golden images of a wave function: stage, carpet, profile, spectrum, and errors against steps.
#include <QTest>

#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/engine/figure/hand_made.hpp"
#include "tests/golden/golden_check.hpp"
#include "tests/tools/test.hpp"
#include "ui/pictures/snapshot.hpp"
#include "ui/plots/plot_renderer.hpp"

namespace extremal::wave_test {

class WaveGoldenTest : public QObject {
    Q_OBJECT

    /// Every coefficient is well above round-off, so that the pictures do not depend on it.
    static const Scene& scene() {
        static const Scene read = readScene(std::string(R"J({"extremal": 1, "title": "A packet in a well",
            "model": {"type": "schrodinger", "potential": "5*(1 - cos(x))", "modes": 32},
            "initial": {"psi": {"packet": "periodic-gaussian", "kappa": 12, "centre": 2, "wave_number": 2}}, "time": {"end": 2},
            "schemes": [{"label": "Gauss 8", "step": 0.05, "scheme": "schrodinger-gauss-4"},
                        {"label": "Crank-Nicolson", "step": 0.1, "baseline": "crank-nicolson"}],
            "reference": {"type": "none"}, "observe": ["norm"], "output": {"every": 0.1}, "views": ["stage", "carpet"]})J"))
                                      .scene;
        return read;
    }
    static const Comparison& comparison() {
        static const Comparison result = run(scene());
        return result;
    }
    static Figure figure(const std::string& view, const std::string& part = "") {
        static const System system = makeSystem(scene());
        View v;
        v.id = view;
        if (!part.empty()) v.keys.keys.emplace_back("part", part);
        return makeFigure(comparison(), v, &system);
    }
    static QImage picture(const Figure& f, const Theme& theme = Theme::light()) {
        return renderFigure(f, {480, 320}, theme);
    }
    static void check(const QImage& image, const QString& name,
                      const GoldenLimits& limits = GoldenLimits::plot()) {
        const GoldenResult result = checkGolden(image, name, limits);
        QVERIFY2(result.isEqual, qPrintable(result.message));
    }

private slots:
    void theStageMatchesItsImage() {
        SnapshotRequest request;
        request.view = "stage";
        request.width = 480;
        request.height = 320;
        request.time = 1.2;
        check(snapshotImage(std::make_shared<const Comparison>(comparison()), request), "wave-stage",
              GoldenLimits::stage());
    }
    void theCarpetMatchesItsImage() { check(picture(figure("carpet")), "wave-carpet"); }
    void theProfileMatchesItsImage() { check(picture(figure("profile")), "wave-profile"); }
    void bothPartsMatchTheirImages() {
        check(picture(figure("profile", "both")), "wave-parts");
        check(picture(figure("profile", "both"), Theme::dark()), "wave-parts-dark");
        Figure alike = figure("profile", "both");
        for (Series& s : alike.series()) s.tone = Tone::full;
        QVERIFY(!isWithin(compareImages(picture(figure("profile", "both")), picture(alike), 8),
                          GoldenLimits::plot()));
    }
    void theSpectrumMatchesItsImage() { check(picture(figure("spectrum")), "wave-spectrum"); }
    void theConjugateIsSeen() {
        Figure wrong = figure("carpet");
        for (double& turns : wrong.heat()->hues) turns = -turns;
        QVERIFY(!isWithin(compareImages(picture(figure("carpet")), picture(wrong), 8), GoldenLimits::plot()));
    }
    void theRectangleMatchesItsImage() {
        const Scene plane = readScene(std::string(R"J({"extremal": 1, "title": "A packet in the plane",
            "model": {"type": "schrodinger-2d", "potential": "4*(2 - cos(x) - cos(y + 0.5))", "modes": 32, "modes_y": 24, "domain_y": [0, 5]},
            "initial": {"psi": {"packet": "periodic-gaussian", "kappa": 6, "centre": 2, "wave_number": 3, "kappa_y": 4,
                                "centre_y": 3, "wave_number_y": "-2*pi/5"}}, "time": {"end": 1},
            "schemes": [{"label": "SRKN 11b", "step": 0.05, "baseline": "srkn-11b"}],
            "reference": {"type": "none"}, "observe": ["norm"], "views": ["stage", "profile"]})J"))
                                .scene;
        const auto result = std::make_shared<const Comparison>(run(plane));
        const System system = makeSystem(plane);
        SnapshotRequest request;
        request.view = "stage";
        request.width = 480;
        request.height = 320;
        request.time = 0.6;
        check(snapshotImage(result, request), "plane-stage", GoldenLimits::stage());
        for (const char* view : {"profile", "carpet", "spectrum"})
            check(picture(makeFigure(*result, View{view, "", ""}, &system), Theme::dark()),
                  QString("plane-%1-dark").arg(view));
        View real{"profile", "", ""};
        real.keys.keys.emplace_back("part", "real");
        check(picture(makeFigure(*result, real, &system)), "plane-real");
        // Seen failing: x and y exchanged.
        Figure wrong = makeFigure(*result, View{"profile", "", ""}, &system);
        const Figure right = wrong;
        std::swap(wrong.heat()->columns, wrong.heat()->rows);
        QVERIFY(!isWithin(compareImages(picture(right), picture(wrong), 8), GoldenLimits::plot()));
    }
    void errorsAgainstStepsMatchTheirImages() {
        Comparison made = handmade::comparison();
        for (auto& scheme : made.schemes) {
            auto counted = std::make_shared<SchemeResult>(*scheme);
            for (std::size_t r = 0; r < counted->trajectory.rows(); ++r)
                counted->trajectory.nodes.push_back(5.0 * static_cast<double>(r));
            scheme = counted;
        }
        const System pendulum = handmade::pendulum();
        View view{"energy", "", ""};
        view.keys.keys.emplace_back("against", "steps");
        check(picture(makeFigure(made, view, &pendulum)), "plot-against-steps");
    }
};

EXTREMAL_TEST(WaveGoldenTest)
}  // namespace extremal::wave_test

#include "wave_test.moc"
