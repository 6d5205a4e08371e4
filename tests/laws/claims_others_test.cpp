// SPDX-License-Identifier: GPL-3.0-or-later
/// Systems of further kinds (neither coordinates nor bodies nor wave functions): everything for them,
/// measured by what the systems say of themselves. And no model of the catalogue is left out by the suites of
/// claims.
#include <QTest>

#include <cmath>
#include <map>
#include <set>

#include "engine/core/problem.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/laws/claims.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::claims_others_test {

namespace {

bool isMeasured(const Trial& trial, const std::string& what) {
    for (const double each : {24., 6., 1., 0.4}) try {
            if (std::isfinite(conservedDefect(trial, what, each).value_or(NAN))) return true;
        } catch (const InvalidScene&) {
        }
    return false;
}

/// What a space and a rule conserve, alone or composed, they conserve with other keys as well.
std::string sourceOf(const CatalogueScheme& c) {
    if (!c.scheme.family) return c.scheme.spec.baseline.type;
    return c.scheme.discretization.space.type + " x " + c.scheme.discretization.quadrature.type;
}

}  // namespace

class ClaimsOthersTest : public QObject {
    Q_OBJECT

    const ClaimSuite suite_{SubjectKind::other,
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
    /// Momenta are those of coordinates and bodies, norms those of wave functions: what a scheme conserves is
    /// measured on one kind of system that it fits, at least.
    void everythingConservedIsMeasured() {
        std::map<std::string, std::set<std::string>> missing;
        std::set<std::string> measured;
        for (const SubjectKind kind :
             {SubjectKind::coordinates, SubjectKind::body, SubjectKind::wave, SubjectKind::other})
            for (const Subject& on : everySubject(kind))
                for (const CatalogueScheme& c : everythingOn(on.system, on.start, on.time / 24))
                    for (const std::string& what : c.claims().conserves) {
                        const std::string name = sourceOf(c);
                        if (c.scheme.isAdaptive() || measured.contains(name + what)) continue;
                        missing[what].insert(name);
                        if (!isMeasured(trialOf(on, c), what)) continue;
                        measured.insert(name + what);
                        missing[what].erase(name);
                    }
        for (const auto& [what, names] : missing)
            for (const std::string& name : names) qWarning("%s: %s", what.c_str(), name.c_str());
        for (const auto& [what, names] : missing) QVERIFY2(names.empty(), what.c_str());
    }
    void everyModelIsASubject() {
        std::set<std::string> known;
        for (const SubjectKind kind :
             {SubjectKind::coordinates, SubjectKind::body, SubjectKind::wave, SubjectKind::other})
            for (const Subject& s : everySubject(kind)) known.insert(s.system.id);
        for (const ModelEntry& model : modelCatalog()) {
            if (known.contains(model.item.id)) continue;
            // Problems without motion (laws.claims_elliptic); fields (laws.claims_fields), whose orders are
            // those of the mesh and the step together; asynchronous bodies
            // (tests/engine/family/asynchronous), fields over rectangles
            // (tests/engine/family/spectral_field).
            bool isElsewhere = false;
            for (const Preset* preset : onePerModel()) {
                const Scene scene = readScene(preset->json).scene;
                if (scene.model.type != model.item.id) continue;
                const System system = makeSystem(scene);
                isElsewhere = isElsewhere || !system.isMotion() || system.parts.find<ScalarField>() ||
                              system.parts.find<Membrane>() || system.parts.find<PlaneField>();
            }
            QVERIFY2(isElsewhere,
                     (model.item.id + " has no preset, so that no claim is measured on it").c_str());
        }
    }
};

EXTREMAL_TEST(ClaimsOthersTest)
}  // namespace extremal::laws::claims_others_test

#include "claims_others_test.moc"
