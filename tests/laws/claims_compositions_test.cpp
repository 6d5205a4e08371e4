// SPDX-License-Identifier: GPL-3.0-or-later
/// Compositions of everything that is symmetric, for coordinates: two orders up, and all else as before.
#include <QTest>

#include "tests/laws/claims.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::claims_compositions_test {

class ClaimsCompositionsTest : public QObject {
    Q_OBJECT
    const ClaimSuite suite_{SubjectKind::coordinates,
                            [](const CatalogueScheme& c) { return c.group == Group::composition; }};

private slots:
    void everyClaimHolds_data() {
        QTest::addColumn<QString>("name");
        const std::vector<std::string> names = suite_.names();
        QVERIFY(names.size() >= 10);
        for (const std::string& name : names)
            QTest::addRow("%s", name.c_str()) << QString::fromStdString(name);
    }
    void everyClaimHolds() {
        QFETCH(QString, name);
        QVERIFY(suite_.holds(name.toStdString()));
    }
};

EXTREMAL_TEST(ClaimsCompositionsTest)
}  // namespace extremal::laws::claims_compositions_test

#include "claims_compositions_test.moc"
