// SPDX-License-Identifier: GPL-3.0-or-later
/// The contract of families: few members, which all of them set; what only some have are parts.
#include <QTest>

#include "engine/baseline/catalog.hpp"
#include "engine/family/family.hpp"
#include "engine/family/parts/nodes.hpp"
#include "engine/family/parts/solver_methods.hpp"
#include "engine/family/parts/variant.hpp"
#include "engine/model/system.hpp"
#include "tests/tools/test.hpp"

namespace extremal::families_test {
namespace {

struct Anything {
    template <class T>
    operator T() const;
};

/// The number of members of an aggregate: how many values it can be made of.
template <class T, class... Values>
constexpr std::size_t memberCount() {
    if constexpr (requires { T{Values{}..., Anything{}}; })
        return memberCount<T, Values..., Anything>();
    else
        return sizeof...(Values);
}

struct Three {
    std::string text = "a";
    CatalogItem item;
    void (*call)(int) = nullptr;
};

}  // namespace

class FamiliesTest : public QObject {
    Q_OBJECT

private slots:
    void membersAreCounted() { QCOMPARE(memberCount<Three>(), 3u); }
    void aFamilyHasAtMostTwelveMembers() { QVERIFY(memberCount<Family>() <= 12); }
    void aBaselineHasAtMostFiveMembers() { QVERIFY(memberCount<BaselineEntry>() <= 5); }

    void everyFamilySetsAllMembers() {
        for (const Family& f : families())
            QVERIFY2(!f.item.id.empty() && !f.source.empty() && !f.spaces.empty() && !f.takes.all().empty() &&
                         f.completeRule && f.rules && f.describe && f.check && f.choices && f.written &&
                         f.make,
                     f.item.id.c_str());
        for (const BaselineEntry& e : baselineCatalog())
            QVERIFY2(!e.item.id.empty() && !e.takes.all().empty() && e.make, e.item.id.c_str());
    }

    /// A part that all families had would be a member.
    void partsAreOfSomeFamilies() {
        std::size_t methods = 0, grids = 0, atNodes = 0, variants = 0;
        for (const Family& f : families()) {
            methods += f.parts.find<SolverMethods>() != nullptr;
            grids += f.parts.find<OwnTimeGrid>() != nullptr;
            atNodes += f.parts.find<NodesAlone>() != nullptr;
            variants += f.parts.find<Variant>() != nullptr;
            QVERIFY(f.parts.needs().empty());
        }
        for (const std::size_t count : {methods, grids, atNodes, variants})
            QVERIFY(count > 0 && count < families().size());
    }

    /// What holds where a family has not got a part.
    void withoutAPartTheUsualHolds() {
        QCOMPARE(timeGridOf({"polynomial", {{"degree", 2}}, {}}), TimeGrid::fixed);
        QCOMPARE(timeGridOf({"moving-time", {{"degree", 2}}, {}}), TimeGrid::free);
        QCOMPARE(timeGridOf({"of no family", {}, {}}), TimeGrid::fixed);
        QVERIFY(solverMethods(*findFamily("elliptic")).empty());
        QCOMPARE(solverMethods(*findFamily("lie")), std::vector<std::string>{"newton"});
        QVERIFY(!familyPart<Variant>({"polynomial", {}, {}}) && familyPart<Variant>({"moving-time", {}, {}}));
        QVERIFY(!familyPart<Variant>({"of no family", {}, {}}));
    }
};

EXTREMAL_TEST(FamiliesTest)
}  // namespace extremal::families_test

#include "families_test.moc"
