// SPDX-License-Identifier: GPL-3.0-or-later
/// Licences: of every library in About and in the handbook, of every font in the package.
#include <QDir>
#include <QFile>
#include <QTest>

#include <algorithm>

#include "engine/core/libraries.hpp"
#include "tests/tools/test.hpp"
#include "ui/windows/about.hpp"

namespace extremal::licences_test {
namespace {

QString textOf(const QString& path) {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

}  // namespace

class LicencesTest : public QObject {
    Q_OBJECT
private slots:
    void ofLibraries() {
        const QString page = textOf(":/handbook/licences.md"), about = aboutText("nothing");
        QVERIFY(!page.isEmpty());
        for (const auto& [library, licence] : licences()) {
            QVERIFY2(page.contains("\n| " + library + " | " + licence + " | "), qPrintable(library));
            QVERIFY2(about.contains(library + ' ' + licence), qPrintable(library));
        }
        QCOMPARE(page.count("\n| "), qsizetype(licences().size()) + 2);  // the head and the line below it
        for (const auto& [library, version] : libraries()) {
            const auto isIt = [&](const auto& entry) { return entry.first.toStdString() == library; };
            QVERIFY2(std::any_of(licences().begin(), licences().end(), isIt), library.c_str());
        }
    }

    void ofFonts() {
        const QDir fonts(":/fonts");
        const QStringList names = fonts.entryList({"*.otf"});
        QVERIFY(names.size() >= 4);
        const QString copyright = textOf(QStringLiteral(EXTREMAL_SOURCE_DIR "/package/copyright"));
        for (const QString& name : names) QVERIFY2(copyright.contains(name), qPrintable(name));
    }
};

EXTREMAL_TEST(LicencesTest)

}  // namespace extremal::licences_test

#include "licences_test.moc"
