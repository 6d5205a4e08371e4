// SPDX-License-Identifier: GPL-3.0-or-later
/// What is not taken is refused: every model with one more part, which is unknown to all, is refused by every
/// family, baseline, observable and view but those that look at rows alone, and the reason is that part.
#include <QTest>

#include <set>

#include "engine/model/parts/constraint.hpp"
#include "engine/baseline/catalog.hpp"
#include "engine/core/problem.hpp"
#include "engine/family/scheme.hpp"
#include "engine/model/spins/spins.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/symmetry/symmetry.hpp"
#include "engine/view/catalog.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::parts_test {
namespace {

struct Wind {
    static constexpr PartInfo part{"wind", "a wind"};
};
/// A part that may be left alone.
struct Label {
    static constexpr PartInfo part{"label", "a label", false};
};

System exampleOf(const ModelEntry& entry) {
    Value model(Value::Object{{"type", entry.item.id}});
    for (const FieldInfo& field : entry.item.parameters)
        if (!field.example.isNull()) model.set(field.key, field.example);
    Value document(Value::Object{{"extremal", 1}, {"model", model}, {"schemes", Value::Array{}}});
    if (!entry.interval) document.set("time", Value(Value::Object{{"end", 20 * entry.exampleStep}}));
    const ReadScene read = readScene(document);
    return read.resolved && read.resolved->system ? *read.resolved->system : makeSystem(read.scene);
}

/// Of observables and views that look at rows and states, whatever moved them.
const std::set<std::string> observablesOfRows = {"effort", "error", "order", "step"};
const std::set<std::string> viewsOfRows = {
    "body-momentum", "carpet",  "curve-error",    "error", "mesh", "parameter-map", "phase",
    "profile",       "section", "space-momentum", "stage", "step", "trajectory",    "work-precision"};

/// Where an entry has no objection to a wind, or another one than that.
template <class Entry>
std::string overlooked(const Entry& entry, const System& plain, const System& windy) {
    if (appliesTo(entry, windy)) return entry.item.id + " takes a wind";
    if (!appliesTo(entry, plain)) return {};
    const std::string needed = neededInstead(entry.takes, windy.parts);
    return needed == "a problem without a wind" ? std::string() : entry.item.id + " says: " + needed;
}

template <class F>
std::string refusalOf(F make) {
    try {
        make();
    } catch (const InvalidScene& error) {
        return error.what();
    }
    return {};
}

}  // namespace

class PartsTest : public QObject {
    Q_OBJECT

private slots:
    void everyModel_data() {
        QTest::addColumn<QString>("id");
        for (const ModelEntry& entry : modelCatalog())
            QTest::newRow(entry.item.id.c_str()) << QString::fromStdString(entry.item.id);
    }
    void everyModel() {
        QFETCH(QString, id);
        const System plain = exampleOf(*findModel(id.toStdString()));
        System windy = plain;
        windy.parts.set(Wind{});
        // Spins are those of a Hamiltonian, and bodies in space have constraints.
        const std::size_t needs = plain.parts.find<Spins>() || plain.parts.find<Constraint>() ? 2 : 1;
        QCOMPARE(plain.parts.needs().size(), needs);
        QCOMPARE(windy.parts.needs().size(), needs + 1);
        std::string faults;
        const auto note = [&](const std::string& fault) {
            if (!fault.empty()) faults += fault + "; ";
        };
        int taken = 0;
        for (const Family& family : families()) {
            note(overlooked(family, plain, windy));
            if (!appliesTo(family, plain)) continue;
            ++taken;
            for (const SpaceEntry& space : family.spaces) {
                const std::string reason = mismatch({{space.item.id, {}, {}}, {}, {}}, windy);
                if (reason.find("a problem without a wind") == std::string::npos)
                    note(space.item.id + ": " + reason);
            }
        }
        for (const BaselineEntry& entry : baselineCatalog()) {
            note(overlooked(entry, plain, windy));
            if (!appliesTo(entry, plain)) continue;
            ++taken;
            ResolvedScheme scheme;
            scheme.baseline = &entry;
            const std::string said = refusalOf([&] { (void)scheme.make(windy, 0.1, {}); });
            if (said.find("needs a problem without a wind") == std::string::npos ||
                said.find("no scheme takes it") == std::string::npos)
                note(entry.item.id + " said: " + said);
        }
        QVERIFY(taken > 0);
        for (const ObservableEntry& entry : observableEntries())
            if (!observablesOfRows.contains(entry.item.id)) note(overlooked(entry, plain, windy));
        for (const ViewEntry& entry : viewEntries()) {
            if (viewsOfRows.contains(entry.item.id)) continue;
            const View view{entry.item.id, "", ""};
            const std::string said = missingFor(view, windy);
            const bool isOfPlain = missingFor(view, plain).empty();
            if (said.empty() || (isOfPlain && said != "a problem without a wind"))
                note(entry.item.id + " says: " + said);
        }
        if (!choiceGrids(windy).empty()) note("the window offers schemes");
        if (!symmetriesOf(windy)->empty()) note("it has symmetries");
        QVERIFY2(faults.empty(), faults.c_str());
    }
    void aPartThatBindsNothingIsLeftAlone() {
        const System plain = exampleOf(*findModel("kepler"));
        System labelled = plain;
        labelled.parts.set(Label{});
        for (const Family& family : families())
            QCOMPARE(appliesTo(family, labelled), appliesTo(family, plain));
        for (const BaselineEntry& entry : baselineCatalog())
            QCOMPARE(appliesTo(entry, labelled), appliesTo(entry, plain));
        for (const ObservableEntry& entry : observableEntries())
            QCOMPARE(appliesTo(entry, labelled), appliesTo(entry, plain));
        for (const ViewEntry& entry : viewEntries())
            QCOMPARE(missingFor({entry.item.id, "", ""}, labelled),
                     missingFor({entry.item.id, "", ""}, plain));
    }
    /// The law has teeth: entries that forgot to say what they take.
    void anEntryThatTakesTooMuchIsFound() {
        const System plain = exampleOf(*findModel("kepler"));
        System windy = plain;
        windy.parts.set(Wind{});
        BaselineEntry careless = *findBaseline("rk4");
        QVERIFY(overlooked(careless, plain, windy).empty());
        careless.takes = Takes::everything();
        QVERIFY(!overlooked(careless, plain, windy).empty());
    }
    void partsAreFoundByTheirType() {
        Parts parts;
        QVERIFY(!parts.find<Wind>() && parts.needs().empty());
        parts.set(Wave{});
        parts.set(Wind{});
        parts.set(Label{});
        QVERIFY(parts.find<Wind>() && parts.find<Label>() && !parts.find<Body>());
        QCOMPARE(untaken(Takes::only<Wave>(), parts), std::string("a wind"));
        QCOMPARE(untaken(Takes::only<Body>(), parts), std::string("a wave function and a wind"));
        QCOMPARE(untaken(Takes::everything(), parts), std::string());
        QVERIFY(isTaken(Takes::everything(), {}) && !isTaken(Takes::only<Wave>(), {}));
        QCOMPARE(neededInstead(Takes::only<Wave>(), {}), std::string("a wave function"));
        QCOMPARE(neededInstead(Takes::only<Body>(), parts), std::string("a rigid body"));
        QCOMPARE(neededInstead(Takes::only<Wave>(), parts), std::string("a problem without a wind"));
        const Parts copy = parts;
        QCOMPARE(copy.find<Wave>(), parts.find<Wave>());
    }
};

EXTREMAL_TEST(PartsTest)
}  // namespace extremal::laws::parts_test

#include "parts_test.moc"
