// SPDX-License-Identifier: GPL-3.0-or-later
/// Everything for wave functions, alone and composed: what it claims, measured on every form of their models
/// and on a potential that depends on time.
#include <QTest>

#include "tests/laws/claims.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::claims_waves_test {

class ClaimsWavesTest : public QObject {
    Q_OBJECT
    const ClaimSuite suite_{SubjectKind::wave,
                            [](const CatalogueScheme& c) { return !c.scheme.isAdaptive(); }};

private slots:
    void everyClaimHolds_data() {
        QTest::addColumn<QString>("name");
        const std::vector<std::string> names = suite_.names();
        QVERIFY(names.size() >= 40);
        for (const std::string& name : names)
            QTest::addRow("%s", name.c_str()) << QString::fromStdString(name);
    }
    void everyClaimHolds() {
        QFETCH(QString, name);
        QVERIFY(suite_.holds(name.toStdString()));
    }
};

EXTREMAL_TEST(ClaimsWavesTest)
}  // namespace extremal::laws::claims_waves_test

#include "claims_waves_test.moc"
