// SPDX-License-Identifier: GPL-3.0-or-later
/// Every space with every rule, for coordinates: what the discretizations claim, measured on every system.
#include <QTest>

#include "tests/laws/claims.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::claims_spaces_test {

class ClaimsSpacesTest : public QObject {
    Q_OBJECT
    // Moving times are measured under their names and in laws.moving_times: every rule with every policy
    // would take longer than all other spaces together.
    const ClaimSuite suite_{SubjectKind::coordinates, [](const CatalogueScheme& c) {
                                return c.group == Group::space && c.scheme.grid != TimeGrid::free;
                            }};

private slots:
    void everyClaimHolds_data() {
        QTest::addColumn<QString>("name");
        const std::vector<std::string> names = suite_.names();
        QVERIFY(names.size() >= 30);
        for (const std::string& name : names)
            QTest::addRow("%s", name.c_str()) << QString::fromStdString(name);
    }
    void everyClaimHolds() {
        QFETCH(QString, name);
        QVERIFY(suite_.holds(name.toStdString()));
    }
};

EXTREMAL_TEST(ClaimsSpacesTest)
}  // namespace extremal::laws::claims_spaces_test

#include "claims_spaces_test.moc"
