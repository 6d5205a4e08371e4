// SPDX-License-Identifier: GPL-3.0-or-later
/// The handbook's page of keys is what the descriptors say.
#include <QDir>
#include <QFile>
#include <QTest>

#include "tests/tools/parameters_page.hpp"
#include "tests/tools/test.hpp"

namespace extremal::parameters_test {

class ParametersTest : public QObject {
    Q_OBJECT
private slots:
    void thePageIsWhatTheDescriptorsSay() {
        QFile page(QStringLiteral(EXTREMAL_SOURCE_DIR "/resources/handbook/parameters.md"));
        const std::string expected = extremal::tools::parametersPage();
        if (page.open(QIODevice::ReadOnly) && page.readAll().toStdString() == expected) return;
        QDir().mkpath(QStringLiteral(EXTREMAL_TEST_OUTPUT));
        QFile actual(QStringLiteral(EXTREMAL_TEST_OUTPUT "/parameters.md"));
        QVERIFY(actual.open(QIODevice::WriteOnly));
        actual.write(expected.data(), static_cast<qint64>(expected.size()));
        QFAIL(qPrintable("resources/handbook/parameters.md is out of date: copy " + actual.fileName()));
    }
};

EXTREMAL_TEST(ParametersTest)
}  // namespace extremal::parameters_test

#include "parameters_test.moc"
