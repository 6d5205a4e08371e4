// SPDX-License-Identifier: GPL-3.0-or-later
/// Whoever shows or watches a run asks for what it needs, and not for the kind of the problem: problems of a
/// kind that does not exist have their pictures, and runs of theirs are found lost.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "engine/figure/recipe.hpp"
#include "engine/model/parts/coefficient_sizes.hpp"
#include "engine/model/parts/potential_levels.hpp"
#include "engine/run/march/motion_check.hpp"
#include "engine/run/products.hpp"
#include "engine/symmetry/symmetry.hpp"
#include "engine/view/catalog.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::other_problems_test {
namespace {

/// A way of moving that is not in any catalogue.
struct Tide {
    static constexpr PartInfo part{"tide", "a tide"};
};

/// Over 4 by 3 nodes of the rectangle [0, 4) x [0, 6); a sample is the state.
System overRectangle(bool isComplex) {
    System s;
    s.id = "tide";
    s.parts.set(Tide{});
    s.field.x = {0, 1, 2, 3};
    s.field.y = {0, 2, 4};
    s.field.along = {0, 4};
    s.field.across = {0, 6};
    s.field.components =
        isComplex ? std::vector<std::string>{"re", "im"} : std::vector<std::string>{"u", "u_t"};
    s.field.isComplex = isComplex;
    s.field.sample = [n = s.field.size()](const double* x, double* values) { std::copy_n(x, n, values); };
    return s;
}

/// One scheme whose samples at t = 0 and 1 are all these values.
Comparison comparisonOf(const std::vector<double>& values) {
    Comparison c;
    c.scene.end.value = 1;
    auto result = std::make_shared<SchemeResult>();
    result->spec.label = "s";
    FieldFrames& frames = result->products.make<FieldFrames>();
    for (const double t : {0.0, 1.0})
        frames.all.push_back({t, std::make_shared<std::vector<double>>(values)});
    result->summary.status = RunStatus::done;
    c.schemes.push_back(result);
    c.isFinished = true;
    return c;
}

Figure figureOf(const char* id, const System& system, const std::vector<double>& values) {
    const Comparison comparison = comparisonOf(values);
    const View view{id, "", ""};
    return draw({comparison, view, &system, *findView(id)});
}

}  // namespace

class OtherProblemsTest : public QObject {
    Q_OBJECT
private slots:
    void aRealFieldInThePlaneIsDrawn() {
        const System system = overRectangle(false);
        std::vector<double> values(24, 100);  // u_t is not to be seen
        for (std::size_t j = 0; j < 12; ++j) values[j] = -static_cast<double>(j);
        const Figure profile = figureOf("profile", system, values);
        QVERIFY(profile.heat());
        QCOMPARE(profile.heat()->columns, 4);
        QCOMPARE(profile.heat()->rows, 3);
        QCOMPARE(profile.heat()->left, -0.5);
        QCOMPARE(profile.heat()->top, 5.0);
        QVERIFY(profile.heat()->hues.empty());
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                QCOMPARE(profile.heat()->values[3 * i + k], -static_cast<double>(i + 4 * k));
        QVERIFY(profile.subtitle.starts_with("u ·"));

        const Figure carpet = figureOf("carpet", system, values);
        QVERIFY(carpet.heat());
        QCOMPARE(carpet.heat()->rows, 4);
        QCOMPARE(carpet.heat()->values.front(), std::sqrt((16.0 + 64.0) * 2));
        QVERIFY(carpet.subtitle.starts_with("√∫u² dy"));
    }
    void aComplexOneHasItsPhase() {
        std::vector<double> values(24, 0);
        values[12] = 3;
        const Figure profile = figureOf("profile", overRectangle(true), values);
        QVERIFY(profile.heat());
        QCOMPARE(profile.heat()->values.front(), 3.0);
        QCOMPARE(profile.heat()->hues.front(), 0.25);
        const Figure carpet = figureOf("carpet", overRectangle(true), values);
        QCOMPARE(carpet.heat()->values.front(), std::sqrt(18.0));
        QVERIFY(carpet.subtitle.starts_with("√∫|ψ|² dy"));
    }
    void whatAProblemHasBesidesIsDrawn() {
        System system;
        system.parts.set(Tide{});
        const auto numbers = [](std::vector<double> all) {
            return std::make_shared<const std::vector<double>>(std::move(all));
        };
        system.parts.set(PotentialLevels{numbers({0, 1, 2}), numbers({2, 0, 1}), 3, true, "", [] {
                                             return std::vector<double>{0.5, 1.5};
                                         }});
        system.parts.set(
            CoefficientSizes{"order", 0, 2, "", [](const std::vector<double>& sample) {
                                 return std::vector<CoefficientSizes::Line>{{"", {0, 1}, sample}};
                             }});
        const Figure levels = figureOf("levels", system, {4, 5});
        QCOMPARE(levels.series().size(), std::size_t(3));
        QCOMPARE(levels.series()[0].x, (std::vector<double>{0, 1, 2, 3}));
        QCOMPARE(levels.series()[0].y.back(), 2.0);
        QVERIFY(std::isnan(levels.series()[1].y.front()) && levels.series()[1].y[1] == 0.5);
        const Figure spectrum = figureOf("spectrum", system, {4, 5});
        QCOMPARE(spectrum.x.title, std::string("order"));
        QCOMPARE(spectrum.series().front().y, (std::vector<double>{4, 5}));
    }
    /// Its energy is not known; its norm is enough.
    void aUnitaryMotionThatGainsNormIsLost() {
        System system;
        system.parts.set(Tide{});
        const State start{0, 0, {3, 4}, {}};
        QCOMPARE(MotionCheck(system, start, 0.1).scale(), 0.0);
        system.isUnitary = true;
        MotionCheck judge(system, start, 0.1);
        QCOMPARE(judge.scale(), 25.0);
        const double turned[] = {4, -3}, lost[] = {300, 400};
        QVERIFY(judge.isSound(1, turned));
        QVERIFY(!judge.isSound(2, lost));
    }
    /// States of other sizes are tried where it is said how they are made.
    void anEdgeOfTheEnergyIsSought() {
        System system;
        system.parts.set(Tide{});
        system.energy = [](double, const double* x) { return std::log(x[0]) + x[1]; };
        const State start{0, 0, {1, 0}, {}};
        const auto soundNodes = [&] {
            MotionCheck judge(system, start, 0.1);
            const State beyond{6.5, 65, {-1, 0}, {}};  // at a node that is not looked at for its own sake
            NodeBlock block(2, 1);
            block.push(beyond, {});
            return judge.soundNodes(block, false);
        };
        QCOMPARE(soundNodes(), std::size_t(1));
        system.blocks.sizes = {1, 1};
        QCOMPARE(soundNodes(), std::size_t(0));
    }
    /// The three things that coordinates were once taken for.
    void aLagrangianBesideAnotherPartIsNotTheWhole() {
        System system = laws::systemNamed("kepler");
        QVERIFY(system.hasCoordinates() && system.isMovedOnlyBy<Mechanical>());
        QVERIFY(linearTestOf(system) == LinearTest::oscillator);
        QVERIFY(!symmetriesOf(system)->empty());
        system.parts.set(Tide{});
        QVERIFY(system.hasCoordinates() && system.parts.find<Mechanical>());
        QVERIFY(!system.isMovedOnlyBy<Mechanical>());
        QVERIFY(linearTestOf(system) == LinearTest::none);
        QVERIFY(symmetriesOf(system)->empty());
    }
};

EXTREMAL_TEST(OtherProblemsTest)
}  // namespace extremal::other_problems_test

#include "other_problems_test.moc"
