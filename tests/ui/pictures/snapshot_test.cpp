// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/tools/test.hpp"
#include "ui/pictures/snapshot.hpp"

#include <QFile>
#include <QTemporaryDir>
#include <QTest>

#include "tests/ui/stage/model_comparison.hpp"
#include "ui/pictures/snapshot_page.hpp"

namespace extremal::snapshot_test {

class SnapshotTest : public QObject {
    Q_OBJECT

    std::shared_ptr<const Comparison> comparison_ = fake::comparison(fake::pendulum());
    QTemporaryDir folder_;

    SnapshotRequest request(const QString& name, const std::string& view = "all") const {
        SnapshotRequest r;
        r.file = folder_.filePath(name);
        r.view = view;
        r.width = 500;
        r.height = 400;
        return r;
    }
    static QByteArray bytes(const QString& file) {
        QFile f(file);
        return f.open(QIODevice::ReadOnly) ? f.readAll() : QByteArray();
    }
    /// The kind of the error, or -1 if there is none; and its text.
    std::pair<int, QString> failure(const SnapshotRequest& r) const {
        try {
            checkSnapshot(comparison_->scene, r);
        } catch (const SnapshotError& e) {
            return {static_cast<int>(e.kind),
                    QString::fromStdString(e.where + ": " + e.what() + " (" + e.hint + ")")};
        }
        return {-1, {}};
    }

private slots:
    void sameComparisonGivesSameBytes() {
        for (const char* kind : {"png", "pdf", "svg"}) {
            const SnapshotRequest a = request(QString("a.") + kind), b = request(QString("b.") + kind);
            makeSnapshot(comparison_, a);
            makeSnapshot(comparison_, b);
            QVERIFY(bytes(a.file).size() > 5000);
            QVERIFY2(bytes(a.file) == bytes(b.file), kind);
        }
    }

    void picturesHaveTheSizeAsked() {
        for (const auto& [width, height] : {std::pair(64, 64), std::pair(8192, 64), std::pair(333, 777)})
            for (const char* view : {"all", "stage", "phase"}) {
                SnapshotRequest r = request("size.png", view);
                r.width = width;
                r.height = height;
                makeSnapshot(comparison_, r);
                QCOMPARE(QImage(r.file).size(), QSize(width, height));
            }
    }

    void pngIsWhatSnapshotImageShows() {
        const SnapshotRequest r = request("same.png");
        makeSnapshot(comparison_, r);
        QCOMPARE(QImage(r.file).convertToFormat(QImage::Format_RGB32), snapshotImage(comparison_, r));
    }

    void timesAreThoseOfTheNearestRow() {
        SnapshotRequest r = request("time.png", "stage");
        QCOMPARE(makeSnapshot(comparison_, r).time, 10.0);
        r.time = 3.1234;
        QCOMPARE(makeSnapshot(comparison_, r).time, 312 * 0.01);
        r.time = -5;
        QCOMPARE(makeSnapshot(comparison_, r).time, 0.0);
    }

    void comparisonsSayWhetherPicturesDiffer() {
        const SnapshotRequest base = request("base.png", "stage");
        makeSnapshot(comparison_, base);
        SnapshotRequest r = request("again.png", "stage");
        r.compareWith = base.file;
        const SnapshotResult same = makeSnapshot(comparison_, r);
        QVERIFY(same.isCompared && same.isEqual);
        QCOMPARE(same.differingPercent, 0.0);
        QVERIFY(QFile::exists(folder_.filePath("again.png.diff.png")));

        r.time = 5;
        const SnapshotResult other = makeSnapshot(comparison_, r);
        QVERIFY(!other.isEqual);
        r.tolerance = 100;
        QVERIFY(makeSnapshot(comparison_, r).isEqual);
        r.width = 400;
        QVERIFY(!makeSnapshot(comparison_, r).isEqual);
        // A vector picture is compared as it would be drawn in pixels.
        SnapshotRequest vector = request("again.svg", "stage");
        vector.compareWith = base.file;
        QVERIFY(makeSnapshot(comparison_, vector).isEqual);
    }

    void unusableRequestsAreToldBeforeTheRun() {
        const int unusable = static_cast<int>(SnapshotError::Kind::unusable);
        QCOMPARE(failure(request("fine.png")).first, -1);
        QCOMPARE(failure(request("picture.gif")).first, unusable);
        const auto view = failure(request("a.png", "phaze"));
        QCOMPARE(view.first, unusable);
        QVERIFY2(view.second.contains("phase"), qPrintable(view.second));
        QCOMPARE(failure(request("a.png", "momentum")).first, unusable);  // not observed
        SnapshotRequest r = request("a.png");
        r.width = 63;
        QCOMPARE(failure(r).first, unusable);
        r = request("a.png");
        r.tolerance = -1;
        QCOMPARE(failure(r).first, unusable);
        r = request("a.png");
        r.compareWith = folder_.filePath("nowhere.png");
        QCOMPARE(failure(r).first, unusable);
        QCOMPARE(failure(request("nowhere/a.png")).first, static_cast<int>(SnapshotError::Kind::unwritable));
    }

    void cardsFillThePageWithoutOverlap() {
        for (std::size_t count = 1; count <= 12; ++count)
            for (const QSizeF& size : {QSizeF(1200, 700), QSizeF(600, 1000), QSizeF(3000, 500)}) {
                const QRectF area(QPointF(10, 20), size);
                const auto places = cardPlaces(area, count, 10);
                QCOMPARE(places.size(), count);
                for (std::size_t i = 0; i < count; ++i) {
                    QVERIFY(area.adjusted(-1, -1, 1, 1).contains(places[i]));
                    for (std::size_t j = 0; j < i; ++j) QVERIFY(!places[i].intersects(places[j]));
                }
            }
    }
};

EXTREMAL_TEST(SnapshotTest)
}  // namespace extremal::snapshot_test

#include "snapshot_test.moc"
