/// What a run is expected to take: steps, maps, and how many nodes a wave function has.
#include <QTest>

#include "engine/run/run.hpp"
#include "engine/scene/codec.hpp"
#include "engine/scene/preset.hpp"
#include "tests/tools/test.hpp"
#include "ui/shell/run_control.hpp"

namespace extremal::run_control_test {
namespace {

Scene scene(const std::string& name, const std::vector<Override>& overrides = {}) {
    const ReadScene read = readScene(findPreset(name)->json, overrides);
    for (const Problem& p : read.errors) qWarning("%s %s", p.pointer.c_str(), p.message.c_str());
    return read.scene;
}

}  // namespace

class RunControlTest : public QObject {
    Q_OBJECT
private slots:
    void mapsCount() {
        const CostModel model;
        const Scene with = scene("stiffness-map");
        Scene without = with;
        std::erase_if(without.views, [](const View& v) { return v.id == "parameter-map"; });
        QVERIFY(without.views.size() < with.views.size());
        QVERIFY(model.predict(with) > 10 * model.predict(without));
    }
    void nodesCount() {
        CostModel model;
        const Scene small = scene("double-slit", {{"/model/modes", 16.0}, {"/model/modes_y", 16.0}}),
                    large = scene("double-slit");
        QVERIFY(std::abs(model.predict(large) / model.predict(small) - 256) < 1e-9);
        // What was measured on few nodes is carried over to many, and the other way round.
        Comparison measured;
        measured.scene = small;
        for (const SchemeSpec& spec : small.schemes) {
            auto result = std::make_shared<SchemeResult>();
            result->spec = spec;
            result->summary.steps = 100;
            result->summary.cpuSeconds = 0.01;
            measured.schemes.push_back(result);
        }
        model.learn(measured);
        double steps = 0;
        for (const SchemeSpec& spec : small.schemes) steps += 1.25 / spec.step.value;
        QVERIFY(std::abs(model.predict(small) - 1e-4 * steps) < 1e-9);
        QVERIFY(std::abs(model.predict(large) - 256 * 1e-4 * steps) < 1e-7);
    }
};

EXTREMAL_TEST(RunControlTest)
}  // namespace extremal::run_control_test

#include "run_control_test.moc"
