// SPDX-License-Identifier: GPL-3.0-or-later
/// The start page: every preset in a section, with a picture; the search; recent files; a new scene.
#include <QFile>
#include <QLineEdit>
#include <QPushButton>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>

#include <set>

#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/pictures/card_picture.hpp"
#include "ui/shell/gallery.hpp"
#include "ui/shell/start_page.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::start_page_test {

class StartPageTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void everyPresetIsInOneSection() {
        const std::vector<GallerySection> sections = readGallery();
        QCOMPARE(sections.front().title, QString("First steps"));
        QCOMPARE(sections.front().items.front().id, QString("spring-pendulum"));
        std::set<QString> shown;
        std::size_t count = 0;
        for (const GallerySection& section : sections)
            for (const GalleryItem& item : section.items) {
                shown.insert(item.id);
                ++count;
                QVERIFY2(!item.title.isEmpty() && !item.lesson.isEmpty(), qPrintable(item.id));
            }
        QCOMPARE(shown.size(), presets().size());
        QCOMPARE(count, presets().size());  // none twice
        // Named by the data, not by what is left over.
        QFile file(":/gallery.json");
        QVERIFY(file.open(QIODevice::ReadOnly));
        const QByteArray text = file.readAll();
        for (const Preset& preset : presets())
            QVERIFY2(text.contains(
                         '"' + QByteArray(preset.id.data(), static_cast<qsizetype>(preset.id.size())) + '"'),
                     std::string(preset.id).c_str());
    }
    void theSearchLooksAtTitlesAndLessons() {
        MainWindow window(Theme::light(), false);
        window.resize(1300, 900);
        window.show();
        auto* page = window.findChild<StartPage*>();
        QCOMPARE(static_cast<std::size_t>(page->shownPresets().size()), presets().size());
        page->search("tennis RACKET");
        QCOMPARE(page->shownPresets(), QStringList{"tennis-racket"});
        page->search("hénon");
        QVERIFY(page->shownPresets().contains("henon-heiles"));
        page->search("no such words");
        QVERIFY(page->shownPresets().isEmpty());
        page->search("double pendulum");
        auto* field = page->findChild<QLineEdit*>("search");
        QTest::keyClick(field, Qt::Key_Return);
        QCOMPARE(window.workspace().origin(), QString("preset:double-pendulum"));
    }
    void picturesComeFromFiles() {
        QTemporaryDir folder;
        const QString file = presetPictureFile(folder.path(), "kepler", true);
        QVERIFY(file.endsWith("/kepler-dark.png"));
        // A card takes the first part of the way through the run.
        const Preset* preset = findPreset("pendulum");
        const ReadScene read = readScene(preset->json);
        const Scene plain = sceneOfPicture(read.scene);
        QVERIFY(plain.reference.kind == ReferenceSpec::Kind::none && plain.observe.empty());
        const auto result = std::make_shared<const Comparison>(run(plain));
        const QImage light = cardPicture(result, Theme::light(), 2),
                     dark = cardPicture(result, Theme::dark(), 2);
        QCOMPARE(light.size(), cardPictureSize * 2);
        QVERIFY(qGray(light.pixel(3, 3)) > 200 && qGray(dark.pixel(3, 3)) < 80);
        std::set<QRgb> colours;
        for (int x = 0; x < light.width(); ++x)
            for (int y = 0; y < light.height(); ++y) colours.insert(light.pixel(x, y));
        QVERIFY(colours.size() > 50);  // something is drawn
    }
    void aNewSceneFromALagrangianRuns() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.findChild<QPushButton*>("newLagrangian")->click();
        QCOMPARE(window.workspace().scene().model.type, std::string("lagrangian"));
        QVERIFY(waitForResults(window));
        for (const auto& result : window.runControl().results()->schemes)
            QVERIFY(result->summary.status == RunStatus::done);
    }
    void recentFilesAreOffered() {
        QTemporaryDir folder;
        const QString path = folder.filePath("mine.json");
        {
            MainWindow window(Theme::light());
            QVERIFY(window.open("preset:pendulum"));
            QVERIFY(window.workspace().saveAs(path));
        }
        MainWindow window(Theme::light());
        window.show();
        auto* page = window.findChild<StartPage*>();
        QPushButton* recent = nullptr;
        for (QPushButton* button : page->findChildren<QPushButton*>())
            if (button->text() == "mine.json") recent = button;
        QVERIFY(recent && recent->isVisible());
        recent->click();
        QCOMPARE(window.workspace().path(), path);
        QSettings().remove("window/recent");
    }
};

EXTREMAL_TEST(StartPageTest)
}  // namespace extremal::start_page_test

#include "start_page_test.moc"
