// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/tools/test.hpp"
#include "ui/pictures/playing_page.hpp"

#include <QCryptographicHash>
#include <QRegularExpression>
#include <QTest>

#include <cmath>

#include "engine/figure/image/svg.hpp"
#include "engine/figure/sample.hpp"
#include "tests/ui/stage/model_comparison.hpp"
#include "ui/pictures/export_folder.hpp"

namespace extremal::playing_page_test {

class PlayingPageTest : public QObject {
    Q_OBJECT

    ExportParts parts(const std::string& words, int frames = 5) const {
        auto comparison = fake::comparison(fake::pendulum());
        comparison->scene.title = comparison->scene.notes = comparison->scene.lesson =
            comparison->scene.source = words;
        ExportParts all;
        for (const char* view : {"energy", "phase"})
            all.figures.push_back(makeFigure(*comparison, {view, "", ""}));
        for (Figure& figure : all.figures) figure.title = figure.summary = figure.x.title = words;
        all.comparison = comparison;
        all.frames = frames;
        return all;
    }
    static qsizetype count(const QString& text, const char* what) { return text.count(QLatin1String(what)); }

private slots:
    void itHasAFramePerTime() {
        const QString page = reportPage(parts("Pendulum", 7));
        QCOMPARE(count(page, "<img alt=\"\" width=\"720\""), qsizetype{6});  // and the first, which has words
        QVERIFY(page.contains("max=\"6\""));
        for (const QString& at : {page.section("data-at=\"", 1, 1).section('"', 0, 0),
                                  page.section("data-at=\"", 2, 2).section('"', 0, 0)})
            QCOMPARE(at.split(';').size(), qsizetype{7});
        const QString still = reportPage(parts("Pendulum", 0));
        QCOMPARE(count(still, "data-at"), qsizetype{0});
        QCOMPARE(count(still, "id=\"play\""), qsizetype{0});
    }

    void dotsAreOnTheCurves() {
        const ExportParts all = parts("Pendulum", 9);
        const Film film = filmOf(all.comparison, 9);
        const QString html = movingFigureHtml(all.figures[1], 720, 440, film);
        const QStringList frames = html.section("data-at=\"", 1, 1).section('"', 0, 0).split(';');
        const SvgFrame frame = svgFrame(all.figures[1], {720, 440, false});
        for (std::size_t k = 0; k < film.times.size(); ++k) {
            const QStringList dots = frames[static_cast<qsizetype>(k)].split(' ');
            const auto& series = all.figures[1].series();
            for (std::size_t i = 0; i < static_cast<std::size_t>(dots.size()); ++i) {
                if (dots[static_cast<qsizetype>(i)].isEmpty()) continue;
                // From percent of the picture back to values, by the axes.
                const QStringList xy = dots[static_cast<qsizetype>(i)].split(',');
                const double px = xy[0].toDouble() * 7.2, py = xy[1].toDouble() * 4.4;
                const double x = frame.x.first + (px - frame.left) / (frame.right - frame.left) *
                                                     (frame.x.second - frame.x.first);
                const double y = frame.y.first + (frame.bottom - py) / (frame.bottom - frame.top) *
                                                     (frame.y.second - frame.y.first);
                const auto p = pointAt(series[i], film.times[k]);
                QVERIFY(p);
                QVERIFY(std::abs(x - p->first) < 1e-3 * (frame.x.second - frame.x.first));
                QVERIFY(std::abs(y - p->second) < 1e-3 * (frame.y.second - frame.y.first));
            }
        }
    }

    void itsPolicyAdmitsItsOneScriptAlone() {
        const QString hostile = QStringLiteral(
            "</script><script>alert(1)</script>\"><img src=x onerror=alert(2)> <svg/onload=alert(3)> "
            "[a](javascript:alert(4)) ${alert(5)} '\"><!-- --> ;\" data-x=\"");
        const QString page = reportPage(parts(hostile.toStdString()));
        QCOMPARE(count(page, "<script"), qsizetype{1});
        QCOMPARE(count(page, "</script>"), qsizetype{1});
        const QString script = page.section("<script>", 1, 1).section("</script>", 0, 0);
        QCOMPARE(script, playScript());
        const QByteArray hash =
            QCryptographicHash::hash(script.toUtf8(), QCryptographicHash::Sha256).toBase64();
        QVERIFY(page.contains("script-src 'sha256-" + hash + "'"));
        // No tag carries a handler or leads anywhere.
        static const QRegularExpression tag(QStringLiteral("<[a-zA-Z][^>]*>"));
        for (const QRegularExpressionMatch& match : tag.globalMatch(page)) {
            const QString text = match.captured().remove(QRegularExpression("\"[^\"]*\""));  // without values
            QVERIFY2(!text.contains(QRegularExpression("\\son[a-z]+\\s*=")), qPrintable(text.left(200)));
            QVERIFY2(!text.contains("javascript:"), qPrintable(text.left(200)));
        }
        // The script is a constant: it has nothing of the scene, and writes no markup.
        for (const char* active : {"innerHTML", "eval", "Function(", "document.write", "insertAdjacent"})
            QVERIFY2(!script.contains(active), active);
    }

    void theSceneIsInThePage() {
        const QString page = reportPage(parts("A <b> & \"c\""));
        const QString text = page.section("<summary>scene.json</summary><pre>", 1, 1).section("</pre>", 0, 0);
        QVERIFY(text.contains("&lt;b&gt;") && text.contains("schemes"));
    }
};

EXTREMAL_TEST(PlayingPageTest)
}  // namespace extremal::playing_page_test

#include "playing_page_test.moc"
