// SPDX-License-Identifier: GPL-3.0-or-later
/// Random actions in the window: clicks, letters, keys, drags, dropped files, menus. Whatever is done, the
/// program goes on, the scene stays one that can be read, and afterwards the window works as ever.
///
/// The sequence follows from its seed, so that what fell is met again by the same seed. Some hundred actions
/// for each of a few seeds in the suite; for hours
///
///     EXTREMAL_MONKEY=100000 EXTREMAL_MONKEY_SEED=17 test.ui shell.monkey
///
/// with that many actions and this first seed. The last actions are printed where the program ends.
#include <QAction>
#include <QApplication>
#include <QDesktopServices>
#include <QDir>
#include <QDropEvent>
#include <QKeyEvent>
#include <QMenu>
#include <QMimeData>
#include <QPointer>
#include <QPushButton>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <QWheelEvent>

#include <algorithm>
#include <array>
#include <random>
#include <tuple>

#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/theme.hpp"
#include "ui/shell/actions.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::monkey_test {
namespace {

constexpr std::array presets = {"kepler",       "spring-pendulum", "pendulum",       "free-body",
                                "wave",         "kepler-sem",      "elliptic",       "bar-notch",
                                "henon-heiles", "tunnelling",      "static-profile", "duffing"};
constexpr std::array words = {"chaos", "kepler", "k*x^2", "1e300", "-1",   "x_t^2/2 - cos(x)",
                              "0.05",  "energy", "))((",  "\"",    "1e-5", "nan",
                              "[1]",   "{",      "é∂"};
constexpr std::array keys = {Qt::Key_Tab,    Qt::Key_Backtab,   Qt::Key_Return,  Qt::Key_Escape,
                             Qt::Key_Left,   Qt::Key_Right,     Qt::Key_Up,      Qt::Key_Down,
                             Qt::Key_Delete, Qt::Key_Backspace, Qt::Key_Home,    Qt::Key_End,
                             Qt::Key_F1,     Qt::Key_Space,     Qt::Key_PageDown};

/// What is pressed may be gone before the release, which on a desktop goes to what is under the pointer then:
/// a menu or a question has a loop of its own. QTest::mouseClick sends the release all the same.
void clickOn(QWidget* widget, Qt::MouseButton button, const QPoint& at) {
    const QPointer<QWidget> guard(widget);
    QTest::mousePress(widget, button, {}, at);
    if (guard) QTest::mouseRelease(guard, button, {}, at);
}

class Monkey {
public:
    Monkey(MainWindow& window, unsigned seed, const QDir& folder)
        : window_(window), random_(seed), folder_(folder) {
        answerLater();
    }

    void act() {
        const int kind = below(16);
        switch (kind) {
            case 0:
            case 1:
            case 2:
                return click(Qt::LeftButton);
            case 3:
                return doubleClick();
            case 4:
                return click(Qt::RightButton);
            case 5:
                return wheel();
            case 6:
                return type(QString(QChar('a' + below(26))));
            case 7:
                return type(QString::fromUtf8(any(words)));
            case 8:
            case 9:
                return press(any(keys));
            case 10:
            case 11:
                return trigger();
            case 12:
                return drag();
            case 13:
                return drop();
            case 14:
                return open();
            default:
                return resize();
        }
    }
    /// The scene can be written and read, and the window is there.
    QString fault() const {
        if (!window_.isVisible()) window_.show();
        const ReadScene read =
            readScene(writeScene(window_.workspace().scene()), {}, folder_.path().toStdString());
        return read.errors.empty() ? QString() : QString::fromStdString(read.errors.front().message);
    }
    QString log() const { return log_.join("; "); }

private:
    int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
    template <class T, std::size_t N>
    T any(const std::array<T, N>& all) {
        return all[static_cast<std::size_t>(below(static_cast<int>(N)))];
    }
    void note(const QString& what) {
        log_ << what;
        if (log_.size() > 30) log_.removeFirst();
    }
    /// A widget that can be seen; null where nothing is visible.
    QWidget* widget() {
        QList<QWidget*> seen;
        for (QWidget* w : QApplication::allWidgets())
            if (w->isVisible() && w->isEnabled() && w->width() > 1 && w->height() > 1 &&
                !w->visibleRegion().isEmpty())
                seen << w;
        std::sort(seen.begin(), seen.end(), [](const QWidget* a, const QWidget* b) {
            const QPoint p = a->mapToGlobal(QPoint(0, 0)), q = b->mapToGlobal(QPoint(0, 0));
            return std::tuple(p.y(), p.x(), a->width(), a->height(), a->metaObject()->className()) <
                   std::tuple(q.y(), q.x(), b->width(), b->height(), b->metaObject()->className());
        });
        return seen.isEmpty() ? nullptr : seen[below(static_cast<int>(seen.size()))];
    }
    QPoint within(const QWidget& w) { return {below(w.width()), below(w.height())}; }
    QWidget* focused() { return QApplication::focusWidget() ? QApplication::focusWidget() : &window_; }

    void click(Qt::MouseButton button) {
        if (QWidget* w = widget()) {
            note(QString("%1 click on %2").arg(button).arg(w->metaObject()->className()));
            clickOn(w, button, within(*w));
        }
    }
    void doubleClick() {
        if (QWidget* w = widget()) {
            note(QString("double click on %1").arg(w->metaObject()->className()));
            QTest::mouseDClick(w, Qt::LeftButton, {}, within(*w));
        }
    }
    void wheel() {
        if (QWidget* w = widget()) {
            note(QString("wheel on %1").arg(w->metaObject()->className()));
            const QPoint at = within(*w);
            QWheelEvent event(at, w->mapToGlobal(at), {}, {0, below(2) ? 120 : -120}, Qt::NoButton,
                              below(4) ? Qt::NoModifier : Qt::ControlModifier, Qt::NoScrollPhase, false);
            QApplication::sendEvent(w, &event);
        }
    }
    /// Letter by letter, wherever the focus goes meanwhile.
    void type(const QString& text) {
        note("type " + text);
        for (const QChar c : text) {
            if (c.unicode() < 128) {
                QTest::keyClick(focused(), c.toLatin1());
                continue;
            }
            QKeyEvent event(QEvent::KeyPress, 0, Qt::NoModifier, QString(c));
            QApplication::sendEvent(focused(), &event);
        }
    }
    void press(Qt::Key key) {
        constexpr std::array modifiers = {Qt::NoModifier, Qt::NoModifier, Qt::NoModifier, Qt::ShiftModifier,
                                          Qt::ControlModifier};
        const Qt::KeyboardModifier modifier = any(modifiers);
        note(QString("key %1 with %2").arg(key, 0, 16).arg(modifier, 0, 16));
        QTest::keyClick(focused(), key, modifier);
    }
    void trigger() {
        const QList<QAction*>& all = window_.actions().all();
        QAction* const action = all[below(static_cast<int>(all.size()))];
        if (action == window_.actions().find("quit") || !action->isEnabled()) return;
        note("action " + action->text());
        action->trigger();
    }
    void drag() {
        QWidget* const w = widget();
        if (!w) return;
        note(QString("drag on %1").arg(w->metaObject()->className()));
        const QPointer<QWidget> guard(w);
        QTest::mousePress(w, Qt::LeftButton, below(3) ? Qt::NoModifier : Qt::ControlModifier, within(*w));
        for (int i = 0; i < 4 && guard; ++i) QTest::mouseMove(w, within(*w));
        if (guard) QTest::mouseRelease(w, Qt::LeftButton, {}, within(*w));
    }
    void drop() {
        constexpr std::array files = {"scene.json", "broken.json", "table.csv", "missing.json", "empty"};
        const QString file = any(files);
        note("drop " + file);
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(folder_.filePath(file))});
        const QPointF at = within(window_);
        QDragEnterEvent enter(at.toPoint(), Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(&window_, &enter);
        QDropEvent event(at, Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(&window_, &event);
    }
    void open() {
        const QString name = any(presets);
        note("open " + name);
        window_.open("preset:" + name);
    }
    void resize() {
        note("resize");
        window_.resize(500 + below(1300), 400 + below(800));
    }
    /// Dialogs, menus and questions wait in loops of their own: they are answered there, each time by another
    /// timer, since an answer may open the next dialog.
    void answerLater() {
        QTimer::singleShot(5, &answers_, [this] {
            answerLater();
            answer();
        });
    }
    /// To what waits for an answer: another letter, a choice, or Esc.
    void answer() {
        QWidget* const waiting = QApplication::activePopupWidget() ? QApplication::activePopupWidget()
                                                                   : QApplication::activeModalWidget();
        if (!waiting) return;
        constexpr std::array answers = {Qt::Key_Escape, Qt::Key_Escape, Qt::Key_Down,
                                        Qt::Key_Tab,    Qt::Key_Return, Qt::Key_5};
        QTest::keyClick(waiting, any(answers));
        if (++waited_ % 20 == 0 && waiting->isVisible()) waiting->close();
    }

    MainWindow& window_;
    std::mt19937 random_;
    QDir folder_;
    QObject answers_;  ///< ends the timers
    QStringList log_;
    int waited_ = 0;
};

bool write(const QString& path, const QByteArray& text) {
    QFile file(path);
    return file.open(QIODevice::WriteOnly) && file.write(text) == text.size();
}

}  // namespace

class MonkeyTest : public QObject {
    Q_OBJECT

public slots:
    void ignore(const QUrl&) {}

private slots:
    void initTestCase() {
        QStandardPaths::setTestModeEnabled(true);
        QCoreApplication::setApplicationName("ExtremalMonkeyTest");
        loadFonts();
        applyTheme(*qApp, Theme::light());
        for (const char* scheme : {"http", "https", "file"})
            QDesktopServices::setUrlHandler(scheme, this, "ignore");
        // What dialogs save goes here.
        QVERIFY(folder_.isValid() && QDir::setCurrent(folder_.path()));
        const ReadScene scene = readScene(loadSceneText("preset:harmonic-oscillator"));
        QVERIFY(write(folder_.filePath("scene.json"), QByteArray::fromStdString(writeScene(scene.scene))));
        QVERIFY(write(folder_.filePath("broken.json"), "{\"extremal\": 1, \"model\": "));
        QVERIFY(write(folder_.filePath("table.csv"), "t,q.x\n0,1\n1,nan\n"));
        QVERIFY(write(folder_.filePath("empty"), ""));
    }
    void aWidgetMayGoAwayWhileItIsPressed() {
        auto* const button = new QPushButton("remove");
        connect(button, &QPushButton::pressed, button, [button] { delete button; });
        const QPointer<QWidget> guard(button);
        button->show();
        clickOn(button, Qt::LeftButton, {2, 2});
        QVERIFY(!guard);
    }
    void nothingThatIsDoneEndsTheProgram_data() {
        QTest::addColumn<unsigned>("seed");
        const QByteArray first = qgetenv("EXTREMAL_MONKEY_SEED");
        for (unsigned i = 0; i < (first.isEmpty() ? 3u : 1u); ++i) {
            const unsigned seed = first.isEmpty() ? 1 + i : first.toUInt();
            QTest::addRow("seed %u", seed) << seed;
        }
    }
    void nothingThatIsDoneEndsTheProgram() {
        QFETCH(unsigned, seed);
        const QByteArray wanted = qgetenv("EXTREMAL_MONKEY");
        const int actions = wanted.isEmpty() ? 300 : wanted.toInt();
        MainWindow window(Theme::light(), false);
        window.resize(1400, 900);
        window.show();
        QVERIFY(window.open("preset:kepler"));
        {
            Monkey monkey(window, seed, QDir(folder_.path()));
            for (int i = 0; i < actions; ++i) {
                monkey.act();
                QCoreApplication::processEvents();
                if (i % 20 > 0) continue;
                const QString fault = monkey.fault();
                QVERIFY2(fault.isEmpty(), qPrintable(fault + " after: " + monkey.log()));
            }
        }
        for (QWidget* other : QApplication::topLevelWidgets())
            if (other != &window && other->isVisible()) other->close();
        QVERIFY(window.workspace().saveAs(folder_.filePath("end.json")));
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
    }

private:
    QTemporaryDir folder_;
};

EXTREMAL_TEST(MonkeyTest)

}  // namespace extremal::monkey_test

#include "monkey_test.moc"
