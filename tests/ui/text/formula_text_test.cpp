// SPDX-License-Identifier: GPL-3.0-or-later
/// Formulas in notes are typeset, those of all presets completely.
#include <QTest>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextDocument>

#include "engine/passport/document.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"
#include "ui/text/formula_text.hpp"
#include "ui/text/text_view.hpp"
#include "ui/text/typeset.hpp"

namespace extremal::formula_text_test {
namespace {

struct Piece {
    QString text;
    QTextCharFormat format;
};

std::vector<Piece> piecesOf(const QTextDocument& document) {
    std::vector<Piece> pieces;
    for (QTextBlock block = document.begin(); block.isValid(); block = block.next())
        for (auto it = block.begin(); !it.atEnd(); ++it)
            pieces.push_back({it.fragment().text(), it.fragment().charFormat()});
    return pieces;
}

QString shown(const QString& text, QTextDocument& document) {
    document.setMarkdown(withFormulas(text));
    formatFormulas(document);
    return document.toPlainText();
}

}  // namespace

class FormulaTextTest : public QObject {
    Q_OBJECT
private slots:
    void symbolsRootsAndPowersAreTypeset() {
        QTextDocument document;
        QCOMPARE(shown("with $\\omega = \\sqrt{k/m} = 100$ and $10^{12}$ **bold**", document),
                 QString::fromUtf8("with ω = √k/m = 100 and 1012 bold"));
        bool hasRoot = false, hasPower = false, hasItalic = false, isBold = false;
        for (const auto& [text, format] : piecesOf(document)) {
            hasRoot = hasRoot || (format.fontOverline() && QString("k/m").contains(text));
            hasItalic = hasItalic || (format.fontItalic() && text == "m");
            hasPower =
                hasPower || (format.verticalAlignment() == QTextCharFormat::AlignSuperScript && text == "12");
            isBold = isBold || (text == "bold" && format.fontWeight() > QFont::Normal);
        }
        QVERIFY(hasRoot && hasPower && hasItalic && isBold);
    }
    void moneyIsNoFormula() {
        QTextDocument document;
        QCOMPARE(shown("5 $ and 6 $ more", document), QString("5 $ and 6 $ more"));
        QCOMPARE(shown("one $ alone", document), QString("one $ alone"));
    }
    void pagesOfTheEngineAreTypeset() {
        const Document page{
            "Page",
            {Document::Paragraph{"The unknowns Y_1, …, Y_{m−1} and φ_a."},
             Document::Formulas{{{"Q_i = q_0 + Σ_a φ_a(c_i) Y_a", ""}}},
             Document::Table{{"column", "x_t^2"}, {{"a", "b_i"}}}, Document::Listing{{"A[1,1] = x_0"}}}};
        TextView browser;
        browser.showPage(page);
        const QString text = browser.toPlainText();
        for (const char* part :
             {"The unknowns Y1, …, Ym−1 and φa.", "Qi = q0 + Σa φa(ci) Ya", "xt2", "bi", "A[1,1] = x_0"})
            QVERIFY2(text.contains(QString::fromUtf8(part)), qPrintable(text));
        int lowered = 0, raised = 0, italic = 0;
        for (const Piece& piece : piecesOf(*browser.document())) {
            const auto place = piece.format.verticalAlignment();
            lowered += place == QTextCharFormat::AlignSubScript;
            raised += place == QTextCharFormat::AlignSuperScript;
            italic += piece.format.fontItalic();
            if (piece.text.contains("Q")) QVERIFY(!piece.format.fontFixedPitch());
        }
        QCOMPARE(lowered, 11);
        QCOMPARE(raised, 1);
        QVERIFY2(italic >= 6, qPrintable(QString::number(italic)));
    }
    void notesOfAllPresetsHaveNoRawTeX() {
        for (const Preset& preset : presets()) {
            const Scene scene = readScene(preset.json).scene;
            QVERIFY2(
                scene.lesson.find('$') == std::string::npos && scene.title.find('$') == std::string::npos,
                preset.id.data());
            QTextBrowser page;
            showMarkdown(page, withFormulas(QString::fromStdString(scene.notes)));
            const QString text = page.document()->toPlainText();
            QVERIFY2(!text.contains('$') && !text.contains('\\') && !text.contains('{'),
                     qPrintable(QString::fromUtf8(preset.id.data()) + ": " + text));
            for (const QChar c : text) QVERIFY(c.unicode() < 0xE000 || c.unicode() > 0xE0FF);
        }
    }
};

EXTREMAL_TEST(FormulaTextTest)
}  // namespace extremal::formula_text_test

#include "formula_text_test.moc"
