// SPDX-License-Identifier: GPL-3.0-or-later
/// The passport of the selected scheme in the window, and what is saved from it.
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <QTextBrowser>

#include "tests/tools/test.hpp"
#include "ui/base/notices.hpp"
#include "ui/base/theme.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/windows/passport_window.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::passport_window_test {
namespace {

QString contentOf(const QString& path) {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

}  // namespace

class PassportWindowTest : public QObject {
    Q_OBJECT
private slots:
    void theSelectedSchemeHasItsPassport() {
        MainWindow window(Theme::light(), false);
        QVERIFY(window.open("preset:pendulum"));
        window.workspace().selectScheme(1);
        window.actions().find("passport")->trigger();
        auto* passport = window.findChild<PassportWindow*>("passport");
        QVERIFY(passport);
        const auto text = [&] { return passport->findChild<QTextBrowser*>()->toPlainText(); };
        QVERIFY(passport->windowTitle().contains("Galerkin Lobatto 4"));
        QVERIFY2(text().contains("5/24"), qPrintable(text()));
        QVERIFY(QTest::qWaitFor([&] { return passport->isComplete(); }, 60000));
        QVERIFY2(text().contains("Measured order"), qPrintable(text()));

        QTemporaryDir folder;
        for (const char* name : {"page.tex", "page.html", "page.md", "step.cpp", "step.py"})
            QVERIFY(passport->saveAs(folder.filePath(name)));
        QVERIFY(contentOf(folder.filePath("page.tex")).contains("\\begin{document}"));
        QVERIFY(contentOf(folder.filePath("step.cpp")).contains("int main("));
        QVERIFY(!passport->saveAs(folder.filePath("missing/page.tex")));
        QVERIFY(!window.notices().all().empty());
    }
};

EXTREMAL_TEST(PassportWindowTest)

}  // namespace extremal::passport_window_test

#include "passport_window_test.moc"
