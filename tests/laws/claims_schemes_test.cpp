// SPDX-License-Identifier: GPL-3.0-or-later
/// Named schemes and baselines for coordinates: what they claim, measured on every system.
#include <QTest>

#include "tests/laws/claims.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::claims_schemes_test {

class ClaimsSchemesTest : public QObject {
    Q_OBJECT
    const ClaimSuite suite_{SubjectKind::coordinates, [](const CatalogueScheme& c) {
                                return !c.scheme.isAdaptive() &&
                                       (c.group == Group::named || c.group == Group::baseline);
                            }};

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

EXTREMAL_TEST(ClaimsSchemesTest)
}  // namespace extremal::laws::claims_schemes_test

#include "claims_schemes_test.moc"
