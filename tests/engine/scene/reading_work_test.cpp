// SPDX-License-Identifier: GPL-3.0-or-later
/// Reading a scene is bounded: by a count of operations, which is the same on every machine and whatever was
/// read before, and by the numbers of its parts. Figures are what was measured.
#include <QTest>

#include <algorithm>
#include <cstdio>
#include <stop_token>
#include <string>

#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::reading_work_test {
namespace {

Value sceneWith(Value::Array schemes, Value model = "harmonic-oscillator") {
    return Value::Object{{"extremal", 1},
                         {"model", std::move(model)},
                         {"initial", Value::Object{{"q", Value::Array{1}}, {"p", Value::Array{0}}}},
                         {"time", Value::Object{{"end", 1}}},
                         {"schemes", std::move(schemes)}};
}

Value schemeOf(Value space, double step = 0.1) {
    return Value::Object{{"space", std::move(space)}, {"step", step}};
}

Value spline(int degree, int cells) {
    return Value::Object{{"type", "spline"}, {"degree", degree}, {"cells", cells}};
}

Value typed(Value::Array functions) {
    return Value::Object{{"type", "typed"}, {"functions", std::move(functions)}};
}

/// Splines with a knot of their own, so that no two have the same table.
Value bent(int degree, int knots, int number) {
    Value::Array ends;
    for (int k = 1; k <= knots; ++k) ends.emplace_back((k + 1e-3 * number / (k + 1)) / (knots + 1));
    return Value::Object{{"type", "spline"}, {"degree", degree}, {"knots", std::move(ends)}};
}

std::string textOf(const ReadScene& read) {
    std::string text;
    for (const Problem& p : read.errors) text += p.pointer + ": " + p.message + " (" + p.hint + ")\n";
    return text;
}

}  // namespace

class ReadingWorkTest : public QObject {
    Q_OBJECT
private slots:
    void largeTablesAreReadWithinTheBudget_data() {
        QTest::addColumn<int>("degree");
        QTest::addColumn<int>("cells");
        QTest::addColumn<double>("most");
        // Twice what was counted.
        QTest::newRow("3 with 64 cells") << 3 << 64 << 1.6e9;
        QTest::newRow("12 with 64 cells") << 12 << 64 << 2.7e9;
        QTest::newRow("24 with 64 cells") << 24 << 64 << 7e9;
        QTest::newRow("24 with 2 cells") << 24 << 2 << 2.2e8;
    }
    void largeTablesAreReadWithinTheBudget() {
        QFETCH(int, degree);
        QFETCH(int, cells);
        QFETCH(double, most);
        const ReadScene read = readScene(sceneWith({schemeOf(spline(degree, cells))}));
        QVERIFY2(read.errors.empty(), textOf(read).c_str());
        QVERIFY2(read.work < most, QByteArray::number(read.work));
    }

    void typedSpacesAreReadWithinTheBudget() {
        Value::Array schemes;
        for (int i = 1; i <= 30; ++i)
            schemes.push_back(schemeOf(typed({"1", "tau", "cos(" + std::to_string(i) + "*h*tau)",
                                              "sin(" + std::to_string(i) + "*h*tau)"})));
        const ReadScene read = readScene(sceneWith(schemes));
        QVERIFY2(read.errors.empty(), textOf(read).c_str());
        QVERIFY2(read.work < 1.2e9, QByteArray::number(read.work));
    }

    void theCountDoesNotDependOnWhatWasReadBefore() {
        const Value scene =
            sceneWith({schemeOf(bent(5, 7, 1)), schemeOf(bent(5, 7, 2)), schemeOf(bent(5, 7, 1), 0.05),
                       schemeOf(typed({"1", "tau", "exp(tau/3)"}))});
        const ReadScene first = readScene(scene);
        QVERIFY2(first.errors.empty(), textOf(first).c_str());
        QCOMPARE(readScene(scene).work, first.work);
        QVERIFY(first.work > 1e6);
        // A scheme with a table that is there already costs no second one.
        const ReadScene fewer = readScene(sceneWith(
            {schemeOf(bent(5, 7, 1)), schemeOf(bent(5, 7, 2)), schemeOf(typed({"1", "tau", "exp(tau/3)"}))}));
        QVERIFY(first.work - fewer.work < 0.1 * fewer.work);
    }

    void whatUsesUpTheBudgetIsNamed() {
        Value::Array many;
        for (int i = 0; i < 100; ++i) many.push_back(schemeOf(bent(20, 60, i)));
        const ReadScene read = readScene(sceneWith(many));
        QCOMPARE(read.errors.size(), std::size_t{1});
        QCOMPARE(read.errors[0].pointer, std::string("/schemes"));
        QVERIFY2(
            read.errors[0].message.find("takes too long to read: a scene may take 1e+10 operations") == 0 &&
                read.errors[0].message.find(" schemes have used ") != std::string::npos,
            read.errors[0].message.c_str());
        QVERIFY(read.errors[0].hint.find("fewer schemes") == 0);
        QVERIFY(read.work > mostReadingWork && read.work < 1.2 * mostReadingWork);
    }

    void oneSchemeThatUsesUpTheBudgetIsNamed() {
        Value scheme = schemeOf(spline(24, 64));
        scheme.set("quadrature", Value::Object{{"type", "gauss"}, {"nodes", 64}, {"panels", 256}});
        const ReadScene read = readScene(sceneWith({schemeOf(spline(1, 1)), scheme}));
        QCOMPARE(read.errors.size(), std::size_t{1});
        QCOMPARE(read.errors[0].pointer, std::string("/schemes/1"));
        QCOMPARE(read.errors[0].hint, std::string("a lower degree, or fewer cells, functions or nodes"));
    }

    void tablesThatFillTheMemoryAreRefused() {
        Value scheme = schemeOf(spline(24, 64));
        scheme.set("quadrature", Value::Object{{"type", "gauss"}, {"nodes", 1000}, {"panels", 960}});
        const ReadScene read = readScene(sceneWith({scheme}));
        QVERIFY2(textOf(read).find("has 960000 nodes for the 88 functions of the space") != std::string::npos,
                 textOf(read).c_str());
        const ReadScene knots = readScene(sceneWith({schemeOf(bent(3, 64, 0))}));
        QVERIFY2(textOf(knots).find("are 64, the limit is 63") != std::string::npos, textOf(knots).c_str());
    }

    /// Newton's matrix of 64 coordinates that all act on each other has 5568 rows: one step takes minutes,
    /// and its duration is forecast all the same.
    void theForecastOfLongStepsIsBounded() {
        Value::Array names, q, p;
        for (int i = 1; i <= 64; ++i) {
            names.emplace_back("x" + std::to_string(i));
            q.emplace_back(0.1);
            p.emplace_back(0);
        }
        Value scheme = schemeOf(spline(24, 64), 3);
        scheme.set("solver", Value::Object{{"method", "newton"}});
        Value scene =
            sceneWith({scheme}, Value::Object{{"type", "lagrangian"},
                                              {"coordinates", names},
                                              {"lagrangian",
                                               "sum(i, 1..64, x[i]_t^2/2) + "
                                               "cos(sum(i, 1..64, x[i]))"}});
        scene.set("initial", Value::Object{{"q", q}, {"p", p}});
        scene.set("time", Value::Object{{"end", 1e6}});
        scene.set("reference", "none");
        const ReadScene read = readScene(scene);
        QVERIFY2(read.errors.empty(), textOf(read).c_str());
        QVERIFY(read.work < mostReadingWork);
        QVERIFY(std::any_of(read.warnings.begin(), read.warnings.end(),
                            [](const Problem& w) { return w.message.find("will take more than ") == 0; }));
    }

    void readingIsStopped() {
        std::stop_source source;
        source.request_stop();
        const Value scene = sceneWith({schemeOf(bent(6, 9, 3))});
        const ReadScene read = readScene(scene, {}, ".", source.get_token());
        QCOMPARE(read.errors.size(), std::size_t{1});
        QCOMPARE(read.errors[0].message, std::string("was not read to its end: it was stopped"));
        QVERIFY(!read.resolved);
        // Nothing of it is remembered as a refusal.
        QVERIFY(readScene(scene).errors.empty());
    }

    void numbersOfPartsAreLimited_data() {
        QTest::addColumn<QString>("pointer");
        QTest::addColumn<int>("count");
        QTest::addColumn<QString>("message");
        QTest::newRow("schemes") << "/schemes" << 1001 << "has 1001 schemes, the limit is 1000";
        QTest::newRow("views") << "/views" << 1001 << "has 1001 views, the limit is 1000";
        QTest::newRow("observe") << "/observe" << 1001 << "has 1001 names, the limit is 1000";
        QTest::newRow("events") << "/events" << 1001 << "has 1001 events, the limit is 1000";
        QTest::newRow("steps") << "/steps" << 1001 << "has 1001 steps, the limit is 1000";
    }
    void numbersOfPartsAreLimited() {
        QFETCH(QString, pointer);
        QFETCH(int, count);
        QFETCH(QString, message);
        Value scene = sceneWith({schemeOf(spline(1, 1))});
        scene.set(pointer.mid(1).toStdString(), Value::Array(static_cast<std::size_t>(count), Value("?")));
        const ReadScene read = readScene(scene);
        QCOMPARE(QString::fromStdString(textOf(read)).count('\n'), 1);
        QCOMPARE(QString::fromStdString(read.errors[0].pointer), pointer);
        QCOMPARE(QString::fromStdString(read.errors[0].message), message);
    }

    void parametersAreLimited() {
        const auto model = [](int count, const Value& value) {
            Value::Object parameters;
            for (int i = 0; i < count; ++i) parameters.emplace_back("k" + std::to_string(i), value);
            return Value::Object{{"type", "lagrangian"},
                                 {"coordinates", Value::Array{"x"}},
                                 {"lagrangian", "x_t^2/2 - k0*x^2/2"},
                                 {"parameters", std::move(parameters)}};
        };
        const ReadScene many = readScene(sceneWith({schemeOf(spline(1, 1))}, model(10001, 1)));
        QCOMPARE(many.errors.size(), std::size_t{1});
        QCOMPARE(many.errors[0].pointer, std::string("/model/parameters"));
        QVERIFY(many.errors[0].message.find("has 10001 ") == 0);
        QVERIFY2(readScene(sceneWith({schemeOf(spline(1, 1))}, model(10000, "1+1"))).errors.empty(),
                 "at the limit");
    }

    void longChainsOfParametersAreRefused() {
        Value::Object parameters;
        for (int i = 0; i < 9999; ++i)
            parameters.emplace_back("k" + std::to_string(i), "k" + std::to_string(i + 1) + "/2");
        parameters.emplace_back("k9999", 1);
        const ReadScene read = readScene(
            sceneWith({schemeOf(spline(1, 1))}, Value::Object{{"type", "lagrangian"},
                                                              {"coordinates", Value::Array{"x"}},
                                                              {"lagrangian", "x_t^2/2 - k0*x^2/2"},
                                                              {"parameters", std::move(parameters)}}));
        QVERIFY(!read.errors.empty());
        QVERIFY2(read.errors[0].message.find("depends on a chain of more than 200 parameters") == 0,
                 textOf(read).c_str());
    }

    void keysThatAreNotKnownAreNamedUpToAHundred() {
        Value scene = sceneWith({schemeOf(spline(1, 1))});
        for (int i = 0; i < 5000; ++i) scene.asObject().emplace_back("key" + std::to_string(i), 1);
        const ReadScene read = readScene(scene);
        QCOMPARE(read.errors.size(), std::size_t{101});
        QCOMPARE(read.errors.back().message, std::string("has 4900 more unknown keys"));
    }

    void valuesOfATextAreLimited() {
        std::string text = "[0";
        for (int i = 0; i < mostJsonValues; ++i) text += ",0";
        const ReadScene read = readScene(text + "]");
        QCOMPARE(read.errors.size(), std::size_t{1});
        QCOMPARE(read.errors[0].message, std::string("has more than 2000000 values"));
    }
};

EXTREMAL_TEST(ReadingWorkTest)

}  // namespace extremal::reading_work_test

#include "reading_work_test.moc"
