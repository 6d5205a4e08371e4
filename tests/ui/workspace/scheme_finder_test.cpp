// SPDX-License-Identifier: GPL-3.0-or-later
/// The scheme of a cell of the grid is found in that cell and in no other.
#include "ui/workspace/scheme_finder.hpp"

#include <QTest>

#include <string>

#include "engine/family/family.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::scheme_finder_test {

class SchemeFinderTest : public QObject {
    Q_OBJECT
private slots:
    void aSchemeIsInItsCellAlone() {
        int looked = 0;
        for (const char* preset :
             {"kepler", "heavy-top", "free-body", "spring-pendulum", "wave", "coherent-state", "breather"}) {
            const ResolvedScene whole = *readScene(findPreset(preset)->json).resolved;
            const ChoiceGrid grid = choicesFor(*whole.system);
            for (const ChoiceGrid::Cell& own : grid.cells) {
                if (own.isOwn || own.discretization.space.type.empty()) continue;
                ResolvedScene scene = whole;
                ResolvedScheme scheme = scene.schemes.front();
                scheme.discretization = own.discretization;
                scheme.spec = {};
                scheme.spec.step = whole.schemes.front().spec.step;
                scheme.family = familyOf(own.discretization.space);
                if (!scheme.plain()) continue;
                scene.schemes = {scheme};
                for (const ChoiceGrid::Cell& cell : grid.cells)
                    if (!cell.isOwn)
                        QVERIFY2((findScheme(scene, cell, false) == 0) == (cell.id == own.id),
                                 (std::string(preset) + ": " + own.id + " and " + cell.id).c_str());
                ++looked;
            }
        }
        qInfo("%d cells", looked);
        QVERIFY(looked > 100);
    }
};

EXTREMAL_TEST(SchemeFinderTest)
}  // namespace extremal::scheme_finder_test

#include "scheme_finder_test.moc"
