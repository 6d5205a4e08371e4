// SPDX-License-Identifier: GPL-3.0-or-later
/// What is advised where a scheme does not take a system: all that take it, and none that does not.
#include <QTest>

#include "engine/baseline/catalog.hpp"
#include "engine/core/problem.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::baseline_catalog_test {
namespace {

struct Wind {
    static constexpr PartInfo part{"wind", "a wind"};
};

Settings withDefaults(const CatalogItem& item) {
    Settings settings{item.id, {}, {}};
    for (const FieldInfo& f : item.parameters) settings.keys.emplace_back(f.key, f.firstValue());
    return settings;
}

ReadScene readPreset(const char* id) { return readScene(findPreset(id)->json); }

/// The hint of the refusal of a scheme; empty: it was made.
std::string hintFor(const ResolvedScheme& scheme, const System& system) {
    try {
        (void)scheme.make(system, 0.1, {});
    } catch (const InvalidScene& error) {
        return error.problems().front().hint;
    }
    return {};
}

ResolvedScheme ofSpace(const std::string& id) {
    ResolvedScheme scheme;
    scheme.discretization.space = {id, {}, {}};
    scheme.family = familyOf(scheme.discretization.space);
    return scheme;
}

ResolvedScheme ofBaseline(const std::string& id) {
    ResolvedScheme scheme;
    scheme.baseline = findBaseline(id);
    return scheme;
}

}  // namespace

class CatalogTest : public QObject {
    Q_OBJECT

private slots:
    void adviceNamesThoseThatTakeASystem_data() {
        QTest::addColumn<QString>("preset");
        for (const char* preset : {"kepler", "forced-pendulum", "free-body", "elliptic", "klein-gordon",
                                   "coherent-state", "membrane", "free-knots"})
            QTest::newRow(preset) << preset;
    }
    void adviceNamesThoseThatTakeASystem() {
        QFETCH(QString, preset);
        const ReadScene read = readPreset(qPrintable(preset));
        QVERIFY(read.resolved);
        const System& system = *read.resolved->system;
        const QString advice = QString::fromStdString(schemesFor(system));
        const QStringList words = QString(advice).replace(',', ' ').split(' ');
        const auto isNamed = [&](const CatalogItem& item) {
            return words.contains(QString::fromStdString(item.id));
        };
        bool hasBaselines = false, hasSpaces = false;
        for (const CatalogItem& space : spaceCatalog()) {
            const bool takes = isFor({withDefaults(space), {}, {}}, system);
            hasSpaces = hasSpaces || takes;
            QVERIFY2(isNamed(space) == takes, qPrintable(QString::fromStdString(space.id) + ": " + advice));
        }
        for (const BaselineEntry& entry : baselineCatalog()) {
            const bool takes = canIntegrate(entry, system);
            hasBaselines = hasBaselines || takes;
            QVERIFY2(isNamed(entry.item) == takes,
                     qPrintable(QString::fromStdString(entry.item.id) + ": " + advice));
        }
        QVERIFY(hasSpaces);
        QCOMPARE(advice.contains("the baseline"), hasBaselines);
    }
    /// The energy of a driven motion cannot choose the steps.
    void aSpaceWithAConditionIsNotAdvisedWhereThatFails() {
        const auto adviceOf = [](const char* preset) {
            return schemesFor(*readPreset(preset).resolved->system);
        };
        QVERIFY(adviceOf("kepler").find("moving-time") != std::string::npos);
        QVERIFY(adviceOf("forced-pendulum").find("moving-time") == std::string::npos);
    }

    void refusalsOfSpacesAndBaselinesAdviseTheSame() {
        const ReadScene kepler = readPreset("kepler"), elliptic = readPreset("elliptic");
        const System &motion = *kepler.resolved->system, &problem = *elliptic.resolved->system;
        QCOMPARE(hintFor(ofSpace("fourier"), motion), schemesFor(motion));
        QCOMPARE(hintFor(ofBaseline("crank-nicolson"), motion), schemesFor(motion));
        QCOMPARE(hintFor(ofSpace("fourier"), problem), std::string("it has the space elliptic-elements"));
        QCOMPARE(hintFor(ofBaseline("rk4"), problem), std::string("it has the space elliptic-elements"));
    }

    void nothingIsAdvisedWhereNothingTakesASystem() {
        System windy = *readPreset("kepler").resolved->system;
        windy.parts.set(Wind{});
        QVERIFY(spacesFor(windy).empty() && baselinesFor(windy).empty());
        QCOMPARE(hintFor(ofSpace("polynomial"), windy), std::string("no scheme takes it"));
        QCOMPARE(hintFor(ofBaseline("rk4"), windy), std::string("no scheme takes it"));
    }
};

EXTREMAL_TEST(CatalogTest)
}  // namespace extremal::baseline_catalog_test

#include "catalog_test.moc"
