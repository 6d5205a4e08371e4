// SPDX-License-Identifier: GPL-3.0-or-later
/// Pictures along a run stay within their memory, evenly spread, first and last included.
#include <QTest>

#include "engine/trajectory/frames.hpp"
#include "tests/tools/test.hpp"

namespace extremal::frames_test {
namespace {

std::vector<Frame> offerRows(int rows, std::size_t size) {
    FrameKeeper keeper;
    std::vector<Frame> frames;
    for (int k = 0; k < rows; ++k)
        keeper.offer(
            k, false, [&] { return std::make_shared<const std::vector<double>>(size, k); }, frames);
    keeper.offer(
        rows - 1, true, [&] { return std::make_shared<const std::vector<double>>(size, rows - 1); }, frames);
    return frames;
}

}  // namespace

class FramesTest : public QObject {
    Q_OBJECT
private slots:
    void allRowsWhileTheyFit() {
        const auto frames = offerRows(500, 512);
        QCOMPARE(frames.size(), std::size_t{500});
        for (std::size_t k = 0; k < frames.size(); ++k)
            QCOMPARE((*frames[k].values)[0], static_cast<double>(k));
    }
    void evenlySpreadBeyond() {
        for (const auto& [rows, size] :
             {std::pair{2000, std::size_t{4096}}, {2000, std::size_t{131072}}, {20000, std::size_t{256}}}) {
            const auto frames = offerRows(rows, size);
            QVERIFY(frames.size() * size <= FrameKeeper::usual + 2 * size);
            QVERIFY(frames.size() * size > FrameKeeper::usual / 4 || frames.size() <= 4);
            QCOMPARE(frames.front().t, 0.0);
            QCOMPARE(frames.back().t, rows - 1.0);
            const double spacing = frames[1].t - frames[0].t;
            for (std::size_t k = 2; k + 1 < frames.size(); ++k)
                QCOMPARE(frames[k].t - frames[k - 1].t, spacing);
            QVERIFY(frames.back().t - frames[frames.size() - 2].t <= spacing);
        }
    }
};

EXTREMAL_TEST(FramesTest)
}  // namespace extremal::frames_test

#include "frames_test.moc"
