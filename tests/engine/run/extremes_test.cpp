// SPDX-License-Identifier: GPL-3.0-or-later
/// The extreme that an observable declares is in the summary by its name, whatever the observable: every one
/// of the catalogue on each kind of system.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/observe/catalog.hpp"
#include "engine/run/files/export.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::extremes_test {
namespace {

/// A few steps of the first scheme of a preset, every node a row, with all observables that the system has.
Scene observedIn(const char* preset) {
    Scene scene = readScene(findPreset(preset)->json).scene;
    const System system = makeSystem(scene);
    scene.schemes.resize(1);
    if (system.isMotion()) scene.end = {scene.start.value + 20 * scene.schemes.front().step.value, {}};
    scene.every.reset();
    scene.views.clear();
    scene.observe.clear();
    for (const ObservableEntry& entry : observableEntries())
        if (appliesTo(entry, system) && entry.bind) scene.observe.push_back(entry.item.id);
    return scene;
}

}  // namespace

class ExtremesTest : public QObject {
    Q_OBJECT
private slots:
    void everyObservableHasItsExtremeInTheSummary_data() {
        QTest::addColumn<QString>("preset");
        for (const char* preset : {"kepler", "spring-pendulum", "heavy-top", "schrodinger-seed", "elliptic"})
            QTest::newRow(preset) << QString(preset);
    }
    void everyObservableHasItsExtremeInTheSummary() {
        QFETCH(QString, preset);
        const Scene scene = observedIn(preset.toUtf8().constData());
        const System system = makeSystem(scene);
        const State initial = initialState(scene, system);
        const Comparison c = run(scene);
        const SchemeResult& result = *c.schemes.front();
        QVERIFY(result.summary.status == RunStatus::done);
        const auto& extremes = result.summary.extremes;
        std::size_t declared = 0;
        for (const ObservableEntry& entry : observableEntries()) {
            if (std::find(scene.observe.begin(), scene.observe.end(), entry.item.id) == scene.observe.end())
                continue;
            const ExactSolution none = [](double, std::span<double> x) { std::fill(x.begin(), x.end(), 0); };
            const Observer observer = entry.bind({system, initial, none});
            if (observer.extreme < 0) continue;
            ++declared;
            const std::string column = observer.columns[static_cast<std::size_t>(observer.extreme)].name;
            const auto found = std::find_if(extremes.begin(), extremes.end(), [&](const Summary::Extreme& e) {
                return e.observable == entry.item.id && e.column == column;
            });
            QVERIFY2(found != extremes.end(), entry.item.id.c_str());
            double largest = NAN;
            for (const double value : result.trajectory[column])
                if (std::isfinite(value) && !(std::abs(value) <= largest)) largest = std::abs(value);
            QVERIFY2(found->value == largest || (std::isnan(found->value) && std::isnan(largest)),
                     entry.item.id.c_str());
        }
        qInfo("%zu extremes of %zu observables", declared, scene.observe.size());
        QVERIFY(declared >= 1 && declared == extremes.size());
    }
};

EXTREMAL_TEST(ExtremesTest)
}  // namespace extremal::extremes_test

#include "extremes_test.moc"
