// SPDX-License-Identifier: GPL-3.0-or-later
/// The handbook keeps up with the program: its pages hang together, its scenes are valid, and what the
/// catalogues offer is in it.
#include <QDir>
#include <QFile>
#include <QRegularExpression>
#include <QTest>

#include "engine/baseline/catalog.hpp"
#include "engine/family/scheme.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/model/system.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/space/catalog.hpp"
#include "engine/view/catalog.hpp"
#include "tests/tools/test.hpp"

namespace extremal::handbook_test {

namespace {

const QString folder = QStringLiteral(EXTREMAL_SOURCE_DIR "/resources/handbook/");

QString fileText(const QString& path) {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

QStringList pages() { return QDir(folder).entryList({"*.md"}, QDir::Files); }

QStringList linksOf(const QString& page) {
    static const QRegularExpression link(R"(\]\(([^)#:]+\.md)[^):]*\))");
    QStringList links;
    auto matches = link.globalMatch(fileText(folder + page));
    while (matches.hasNext()) links << matches.next().captured(1);
    return links;
}

/// What the page does not mention, as code, of the ids and keys of a catalogue.
QStringList missingFrom(const char* page, const std::vector<CatalogItem>& items) {
    const QString text = fileText(folder + page);
    QStringList missing;
    const auto expect = [&](const std::string& name) {
        const QString word = QString::fromStdString(name);
        if (!text.contains("`" + word + "`") && !text.contains("## " + word + "\n")) missing << word;
    };
    for (const CatalogItem& item : items) {
        expect(item.id);
        for (const FieldInfo& field : item.parameters) {
            expect(field.key);
            for (const std::string& choice : field.choices) expect(choice);
        }
    }
    return missing;
}

template <class Entry>
std::vector<CatalogItem> itemsOf(const std::vector<Entry>& entries) {
    std::vector<CatalogItem> items;
    for (const Entry& e : entries) items.push_back(e.item);
    return items;
}

}  // namespace

class HandbookTest : public QObject {
    Q_OBJECT

private slots:
    void everyPageIsReachedFromTheIndexAndCompiledIn() {
        const QString resources = fileText(QStringLiteral(EXTREMAL_SOURCE_DIR "/resources/resources.qrc"));
        QStringList reached{"index.md"};
        for (int i = 0; i < reached.size(); ++i)
            for (const QString& link : linksOf(reached[i]))
                if (!reached.contains(link)) reached << link;
        for (const QString& page : pages()) {
            QVERIFY2(reached.contains(page), qPrintable(page));
            QVERIFY2(resources.contains("<file>handbook/" + page + "</file>"), qPrintable(page));
        }
        for (const QString& page : reached) QVERIFY2(QFile::exists(folder + page), qPrintable(page));
    }

    void everyCatalogueEntryIsDescribed_data() {
        QTest::addColumn<QStringList>("missing");
        QTest::newRow("models") << missingFrom("models.md", itemsOf(modelCatalog()));
        QTest::newRow("spaces") << missingFrom("spaces.md", spaceCatalog());
        QTest::newRow("quadratures") << missingFrom("quadratures.md", quadratureCatalog());
        QTest::newRow("schemes") << missingFrom("schemes.md", itemsOf(schemeCatalog()));
        QTest::newRow("compositions") << missingFrom("schemes.md", compositionCatalog());
        QTest::newRow("baselines") << missingFrom("baselines.md", itemsOf(baselineCatalog()));
        QTest::newRow("observables") << missingFrom("observables.md", observableCatalog());
        QTest::newRow("views") << missingFrom("observables.md", viewCatalog());
    }
    void everyCatalogueEntryIsDescribed() {
        QFETCH(QStringList, missing);
        QVERIFY2(missing.isEmpty(), qPrintable(missing.join(", ")));
    }

    void scenesInThePagesAreValid() {
        static const QRegularExpression block("```json\n(.*?)```",
                                              QRegularExpression::DotMatchesEverythingOption);
        int scenes = 0;
        for (const QString& page : pages()) {
            auto matches = block.globalMatch(fileText(folder + page));
            while (matches.hasNext()) {
                const QString json = matches.next().captured(1);
                if (!json.contains("\"extremal\"")) continue;
                ++scenes;
                const ReadScene read = readScene(json.toStdString());
                const std::string what =
                    read.errors.empty() ? "" : read.errors[0].pointer + ": " + read.errors[0].message;
                QVERIFY2(read.errors.empty() && read.warnings.empty(), (page.toStdString() + what).c_str());
            }
        }
        QVERIFY(scenes > 0);
    }
};

EXTREMAL_TEST(HandbookTest)
}  // namespace extremal::handbook_test

#include "handbook_test.moc"
