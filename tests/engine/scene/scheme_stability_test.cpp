// SPDX-License-Identifier: GPL-3.0-or-later
/// Intervals of instability: their published values, and one answer for everyone who asks.
#include "engine/scene/outlook/scheme_stability.hpp"

#include <QTest>

#include <cmath>
#include <numbers>

#include "engine/family/field/dispersion.hpp"
#include "engine/family/time_table.hpp"
#include "engine/family/frequency.hpp"
#include "engine/passport/passport.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/stability/linear_stability.hpp"
#include "tests/tools/test.hpp"

namespace extremal::scheme_stability_test {
namespace {

ReadScene oscillator(const std::string& scheme, double step = 0.1, const std::string& end = "100",
                     const std::string& model = R"({"type":"harmonic-oscillator"})") {
    return readScene(std::string_view(R"({"extremal":1,"model":)" + model +
                                      R"(,"initial":{"q":[1]},"time":{"end":)" + end +
                                      R"(},"reference":"none","observe":["energy"],"schemes":[{"step":)" +
                                      QString::number(step, 'g', 17).toStdString() + "," + scheme + "}]}"));
}

std::string ruled(int degree, const std::string& rule) {
    return R"("space":{"type":"polynomial","degree":)" + std::to_string(degree) + R"(},"quadrature":)" + rule;
}

std::string named(const std::string& family, int degree) {
    return "\"scheme\":\"" + family + std::to_string(degree) + "\"";
}

std::vector<UnstableInterval> intervalsOf(const std::string& scheme) {
    const ReadScene read = oscillator(scheme);
    for (const Problem& p : read.errors) qWarning("%s %s", p.pointer.c_str(), p.message.c_str());
    return stabilityOf(read.resolved->schemes.at(0))->intervals;
}

/// Warnings of the topic, joined.
std::string warnedOf(const ReadScene& read) {
    std::string all;
    for (const Problem& p : read.warnings)
        if (p.topic == "stability-limit") all += p.message + " | " + p.hint;
    return all;
}

}  // namespace

class SchemeStabilityTest : public QObject {
    Q_OBJECT
private slots:
    void edgesAreThoseOfTheTable_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<int>("place");
        QTest::addColumn<double>("low");
        QTest::addColumn<double>("high");
        QTest::addColumn<double>("growth");
        const auto row = [](const char* name, const std::string& scheme, int place, double low, double high,
                            double growth) {
            QTest::newRow(name) << QString::fromStdString(scheme) << place << low << high << growth;
        };
        const auto gauss = [](int n) { return R"({"type":"gauss","nodes":)" + std::to_string(n) + "}"; };
        row("Lobatto 2", R"("scheme":"galerkin-lobatto-2")", 0, 2.828427, 3.464102, 0.34);
        row("Lobatto 3", R"("scheme":"galerkin-lobatto-3")", 0, 3.112718, 3.162278, 2.5e-2);
        row("Lobatto 4", R"("scheme":"galerkin-lobatto-4")", 0, 3.140445, 3.142467, 1.0e-3);
        row("Lobatto 5", R"("scheme":"galerkin-lobatto-5")", 0, 3.141564, 3.141616, 2.6e-5);
        row("Lobatto 6", R"("scheme":"galerkin-lobatto-6")", 0, 3.1415922, 3.1415931, 4.5e-7);
        row("4, Gauss 5", ruled(4, gauss(5)), 0, 3.141616, 3.142467, 4.3e-4);
        row("5, Gauss 6", ruled(5, gauss(6)), 0, 3.1415931, 3.1416158, 1.1e-5);
        row("5, Radau 5", ruled(5, R"({"type":"radau","nodes":5})"), 0, 3.141427, 3.141747, 1.6e-4);
        row("8, Clenshaw-Curtis 9", ruled(8, R"({"type":"clenshaw-curtis","nodes":9})"), 0, 3.141543,
            3.141593, 2.5e-5);
        row("Lobatto 7, second", R"("scheme":"galerkin-lobatto-7")", 1, 6.283060, 6.283290, 1.2e-4);
    }
    void edgesAreThoseOfTheTable() {
        QFETCH(QString, scheme);
        QFETCH(int, place);
        QFETCH(double, low);
        QFETCH(double, high);
        QFETCH(double, growth);
        const auto all = intervalsOf(scheme.toStdString());
        QVERIFY(static_cast<int>(all.size()) > place);
        const UnstableInterval& found = all[static_cast<std::size_t>(place)];
        const double printed = low > 3.14159 && low < 3.1416 ? 5.1e-8 : 5.1e-7;
        QVERIFY2(std::abs(found.low - low) < printed, qPrintable(QString::number(found.low, 'g', 12)));
        QVERIFY2(std::abs(found.high - high) < printed, qPrintable(QString::number(found.high, 'g', 12)));
        QVERIFY2(std::abs(found.growth / growth - 1) < 0.06, qPrintable(QString::number(found.growth)));
    }
    /// Which also fixes them beyond the digits that are printed.
    void intervalsTileTheNeighbourhoodOfPi() {
        for (const int s : {3, 4, 5, 6}) {
            const auto lobatto = intervalsOf(named("galerkin-lobatto-", s))[0];
            const auto gauss =
                intervalsOf(ruled(s - 1, R"({"type":"gauss","nodes":)" + std::to_string(s) + "}"))[0];
            QVERIFY(std::abs(lobatto.high - gauss.low) < 1e-12);
        }
        const auto two = intervalsOf(R"("scheme":"galerkin-lobatto-2")")[0];
        QVERIFY(std::abs(two.low - std::sqrt(8.0)) < 1e-14 && std::abs(two.high - std::sqrt(12.0)) < 1e-14);
    }
    /// Slabs of fields in time have the functions of a step.
    void slabsInTimeHaveTheIntervalsOfSteps() {
        for (const int s : {1, 2, 3, 4}) {
            const auto slabs =
                timeIntervals(TimeTable(s, makeRule<double>({"lobatto", {{"nodes", s + 1.0}}, {}})));
            const auto steps = intervalsOf(named("galerkin-lobatto-", s));
            QCOMPARE(slabs.size(), steps.size());
            for (std::size_t i = 0; i < slabs.size(); ++i)
                QVERIFY(std::abs(slabs[i].low - steps[i].low) < 1e-11 * steps[i].low);
            const auto none = timeIntervals(TimeTable(s, gauss<double>(s)));
            QVERIFY2(none.empty(), none.empty() ? "" : qPrintable(QString::number(none[0].low, 'g', 12)));
        }
    }
    void gaussHasNoInterval() {
        for (int s = 1; s <= 24; ++s)
            QCOMPARE(intervalsOf(named("galerkin-gauss-", s)).size(), std::size_t(0));
        QCOMPARE(intervalsOf(R"("baseline":{"type":"gauss-collocation","stages":4})").size(), std::size_t(0));
        QCOMPARE(intervalsOf(R"("scheme":"midpoint","composition":"yoshida")").size(), std::size_t(0));
    }
    void everyoneGivesTheSameLimit_data() {
        QTest::addColumn<QString>("scheme");
        for (
            const std::string& scheme :
            {std::string(R"("scheme":"galerkin-lobatto-4")"), ruled(5, R"({"type":"radau","nodes":5})"),
             ruled(6, R"({"type":"clenshaw-curtis","nodes":7})"),
             ruled(4, R"({"type":"nodes","nodes":[0,0.25,0.5,0.75,1]})"),
             std::string(
                 R"("space":{"type":"spline","degree":3,"cells":3},"quadrature":{"type":"lobatto","nodes":4})"),
             std::string(
                 R"("space":{"type":"typed","functions":["1","tau","tau^2","tau^3","tau^4"]},"quadrature":{"type":"lobatto","nodes":5})"),
             std::string(R"("scheme":"galerkin-lobatto-3","composition":"suzuki")"),
             std::string(R"("baseline":"stormer-verlet","composition":"yoshida")"),
             std::string(R"("baseline":"blanes-moan-s10")"), std::string(R"("baseline":"srkn-14a")")})
            QTest::newRow(scheme.c_str()) << QString::fromStdString(scheme);
    }
    void everyoneGivesTheSameLimit() {
        QFETCH(QString, scheme);
        const ReadScene read = oscillator(scheme.toStdString());
        QVERIFY2(read.resolved, read.errors.empty() ? "" : read.errors[0].message.c_str());
        const ResolvedScheme& resolved = read.resolved->schemes[0];
        const double limit = firstEdge(stabilityOf(resolved)->intervals);
        QVERIFY(std::isfinite(limit));
        QCOMPARE(resolved.stabilityLimit(), limit);
        if (!resolved.isComposed() && resolved.family) QCOMPARE(resolved.properties.stabilityLimit, limit);
        const LinearStability study = linearStability(read.scene, 0, {});
        QVERIFY(study.hasLimit);
        QVERIFY(std::abs(study.limit() - limit) < 1e-12 * limit);
        // What one step makes of the test equation, at the places of the study.
        for (const LinearStability::Point& p : study.points) {
            const double growth = stabilityOf(resolved)->growth(p.z);
            if (growth > 1e-5) QVERIFY2(!p.isStable(), qPrintable(QString::number(p.z)));
            if (growth == 0 && p.amplification == p.amplification)
                QVERIFY2(p.amplification < 1 + 1e-6, qPrintable(QString::number(p.z)));
        }
        std::string page;
        for (const auto& block : passportOf(*read.resolved, 0).blocks)
            if (const auto* text = std::get_if<Document::Paragraph>(&block)) page += text->text;
        const std::string digits = QString::number(limit, 'g', 6).toStdString();
        QVERIFY2(page.find("up to " + digits.substr(0, 6)) != std::string::npos, (digits + page).c_str());
    }
    void aResonanceIsAnnouncedWhereItMatters() {
        const auto of = [](double step, int steps, const std::string& scheme) {
            return warnedOf(oscillator(scheme, step, QString::number(step * steps, 'g', 17).toStdString()));
        };
        const std::string lobatto = R"("scheme":"galerkin-lobatto-4")";
        const std::string said = of(3.14146, 2000, lobatto);
        QVERIFY2(said.starts_with("resonance at h omega = pi: growth 0.001 a step, e^2 in this run"),
                 said.c_str());
        QVERIFY(said.find("limit") == std::string::npos);
        QVERIFY(!of(3.14146, 1100, lobatto).empty());
        QVERIFY(of(3.14146, 100, lobatto).empty());
        // Beside the interval, and beyond it, where one limit would refuse.
        QVERIFY(of(3.139, 100000, lobatto).empty());
        QVERIFY(of(3.2, 100000, lobatto).empty());
        QVERIFY(of(3.141587, 200000, ruled(5, R"({"type":"radau","nodes":5})"))
                    .starts_with("resonance at h omega = pi: growth 0.00016 a step, e^32"));
        QVERIFY(of(3.14159, 100000, R"("scheme":"galerkin-gauss-4")").empty());
        QVERIFY(
            of(6.2832, 20000, R"("scheme":"galerkin-lobatto-7")").starts_with("resonance at h omega = 2 pi"));
        const std::string beyond = of(6, 100, R"("scheme":"galerkin-lobatto-2")");
        QVERIFY2(
            beyond.find("step times frequency may be at most 4.9, and not from 2.8284271 to 3.4641016") !=
                std::string::npos,
            beyond.c_str());
        QVERIFY(of(4, 100, R"("scheme":"galerkin-lobatto-2")").empty());
    }
    void whatIsAnnouncedHappens() {
        const auto growthOf = [](double step, int steps, const std::string& scheme) {
            const ReadScene read =
                oscillator(scheme, step, QString::number(step * (steps + 0.5), 'g', 17).toStdString());
            return ::extremal::run(read.scene).schemes.at(0)->summary.maxEnergyError;
        };
        const std::string lobatto = R"("scheme":"galerkin-lobatto-4")";
        const double inside = growthOf(3.14146, 2000, lobatto), outside = growthOf(3.139, 2000, lobatto);
        qInfo("largest energy error in the resonance %.3g, beside it %.3g", inside, outside);
        QVERIFY(inside > 5 && outside < 1);
    }
    /// The step that is advised neither grows nor is warned of.
    void theAdvisedStepWorks() {
        for (const std::string& scheme :
             {std::string(R"("scheme":"galerkin-lobatto-4")"), ruled(5, R"({"type":"radau","nodes":5})"),
              std::string(R"("scheme":"galerkin-lobatto-2")"), std::string(R"("baseline":"stormer-verlet")")})
            for (const double step : {3.141587, 3.0, 6.0}) {
                const std::string end = QString::number(step * 20000, 'g', 17).toStdString();
                const std::string said = warnedOf(oscillator(scheme, step, end));
                if (said.empty()) continue;
                const auto at = said.find("| a step of ");
                QVERIFY2(at != std::string::npos, said.c_str());
                const double advised = std::stod(said.substr(at + 12));
                QVERIFY(advised < step);
                QVERIFY2(warnedOf(oscillator(scheme, advised, end)).empty(), said.c_str());
            }
    }
    /// Not the highest frequency alone.
    void everyFrequencyOfTheSceneIsLookedAt() {
        const std::string scene = R"~({"extremal":1,"model":{"type":"lagrangian","coordinates":["x","y"],
            "lagrangian":"x_t^2/2+y_t^2/2-x^2/2-0.845*y^2"},"initial":{"q":[0.1,0.1]},"time":{"end":20000},
            "schemes":[{"step":3.14146,"scheme":"galerkin-lobatto-4"}]})~";
        const std::string said = warnedOf(readScene(std::string_view(scene)));
        QVERIFY2(said.find("omega = 1;") != std::string::npos, said.c_str());
    }
    void frequenciesAreThoseOfTheLinearisation() {
        const ReadScene read = readScene(std::string_view(
            R"~({"extremal":1,"model":{"type":"lagrangian","coordinates":["x","y","z"],
            "lagrangian":"x_t^2+y_t^2/2+z_t^2/2-(x-y)^2/2-(y-z)^2/2-y^2/2-z^2/2"},"initial":{"q":[0.1,0,0]},
            "time":{"end":1},"schemes":[{"step":0.1,"scheme":"midpoint"}]})~"));
        QVERIFY(read.resolved);
        const auto w = linearFrequencies(*read.resolved->system, read.resolved->initial);
        QCOMPARE(w.size(), std::size_t(3));
        // Roots of det(K - w^2 M), M = diag(2, 1, 1).
        for (const double each : w) {
            const double s = each * each;
            const double det = (1 - 2 * s) * ((3 - s) * (2 - s) - 1) - (2 - s);
            QVERIFY(std::abs(det) < 1e-12);
        }
        QVERIFY(std::abs(w.back() - highestFrequency(*read.resolved->system, read.resolved->initial)) < 1e-3);
    }
};

EXTREMAL_TEST(SchemeStabilityTest)
}  // namespace extremal::scheme_stability_test

#include "scheme_stability_test.moc"
