// SPDX-License-Identifier: GPL-3.0-or-later
/// The laws of claims seen failing: each of them on a scheme that is broken in the way it is there to find,
/// on every kind of system that it applies to, and on schemes that claim too much or too little.
#include <QTest>

#include <algorithm>
#include <set>

#include "engine/action/table.hpp"
#include "engine/integrator/condensed.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/space/polynomial.hpp"
#include "tests/laws/claims.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::claims_teeth_test {
namespace {

/// A scheme that loses a part in ten thousand of the second half of its state at every step.
class Leaking final : public Integrator {
public:
    explicit Leaking(std::unique_ptr<Integrator> inner) : inner_(std::move(inner)) {}
    double stepSize() const override { return inner_->stepSize(); }
    void setStep(double h) override { inner_->setStep(h); }
    void begin(State& state) override { inner_->begin(state); }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Leaking>(inner_->clone()); }
    StepReport advance(State& state, double until) override {
        const StepReport report = inner_->advance(state, until);
        for (std::size_t i = state.x.size() / 2; i < state.x.size(); ++i) state.x[i] *= 1 - 1e-4;
        return report;
    }
    void denseOutput(double tau, std::span<double> x) const override { inner_->denseOutput(tau, x); }

private:
    std::unique_ptr<Integrator> inner_;
};

bool isFound(const Found& found, const std::string& what) {
    return std::any_of(found.broken.begin(), found.broken.end(),
                       [&](const std::string& b) { return b.starts_with(what); });
}

const char* schemeOf(SubjectKind kind) {
    return kind == SubjectKind::coordinates ? "midpoint"
           : kind == SubjectKind::body      ? "lie-1"
                                            : "schrodinger-gauss-1";
}

}  // namespace

class ClaimsTeethTest : public QObject {
    Q_OBJECT
    std::map<SubjectKind, std::vector<Subject>> subjects_;

    CatalogueScheme schemeOn(const Subject& on) const {
        const auto all = everythingOn(on.system, on.start, on.time / 24);
        const char* const wanted = schemeOf(kindOfSubject(on.system));
        return *std::find_if(all.begin(), all.end(),
                             [&](const CatalogueScheme& c) { return c.name == wanted; });
    }

private slots:
    void initTestCase() {
        for (const SubjectKind kind : {SubjectKind::coordinates, SubjectKind::body, SubjectKind::wave})
            subjects_[kind] = everySubject(kind);
        // Those that have what the laws need: an oscillator, momenta, potentials at rest and driven ones.
        for (auto& [kind, subjects] : subjects_)
            std::erase_if(subjects, [](const Subject& s) {
                const std::set<std::string> wanted{"harmonic-oscillator", "kepler", "heavy-top", "periodic",
                                                   "driven"};
                return !wanted.contains(s.name) && !wanted.contains(s.system.id);
            });
        QCOMPARE(subjects_.at(SubjectKind::coordinates).size(), std::size_t(2));
        QCOMPARE(subjects_.at(SubjectKind::body).size(), std::size_t(1));
        QCOMPARE(subjects_.at(SubjectKind::wave).size(), std::size_t(2));
    }
    void whatLeaksIsFound_data() {
        QTest::addColumn<int>("kind");
        QTest::addColumn<QStringList>("laws");
        const auto row = [](const char* name, SubjectKind kind, const QStringList& laws) {
            QTest::newRow(name) << static_cast<int>(kind) << laws;
        };
        row("coordinates", SubjectKind::coordinates,
            {"order", "does not return", "not symplectic", "momentum", "quadratic invariants"});
        row("bodies", SubjectKind::body, {"order", "does not return", "not symplectic", "momentum"});
        row("waves", SubjectKind::wave, {"order", "does not return", "not symplectic", "norm", "energy"});
    }
    void whatLeaksIsFound() {
        QFETCH(int, kind);
        QFETCH(QStringList, laws);
        Found broken;
        for (const Subject& on : subjects_.at(static_cast<SubjectKind>(kind))) {
            const CatalogueScheme scheme = schemeOn(on);
            Found whole;
            Trial trial = trialOf(on, scheme);
            measure(whole, trial);
            QVERIFY2(whole.broken.empty(), whole.broken.empty() ? "" : whole.broken.front().c_str());
            trial.make = [make = trial.make](double step) { return std::make_unique<Leaking>(make(step)); };
            measure(broken, trial);
        }
        for (const QString& law : laws) QVERIFY2(isFound(broken, law.toStdString()), qPrintable(law));
    }
    /// Gauss(2) with weights 0.51 and 0.49: symplectic, but of order 1.
    void wrongWeightsAreFound() {
        const Subject& on = subjects_.at(SubjectKind::coordinates).back();
        Rule<double> rule = gauss<double>(2);
        rule.b = {0.51, 0.49};
        const Table<double> table = makeTable(polynomialSpace<double>(2, PolynomialBasis::lobatto), rule);
        Found found;
        measure(found, {on, {4, false, true, {"momentum"}}, [&](double step) {
                            return makeCondensed(on.system.mechanics(),
                                                 [table](double) { return std::vector{table}; }, step, {});
                        }});
        QVERIFY(isFound(found, "order") && found.broken.size() == 1);
    }
    void wrongClaimsAreFound_data() {
        QTest::addColumn<QString>("what");
        for (const char* what : {"order", "the order is better", "returns everywhere",
                                 "is symplectic everywhere", "conserves momentum everywhere"})
            QTest::newRow(what) << QString(what);
    }
    /// The midpoint rule claims two orders more, or less than it does.
    void wrongClaimsAreFound() {
        QFETCH(QString, what);
        Found found;
        CatalogueScheme scheme;
        for (const Subject& on : subjects_.at(SubjectKind::coordinates)) {
            scheme = schemeOn(on);
            Claims& claims = scheme.scheme.claims;
            if (what == "order") claims.order = 4;
            if (what.startsWith("the order")) claims.order = 1;
            if (what.startsWith("returns")) claims.isSymmetric = false;
            if (what.startsWith("is symplectic")) claims.isSymplectic = false;
            if (what == "conserves momentum everywhere") claims.conserves = {};
            measure(found, trialOf(on, scheme));
        }
        findGaps(found, scheme);
        findModesty(found, scheme, subjects_.at(SubjectKind::coordinates).back());
        for (const std::string& b : found.broken) qInfo("%s", b.c_str());
        QVERIFY(isFound(found, what.toStdString()));
    }
    void whatNothingMeasuresIsNotMeasured() {
        const Subject& on = subjects_.at(SubjectKind::coordinates).front();
        const CatalogueScheme scheme = schemeOn(on);
        QVERIFY(!conservedDefect(trialOf(on, scheme), "helicity", 24));
        QVERIFY(!conservedDefect(trialOf(on, scheme), "norm", 24));
        const Subject& wave = subjects_.at(SubjectKind::wave).back();
        const CatalogueScheme gauss = schemeOn(wave);
        QVERIFY(!wave.isAutonomous && conservedDefect(trialOf(wave, gauss), "norm", 24));
        QVERIFY(!conservedDefect(trialOf(wave, gauss), "norm if H is constant", 24));
    }
};

EXTREMAL_TEST(ClaimsTeethTest)
}  // namespace extremal::laws::claims_teeth_test

#include "claims_teeth_test.moc"
