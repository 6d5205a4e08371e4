// SPDX-License-Identifier: GPL-3.0-or-later
#include <QDir>
#include <QFile>
#include <QTest>

#include "tests/fuzz/kinds.hpp"
#include "tests/tools/test.hpp"

namespace extremal::fuzz::fuzz_test {

class FuzzTest : public QObject {
    Q_OBJECT
private slots:
    /// Texts that once made the program fall, hang or contradict itself, as KIND-NAME.txt.
    void whatOnceFellStands_data() {
        QTest::addColumn<QString>("file");
        for (const QFileInfo& file : QDir(EXTREMAL_SOURCE_DIR "/tests/fuzz/cases").entryInfoList(QDir::Files))
            QTest::newRow(qPrintable(file.fileName())) << file.filePath();
    }
    void whatOnceFellStands() {
        QFETCH(QString, file);
        QFile in(file);
        QVERIFY(in.open(QFile::ReadOnly));
        const std::string name = QFileInfo(file).fileName().section('-', 0, 0).toStdString();
        for (const Kind& kind : kinds())
            if (kind.name == name) {
                const std::string fault = judgeCase(kind, in.readAll().toStdString());
                QVERIFY2(fault.empty(), fault.c_str());
                return;
            }
        QFAIL("of no kind");
    }

    void someOfEachKindStand_data() {
        QTest::addColumn<int>("kind");
        for (std::size_t k = 0; k < kinds().size(); ++k)
            QTest::newRow(kinds()[k].name.data()) << static_cast<int>(k);
    }
    void someOfEachKindStand() {
        QFETCH(int, kind);
        const Kind& its = kinds()[static_cast<std::size_t>(kind)];
        for (std::uint64_t number = 0; number < 300; ++number) {
            const std::string text = makeCase(its, 1, number);
            const std::string fault = judgeCase(its, text);
            QVERIFY2(fault.empty(), (fault + "\n" + text).c_str());
        }
    }
};

EXTREMAL_TEST(FuzzTest)

}  // namespace extremal::fuzz::fuzz_test

#include "fuzz_test.moc"
