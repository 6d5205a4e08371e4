// SPDX-License-Identifier: GPL-3.0-or-later
/// The limits of the golden images see every single shape: each one is removed from a drawing in turn, and
/// the comparison with the whole drawing must fail.
#include <QPainter>
#include <QTest>

#include <algorithm>

#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/engine/figure/hand_made.hpp"
#include "tests/golden/golden_check.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/stage/model_comparison.hpp"
#include "ui/base/theme.hpp"
#include "ui/plots/plot_renderer.hpp"
#include "ui/stage/stage_overlay.hpp"
#include "ui/stage/stage_picture.hpp"
#include "ui/stage/stage_player.hpp"

namespace extremal::golden_teeth_test {

namespace {

/// The stage of a comparison at one time, drawn with parts of its frame removed.
class Stage {
public:
    Stage(std::shared_ptr<const Comparison> comparison, double t)
        : player_(std::move(comparison)),
          frame(player_.frame(t, stageStyle(Theme::light()))),
          camera_(player_.fittedCamera(size_.width(), size_.height(), stageMargin)) {}

    QImage draw(const StageFrame& shapes, const StageFrame& words, bool hasLegend = true) const {
        QImage image = drawStage(shapes, camera_, size_, 1);
        QPainter painter(&image);
        paintOverlay(painter, QRectF(QPointF(0, 0), size_), words, player_, Theme::light(),
                     {hasLegend, camera_});
        return image;
    }
    QImage draw(const StageFrame& f) const { return draw(f, f); }

private:
    const QSizeF size_{520, 300};
    StagePlayer player_;

public:
    const StageFrame frame;

private:
    Camera camera_;
};

/// A part may be covered by others: a trail that retraces itself, a line behind a face. Its absence changes
/// no channel by more than this, of 255, which is not visible.
constexpr int invisible = 3;

/// Counts what was removed, and names what the comparison does not miss.
struct Teeth {
    const QImage& whole;
    const GoldenLimits limits;
    int removed = 0, covered = 0;
    QStringList unseen = {};

    void bite(const QImage& without, const QString& what) {
        ++removed;
        const ImageDifference d = compareImages(without, whole, limits.threshold);
        if (d.largest <= invisible)
            ++covered;
        else if (isWithin(d, limits))
            unseen << QString("%1: %2 % of the worst tile, largest difference %3")
                          .arg(what)
                          .arg(d.worstTilePercent)
                          .arg(d.largest);
    }
    /// At least so many parts could be seen, and each was missed.
    void check(int atLeast) const {
        qInfo("%d parts removed, %d of them covered by others", removed, covered);
        QVERIFY2(unseen.isEmpty(), qPrintable(unseen.join("\n")));
        QVERIFY(removed - covered >= atLeast);
    }
};

/// Draws the frame without one entry of `list(frame)` at a time, or without `together` neighbouring ones.
template <class List>
void removeEach(const Stage& stage, Teeth& teeth, const QString& what, std::size_t together,
                const List& list) {
    StageFrame copy = stage.frame;
    const std::size_t count = list(copy).size();
    for (std::size_t i = 0; i < count; i += together) {
        copy = stage.frame;
        auto& entries = list(copy);
        const auto first = entries.begin() + static_cast<std::ptrdiff_t>(i);
        entries.erase(first, first + static_cast<std::ptrdiff_t>(std::min(together, count - i)));
        teeth.bite(stage.draw(copy), what + " " + QString::number(i));
    }
}

void removeHalves(const Stage& stage, Teeth& teeth, const QString& what, std::size_t layer,
                  std::vector<TrailPoint> StageLayer::*trail) {
    const auto half = static_cast<std::ptrdiff_t>((stage.frame.layers[layer].*trail).size() / 2);
    if (half == 0) return;
    for (const bool isOlder : {true, false}) {
        StageFrame copy = stage.frame;
        auto& points = copy.layers[layer].*trail;
        if (isOlder)
            points.erase(points.begin(), points.begin() + half);
        else
            points.erase(points.begin() + half, points.end());
        teeth.bite(stage.draw(copy), what + (isOlder ? ", older half" : ", newer half"));
    }
}

/// `together`: of the scenery; a potential is drawn by many short segments.
void removeShapes(const Stage& stage, Teeth& teeth, std::size_t together = 1) {
    removeEach(
        stage, teeth, "scenery", together, [](StageFrame & f) -> auto& { return f.scenery; });
    if (stage.frame.inset)
        removeEach(
            stage, teeth, "inset", 1, [](StageFrame & f) -> auto& { return f.inset->backdrop; });
    for (std::size_t l = 0; l < stage.frame.layers.size(); ++l) {
        const QString name = "scheme " + QString::number(l);
        removeEach(
            stage, teeth, name + ", shape", 1, [l](StageFrame & f) -> auto& { return f.layers[l].shapes; });
        removeHalves(stage, teeth, name + ", trail", l, &StageLayer::trail);
        removeHalves(stage, teeth, name + ", trail of the inset", l, &StageLayer::insetTrail);
    }
}

void removeWords(const Stage& stage, Teeth& teeth) {
    const StageFrame& f = stage.frame;
    teeth.bite(stage.draw(f, f, false), "legend");
    StageFrame words = f;
    words.t += 0.1;  // one digit of the time
    teeth.bite(stage.draw(f, words), "time");
    for (std::size_t l = 0; l < f.layers.size(); ++l) {
        words = f;
        words.layers[l].label.clear();
        teeth.bite(stage.draw(f, words), "name of scheme " + QString::number(l));
    }
    for (std::size_t n = 0; n < f.notes.size(); ++n) {
        words = f;
        words.notes.erase(words.notes.begin() + static_cast<std::ptrdiff_t>(n));
        teeth.bite(stage.draw(f, words), "note " + QString::number(n));
    }
    if (f.inset) {
        words = f;
        words.inset->title.clear();
        teeth.bite(stage.draw(f, words), "title of the inset");
    }
}

}  // namespace

class GoldenTeethTest : public QObject {
    Q_OBJECT

private slots:
    void aMissingShapeOfTheStageIsSeen_data() {
        QTest::addColumn<int>("film");
        QTest::addColumn<double>("time");
        QTest::newRow("spring-pendulum") << 0 << 3.2;
        QTest::newRow("spring-pendulum, after a failure") << 0 << 6.2;
        QTest::newRow("pendulum") << 1 << 2.6;
        QTest::newRow("kepler") << 2 << 11.3;
        QTest::newRow("oscillator") << 3 << 2.0;
        QTest::newRow("free body") << 4 << 6.2;
        QTest::newRow("top") << 5 << 4.4;
    }
    void aMissingShapeOfTheStageIsSeen() {
        QFETCH(int, film);
        QFETCH(double, time);
        const fake::Film films[] = {fake::springPendulum(), fake::pendulum(), fake::kepler(),
                                    fake::oscillator(),     fake::freeBody(), fake::heavyTop()};
        const Stage stage(fake::comparison(films[film]), time);
        const QImage whole = stage.draw(stage.frame);
        Teeth teeth{whole, GoldenLimits::stage()};
        removeShapes(stage, teeth);
        removeWords(stage, teeth);
        teeth.check(9);
    }
    void aMissingWaveFunctionIsSeen() {
        for (const char* preset : {"coherent-state", "double-slit"}) {
            Scene scene = readScene(findPreset(preset)->json, {{"/time/end", 0.2},
                                                               {"/reference/type", "none"},
                                                               {"/observe", Value::Array{"norm"}}})
                              .scene;
            const Stage stage(std::make_shared<const Comparison>(run(scene)), 0.1);
            const QImage whole = stage.draw(stage.frame);
            Teeth teeth{whole, GoldenLimits::stage()};
            removeShapes(stage, teeth, 8);
            removeWords(stage, teeth);
            teeth.check(3);
        }
    }

    void aMissingPartOfAPlotIsSeen() {
        const System pendulum = handmade::pendulum();
        for (const char* id : {"energy", "error", "phase"}) {
            View view;
            view.id = id;
            const Figure right = makeFigure(handmade::comparison(), view, &pendulum);
            const auto picture = [](const Figure& f) { return renderFigure(f, {600, 400}, Theme::light()); };
            const QImage whole = picture(right);
            Teeth teeth{whole, GoldenLimits::plot()};
            for (std::size_t i = 0; i < right.series().size(); ++i) {
                const QString name = QString("%1, series %2").arg(id).arg(i);
                Figure wrong = right;
                wrong.series()[i].x.resize(wrong.series()[i].x.size() / 2);
                wrong.series()[i].y.resize(wrong.series()[i].x.size());
                if (!wrong.series()[i].t.empty()) wrong.series()[i].t.resize(wrong.series()[i].x.size());
                teeth.bite(picture(wrong), name + ", second half");
                wrong = right;
                wrong.series()[i].label.clear();
                teeth.bite(picture(wrong), name + ", name in the legend");
            }
            for (std::size_t i = 0; i < right.layers.size(); ++i) {
                if (!std::holds_alternative<FailureMark>(right.layers[i])) continue;
                Figure wrong = right;
                wrong.layers.erase(wrong.layers.begin() + static_cast<std::ptrdiff_t>(i));
                teeth.bite(picture(wrong), QString("%1, failure %2").arg(id).arg(i));
            }
            Figure wrong = right;
            wrong.subtitle.clear();
            if (!right.subtitle.empty()) teeth.bite(picture(wrong), "subtitle");
            wrong = right;
            wrong.y.title.clear();
            teeth.bite(picture(wrong), "title of the axis");
            teeth.check(5);
        }
    }

    void aMissingEntryOfTheKktMatrixIsSeen() {
        const Scene scene = readScene(loadSceneText("preset:kkt-matrix")).scene;
        const Comparison comparison = run(scene);
        const System system = makeSystem(scene);
        for (const char* scheme : {"hat functions", "Lobatto basis", "Legendre basis"}) {
            View view;
            view.id = "sparsity";
            view.scheme = scheme;
            const Figure right = makeFigure(comparison, view, &system);
            const QImage whole = renderFigure(right, {600, 400}, Theme::light());
            Teeth teeth{whole, GoldenLimits::plot()};
            for (std::size_t s = 0; s < right.series().size(); ++s)
                for (std::size_t i = 0; i < right.series()[s].x.size(); i += 7) {
                    Figure wrong = right;
                    wrong.series()[s].x.erase(wrong.series()[s].x.begin() + static_cast<std::ptrdiff_t>(i));
                    wrong.series()[s].y.erase(wrong.series()[s].y.begin() + static_cast<std::ptrdiff_t>(i));
                    teeth.bite(renderFigure(wrong, {600, 400}, Theme::light()),
                               QString("%1: entry %2 of series %3").arg(scheme).arg(i).arg(s));
                }
            teeth.check(10);
        }
    }
};

EXTREMAL_TEST(GoldenTeethTest)
}  // namespace extremal::golden_teeth_test

#include "golden_teeth_test.moc"
