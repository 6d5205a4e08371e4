// SPDX-License-Identifier: GPL-3.0-or-later
/// Golden images of whole snapshots: stage, plots, cards and text together.
#include <QTest>

#include "tests/golden/golden_check.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/stage/model_comparison.hpp"
#include "ui/pictures/snapshot.hpp"

namespace extremal::snapshot_test {

class SnapshotGoldenTest : public QObject {
    Q_OBJECT

    static void check(const fake::Film& film, const SnapshotRequest& request, const QString& name) {
        const GoldenResult result =
            checkGolden(snapshotImage(fake::comparison(film), request), name, GoldenLimits::stage());
        QVERIFY2(result.isEqual, qPrintable(result.message));
    }
    static SnapshotRequest request(const std::string& view, int width, int height, double time) {
        SnapshotRequest r;
        r.view = view;
        r.width = width;
        r.height = height;
        r.time = time;
        return r;
    }

private slots:
    void allViewsOfASceneMatchTheirImages() {
        check(fake::springPendulum(), request("all", 900, 600, 6.2), "snapshot-all");
    }
    void oneViewFillsThePage() { check(fake::kepler(), request("stage", 600, 400, 6.2), "snapshot-stage"); }
};

EXTREMAL_TEST(SnapshotGoldenTest)
}  // namespace extremal::snapshot_test

#include "snapshot_test.moc"
