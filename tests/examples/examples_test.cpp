// SPDX-License-Identifier: GPL-3.0-or-later
/// The worked examples of the handbook ("Adding to the program"): each is one file, and does what the
/// handbook says.
#include <QFile>
#include <QFileInfo>
#include <QRegularExpression>
#include <QTest>

#include <cmath>

#include "engine/integrator/galerkin_step.hpp"
#include "engine/family/scheme.hpp"
#include "engine/figure/recipe.hpp"
#include "tests/examples/boole.cpp"
#include "tests/examples/damped_euler.cpp"
#include "tests/examples/galerkin_fine.cpp"
#include "tests/examples/line/family.cpp"
#include "tests/examples/quartic_oscillator.cpp"
#include "tests/examples/trigonometric.cpp"
#include "tests/examples/virial.cpp"
#include "tests/examples/virial_view.cpp"
#include "tests/tools/test.hpp"

namespace extremal::examples_test {

namespace {

System quartic() {
    return systems::quartic_oscillator().make({"quartic-oscillator", {{"m", 1}, {"c", 1}}, {}});
}

System harmonic() {
    return findModel("harmonic-oscillator")->make({"harmonic-oscillator", {{"m", 1}, {"k", 1}}, {}});
}

State integrate(const System& system, const Discretization& discretization, State state, double step,
                int steps) {
    const auto integrator = makeIntegrator(system, discretization, Clock{0, step});
    for (int i = 0; i < steps; ++i)
        if (advance(*integrator, state).outcome != Outcome::converged) return {};
    return state;
}

QString fileText(const QString& path) {
    QFile file(QStringLiteral(EXTREMAL_SOURCE_DIR "/") + path);
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

}  // namespace

class ExamplesTest : public QObject {
    Q_OBJECT

private slots:
    void systemIsIntegratedWithItsEnergyBounded() {
        const System system = quartic();
        const Mechanics<double>& m = system.mechanics();
        State state{0, 0, {1, 0}};
        const double start = m.energy(m.model.get(), 0, &state.x[0], &state.x[1]);
        QCOMPARE(start, 0.25);
        state = integrate(system, *namedScheme("galerkin-gauss-2"), state, 0.1, 1000);
        QCOMPARE(state.x.size(), std::size_t{2});
        const double change = m.energy(m.model.get(), state.t, &state.x[0], &state.x[1]) - start;
        QVERIFY2(std::abs(change) < 1e-5, qPrintable(QString::number(change)));
    }

    void spaceFittedToTheFrequencyIsExact() {
        // The exact motion cos t lies in the space, so the step finds it, here with four fifths of a period
        // each.
        const double step = 5;
        const SpaceEntry entry = spaces::trigonometric();
        const Rule<double> rule = gauss<double>(24);
        const Table<double> table = makeTable(entry.make({"trigonometric", {{"z", step}}, {}}), rule);
        GalerkinStep<double, 1> integrator(harmonic().mechanics(), table, step, {});
        double q = 1, p = 0;
        for (int i = 0; i < 20; ++i)
            QVERIFY(integrator.advance(i * step, &q, &p, {}).outcome == Outcome::converged);
        QVERIFY2(std::hypot(q - std::cos(20 * step), p + std::sin(20 * step)) < 1e-11,
                 qPrintable(QString::number(q)));
    }

    void ruleHasTheDegreeItClaims() {
        const RuleEntry entry = rules::boole();
        for (const int panels : {1, 3}) {
            const Settings settings = {"boole", {{"panels", panels}}, {}};
            const auto rule = makeRule<boost::multiprecision::float128>(entry, settings);
            QCOMPARE(rule.degree, 5);
            QCOMPARE(makeRule<double>(entry, settings).size(), rule.size());
            for (int degree = 0; degree <= 6; ++degree) {
                boost::multiprecision::float128 sum = 0;
                for (std::size_t i = 0; i < rule.c.size(); ++i) sum += rule.b[i] * pow(rule.c[i], degree);
                const double error = static_cast<double>(abs(sum * (degree + 1) - 1));
                QVERIFY2(degree == 6 ? error > 1e-6 : error < 1e-30, qPrintable(QString::number(error)));
            }
        }
    }

    void ruleMakesASchemeWithAnySpace() {
        // Polynomials of degree 2 have order 4, and the rule of degree 5 keeps it.
        const Rule<double> rule = makeRule<double>(rules::boole(), {"boole", {{"panels", 1}}, {}});
        const Table<double> table =
            makeTable(makeSpace({"polynomial", {{"degree", 2}, {"basis", "lobatto"}}, {}}), rule);
        const System system = quartic();
        const auto end = [&](int n) {
            GalerkinStep<double, 1> integrator(system.mechanics(), table, 3.0 / n, {});
            double q = 1, p = 0;
            for (int i = 0; i < n; ++i)
                if (integrator.advance(i * 3.0 / n, &q, &p, {}).outcome != Outcome::converged) return 0.0;
            return q;
        };
        const double finest = end(1280), order = std::log2((end(40) - finest) / (end(80) - finest));
        QVERIFY2(std::abs(order - 4) < 0.1, qPrintable(QString::number(order)));
    }

    void schemeClaimsAndHasTheOrderOfItsDegree() {
        const Discretization discretization = schemes::galerkin_fine().make(2);
        QCOMPARE(describe(discretization.space, discretization.quadrature).claims.order, 4);
        const System system = quartic();
        const auto end = [&](int n) {
            return integrate(system, discretization, {0, 0, {1, 0}}, 3.0 / n, n).x;
        };
        const auto finest = end(1280), coarse = end(40), fine = end(80);
        for (std::size_t i = 0; i < 2; ++i) {
            const double order = std::log2(std::abs(coarse[i] - finest[i]) / std::abs(fine[i] - finest[i]));
            QVERIFY2(std::abs(order - 4) < 0.1,
                     qPrintable(QString::number(order)));  // measured: 3.995 for q, 3.999 for p
        }
    }

    void familyHasTheOrderAndTheStructureItClaims() {
        const Family family = family::line();
        const System system = quartic();
        QVERIFY(appliesTo(family, system));
        const Discretization made = family.choices(system).cells.front().discretization;
        const Properties known = family.describe(made);
        const auto end = [&](int n, std::vector<double> x) {
            const auto integrator = family.make(system, made, 3.0 / n);
            State state{0, 0, std::move(x), {}};
            for (int i = 0; i < n; ++i)
                if (advance(*integrator, state).outcome != Outcome::converged) return std::vector<double>();
            return state.x;
        };
        const auto finest = end(327680, {1, 0.3}), coarse = end(2560, {1, 0.3}), fine = end(5120, {1, 0.3});
        for (std::size_t i = 0; i < 2; ++i) {
            const double order = std::log2(std::abs(coarse[i] - finest[i]) / std::abs(fine[i] - finest[i]));
            QVERIFY2(std::abs(order - known.claims.order) < 0.1,
                     qPrintable(QString::number(order)));  // measured: 1.05 for q, 1.05 for p
        }
        // The determinant of the map of the plane, by central differences.
        const double delta = 1e-5;
        const auto right = end(30, {1 + delta, 0.3}), left = end(30, {1 - delta, 0.3}),
                   up = end(30, {1, 0.3 + delta}), down = end(30, {1, 0.3 - delta});
        const double area =
            ((right[0] - left[0]) * (up[1] - down[1]) - (right[1] - left[1]) * (up[0] - down[0])) /
            (4 * delta * delta);
        QVERIFY2(known.claims.isSymplectic && std::abs(area - 1) < 1e-8,
                 qPrintable(QString::number(area - 1)));
    }

    /// A part is refused by whoever does not name it, with its title as the reason.
    void partIsTakenByThoseAloneWhoSaySo() {
        System system = harmonic();
        const BaselineEntry own = baselines::damped_euler();
        QVERIFY(appliesTo(own, system));
        system.parts.set(Drag{0.5});
        QVERIFY(appliesTo(own, system));
        for (const Family& family : families()) QVERIFY2(!appliesTo(family, system), family.item.id.c_str());
        for (const BaselineEntry& entry : baselineCatalog())
            QVERIFY2(!appliesTo(entry, system), entry.item.id.c_str());
        QCOMPARE(mismatch(*namedScheme("galerkin-gauss-2"), system),
                 std::string("polynomial needs a problem without a drag, which harmonic-oscillator is not"));
    }

    void baselineSlowsDownWithThePartThatItTakes() {
        System system = harmonic();
        constexpr double c = 0.5, T = 2;
        system.parts.set(Drag{c});
        const auto error = [&](int n) {
            const auto integrator = baselines::damped_euler().make(system, {T / n, {}, 0, {}});
            State state{0, 0, {1, 0}, {}};
            for (int i = 0; i < n; ++i)
                if (advance(*integrator, state).outcome != Outcome::converged) return 0.0;
            // x'' + c x' + x = 0 from x = 1 at rest
            const double w = std::sqrt(1 - c * c / 4);
            const double exact = std::exp(-c * T / 2) * (std::cos(w * T) + c / (2 * w) * std::sin(w * T));
            return std::abs(state.x[0] - exact);
        };
        const double order = std::log2(error(1000) / error(2000));
        QVERIFY2(std::abs(order - 1) < 0.02 && error(2000) < 1e-3,
                 qPrintable(QString::number(order) + ", " + QString::number(error(2000))));
    }

    void observableIsComputedAtANode() {
        const System system = quartic();
        const State start{0, 0, {1, 4}}, state{0, 0, {3, -2}};
        const Observer observer = observables::virial().bind({system, start, {}});
        QCOMPARE(observer.columns.size(), std::size_t{2});
        QCOMPARE(observer.columns[static_cast<std::size_t>(observer.extreme)].name,
                 std::string("virial_change"));
        double values[2] = {0, 0};
        observer.evaluate(state, {}, values);
        QCOMPARE(values[0], -6.0);
        QCOMPARE(values[1], -10.0);
    }

    void viewIsDrawnOfItsColumn() {
        auto scheme = std::make_shared<SchemeResult>();
        scheme->spec.label = "Gauss";
        scheme->trajectory.columns = {{"t", "t", "", {0, 1, 2}, {}}, {"virial", "q·p", "", {1, 3, 2}, {}}};
        Comparison comparison;
        comparison.scene.observe = {"virial"};
        comparison.schemes = {scheme};
        const View view{"virial", "", ""};
        const ViewEntry entry = views::virial();
        const Figure figure = draw({comparison, view, nullptr, entry});
        QCOMPARE(figure.title, std::string("Virial"));
        QCOMPARE(figure.y.title, std::string("q·p"));
        QCOMPARE(figure.series().at(0).y, (std::vector<double>{1, 3, 2}));
    }

    void handbookShowsTheseFiles() {
        const QString page = fileText("resources/handbook/extending.md");
        for (const char* name :
             {"quartic_oscillator.cpp", "drag.hpp", "damped_euler.cpp", "trigonometric.cpp", "boole.cpp",
              "galerkin_fine.cpp", "virial.cpp", "virial_view.cpp", "line/family.cpp"}) {
            QString code = fileText(QStringLiteral("tests/examples/%1").arg(name));
            QVERIFY(code.startsWith("// SPDX"));
            code.remove(0, code.indexOf('\n') + 1);
            QVERIFY2(page.contains("```cpp\n" + code + "```"), name);
        }
    }

    /// Each row of the table that says how many files an addition touches names so many: new ones by a
    /// pattern of their folder, and others that exist.
    void handbookCountsTheFilesOfAnAddition() {
        const QString page = fileText("resources/handbook/extending.md");
        const QStringList rows =
            page.section("| what | files | new | changed |", 1, 1).section("\n\n", 0, 0).split('\n');
        QStringList found;
        for (const QString& row : rows) {
            const QStringList cells = row.split('|');
            if (cells.size() < 5 || cells[1].contains("---")) continue;
            static const QRegularExpression quoted("`([^`]+)`");
            const auto filesIn = [](const QString& cell) {
                QStringList files;
                for (auto each = quoted.globalMatch(cell); each.hasNext();) files << each.next().captured(1);
                return files;
            };
            const QStringList added = filesIn(cells[3]), changed = filesIn(cells[4]);
            found << cells[1].trimmed();
            QVERIFY2(cells[2].trimmed().toInt() == added.size() + changed.size(), qPrintable(row));
            for (const QString& file : added) {
                const QString folder = file.section("/<", 0, 0);
                QVERIFY2(QFileInfo(QStringLiteral(EXTREMAL_SOURCE_DIR "/") + folder).isDir(),
                         qPrintable(file));
            }
            for (const QString& file : changed) QVERIFY2(!fileText(file).isEmpty(), qPrintable(file));
        }
        QCOMPARE(found, (QStringList{"system", "part", "space", "rule", "scheme", "family", "baseline",
                                     "observable", "view"}));
    }
};

EXTREMAL_TEST(ExamplesTest)
}  // namespace extremal::examples_test

#include "examples_test.moc"
