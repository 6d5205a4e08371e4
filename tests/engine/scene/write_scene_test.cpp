// SPDX-License-Identifier: GPL-3.0-or-later
/// What a scene has beyond its defaults is written, and reads back.
#include <QTest>

#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::write_scene_test {
namespace {

Scene read(const std::string& text) {
    const ReadScene scene = readScene(text);
    for (const Problem& p : scene.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return scene.scene;
}

}  // namespace

class WriteSceneTest : public QObject {
    Q_OBJECT
private slots:
    void stylesAreCountedFromOne() {
        const Scene scene = read(R"({"extremal":1,"model":{"type":"pendulum"},"initial":{"q":[1],"p":[0]},
            "time":{"end":1},"schemes":[{"step":0.1,"baseline":"stormer-verlet","style":3}]})");
        QCOMPARE(scene.schemes.at(0).style, 2);
        QCOMPARE(read(writeScene(scene)).schemes.at(0).style, 2);
    }
    void theTimeOfTheSecondPositionIsKept() {
        const Scene scene = read(R"({"extremal":1,"model":{"type":"harmonic-oscillator"},
            "initial":{"q":[1],"q1":[0.9],"at":0.2},"time":{"end":1},
            "schemes":[{"step":0.1,"baseline":"stormer-verlet"}]})");
        QVERIFY(scene.initial.at);
        QCOMPARE(scene.initial.at->value, 0.2);
        const Scene again = read(writeScene(scene));
        QVERIFY(again.initial.at);
        QCOMPARE(again.initial.at->value, 0.2);
    }
};

EXTREMAL_TEST(WriteSceneTest)

}  // namespace extremal::write_scene_test

#include "write_scene_test.moc"
