// SPDX-License-Identifier: GPL-3.0-or-later
/// Everything for rigid bodies, alone and composed: what it claims, measured on every body. More of free
/// bodies and of the top: laws.body_claims.
#include <QTest>

#include "tests/laws/claims.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::claims_bodies_test {

class ClaimsBodiesTest : public QObject {
    Q_OBJECT
    const ClaimSuite suite_{SubjectKind::body,
                            [](const CatalogueScheme& c) { return !c.scheme.isAdaptive(); }};

private slots:
    void everyClaimHolds_data() {
        QTest::addColumn<QString>("name");
        const std::vector<std::string> names = suite_.names();
        QVERIFY(names.size() >= 20);
        for (const std::string& name : names)
            QTest::addRow("%s", name.c_str()) << QString::fromStdString(name);
    }
    void everyClaimHolds() {
        QFETCH(QString, name);
        QVERIFY(suite_.holds(name.toStdString()));
    }
};

EXTREMAL_TEST(ClaimsBodiesTest)
}  // namespace extremal::laws::claims_bodies_test

#include "claims_bodies_test.moc"
