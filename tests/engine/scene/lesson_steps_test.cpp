// SPDX-License-Identifier: GPL-3.0-or-later
/// Lessons: what is wrong in their steps is said, and those of the presets can be followed to the end.
#include <QTest>

#include <algorithm>
#include <set>

#include "engine/scene/outlook/lesson_steps.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::lesson_steps_test {
namespace {

const std::string scene =
    R"({"extremal":1,"model":{"type":"pendulum"},"time":{"end":1},"schemes":[{"label":"mid","step":0.1,"scheme":"midpoint"}],)";

ReadScene withSteps(const std::string& steps) { return readScene(scene + "\"steps\":" + steps + "}"); }

}  // namespace

class LessonStepsTest : public QObject {
    Q_OBJECT
private slots:
    void mistakesAreNamed_data() {
        QTest::addColumn<QString>("steps");
        QTest::addColumn<QString>("pointer");
        const auto row = [](const char* name, const char* steps, const char* pointer) {
            QTest::newRow(name) << steps << pointer;
        };
        row("no array", R"({})", "/steps");
        row("no text", R"([{"view":"energy"}])", "/steps/0/text");
        row("unknown key", R"([{"text":"a","vew":"energy"}])", "/steps/0/vew");
        row("unknown view", R"([{"text":"a"},{"text":"b","view":"enrgy"}])", "/steps/1/view");
        row("no place", R"([{"text":"a","set":{"schemes":1}}])", "/steps/0/set/schemes");
        row("a step of the lesson", R"([{"text":"a","set":{"/steps/0/text":"b"}}])",
            "/steps/0/set/~1steps~10~1text");
        row("no bound", R"([{"text":"a","until":{"/time/end":{}}}])", "/steps/0/until/~1time~1end");
        row("bound", R"([{"text":"a","until":{"/time/end":{"above":"x"}}}])",
            "/steps/0/until/~1time~1end/above");
        row("time", R"([{"text":"a","time":true}])", "/steps/0/time");
    }
    void mistakesAreNamed() {
        QFETCH(const QString, steps);
        QFETCH(const QString, pointer);
        const ReadScene read = withSteps(steps.toStdString());
        QCOMPARE(read.errors.size(), std::size_t{1});
        QCOMPARE(QString::fromStdString(read.errors.front().pointer), pointer);
        QVERIFY(!read.errors.front().message.empty());
    }
    void aRenamedSchemeIsAWarning() {
        const auto warningsOf = [](const std::string& label) {
            const ReadScene read = withSteps("[{\"text\":\"a\",\"scheme\":\"" + label + "\"}]");
            if (!read.errors.empty()) return std::ptrdiff_t{-1};
            return std::count_if(read.warnings.begin(), read.warnings.end(),
                                 [](const Problem& p) { return p.pointer == "/steps/0/scheme"; });
        };
        QCOMPARE(warningsOf("mdi"), std::ptrdiff_t{1});
        QCOMPARE(warningsOf("mid"), std::ptrdiff_t{0});
    }
    void theRunDoesNotKnowThem() {
        const ReadScene with = withSteps(R"([{"text":"a","time":0.5,"set":{"/time/end":2}}])");
        QVERIFY(with.errors.empty());
        const ReadScene without = readScene(scene.substr(0, scene.size() - 1) + "}");
        QVERIFY(without.errors.empty());
        QVERIFY(with.scene == without.scene);
    }
    void goalsAreBoundsOrValues() {
        const std::string text = R"([{"text":"a","until":{"/time/end":{"above":1.5,"below":2.5}}},
                                     {"text":"b","until":{"/schemes/0/scheme":"rk4"}},{"text":"c"}])";
        const ReadScene read = withSteps(text);
        QVERIFY(read.errors.empty());
        Value document = parseJson(scene + "\"steps\":" + text + "}");
        const std::vector<LessonStep> steps = lessonSteps(document, read.scene);
        QCOMPARE(steps.size(), std::size_t{3});
        QVERIFY(!isReached(steps[0], document));
        document.set("time", Value(Value::Object{{"end", 2}}));
        QVERIFY(isReached(steps[0], document));
        document.set("time", Value(Value::Object{{"end", 3}}));
        QVERIFY(!isReached(steps[0], document));
        QVERIFY(!isReached(steps[1], document));
        QVERIFY(isReached(steps[2], document));
    }
    void lessonsOfPresetsCanBeFollowed() {
        int lessons = 0;
        for (const Preset& preset : presets()) {
            const std::string id(preset.id);
            Value document = parseJson(preset.json);
            if (!document.find("steps")) continue;
            ++lessons;
            const ReadScene first = readScene(document);
            QVERIFY2(first.errors.empty(), id.c_str());
            Value complete = toValue(first.scene);
            std::set<std::string> views{"work-precision"};  // which the window always has
            for (const View& view : first.scene.views) views.insert(view.id);
            for (const LessonStep& step : lessonSteps(document, first.scene)) {
                const std::string place = id + ": " + step.text.substr(0, 40);
                QVERIFY2(step.view.empty() || views.contains(step.view), place.c_str());
                QVERIFY2(step.set.empty() == step.until.empty(), place.c_str());
                if (step.set.empty()) continue;
                QVERIFY2(!isReached(step, complete), place.c_str());
                std::vector<Override> overrides;
                for (const auto& [pointer, value] : step.set) overrides.push_back({pointer, value});
                const ReadScene after = readScene(complete, overrides);
                QVERIFY2(after.errors.empty(), place.c_str());
                complete = toValue(after.scene);
                QVERIFY2(isReached(step, complete), place.c_str());
            }
        }
        QVERIFY(lessons >= 3);
    }
};

EXTREMAL_TEST(LessonStepsTest)

}  // namespace extremal::lesson_steps_test

#include "lesson_steps_test.moc"
