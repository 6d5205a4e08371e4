// SPDX-License-Identifier: GPL-3.0-or-later
/// Every error and warning has a place in the handbook: that of its topic, else that of its part of the
/// scene.
#include "engine/scene/outlook/topics.hpp"

#include <QTest>

#include <algorithm>

#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::topics_test {

class TopicsTest : public QObject {
    Q_OBJECT
private slots:
    void placesFollowFromPointers() {
        const auto place = [](const char* pointer) { return handbookPlace(Problem{pointer, "", ""}); };
        QCOMPARE(place("/schemes/12/quadrature/nodes"), std::string("quadratures"));
        QCOMPARE(place("/schemes/0/space"), std::string("spaces"));
        QCOMPARE(place("/schemes/0/spaces"), std::string("scenes#schemes"));
        QCOMPARE(place("/schemes/0/step"), std::string("scenes#schemes"));
        QCOMPARE(place("/views/3"), std::string("scenes#views"));
        QCOMPARE(place(""), std::string("scenes#top-level"));
        QCOMPARE(place("/nothing"), std::string("scenes#top-level"));
    }
    void aTopicComesFirst() {
        QCOMPARE(handbookPlace(Problem{"/schemes/0/step", "", "", {}, {}, "resonance"}),
                 std::string("multiscale#resonances"));
        QCOMPARE(handbookPlace(Problem{"/views/3", "", "", {}, {}, "no such topic"}),
                 std::string("scenes#views"));
    }
    void outcomesHavePlaces() {
        QCOMPARE(handbookPlace(Outcome::lost), std::string("studies#runs-that-are-lost"));
        QVERIFY(handbookPlace(Outcome::converged).empty());
        for (const Outcome outcome : {Outcome::diverged, Outcome::singular, Outcome::energyUnsolvable,
                                      Outcome::notFinite, Outcome::stepBudget, Outcome::refused})
            QVERIFY(!handbookPlace(outcome).empty());
    }
    void idsAreUnique() {
        for (auto a = topics().begin(); a != topics().end(); ++a)
            QVERIFY2(std::none_of(topics().begin(), a, [&](const Topic& b) { return b.id == a->id; }),
                     a->id.c_str());
    }
    void findingsOfAModelAndASpaceNameThem() {
        const ReadScene read = readScene(std::string(
            "{\"extremal\":1,\"model\":{\"type\":\"kepler\",\"mu\":-1},\"time\":{\"end\":1},\"schemes\":["
            "{\"step\":0.1,\"space\":{\"type\":\"spline\",\"degree\":0},\"quadrature\":{\"type\":\"gauss\"}},"
            "{\"step\":0.1,\"baseline\":\"nothing\"}]}"));
        const auto placeOf = [&](std::string_view pointer) {
            for (const Problem& p : read.errors)
                if (p.pointer.starts_with(pointer)) return handbookPlace(p);
            return std::string();
        };
        QCOMPARE(placeOf("/model"), std::string("models#kepler"));
        QCOMPARE(placeOf("/schemes/0/space"), std::string("spaces#spline"));
        QCOMPARE(placeOf("/schemes/1/baseline"), std::string("baselines"));
    }
    void warningsNameTheirTopic() {
        const auto topicOf = [](const std::string& schemes, const std::string& rest = "") {
            const ReadScene read = readScene(
                "{\"extremal\":1,\"model\":{\"type\":\"harmonic-oscillator\"},\"time\":{\"end\":10}," + rest +
                "\"schemes\":[" + schemes + "]}");
            std::string all;
            for (const auto* list : {&read.errors, &read.warnings})
                for (const Problem& p : *list) all += p.topic + " ";
            return all;
        };
        const auto has = [](const std::string& all, const char* topic) {
            return (' ' + all).find(std::string(" ") + topic + " ") != std::string::npos;
        };
        QVERIFY(has(topicOf("{\"step\":3,\"baseline\":\"stormer-verlet\"}"), "stability-limit"));
        QVERIFY(has(topicOf("{\"step\":0.1,\"space\":{\"type\":\"polynomial\",\"degree\":3},"
                            "\"quadrature\":{\"type\":\"lobatto\",\"nodes\":3}}"),
                    "few-nodes"));
        QVERIFY(has(topicOf("{\"step\":0.1,\"space\":{\"type\":\"polynomial\",\"degree\":3},"
                            "\"quadrature\":{\"type\":\"gauss\",\"nodes\":2}}"),
                    "refused"));
        QVERIFY(
            has(topicOf("{\"tolerance\":1e-6,\"baseline\":\"dopri5\"}", "\"observe\":[\"reversibility\"],"),
                "way-back"));
    }
};

EXTREMAL_TEST(TopicsTest)
}  // namespace extremal::topics_test

#include "topics_test.moc"
