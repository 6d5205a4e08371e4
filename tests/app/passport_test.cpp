// SPDX-License-Identifier: GPL-3.0-or-later
/// Passports and exported programs: pages of every kind, and programs that compile, run and agree with the
/// CSV of the run.
#include <QDir>
#include <QFile>
#include <QProcess>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/model/typed/typed_mechanics.hpp"
#include "engine/passport/passport.hpp"
#include "engine/passport/scene_formula.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/app/program.hpp"
#include "tests/tools/test.hpp"

namespace extremal::passport_test {
namespace {

using tests::contentOf;
using tests::runProgram;

struct Said {
    int code = -1;
    QString text;
};
Said run(const QString& program, const QStringList& arguments) {
    QProcess process;
    process.setProcessChannelMode(QProcess::MergedChannels);
    process.start(program, arguments);
    if (!process.waitForFinished(tests::limit(120000))) return {};
    return {process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -2,
            QString::fromUtf8(process.readAll())};
}

/// Weights of p that are not those of q, which no scheme of the catalogue has.
constexpr const char* ownTables =
    R"~({"baseline": {"type": "runge-kutta", "a": [[0.25, 0], [0.5, 0.25]], "b": [0.25, 0.75], )~"
    R"~("a_hat": [[0.25, 0.1], [0.5, 0.25]], "b_hat": [0.625, 0.375]}, "step": 0.05})~";
constexpr const char* ownExplicitTables =
    R"~({"baseline": {"type": "runge-kutta", "a": [[], [0.5]], "b": [0.25, 0.75], )~"
    R"~("a_hat": [[0.25], [0.5]], "b_hat": [0.625, 0.375]}, "step": 0.05})~";

}  // namespace

class PassportTest : public QObject {
    Q_OBJECT private slots : void everySchemeOfEveryPresetHasAPage() {
        for (const Preset& preset : presets()) {
            const ReadScene read = readScene(preset.json);
            if (!read.resolved || preset.json.size() > 20000) continue;
            for (std::size_t i = 0; i < read.resolved->schemes.size(); ++i) {
                const Document page = passportOf(*read.resolved, i, {.isMeasured = false});
                const std::string where = std::string(preset.id) + " " + page.title;
                QVERIFY2(written(page, PageFormat::markdown).size() > 300, where.c_str());
                QVERIFY2(written(page, PageFormat::html).ends_with("</html>\n"), where.c_str());
                // Of what pdflatex does not know nothing is left: letters of Latin-1 alone.
                for (const QChar c : QString::fromStdString(written(page, PageFormat::latex)))
                    QVERIFY2(c.unicode() < 0x180, qPrintable(QString::fromStdString(where) + ": U+" +
                                                             QString::number(c.unicode(), 16)));
            }
        }
    }

    void aPassportSaysWhatIsKnown() {
        const tests::Answer answer =
            runProgram({"passport", "preset:pendulum", "--set",
                        R"~(/schemes/-={"label": "G2", "scheme": "galerkin-gauss-2", "step": 0.1})~", "--set",
                        "/time/end=2", "--scheme", "G2"});
        QCOMPARE(answer.code, 0);
        for (const char* line :
             {"# G2", "S(q\\_0, q\\_1)", "A[1,2] = -0.038675134594812882254574390251", "b[1] = 1/2",
              "| f'(f'(f'(f))) | 4 | 1/24 |", "R(z) = (1 + 1/2 z + 1/12 z^2) / (1 − 1/2 z + 1/12 z^2)",
              "stable for every step", "Measured order: 4"})
            if (QString(line).startsWith("S("))
                QVERIFY2(answer.out.contains("S(q_0, q_1) = h Σ_i b_i L(t_0 + c_i h, Q_i, V_i)"), line);
            else
                QVERIFY2(answer.out.contains(line), qPrintable(line + QString("\n") + answer.out));
        const tests::Answer wave = runProgram({"passport", "preset:coherent-state", "--no-measure"});
        QCOMPARE(wave.code, 0);
        QVERIFY2(wave.out.contains("Runge-Kutta tableaus are for systems with coordinates"),
                 qPrintable(wave.out));
        const tests::Answer unknown = runProgram({"passport", "preset:pendulum", "--scheme", "nothing"});
        QCOMPARE(unknown.code, 2);
        QVERIFY2(unknown.err.contains("there is no scheme \"nothing\""), qPrintable(unknown.err));
    }

    /// Their formulas are the models: derivatives agree at states away from symmetry.
    void builtInModelsSayTheirLagrangian() {
        int found = 0;
        for (const std::string& id : modelsWithFormula()) {
            const ModelEntry& entry = *findModel(id);
            ResolvedScene scene;
            scene.scene.model.type = id;
            for (const FieldInfo& f : entry.item.parameters) {
                Value value = f.firstValue();
                if (value.isNumber()) value = 1.25 * value.asNumber();
                scene.scene.model.keys.emplace_back(f.key, value);
            }
            scene.system = std::make_shared<const System>(entry.make(scene.scene.model));
            const Mechanics<double> typed = typed::makeMechanics(*formulaOf(scene)).mechanics;
            const Mechanics<double>& own = scene.system->mechanics();
            const auto d = static_cast<std::size_t>(own.dimension);
            std::vector<double> q(d), v(d), a(2 * d), b(2 * d), A(4 * d * d), B(4 * d * d);
            for (std::size_t i = 0; i < d; ++i) {
                q[i] = 0.3 + 0.2 * static_cast<double>(i);
                v[i] = 0.7 - 0.4 * static_cast<double>(i);
            }
            double L = 0, M = 0;
            typed.jet(typed.model.get(), 0, q.data(), v.data(), &L, a.data(), A.data());
            own.jet(own.model.get(), 0, q.data(), v.data(), &M, b.data(), B.data());
            QVERIFY2(std::abs(L - M) <= 1e-13 * std::abs(L), id.c_str());
            for (std::size_t i = 0; i < 2 * d; ++i)
                QVERIFY2(std::abs(a[i] - b[i]) <= 1e-12 * (1 + std::abs(a[i])), id.c_str());
            for (std::size_t i = 0; i < 4 * d * d; ++i)
                QVERIFY2(std::abs(A[i] - B[i]) <= 1e-12 * (1 + std::abs(A[i])), id.c_str());
            ++found;
        }
        QVERIFY(found >= 8);
    }

    void programsAgreeWithTheRun_data() {
        QTest::addColumn<QString>("preset");
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<QString>("end");
        // Galerkin of two degrees, explicit, a typed Lagrangian, and schemes of the user's.
        QTest::newRow("pendulum, Gauss 2") << "pendulum"
                                           << R"~({"scheme": "galerkin-gauss-2", "step": 0.1})~"
                                           << "5";
        QTest::newRow("kepler, Lobatto 3") << "kepler"
                                           << R"~({"scheme": "galerkin-lobatto-3", "step": 0.1})~"
                                           << "5";
        QTest::newRow("kepler, splitting") << "kepler"
                                           << R"~({"baseline": "blanes-moan-s6", "step": 0.05})~"
                                           << "5";
        QTest::newRow("henon-heiles, Verlet") << "henon-heiles"
                                              << R"~({"scheme": "stormer-verlet-pair", "step": 0.05})~"
                                              << "5";
        QTest::newRow("double pendulum, spline")
            << "double-pendulum"
            << R"~({"space": {"type": "spline", "degree": 2, "cells": 2}, "quadrature": "gauss", "step": 0.05})~"
            << "1";
        QTest::newRow("spring pendulum, Gauss collocation")
            << "spring-pendulum"
            << R"~({"baseline": {"type": "gauss-collocation", "stages": 3}, "step": 0.001})~"
            << "0.1";
        QTest::newRow("harmonic oscillator, RK4") << "harmonic-oscillator"
                                                  << R"~({"baseline": "rk4", "step": 0.05})~"
                                                  << "5";
        QTest::newRow("pendulum, own explicit tables") << "pendulum" << ownExplicitTables << "3";
        QTest::newRow("kepler, own implicit tables") << "kepler" << ownTables << "2";
        QTest::newRow("duffing, composition")
            << "duffing"
            << R"~({"scheme": "midpoint", "step": 0.05, "composition": {"type": "suzuki"}})~"
            << "2";
        QTest::newRow("chain, midpoint") << "fput-chain"
                                         << R"~({"scheme": "midpoint", "step": 0.01})~"
                                         << "1";
        QTest::newRow("charged particle, Gauss 2") << "charged-particle"
                                                   << R"~({"scheme": "galerkin-gauss-2", "step": 0.05})~"
                                                   << "2";
        QTest::newRow("oscillator, fitted functions")
            << "harmonic-oscillator"
            << R"~({"space": {"type": "typed", "functions": [1, "tau", "cos(h*tau)", "sin(h*tau)"]}, "step": 0.2})~"
            << "5";
        // What is written in its own way in each language; the branch that is not taken is out of its domain.
        const auto functions = [](const char* potential) {
            return QString(
                       "double-well\n/views=[\"energy\"]\n/observe=[\"energy\"]\n"
                       R"~(/initial={"q":[0.5,1.2],"v":[0.3,-0.4]})~"
                       "\n"
                       R"~(/model={"type":"lagrangian","coordinates":["x","y"],"parameters":{"k":2},)~"
                       R"~("lagrangian":"x_t^2/2+y_t^2/2-(x^2+y^2)/2-(%1)"})~")
                .arg(potential);
        };
        for (const char* potential :
             {"if(x>-1.9,k*x*x*log(x+2)/4,sqrt(-1.9-x))+max(x-0.1,0)^3/9-min(y,7,0)^3/9",
              "piecewise(t<-1,sqrt(-x),t>=1,acosh(x+3),t==7,log(-9-y^2),x*y/4)+(t!=2 && t<1.5 || t>=2.5)*x/9",
              "erf(x)*erfc(y)+asinh(x*y)+atanh(x/9)/7+log10(x+9)+hypot(x,y-9)/9+pow(x+9,y/9)/99",
              "x*(floor(9*t)+ceil(5*t)+round(3*t)+heaviside(t-1)+sign(t-2)+mod(t,0.7))/20",
              "x*table(t;-1,1;0.25,-2;1.5,3)/9-y*spline(x;-2,1;-0.5,-2;0.5,2;1,0)/9+spline(y;0,0;1,1e-3)"})
            QTest::newRow(potential) << functions(potential)
                                     << R"~({"scheme": "galerkin-gauss-2", "step": 0.0625})~"
                                     << "3";
        // More points than brackets that Python nests.
        QString points;
        for (int k = 0; k < 400; ++k) points += QString(";%1,%2").arg(0.01 * k - 0.5).arg(k % 7);
        QTest::newRow("a long table")
            << functions(qPrintable("x*table(t" + points + ")/9+y*spline(x" +
                                    points.left(2000).section(';', 0, -2) + ")/1e6"))
            << R"~({"scheme": "galerkin-gauss-2", "step": 0.0625})~"
            << "3";
    }
    void programsAgreeWithTheRun() {
        QFETCH(QString, preset);
        QFETCH(QString, scheme);
        QFETCH(QString, end);
        QTemporaryDir folder;
        const QString own = scheme.chopped(1) + R"~(, "label": "own"})~";
        // Behind the name of the preset, one in a line, what is set in it.
        QStringList sets = preset.split('\n');
        QStringList scene{"preset:" + sets.takeFirst()};
        for (const QString& each : sets) scene << "--set" << each;
        scene << "--set"
              << "/schemes/-=" + own << "--set"
              << "/time/end=" + end;
        const tests::Answer ran =
            runProgram(QStringList{"run"} + scene + QStringList{"--out", folder.filePath("run")});
        QVERIFY2(ran.code == 0, qPrintable(ran.err));
        const QString csv = folder.filePath("run/own.csv");
        for (const QString& file : {folder.filePath("own.cpp"), folder.filePath("own.py")}) {
            const tests::Answer made =
                runProgram(QStringList{"program"} + scene + QStringList{"--scheme", "own", "--out", file});
            QVERIFY2(made.code == 0, qPrintable(made.err));
            Said said;
            if (file.endsWith(".cpp")) {
                said =
                    run("g++", {"-O1", "-std=c++17", "-Wall", "-Werror", "-o", folder.filePath("own"), file});
                QVERIFY2(said.code == 0, qPrintable(said.text));
                said = run(folder.filePath("own"), {csv});
            } else {
                said = run(QStringLiteral(EXTREMAL_PYTHON), {file, csv});
            }
            qInfo("%s: %s", qPrintable(QFileInfo(file).suffix()), qPrintable(said.text.trimmed()));
            QVERIFY2(said.code == 0, qPrintable(said.text));
        }
        // The test of the program can fail: another state is found out.
        QFile rows(csv);
        QVERIFY(rows.open(QIODevice::ReadOnly));
        QList<QByteArray> lines = rows.readAll().split('\n');
        rows.close();
        QList<QByteArray> cells = lines[5].split(',');
        cells[1] = QByteArray::number(cells[1].toDouble() + 1e-9, 'g', 17);
        lines[5] = cells.join(',');
        QVERIFY(rows.open(QIODevice::WriteOnly));
        rows.write(lines.join('\n'));
        rows.close();
        QCOMPARE(run(folder.filePath("own"), {csv}).code, 1);
        QCOMPARE(run(QStringLiteral(EXTREMAL_PYTHON), {folder.filePath("own.py"), csv}).code, 1);
    }

    /// The derivative that a program computes by itself is that of `extremal gradient`, of all columns at
    /// once: of a sum of them with different weights.
    void programsHaveTheDerivativeOfTheRun_data() {
        QTest::addColumn<QString>("preset");
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<QString>("with");
        QTest::addColumn<QString>("end");
        const auto row = [](const char* name, const char* preset, const char* scheme, const char* with,
                            const char* end) { QTest::newRow(name) << preset << scheme << with << end; };
        row("Gauss 2", "pendulum", R"~({"scheme": "galerkin-gauss-2", "step": 0.1})~",
            "/model/l,/model/g,/model/m,/initial/q/0", "5");
        row("Lobatto 3, initial values alone", "kepler", R"~({"scheme": "galerkin-lobatto-3", "step": 0.1})~",
            "/initial/q/0,/initial/q/1", "3");
        row("Verlet", "henon-heiles", R"~({"scheme": "stormer-verlet-pair", "step": 0.05})~",
            "/model/lambda,/initial/q/0", "3");
        row("collocation", "spring-pendulum",
            R"~({"baseline": {"type": "gauss-collocation", "stages": 3}, "step": 0.001})~",
            "/model/k,/model/l,/model/g,/initial/q/1", "0.1");
        row("own tables", "pendulum", ownTables, "/model/l,/model/g,/initial/q/0", "2");
        row("own explicit tables", "pendulum", ownExplicitTables, "/model/l,/model/g,/initial/q/0", "2");
        row("RK4", "harmonic-oscillator", R"~({"baseline": "rk4", "step": 0.05})~",
            "/model/k,/model/m,/initial/q/0", "3");
        row("a composition", "duffing",
            R"~({"scheme": "midpoint", "step": 0.05, "composition": {"type": "suzuki"}})~",
            "/model/parameters/c,/model/parameters/k,/initial/q/0", "2");
        row("driven, with explicit time", "forced-pendulum",
            R"~({"scheme": "galerkin-gauss-2", "step": 0.05})~",
            "/model/parameters/F,/model/parameters/g,/initial/q/0,/initial/v/0", "2");
    }
    void programsHaveTheDerivativeOfTheRun() {
        QFETCH(QString, preset);
        QFETCH(QString, scheme);
        QFETCH(QString, with);
        QFETCH(QString, end);
        QTemporaryDir folder;
        const QStringList scene{"preset:" + preset, "--set",
                                "/schemes/-=" + scheme.chopped(1) + R"~(, "label": "own"})~", "--set",
                                "/time/end=" + end};
        QStringList columns;
        QList<QList<double>> byLanguage;
        for (const QString& file : {folder.filePath("own.cpp"), folder.filePath("own.py")}) {
            const tests::Answer made =
                runProgram(QStringList{"program"} + scene +
                           QStringList{"--scheme", "own", "--with", with, "--out", file});
            QVERIFY2(made.code == 0, qPrintable(made.err));
            Said said;
            if (file.endsWith(".cpp")) {
                said =
                    run("g++", {"-O1", "-std=c++17", "-Wall", "-Werror", "-o", folder.filePath("own"), file});
                QVERIFY2(said.code == 0, qPrintable(said.text));
                said = run(folder.filePath("own"), {"--derivative"});
            } else {
                said = run(QStringLiteral(EXTREMAL_PYTHON), {file, "--derivative"});
            }
            QVERIFY2(said.code == 0, qPrintable(said.text));
            QStringList lines = said.text.trimmed().split('\n');
            QCOMPARE(lines.takeFirst().count(','), with.count(',') + 1);
            columns.clear();
            // The sum of all columns with the weights 0.3, 0.55, ...
            QList<double> sums(with.count(',') + 1, 0.0);
            for (const QString& line : lines) {
                const QStringList cells = line.split(',');
                const double weight = 0.3 + 0.25 * static_cast<double>(columns.size());
                columns << cells[0];
                for (qsizetype i = 0; i < sums.size(); ++i) sums[i] += weight * cells[i + 1].toDouble();
            }
            byLanguage << sums;
        }
        QString of;
        for (qsizetype i = 0; i < columns.size(); ++i) {
            const QString name = columns[i].startsWith("q.") ? columns[i].mid(2) : "p_" + columns[i].mid(2);
            of += (i > 0 ? "+" : "") + QString::number(0.3 + 0.25 * static_cast<double>(i)) + "*" + name;
        }
        const tests::Answer gradient = runProgram(
            QStringList{"gradient"} + scene +
            QStringList{"--scheme", "own", "--of", of, "--with", with, "--out", folder.filePath("g")});
        QVERIFY2(gradient.code == 0, qPrintable(gradient.err));
        QFile table(folder.filePath("g/gradient.csv"));
        QVERIFY(table.open(QIODevice::ReadOnly));
        const QList<QByteArray> rows = table.readAll().trimmed().split('\n');
        for (qsizetype i = 0; i < byLanguage[0].size(); ++i) {
            const double exact = rows[i + 1].split(',').back().toDouble();
            for (const QList<double>& sums : byLanguage) {
                const double off = std::abs(sums[i] - exact), size = std::max(1.0, std::abs(exact));
                qInfo("%s: %.15g, off by %.1e", rows[i + 1].split(',')[0].constData(), exact, off);
                QVERIFY(off <= 1e-12 * size);
            }
        }
    }
    void derivativesThatCannotBeSayWhy() {
        QTemporaryDir folder;
        const QString file = folder.filePath("x.py");
        const auto said = [&](const QStringList& more) {
            const tests::Answer made =
                runProgram(QStringList{"program", "preset:pendulum", "--out", file} + more);
            return made.code == 2 ? made.err : QString("code %1").arg(made.code);
        };
        QVERIFY(said({"--with", "/model/nonsense"}).contains("/model/nonsense is not a number"));
        QVERIFY(said({"--with", "/time/end"}).contains("--with"));
        QVERIFY(!QFile::exists(file));
    }

    void whatCannotBeTakenAlongSaysWhy() {
        QTemporaryDir folder;
        const QString file = folder.filePath("x.py");
        const tests::Answer wave = runProgram({"program", "preset:coherent-state", "--out", file});
        QCOMPARE(wave.code, 2);
        QVERIFY2(wave.err.contains("does not say its Lagrangian as a formula"), qPrintable(wave.err));
        const tests::Answer adaptive =
            runProgram({"program", "preset:kepler", "--set",
                        R"~(/schemes/-={"label": "dp", "baseline": "dopri5", "tolerance": 1e-9})~",
                        "--scheme", "dp", "--out", file});
        QCOMPARE(adaptive.code, 2);
        QVERIFY2(adaptive.err.contains("not all of one length"), qPrintable(adaptive.err));
        QVERIFY(!QFile::exists(file));
    }
};

EXTREMAL_TEST(PassportTest)

}  // namespace extremal::passport_test

#include "passport_test.moc"
