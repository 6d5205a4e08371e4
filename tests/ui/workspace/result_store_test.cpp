// SPDX-License-Identifier: GPL-3.0-or-later
/// What has come to its end is kept, and nothing else.
#include <QTest>

#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"
#include "ui/workspace/result_store.hpp"

namespace extremal::result_store_test {

class ResultStoreTest : public QObject {
    Q_OBJECT
private slots:
    void whatHasEndedIsKept_data() {
        QTest::addColumn<int>("status");
        QTest::addColumn<bool>("isKept");
        for (const RunStatus status :
             {RunStatus::waiting, RunStatus::running, RunStatus::done, RunStatus::partial, RunStatus::failed})
            QTest::newRow(name(status))
                << static_cast<int>(status) << (status == RunStatus::done || status == RunStatus::failed);
    }
    void whatHasEndedIsKept() {
        QFETCH(int, status);
        QFETCH(bool, isKept);
        const ReadScene read = readScene(std::string(
            R"({"extremal":1,"model":{"type":"pendulum"},"initial":{"q":[1],"p":[0]},"time":{"end":1},
                "reference":"none","schemes":[{"step":0.1,"baseline":"stormer-verlet"}]})"));
        Comparison comparison = run(read.scene);
        auto result = std::make_shared<SchemeResult>(*comparison.schemes.at(0));
        QCOMPARE(result->summary.status, RunStatus::done);
        result->summary.status = static_cast<RunStatus>(status);
        comparison.schemes = {result};
        ResultStore store;
        store.keep(comparison);
        QCOMPARE(store.find(read.scene, 0) != nullptr, isKept);
    }
};

EXTREMAL_TEST(ResultStoreTest)

}  // namespace extremal::result_store_test

#include "result_store_test.moc"
