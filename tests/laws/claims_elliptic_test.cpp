// SPDX-License-Identifier: GPL-3.0-or-later
/// Every scheme for the elliptic problem: the order in the number of elements that it claims, and what claims
/// none is exact at the nodes.
#include <QTest>

#include <algorithm>

#include "tests/laws/catalogue.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::claims_elliptic_test {
namespace {

/// The largest error at a node over the largest value there; a state is (u_h, u).
double nodalError(const CatalogueScheme& scheme, const System& system, int elements) {
    const auto integrator = scheme.make(system, 1.0 / elements, {0, 0, {0, 0}});
    State state{0, 0, {0, 0}};
    double worst = 0, size = 0;
    for (int k = 0; k < elements; ++k) {
        if (advance(*integrator, state).outcome != Outcome::converged) return 1e300;
        worst = std::max(worst, std::abs(state.x[0] - state.x[1]));
        size = std::max(size, std::abs(state.x[1]));
    }
    return worst / size;
}

/// From elements that resolve the coefficient, whose period is 1/20.
double orderOf(const CatalogueScheme& scheme, const System& system) {
    std::vector<double> h, e;
    for (const int elements : {120, 240, 480}) {
        h.push_back(-std::log(elements));
        e.push_back(std::log(nodalError(scheme, system, elements)));
    }
    return slope(h, e);
}

bool holds(const CatalogueScheme& scheme, const System& system, int claimed) {
    if (claimed == 0) return nodalError(scheme, system, 8) < 1e-9;
    return std::abs(orderOf(scheme, system) - claimed) < 0.15;
}

}  // namespace

class ClaimsEllipticTest : public QObject {
    Q_OBJECT
    const System system_ = systemNamed("multiscale-elliptic", {{"epsilon", 0.05}});

    /// One for each kind of functions: the number of elements is that of the step.
    std::vector<CatalogueScheme> everything() const {
        std::vector<CatalogueScheme> all = everythingOn(system_, {0, 0, {0, 0}}, 0.1);
        std::erase_if(
            all, [](const CatalogueScheme& c) { return c.scheme.discretization.space.find("elements"); });
        return all;
    }

private slots:
    void everyClaimHolds() {
        const auto cases = everything();
        QVERIFY(cases.size() >= 2);
        for (const CatalogueScheme& c : cases) {
            qInfo("%s claims order %d", c.name.c_str(), c.claims().order);
            QVERIFY2(holds(c, system_, c.claims().order), c.name.c_str());
        }
    }
    void wrongClaimsAreFound() {
        for (const CatalogueScheme& c : everything())
            QVERIFY2(!holds(c, system_, c.claims().order > 0 ? 0 : 2), c.name.c_str());
    }
};

EXTREMAL_TEST(ClaimsEllipticTest)
}  // namespace extremal::laws::claims_elliptic_test

#include "claims_elliptic_test.moc"
