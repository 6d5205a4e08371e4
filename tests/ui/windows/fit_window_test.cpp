// SPDX-License-Identifier: GPL-3.0-or-later
/// From a CSV of measurements that is dropped on the window to numbers with deviations: a damped pendulum,
/// computed here by the classical Runge-Kutta method, with noise, and called so in its file and its picture.
/// Pictures of the way are in tests/output/fit of the build folder.
#include <QDir>
#include <QDropEvent>
#include <QElapsedTimer>
#include <QLabel>
#include <QMimeData>
#include <QPushButton>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>
#include <QUrl>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/notices.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/windows/fit_window.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::fit_window_test {
namespace {

constexpr double trueLength = 0.8, trueDamping = 0.15, noise = 0.01;

const char* const scene = R"json({"extremal": 1, "title": "A damped pendulum", "model": {"type": "lagrangian",
    "coordinates": ["theta"], "parameters": {"l": 0.9, "c": 0.1, "g": 9.81},
    "lagrangian": "l^2*theta_t^2/2+g*l*cos(theta)", "forces": {"theta": "-c*l^2*theta_t"}},
    "initial": {"q": [1.2], "p": [0]}, "time": {"end": 10},
    "schemes": [{"label": "Gauss 3", "step": 0.1, "scheme": "galerkin-gauss-3"}],
    "reference": "none", "observe": ["energy"], "views": [{"view": "trajectory", "y": "q.theta"}]})json";

/// theta'' = -g/l sin theta - c theta'.
std::string syntheticCsv() {
    std::mt19937 random(1);
    std::normal_distribution<double> error(0, noise);
    const auto f = [](double x, double v) { return -9.81 / trueLength * std::sin(x) - trueDamping * v; };
    std::string csv =
        "# synthetic: classical Runge-Kutta method, length 0.8, damping 0.15, noise of 0.01 rad\nt,theta\n";
    double x = 1.2, v = 0;
    constexpr double h = 1e-3;
    for (int k = 1; k <= 9600; ++k) {
        const double a1 = f(x, v), v2 = v + h / 2 * a1, a2 = f(x + h / 2 * v, v2), v3 = v + h / 2 * a2,
                     a3 = f(x + h / 2 * v2, v3), v4 = v + h * a3, a4 = f(x + h * v3, v4);
        x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
        v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        if (k % 80 == 0) csv += std::to_string(k * h) + "," + std::to_string(x + error(random)) + "\n";
    }
    return csv;
}

struct Window : MainWindow {
    QTemporaryDir folder;
    Window() : MainWindow(Theme::light(), false) {
        resize(1500, 950);
        show();
        workspace().adopt(toValue(readScene(std::string(scene)).scene));
        if (!waitForResults(*this)) qFatal("no results");
    }
    QString fileOf(const QString& name, const std::string& text) {
        QFile file(folder.filePath(name));
        if (!file.open(QIODevice::WriteOnly)) qFatal("no file");
        file.write(text.data(), static_cast<qint64>(text.size()));
        return file.fileName();
    }
    void drop(const QString& path) {
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(path)});
        const QPoint at = compareView().geometry().center();
        QDragEnterEvent enter(at, Qt::CopyAction, &data, Qt::LeftButton, {});
        QCoreApplication::sendEvent(this, &enter);
        QDropEvent event(at, Qt::CopyAction, &data, Qt::LeftButton, {});
        QCoreApplication::sendEvent(this, &event);
    }
    FitWindow* fit() { return findChild<FitWindow*>(); }
    QTableWidget* numbers() { return fit()->findChild<QTableWidget*>("fitNumbers"); }
    QPushButton* start() { return fit()->findChild<QPushButton*>("fitStart"); }
    QString state() { return fit()->findChild<QLabel*>("fitState")->text(); }
    int rowOf(const QString& name) {
        for (int row = 0; row < numbers()->rowCount(); ++row)
            if (numbers()->item(row, 0)->text() == name) return row;
        return -1;
    }
    void tick(const QString& name) {
        QVERIFY2(rowOf(name) >= 0, qPrintable(name));
        numbers()->item(rowOf(name), 0)->setCheckState(Qt::Checked);
    }
    double parameter(const char* name) {
        return workspace().document().find("model")->find("parameters")->find(name)->asNumber();
    }
    const Notice* notice() {
        const auto& all = notices().all();
        const auto found =
            std::find_if(all.begin(), all.end(), [](const Notice& each) { return each.key == "fit"; });
        return found == all.end() ? nullptr : &*found;
    }
    void picture(const char* name, QWidget* of) {
        const QString place = QStringLiteral(EXTREMAL_TEST_OUTPUT "/fit");
        QDir().mkpath(place);
        QTest::qWait(200);  // plots are drawn by the event loop
        QVERIFY(of->grab().save(QDir(place).filePath(name)));
    }
};

}  // namespace

class FitWindowTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void aFileThatIsDroppedGivesLengthAndDamping() {
        Window window;
        QElapsedTimer clock;
        clock.start();
        window.drop(window.fileOf("synthetic-pendulum.csv", syntheticCsv()));
        QVERIFY(window.fit() && window.fit()->isVisible());
        QVERIFY(!window.start()->isEnabled());
        window.picture("1-dropped.png", window.fit());
        window.tick("l");
        window.tick("c");
        QVERIFY(window.start()->isEnabled());
        window.start()->click();
        QVERIFY(window.fit()->isRunning());
        QVERIFY(QTest::qWaitFor([&] { return !window.fit()->isRunning(); }, 60000));
        QVERIFY2(window.state().startsWith("Gauss 3: sum of squares"), qPrintable(window.state()));
        const double seconds = 1e-3 * static_cast<double>(clock.elapsed());
        // What the scene has now, as one edit.
        const double l = window.parameter("l"), c = window.parameter("c");
        qInfo("l = %.6f, c = %.6f after %.1f s; %s", l, c, seconds, qPrintable(window.notice()->text));
        const auto deviation = [&](const char* name) {
            return window.numbers()->item(window.rowOf(name), 3)->text().mid(2).toDouble();
        };
        QVERIFY(deviation("l") > 1e-5 && deviation("l") < 5e-3);
        QVERIFY(deviation("c") > 1e-4 && deviation("c") < 2e-2);
        QVERIFY(std::abs(l - trueLength) < 4 * deviation("l"));
        QVERIFY(std::abs(c - trueDamping) < 4 * deviation("c"));
        QVERIFY(seconds < 60);
        QVERIFY(window.notice()->text.startsWith("Fitted to synthetic-pendulum.csv: c = "));
        QVERIFY(window.notice()->text.contains("±"));
        QVERIFY(window.notice()->hint.contains("Correlations"));
        // What was measured with what is computed, and residuals of the size of the noise.
        QCOMPARE(window.fit()->plots().size(), std::size_t(2));
        const Figure& residuals = window.fit()->plots().back()->figure();
        QVERIFY(residuals.subtitle.find("synthetic: classical Runge-Kutta method") != std::string::npos);
        double squares = 0;
        for (const double r : residuals.series().front().y) squares += r * r;
        QVERIFY(std::abs(squares / 120 - 1) < 0.1);
        QVERIFY(waitForResults(window));
        window.picture("2-fitted.png", window.fit());
        window.picture("3-scene.png", &window);
        window.workspace().undo();
        QCOMPARE(window.parameter("l"), 0.9);
        QCOMPARE(window.parameter("c"), 0.1);
    }
    void escStopsItAndTheSceneStaysAsItWas() {
        Window window;
        window.drop(window.fileOf("m.csv", syntheticCsv()));
        window.tick("l");
        window.start()->click();
        QVERIFY(window.fit()->isRunning());
        QTest::keyClick(window.fit(), Qt::Key_Escape);
        QVERIFY(!window.fit()->isRunning() && window.fit()->isVisible());
        QVERIFY(window.state().startsWith("Stopped"));
        QTest::qWait(300);  // the thread ends, and says nothing
        QCOMPARE(window.parameter("l"), 0.9);
        QTest::keyClick(window.fit(), Qt::Key_Escape);
        QVERIFY(!window.fit()->isVisible());
        window.actions().find("fitMeasurements")->trigger();  // with the file that it has
        QVERIFY(window.fit()->isVisible());
        window.start()->click();
        window.actions().find("stop")->trigger();
        QVERIFY(!window.fit()->isRunning());
    }
    void whatCannotBeFittedIsSaid() {
        Window window;
        window.drop(window.fileOf("other.csv", "t,y\n0,1\n1,2\n"));
        QVERIFY(window.notice() && window.notice()->text.contains("\"y\" is not one of the state"));
        QVERIFY(!window.notice()->hint.isEmpty());
        // Too few measurements for two numbers: the reason stands in the window, and nothing is changed.
        window.drop(window.fileOf("few.csv", "t,theta\n1,0.5\n"));
        window.tick("l");
        window.tick("c");
        window.start()->click();
        QVERIFY(QTest::qWaitFor([&] { return !window.fit()->isRunning(); }, 60000));
        QVERIFY2(window.state().startsWith("No fit: has 1 measurements for 2 numbers"),
                 qPrintable(window.state()));
        QCOMPARE(window.parameter("l"), 0.9);
    }
    void aSceneThatWasEditedMeanwhileKeepsItsNumbers() {
        Window window;
        window.drop(window.fileOf("m.csv", syntheticCsv()));
        window.tick("l");
        window.start()->click();
        QVERIFY(window.workspace().edit({{"/model/parameters/g", 9.8}}, "g"));
        QVERIFY(QTest::qWaitFor([&] { return !window.fit()->isRunning(); }, 60000));
        QCOMPARE(window.parameter("l"), 0.9);
        QVERIFY(window.notice()->text.contains("has been changed since"));
    }
};

EXTREMAL_TEST(FitWindowTest)
}  // namespace extremal::fit_window_test

#include "fit_window_test.moc"
