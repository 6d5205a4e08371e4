// SPDX-License-Identifier: GPL-3.0-or-later
/// References by two independent routes: the bound holds, pulses are seen before the first step, and what is
/// said of a scheme's error is true or marked. Truth is a closed form, or an error-controlled code in
/// quadruple precision.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/model/typed/typed_mechanics.hpp"
#include "engine/run/reference/force_pulses.hpp"
#include "engine/run/reference/interval.hpp"
#include "engine/run/reference/members.hpp"
#include "engine/run/run.hpp"
#include "tests/tools/hard_motions.hpp"
#include "tests/tools/test.hpp"

namespace extremal::members_test {
namespace {

using namespace hard_motions;

double distanceOf(const std::vector<double>& a, const double* b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum = std::hypot(sum, a[i] - b[i]);
    return sum;
}

/// What a run says of its scheme's error, against the truth at the same rows.
struct Said {
    double said = 0, real = 0;  ///< up to the horizon
    Summary summary;
    ReferenceInfo reference;
    bool isTrueOrMarked() const {
        const bool isTrue = real >= 0.3 * said && real <= 3 * said;
        const bool isMarked = summary.floor >= said || summary.caution.find("judged") != std::string::npos;
        return isTrue || isMarked;
    }
};

Said saidOf(const Case& c) {
    const Comparison done = run(resolved(c.scene).scene);
    const SchemeResult& result = *done.schemes.front();
    Said said;
    said.summary = result.summary;
    said.reference = done.reference;
    const auto t = result.trajectory["t"], error = result.trajectory["error"];
    const std::size_t d = done.system->coordinates.size();
    for (std::size_t row = 0; row < t.size(); ++row) {
        if (t[row] > done.reference.horizon) break;
        std::vector<double> q;
        for (std::size_t k = 0; k < d; ++k) q.push_back(result.trajectory.columns[1 + k].values[row]);
        const double real = distanceOf(c.truth(t[row]), q.data());
        if (std::isfinite(real) && std::isfinite(error[row])) {
            said.real = std::max(said.real, real);
            said.said = std::max(said.said, error[row]);
        }
    }
    qInfo("said %.3g, true %.3g, floor %.2g of %s; %s, %s: bound %.2g, horizon %.4g; %s%s", said.said,
          said.real, said.summary.floor, said.summary.floorOf.c_str(), done.reference.chosen.c_str(),
          done.reference.confirmedBy.c_str(), done.reference.bound, done.reference.horizon,
          done.reference.caution.c_str(), said.summary.caution.c_str());
    return said;
}

/// The largest error of the reference itself up to its horizon, over the bound there.
double broken(const Case& c) {
    const ResolvedScene scene = resolved(c.scene);
    const Reference reference = makeReference(scene, {});
    if (!reference.make) return INFINITY;
    const ExactSolution solution = reference.make();
    std::vector<double> x(scene.initial.x.size());
    constexpr int samples = 499;
    const ReferenceInfo& info = reference.info;
    const double end = std::isfinite(info.horizon) ? info.horizon : scene.scene.end.value;
    double worst = 0;
    for (int i = 1; i <= samples; ++i) {
        const double t = end * i / samples;
        solution(t, x);
        const double error = distanceOf(c.truth(t), x.data());
        if (std::isfinite(error)) worst = std::max(worst, error);
    }
    double bound =
        std::isfinite(info.bound) ? std::max(info.bound, info.estimatedError) : info.estimatedError;
    if (std::isfinite(info.horizon)) {
        bound = 0;
        for (const ReferenceInfo::At& at : info.boundAlong)
            if (at.t <= end * (1 + 1e-12)) bound = std::max(bound, at.value);
    }
    qInfo("%s by %s: off by %.2e, bound %.2e", info.chosen.c_str(), info.confirmedBy.c_str(), worst, bound);
    return worst / bound;
}

}  // namespace

class MembersTest : public QObject {
    Q_OBJECT
private slots:
    void theBoundHolds_data() {
        QTest::addColumn<int>("which");
        QTest::newRow("an orbit that grazes its star") << 0;
        QTest::newRow("wells of abs(x)") << 1;
        QTest::newRow("a pulse of width 1e-3") << 2;
        QTest::newRow("the double pendulum to t = 20") << 3;
        QTest::newRow("a contact by (abs(z) - z)/2") << 4;
        QTest::newRow("a pulse of width 1e-6") << 5;
    }
    void theBoundHolds() {
        QFETCH(int, which);
        const auto made = [&] {
            return which == 0   ? grazing()
                   : which == 1 ? wells()
                   : which == 2 ? pulse(1e-3)
                   : which == 3 ? chaotic()
                   : which == 4 ? contact()
                                : pulse(1e-6, 7.123);
        };
        QVERIFY(broken(made()) <= 1);
        QVERIFY(saidOf(made()).isTrueOrMarked());
    }
    /// Of a pulse that both step over, two step sizes of one method agree to round-off and are wrong by .85:
    /// they are no pair. A scheme that the user takes for the reference is confirmed by another as well.
    void twoStepSizesOfOneMethodAreNoPair() {
        const Case c = pulse(1e-5);
        std::string text = c.scene;
        text.insert(text.find("\"initial\""), R"("reference":{"type":"scheme","scheme":)"
                                              R"({"step":0.01,"scheme":"galerkin-gauss-6"}},)");
        const ReferenceInfo info = makeReference(resolved(text), {}).info;
        QCOMPARE(info.type, std::string("scheme"));
        QVERIFY(info.confirmedBy == "rk8pd" || info.confirmedBy == "bulirsch-stoer");
        QVERIFY2(info.bound > 0.5 && info.estimatedError >= info.bound, info.caution.c_str());
        QVERIFY(info.horizon > 3.3 && info.horizon < 3.5);
        QVERIFY(info.caution.find("errors are judged to there") != std::string::npos);
    }
    /// Two step sizes of collocation err to the same side; the other codes do not.
    void anOrbitThatGrazesItsStarIsKnownTo1e3() {
        const Reference reference = makeReference(resolved(grazing().scene), {});
        QVERIFY2(reference.info.bound < 1e-3, reference.info.caution.c_str());
        QVERIFY(!reference.info.confirmedBy.empty());
    }
    void aPulseIsSeenAndSaid() {
        const Said said = saidOf(pulse(1e-3));
        QCOMPARE(said.reference.pulses.size(), std::size_t{1});
        QVERIFY(std::abs(said.reference.pulses.front().t - 3.37) < 0.005);
        QVERIFY(said.reference.pulses.front().value < 0.02);
        QVERIFY(said.reference.bound < 1e-10);
        const Comparison coarse = run(resolved([] {
                                          std::string text = pulse(1e-3).scene;
                                          return text.replace(text.find("0.01}"), 4, "0.1");
                                      }())
                                          .scene);
        const std::string& caution = coarse.schemes.front()->summary.caution;
        QVERIFY2(caution.find("pulse at t = 3.37") != std::string::npos, caution.c_str());
    }
    void beyondAHorizonNothingIsJudged() {
        const Reference reference = makeReference(resolved(chaotic().scene), {});
        QVERIFY2(reference.info.horizon > 13 && reference.info.horizon < 18.5,
                 reference.info.caution.c_str());
        QVERIFY(reference.info.caution.find("errors are judged to there") != std::string::npos);
        QVERIFY(reference.info.boundAlong.size() > 50);
        QVERIFY(reference.info.estimatedError >= reference.info.bound);
    }
    /// The boxes grow with the logarithm of the width alone.
    void pulsesOfAnyWidthAreFound() {
        for (const double at : {3.37, 7.123})
            for (const double width : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
                const ResolvedScene scene = resolved(pulse(width, at).scene);
                const ForcePulses found = forcePulses(*scene.system, scene.initial, 10, {});
                qInfo("at %g, %g wide: %d boxes, %zu leaves", at, width, found.boxes, found.ends.size());
                QVERIFY(found.boxes > 0 && found.boxes <= 200);
                const double shortest = found.shortestIn(at - 4 * width, at + 4 * width);
                QVERIFY(shortest < 4 * width);
            }
    }
    void whatDoesNotDependOnTimeIsNotScanned() {
        const ResolvedScene scene = resolved(wells().scene);
        QCOMPARE(forcePulses(*scene.system, scene.initial, 10, {}).boxes, 0);
    }
    /// At random inputs in an interval the forces are in their enclosure.
    void anEnclosureContainsAllValues() {
        const ResolvedScene scene = resolved(sceneOf(
            R"("x")",
            "x_t^2/2 + x*(sin(3*t)*exp(-t^2/7) + t^4/(1 + t^2) + sqrt(abs(t - 2)) + tanh(t)*cosh(t/3) + "
            "max(t, 1)*heaviside(t - 1) + cos(t)^3 + atan(t)^2 + (2 + t^2)^1.5 + log(3 + t))",
            R"({"q":[1],"p":[0]})", 4, rk4));
        const Mechanical& m = *scene.system->parts.find<Mechanical>();
        const typed::Tape& tape = *typed::gradientTapeOf(m);
        std::mt19937 random(5);
        std::uniform_real_distribution<double> place(0, 4), length(0, 1), part(0, 1);
        std::vector<RealInterval> r(tape.registers());
        double widest = 0;
        for (int i = 0; i < 2000; ++i) {
            const double a = place(random), b = a + length(random) * length(random), q = 0.7, v = 0.1;
            r[0] = {q, q};
            r[1] = {v, v};
            r[2] = {a, b};
            enclose(tape, r.data());
            const RealInterval force = tape.output(0, r.data());
            QVERIFY(std::isfinite(force.low) && std::isfinite(force.high));
            widest = std::max(widest, force.width());
            for (int k = 0; k < 5; ++k) {
                const double t = a + part(random) * (b - a);
                double gradient[2];
                m.gradient(m.model.get(), t, &q, &v, gradient);
                const double slack = 1e-12 * (1 + std::abs(gradient[0]));
                QVERIFY(gradient[0] >= force.low - slack && gradient[0] <= force.high + slack);
            }
        }
        qInfo("widest %.3g", widest);
        QVERIFY(widest < 1000);
    }
};

EXTREMAL_TEST(MembersTest)
}  // namespace extremal::members_test
#include "members_test.moc"
