// SPDX-License-Identifier: GPL-3.0-or-later
/// A run has the same bits with any number of threads, and in the company of any other schemes: everything
/// that the catalogues offer, in one comparison on each kind of system.
#include <QTest>

#include <bit>
#include <cmath>
#include <cstdint>

#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "tests/laws/catalogue.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::threads_test {
namespace {

/// The scene with everything in place of its scheme, over a few steps.
Scene everythingIn(Scene scene) {
    const System system = makeSystem(scene);
    const State start = initialState(scene, system);
    const double step = scene.schemes.front().step.value;
    scene.schemes.clear();
    for (const CatalogueScheme& c : everythingOn(system, start, step)) scene.schemes.push_back(c.scheme.spec);
    // A boundary-value problem is solved as a whole.
    if (system.isMotion()) scene.end = {scene.start.value + 8 * step, {}};
    scene.reference.kind = ReferenceSpec::Kind::none;
    scene.observe.clear();
    scene.views.clear();
    return scene;
}

bool areSame(const Trajectory& a, const Trajectory& b) {
    if (a.columns.size() != b.columns.size()) return false;
    for (std::size_t c = 0; c < a.columns.size(); ++c) {
        const auto &v = a.columns[c].values, &w = b.columns[c].values;
        const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
        if (!std::equal(v.begin(), v.end(), w.begin(), w.end(),
                        [&](double x, double y) { return bits(x) == bits(y); }))
            return false;
    }
    return true;
}

/// The first scheme that differs; empty: none.
std::string different(const Comparison& a, const Comparison& b) {
    if (a.schemes.size() != b.schemes.size()) return "their number";
    for (std::size_t i = 0; i < a.schemes.size(); ++i) {
        const SchemeResult &x = *a.schemes[i], &y = *b.schemes[i];
        // A step without a solution is the same trouble at the same time.
        if (x.summary.status != y.summary.status || x.summary.cause != y.summary.cause ||
            !areSame(x.trajectory, y.trajectory) || x.summary.steps != y.summary.steps)
            return x.spec.label + ": " + x.summary.advice;
    }
    return {};
}

}  // namespace

class ThreadsTest : public QObject {
    Q_OBJECT

private slots:
    void theirNumberChangesNothing_data() {
        QTest::addColumn<int>("index");
        const std::vector<Scene> scenes = everyGround();
        for (std::size_t i = 0; i < scenes.size(); ++i)
            QTest::addRow("%zu, %s", i, scenes[i].model.type.c_str()) << static_cast<int>(i);
    }
    void theirNumberChangesNothing() {
        QFETCH(int, index);
        const Scene scene = everythingIn(everyGround()[static_cast<std::size_t>(index)]);
        const Comparison one = run(scene, {.threads = 1, .isTimed = false}),
                         several = run(scene, {.threads = 5, .isTimed = false});
        qInfo("%zu schemes", one.schemes.size());
        const std::string what = different(one, several);
        QVERIFY2(what.empty(), what.c_str());
        // Alone, the last scheme does what it does beside all others.
        Scene last = scene;
        last.schemes = {scene.schemes.back()};
        QVERIFY(areSame(run(last, {.threads = 1, .isTimed = false}).schemes.front()->trajectory,
                        one.schemes.back()->trajectory));
    }
    void oneBitIsFound() {
        const Scene scene = everythingIn(everyGround().front());
        Scene other = scene;
        double& step = other.schemes.front().step.value;
        step = std::nextafter(step, 1);
        QVERIFY(!different(run(scene, {.threads = 2, .isTimed = false}),
                           run(other, {.threads = 2, .isTimed = false}))
                     .empty());
    }
};

EXTREMAL_TEST(ThreadsTest)
}  // namespace extremal::laws::threads_test

#include "threads_test.moc"
