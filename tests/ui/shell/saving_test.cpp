/// A scene that is saved, opened and saved again has the same bytes: every preset.
#include <QFile>
#include <QTemporaryDir>
#include <QTest>

#include "engine/scene/preset.hpp"
#include "tests/tools/test.hpp"
#include "ui/shell/notices.hpp"
#include "ui/shell/workspace.hpp"

namespace extremal::saving_test {

class SavingTest : public QObject {
    Q_OBJECT
private slots:
    void savedAgainItHasTheSameBytes() {
        QTemporaryDir folder;
        const auto bytes = [](const QString& path) {
            QFile file(path);
            return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
        };
        for (const Preset& preset : presets()) {
            const QString id = QString::fromUtf8(preset.id.data(), static_cast<qsizetype>(preset.id.size()));
            const QString first = folder.filePath(id + ".json"), second = folder.filePath(id + "-2.json");
            Notices notices;
            Workspace once(notices), twice(notices);
            QVERIFY2(once.open("preset:" + id) && once.saveAs(first), qPrintable(id));
            QVERIFY2(twice.open(first, true) && twice.saveAs(second), qPrintable(id));
            QVERIFY2(!bytes(first).isEmpty() && bytes(first) == bytes(second), qPrintable(id));
            QVERIFY2(once.scene() == twice.scene(), qPrintable(id));
        }
    }
};

EXTREMAL_TEST(SavingTest)
}  // namespace extremal::saving_test

#include "saving_test.moc"
