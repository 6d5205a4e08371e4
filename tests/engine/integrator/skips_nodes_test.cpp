// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps to a node far ahead end where steps from node to node do, and leave what those leave.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "engine/integrator/skips_nodes.hpp"
#include "engine/run/march/march.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::skips_nodes_test {
namespace {

constexpr const char* field =
    R"J({"type":"field","potential":"sine-gordon","domain":[-5,5],"boundary":"periodic","cells":24})J";
constexpr const char* fieldStart = R"J({"u":"2*cos(pi*x/5)+0.3","u_t":"0.5*sin(pi*x/5)"})J";
constexpr const char* stars = R"J({"q":[0.1,0.2],"p":[0.3,-0.1]})J";
constexpr const char* packet = R"J({"psi":{"packet":"gaussian","centre":0.5}})J";

struct Code {
    const char* name;
    const char* model;
    const char* initial;
    const char* scheme;
};
// Tables that begin with kicks and with free motions; of a nonlinear, a driven and a rotating wave function.
const Code codes[] = {
    {"field, kicks outside", field, fieldStart, R"("space":{"type":"free-motion","knots":"strang"})"},
    {"field, kicks inside", field, fieldStart, R"("space":{"type":"free-motion","knots":"srkn-14a"})"},
    {"components",
     R"J({"type":"field-2d","potential":{"name":"klein-gordon-complex","lambda":0.5},"components":["u","v"],"domain":[-3,3],"domain_y":[-2,2],"cells":10,"cells_y":8})J",
     R"J({"u":"0.8*cos(pi*x/3)*cos(pi*y/2)+0.1","v":"0.5*sin(pi*x/3)","u_t":"0.3*sin(pi*y/2)","v_t":"0.2"})J",
     R"("space":{"type":"free-motion","knots":"srkn-11b"})"},
    {"wave, kicks outside", R"J({"type":"schrodinger","modes":64,"interaction":-1})J", packet,
     R"("space":{"type":"free-motion","knots":"srkn-6b"})"},
    {"wave, kicks inside", R"J({"type":"schrodinger","modes":64,"interaction":-1})J", packet,
     R"("space":{"type":"free-motion","knots":"srkn-14a"})"},
    {"linear wave", R"J({"type":"schrodinger","modes":64})J", packet,
     R"("space":{"type":"free-motion","knots":"strang"})"},
    {"driven wave", R"J({"type":"schrodinger","modes":64,"potential":"cos(x-t)"})J", packet,
     R"("space":{"type":"free-motion","knots":"strang"})"},
    {"rotating wave",
     R"J({"type":"schrodinger-2d","domain":[-5,5],"domain_y":[-5,5],"modes":16,"modes_y":16,"potential":"harmonic","interaction":1,"rotation":0.3})J",
     R"J({"psi":{"packet":"gaussian"}})J", R"("space":{"type":"free-motion","knots":"strang"})"},
    {"wave by Gauss", R"J({"type":"schrodinger","modes":64,"interaction":-1})J", packet,
     R"("scheme":"schrodinger-gauss-3")"},
    {"three levels", R"J({"type":"schrodinger","modes":16,"potential":"cos(x)"})J", packet,
     R"("scheme":"schrodinger-three-level")"},
    {"pendulum", R"J({"type":"pendulum"})J", R"J({})J", R"("scheme":"midpoint")"},
    {"stars, kicks outside", R"J({"type":"henon-heiles"})J", stars,
     R"("space":{"type":"free-motion","knots":"srkn-11b"})"},
    {"stars, drifts outside", R"J({"type":"henon-heiles"})J", stars,
     R"("space":{"type":"free-motion","knots":"blanes-moan-s10","first":"drift"})"},
    {"stars, neither", R"J({"type":"henon-heiles"})J", stars, R"("baseline":"symplectic-euler")"},
    {"typed sum",
     R"J({"type":"hamiltonian","coordinates":["x"],"parameters":{},"hamiltonian":"sqrt(1+p_x^2)+x^4/4"})J",
     R"J({"q":[0.8],"p":[0.3]})J", R"("space":{"type":"free-motion","knots":"strang"})"},
};

ResolvedScene sceneOf(const Code& code) {
    const ReadScene read =
        readScene(std::string(R"J({"extremal":1,"model":)J") + code.model + R"J(,"initial":)J" +
                  code.initial + R"J(,"time":{"end":2},"schemes":[{"step":0.05,)J" + code.scheme + "}]}");
    if (!read.resolved) qFatal("%s: %s", code.name, read.errors.front().message.c_str());
    return *read.resolved;
}

struct Motion {
    std::unique_ptr<Integrator> integrator;
    State state;
    explicit Motion(const ResolvedScene& scene) {
        const ResolvedScheme& s = scene.schemes.front();
        state = s.ownSystem ? s.ownInitial : scene.initial;
        integrator = s.make(s.ownSystem ? *s.ownSystem : *scene.system, clock().step, state);
        if (state.memory.empty()) integrator->begin(state);
    }
    static Clock clock() { return {0, 0.05}; }
    std::vector<double> inside() const {
        std::vector<double> x(state.x.size());
        integrator->denseOutput(0.4, x);
        return x;
    }
};

double distance(const std::vector<double>& a, const std::vector<double>& b) {
    double most = a.size() == b.size() ? 0 : HUGE_VAL;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        most = std::max(most, std::abs(a[i] - b[i]));
    return most;
}

}  // namespace

class SkipsNodesTest : public QObject {
    Q_OBJECT
private slots:
    void endsWhereSingleStepsDo() {
        for (const Code& code : codes) {
            const ResolvedScene scene = sceneOf(code);
            for (const long long count : {1, 2, 3, 23}) {
                Motion single(scene), skipping(scene);
                // From a node that was reached as well as from one that a run begins at.
                for (int part = 0; part < 2; ++part) {
                    const StepReport slow =
                        advanceByNodes(*single.integrator, single.state, count, Motion::clock());
                    const StepReport report =
                        advanceOver(*skipping.integrator, skipping.state, count, Motion::clock());
                    QCOMPARE(report.outcome, Outcome::converged);
                    QCOMPARE(skipping.state.node, single.state.node);
                    QCOMPARE(skipping.state.t, single.state.t);
                    const double apart = distance(skipping.state.x, single.state.x),
                                 inside = distance(skipping.inside(), single.inside());
                    QVERIFY2(apart < 2e-13 && inside < 2e-13,
                             qPrintable(QString("%1: %2 %3").arg(code.name).arg(apart).arg(inside)));
                    QCOMPARE(report.cost.evaluations, slow.cost.evaluations);
                    QCOMPARE(report.cost.iterations, slow.cost.iterations);
                }
            }
        }
    }
    /// A state that is not finite leaves a sound one behind; a stop ends it.
    void troubleLeavesASoundState() {
        for (const Code& code : {codes[1], codes[3]}) {
            Motion motion(sceneOf(code));
            std::stop_source stop;
            stop.request_stop();
            motion.integrator->setStop(stop.get_token());
            const std::vector<double> x = motion.state.x;
            QCOMPARE(advanceOver(*motion.integrator, motion.state, 9, Motion::clock()).outcome,
                     Outcome::stopped);
            QCOMPARE(motion.state.node, 0LL);
            QVERIFY(distance(motion.state.x, x) == 0);
        }
        // W' that is not a number from the third step on.
        const Code leaves{"leaves", R"J({"type":"field","potential":"-sqrt(1-u)^3","domain":[-5,5],
            "boundary":"periodic","cells":24})J",
                          R"J({"u":"0.5","u_t":"4"})J", codes[0].scheme};
        Motion motion(sceneOf(leaves));
        QCOMPARE(advanceOver(*motion.integrator, motion.state, 30, Motion::clock()).outcome,
                 Outcome::notFinite);
        QVERIFY(motion.state.node < 3);
        QVERIFY(std::all_of(motion.state.x.begin(), motion.state.x.end(),
                            [](double v) { return std::isfinite(v); }));
    }
    /// A march without sinks counts all steps, and ends where a watched one does.
    void marchesCountAllSteps() {
        for (const Code& code : codes) {
            const ResolvedScene scene = sceneOf(code);
            Motion watched(scene), alone(scene);
            const MarchGrid grid{Motion::clock(), 40, 2};
            const MarchSink sink{[](const Stretch&) { return true; }};
            const MarchReport seen = march(*watched.integrator, watched.state, grid, {&sink, 1}, {}),
                              unseen = march(*alone.integrator, alone.state, grid, {}, {});
            QCOMPARE(unseen.outcome, Outcome::converged);
            QCOMPARE(alone.state.node, 40LL);
            QCOMPARE(unseen.last.step, seen.last.step);
            QCOMPARE(unseen.cost.evaluations, seen.cost.evaluations);
            QVERIFY(distance(alone.state.x, watched.state.x) < 5e-13);
            MarchGrid few = grid;
            few.budget = 7;
            Motion cut(scene);
            QCOMPARE(march(*cut.integrator, cut.state, few, {}, {}).outcome, Outcome::stepBudget);
            QCOMPARE(cut.state.node, 7LL);
        }
    }
};

EXTREMAL_TEST(SkipsNodesTest)

}  // namespace extremal::skips_nodes_test

#include "skips_nodes_test.moc"
