// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/pictures/playing_page.hpp"

#include <QBuffer>
#include <QCryptographicHash>
#include <QPainter>

#include <algorithm>
#include <cmath>

#include "engine/core/text/markup.hpp"
#include "engine/core/text/text.hpp"
#include "engine/figure/image/palette.hpp"
#include "engine/figure/image/svg.hpp"
#include "engine/figure/sample.hpp"
#include "ui/base/theme.hpp"
#include "ui/stage/gl/surface.hpp"
#include "ui/stage/stage_overlay.hpp"
#include "ui/stage/stage_picture.hpp"
#include "ui/stage/stage_player.hpp"

namespace extremal {
namespace {

constexpr int filmWidth = 720, filmHeight = 420;

QString escapedText(const std::string& text) { return QString::fromStdString(markupText(text)); }

QString numberText(double value) { return QString::fromStdString(formatNumber(value, 5)); }

QString dataOf(const QByteArray& bytes, const char* kind) {
    return QStringLiteral("data:image/%1;base64,%2")
        .arg(QLatin1String(kind), QString::fromLatin1(bytes.toBase64()));
}

QImage frameAt(const StagePlayer& player, const Theme& theme, double t) {
    const QSizeF size(filmWidth, filmHeight);
    const StageFrame frame = player.frame(t, stageStyle(theme));
    const Camera camera = player.fittedCamera(filmWidth, filmHeight, stageMargin);
    QImage image = drawStage(frame, camera, size, 1).convertToFormat(QImage::Format_RGB32);
    QPainter painter(&image);
    OverlayOptions options{true};
    options.camera = camera;
    paintOverlay(painter, QRectF(QPointF(0, 0), size), frame, player, theme, options);
    return image;
}

/// A dot of a curve on a frame, in percent of the picture; empty: the curve is not there at that time.
QString placeText(const std::optional<std::pair<double, double>>& place, int width, int height) {
    if (!place) return {};
    return numberText(100 * place->first / width) + ',' + numberText(100 * place->second / height);
}

/// Curves on which a dot goes: those of schemes that know their times.
std::vector<const Series*> dottedIn(const Figure& figure) {
    std::vector<const Series*> all;
    for (const Series& s : figure.series())
        if (s.style >= 0 && hasLine(s.kind) && s.tone == Tone::full && !s.t.empty()) all.push_back(&s);
    return all;
}

/// The places of one frame: "x" of the line, or "x,y" of each dot with spaces between them.
QString framePlaces(const Figure& figure, const SvgFrame& frame, const std::vector<const Series*>& dotted,
                    double t, int width, int height) {
    if (figure.x.isTime) {
        const auto place = frame.at(t, std::nullopt);
        return place ? numberText(100 * place->first / width) : QString();
    }
    QStringList dots;
    for (const Series* s : dotted) {
        const auto p = pointAt(*s, t);
        dots << placeText(p ? frame.at(p->first, p->second) : std::nullopt, width, height);
    }
    return dots.join(' ');
}

}  // namespace

Film filmOf(const std::shared_ptr<const Comparison>& comparison, int count) {
    Film film;
    const StagePlayer player(comparison);
    double start = comparison->scene.start.value, end = start;
    for (const auto& scheme : comparison->schemes)
        if (const auto t = scheme->trajectory["t"]; !t.empty()) end = std::max(end, t.back());
    if (count < 2 || !(end > start)) return film;
    for (int i = 0; i < count; ++i) film.times.push_back(start + (end - start) * i / (count - 1));
    film.unit = QString::fromStdString(player.timeUnit());
    if (!player.hasStage()) return film;
    try {
        const Theme theme = Theme::light();
        for (const double t : film.times) film.frames.push_back(frameAt(player, theme, t));
    } catch (const OpenGlUnavailable&) {
        film.frames.clear();  // the plots move all the same
    }
    return film;
}

QString filmHtml(const Film& film) {
    if (film.times.empty()) return {};
    QString html = QStringLiteral("<section id=\"play\" data-from=\"%1\" data-to=\"%2\" data-unit=\"%3\">\n")
                       .arg(numberText(film.times.front()), numberText(film.times.back()),
                            escapedText(film.unit.toStdString()));
    if (!film.frames.empty()) {
        html += "<figure id=\"film\">\n";
        for (std::size_t i = 0; i < film.frames.size(); ++i) {
            QByteArray bytes;
            QBuffer buffer(&bytes);
            film.frames[i].save(&buffer, "PNG");
            html += QStringLiteral("<img alt=\"%1\" width=\"%2\" height=\"%3\"%4 src=\"%5\">\n")
                        .arg(i == 0 ? QStringLiteral("The motion of all schemes") : QString())
                        .arg(filmWidth)
                        .arg(filmHeight)
                        .arg(i == 0 ? QString() : QStringLiteral(" hidden"), dataOf(bytes, "png"));
        }
        html += "</figure>\n";
    }
    return html + QStringLiteral(
                      "<p class=\"bar\" hidden><button id=\"go\" type=\"button\">Play</button>"
                      "<input id=\"seek\" type=\"range\" min=\"0\" max=\"%1\" value=\"0\" "
                      "aria-label=\"Time\"><output id=\"now\"></output></p>\n</section>\n")
                      .arg(film.times.size() - 1);
}

QString movingFigureHtml(const Figure& figure, int width, int height, const Film& film) {
    const SvgOptions options{width, height, false};
    const QString picture = QStringLiteral("<img alt=\"%1\" width=\"%2\" src=\"%3\">")
                                .arg(escapedText(figure.title), QString::number(width),
                                     dataOf(QByteArray::fromStdString(svgOf(figure, options)), "svg+xml"));
    const std::vector<const Series*> dotted = dottedIn(figure);
    if (film.times.empty() || figure.axes != AxisStyle::scales || isEmpty(figure) ||
        (!figure.x.isTime && dotted.empty()))
        return picture;
    const SvgFrame frame = svgFrame(figure, options);
    QStringList places;
    for (const double t : film.times) places << framePlaces(figure, frame, dotted, t, width, height);
    QString html = QStringLiteral("<div class=\"moving\" data-at=\"%1\">%2").arg(places.join(';'), picture);
    if (figure.x.isTime)
        html += QStringLiteral("<i class=\"line\" hidden style=\"top:%1%;height:%2%\"></i>")
                    .arg(numberText(100 * frame.top / height),
                         numberText(100 * (frame.bottom - frame.top) / height));
    else
        for (const Series* s : dotted)
            html +=
                QStringLiteral("<i class=\"dot\" hidden style=\"background:%1\"></i>")
                    .arg(QLatin1String(lightSeries[static_cast<std::size_t>(s->style) % lightSeries.size()]));
    return html + "</div>";
}

QString playScript() {
    return QStringLiteral(R"js((function () {
  "use strict";
  var play = document.getElementById("play");
  if (!play) return;
  var seek = document.getElementById("seek"), go = document.getElementById("go"), now = document.getElementById("now");
  var from = Number(play.dataset.from), to = Number(play.dataset.to), count = Number(seek.max) + 1;
  var film = document.querySelectorAll("#film img");
  var moving = [].map.call(document.querySelectorAll(".moving"), function (figure) {
    return { at: figure.dataset.at.split(";"), marks: figure.querySelectorAll("i") };
  });
  var shown = 0, plays = false, last = 0, perSecond = 15;
  function show(frame) {
    if (film.length) {
      film[shown].hidden = true;
      film[frame].hidden = false;
    }
    shown = frame;
    moving.forEach(function (figure) {
      var places = figure.at[frame].split(" ");
      [].forEach.call(figure.marks, function (mark, i) {
        var place = (places[i] || "").split(",");
        mark.hidden = place[0] === "";
        mark.style.left = Number(place[0]) + "%";
        if (place.length > 1) mark.style.top = Number(place[1]) + "%";
      });
    });
    seek.value = String(frame);
    now.textContent = "t = " + (from + (to - from) * frame / (count - 1)).toPrecision(4) + " " + play.dataset.unit;
  }
  function setPlaying(on) {
    plays = on;
    go.textContent = on ? "Pause" : "Play";
    if (on && shown === count - 1) show(0);
    last = 0;
    if (on) window.requestAnimationFrame(tick);
  }
  function tick(time) {
    if (!plays) return;
    if (!last) last = time;
    var steps = Math.floor((time - last) * perSecond / 1000);
    if (steps > 0) {
      last += steps * 1000 / perSecond;
      show(Math.min(count - 1, shown + steps));
    }
    if (shown === count - 1) setPlaying(false); else window.requestAnimationFrame(tick);
  }
  go.addEventListener("click", function () { setPlaying(!plays); });
  seek.addEventListener("input", function () { setPlaying(false); show(Number(seek.value)); });
  document.querySelector(".bar").hidden = false;
  show(0);
  if (!window.matchMedia("(prefers-reduced-motion: reduce)").matches) setPlaying(true);
})();
)js");
}

QString pagePolicy() {
    const QByteArray hash = QCryptographicHash::hash(playScript().toUtf8(), QCryptographicHash::Sha256);
    return QStringLiteral(
               "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'sha256-%1'; "
               "base-uri 'none'; form-action 'none'")
        .arg(QString::fromLatin1(hash.toBase64()));
}

QString playStyle() {
    return QStringLiteral(
        "#film img{border:1px solid #dfe3e8;border-radius:8px}.moving{position:relative;display:inline-block}"
        ".line{position:absolute;width:1px;background:#636c78}.dot{position:absolute;width:10px;height:10px;"
        "margin:-6px 0 0 -6px;border:1px solid #fff;border-radius:6px}[hidden]{display:none!important}"
        ".bar{display:flex;gap:12px;align-items:center;max-width:720px;position:sticky;bottom:0;background:#"
        "fff;"
        "padding:8px 0;z-index:1}.bar input{flex:1}.bar "
        "output{min-width:9em;font-variant-numeric:tabular-nums}"
        ".bar button{font:inherit;min-width:5.5em;padding:4px 12px;border-radius:6px;border:1px solid "
        "#c6cbd2;"
        "background:#fff}");
}

}  // namespace extremal
