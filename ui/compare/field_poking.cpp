// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/compare/field_poking.hpp"

#include <QKeyEvent>
#include <QMouseEvent>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "ui/compare/profile_drawing.hpp"
#include "ui/stage/camera.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

/// The values of u in a sample: where they begin, and the place of each.
struct Displaced {
    std::size_t first = 0;
    std::vector<std::array<double, 2>> places;
};

Displaced displacedOf(const FieldSampling& field) {
    if (!field.furtherNodes.empty()) return {field.places() * field.components.size(), field.furtherNodes};
    Displaced u;
    if (field.y.empty())
        for (const double x : field.x) u.places.push_back({x, 0});
    for (const double y : field.y)
        for (const double x : field.x) u.places.push_back({x, y});
    return u;
}

/// Of an axis: its length, and its period if it has one.
struct Side {
    double length, period;
};

Side sideOf(const std::vector<double>& nodes, const FieldSampling::Interval& interval, double period) {
    const auto [low, high] = std::minmax_element(nodes.begin(), nodes.end());
    const double length = interval.length > 0 ? interval.length : *high - *low;
    return {length, period};
}

/// The place in the plane u = 0 that a pixel shows, where the graph stands in space: height is along the
/// second axis there, y along the third.
std::optional<PokedPlace> placeInSpace(const Camera& camera, double px, double py) {
    const Point at = camera.unproject(px, py), towards = camera.axes()[2];
    if (std::abs(towards[1]) < 0.05) return {};  // seen from the side
    const double along = -at[1] / towards[1];
    return PokedPlace{at[0] + along * towards[0], at[2] + along * towards[2], {}};
}

}  // namespace

bool canBePoked(const System& system) {
    const std::vector<std::string>& names = system.field.components;
    return system.field.initial && system.draw && names.size() > 1 && names[names.size() / 2].ends_with("_t");
}

StartEdits editsForPoke(const System& system, const SchemeResult& result, double t, const PokedPlace& place) {
    const FieldSampling& field = system.field;
    const std::vector<double>* const sample = sampleAt(system, result, t);
    if (!sample) return withoutState(result);
    std::vector<double> values = *sample;
    const Displaced u = displacedOf(field);
    const bool isPlane = !field.y.empty(), isPeriodicPlane = isPlane && field.across.length > 0;
    const Side along = sideOf(field.x, field.along, isPeriodicPlane ? field.along.length : field.period);
    const Side across =
        isPlane ? sideOf(field.y, field.across, isPeriodicPlane ? field.across.length : 0) : along;
    const double width = std::min(along.length, across.length) / 25;
    const auto apart = [](double d, double period) { return period > 0 ? std::remainder(d, period) : d; };
    const auto distance = [&](std::size_t i) {
        return std::hypot(apart(u.places[i][0] - place.x, along.period),
                          apart(u.places[i][1] - place.y, across.period));
    };
    double largest = 0, nearest = std::numeric_limits<double>::infinity(), there = 0;
    for (std::size_t i = 0; i < u.places.size(); ++i) {
        const double value = values[u.first + i];
        largest = std::max(largest, std::abs(value));
        if (distance(i) < nearest) nearest = distance(i), there = value;
    }
    if (!(nearest < 3 * width)) return {{}, QObject::tr("the field is not there")};
    const double height = place.u ? *place.u - there : largest > 0 ? largest : 1;
    for (std::size_t i = 0; i < u.places.size(); ++i)
        if (!field.isHeld || !field.isHeld(i))
            values[u.first + i] += height * std::exp(-std::pow(distance(i) / width, 2) / 2);
    return {{{"/initial", field.initial(values)}}, {}};
}

FieldPoking::FieldPoking(Workspace& workspace, RunControl& run, Playback& playback, StageWidget& stage,
                         QObject* parent)
    : QObject(parent), workspace_(workspace), run_(run), playback_(playback), stage_(stage) {
    stage_.installEventFilter(this);
    connect(&workspace_, &Workspace::opened, this, [this] { setOn(false); });
}

void FieldPoking::setOn(bool isOn) {
    if (std::exchange(isOn_, isOn) != isOn) emit onChanged(isOn);
}

const System* FieldPoking::system() const {
    const auto results = run_.results();
    if (!results || !results->system || !workspace_.hasScene()) return nullptr;
    const bool isOfScene = results->scene.model == workspace_.scene().model;
    return isOfScene && canBePoked(*results->system) ? results->system.get() : nullptr;
}

void FieldPoking::pokeAt(QPointF at) {
    const auto results = run_.results();
    const System* const poked = system();
    if (!poked || results->schemes.empty()) return emit refused(tr("no field of this scene can be poked"));
    if (stage_.isSideBySide()) return emit refused(tr("fields are poked where the schemes are together (B)"));
    const double px = at.x() - stage_.width() / 2.0, py = stage_.height() / 2.0 - at.y();
    std::optional<PokedPlace> place;
    if (poked->isSpatial) {
        place = placeInSpace(stage_.camera(), px, py);
    } else {
        const Point r = stage_.camera().unproject(px, py);
        const bool isGraph = poked->field.y.empty();
        place = PokedPlace{r[0], isGraph ? 0 : r[1], {}};
        if (const double unit = isGraph ? heightOfOne(*poked) : 0; unit > 0) place->u = r[1] / unit;
    }
    if (!place) return emit refused(tr("the field is seen from the side: turn it first"));
    const StartEdits start =
        editsForPoke(*poked, resultToStartFrom(workspace_, *results), playback_.time(), *place);
    if (!start.problem.isEmpty()) return emit refused(start.problem);
    const bool wasPlaying = playback_.isPlaying();
    playback_.setPlaying(false);
    if (!workspace_.edit(start.edits, tr("Poke the field"))) return;
    playback_.setTime(playback_.start());
    playback_.setPlaying(wasPlaying);
}

/// Clicks of the left button, and Enter for the middle of the stage. A mouse that has moved has turned or
/// moved the picture.
bool FieldPoking::eventFilter(QObject* watched, QEvent* event) {
    const bool isPress = event->type() == QEvent::MouseButtonPress,
               isRelease = event->type() == QEvent::MouseButtonRelease,
               isKey = event->type() == QEvent::KeyPress && isOn_;
    // Results must not be asked for at other events: some come while the window is destroyed.
    if (watched != &stage_ || !(isPress || isRelease || isKey) || !system()) return false;
    if (isKey) {
        const int key = static_cast<QKeyEvent*>(event)->key();
        if (key != Qt::Key_Return && key != Qt::Key_Enter) return false;
        pokeAt(QRectF(stage_.rect()).center());
        return true;
    }
    const auto* const mouse = static_cast<QMouseEvent*>(event);
    if (mouse->button() != Qt::LeftButton) return false;
    if (isPress) {
        const bool isMeant = isOn_ || mouse->modifiers() == Qt::ShiftModifier;
        pressed_ = isMeant ? std::optional(mouse->position()) : std::nullopt;
        return false;
    }
    constexpr double still = 4;  // pixels
    if (const auto from = std::exchange(pressed_, std::nullopt);
        from && (mouse->position() - *from).manhattanLength() <= still)
        pokeAt(*from);
    return false;
}

}  // namespace extremal
