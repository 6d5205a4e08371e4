// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/compare/orbit_finder.hpp"

#include <QPointer>

#include <algorithm>
#include <memory>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/view/catalog.hpp"
#include "ui/base/background.hpp"
#include "ui/base/notices.hpp"
#include "ui/compare/plot_edits.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

const char* const key = "orbit";

/// The largest multiplier that is not 1 by itself.
QString multiplierOf(const PeriodicOrbit& orbit) {
    if (orbit.multipliers.empty()) return {};
    const std::complex<double> largest = orbit.multipliers.front();
    QString text = QString::fromStdString(formatNumber(largest.real(), 4));
    if (largest.imag() != 0)
        text +=
            QStringLiteral(" ± %1i").arg(QString::fromStdString(formatNumber(std::abs(largest.imag()), 4)));
    return text;
}

/// The first section of a scene; null: it has no section.
const View* sectionOf(const Scene& scene) {
    const auto found = std::find_if(scene.views.begin(), scene.views.end(),
                                    [](const View& view) { return keysOf(view.id, nullptr).hasZeros; });
    return found == scene.views.end() ? nullptr : &*found;
}

}  // namespace

struct OrbitFinder::Search {
    Value document;
    OrbitRequest request;
    OrbitAnswer answer;
    QString problem, remedy;  ///< why nothing was found
};

OrbitFinder::OrbitFinder(Workspace& workspace, Notices& notices, QObject* parent)
    : QObject(parent), workspace_(workspace), notices_(notices) {}

OrbitFinder::~OrbitFinder() { stop_.request_stop(); }

bool OrbitFinder::stop() {
    if (!isRunning_) return false;
    stop_.request_stop();
    isRunning_ = false;
    notices_.dismiss(key);
    return true;
}

void OrbitFinder::seek(const std::vector<Edit>& edits) {
    if (!workspace_.hasScene()) return;
    OrbitRequest request;
    if (const int selected = workspace_.selectedScheme(); selected >= 0)
        request.scheme = workspace_.scene().schemes[static_cast<std::size_t>(selected)].label;
    start(withEdits(workspace_.document(), edits), request);
}

void OrbitFinder::start(const Value& document, const OrbitRequest& request) {
    stop_.request_stop();
    stop_ = std::stop_source();
    isRunning_ = true;
    notices_.post(
        {Notice::Kind::information, key, tr("Looking for a periodic orbit ..."), {}, {{tr("Stop"), [this] {
                                                                                           stop();
                                                                                       }}}});
    runInBackground([self = QPointer(this), document, request, stop = stop_.get_token()] {
        auto search = std::make_shared<Search>(Search{document, request, {}, {}, {}});
        try {
            const ReadScene read = readScene(document);
            if (!read.errors.empty()) throw InvalidScene(read.errors);
            search->answer = seekOrbit(*read.resolved, request, stop);
            search->problem = QString::fromStdString(search->answer.problem);
            search->remedy = QString::fromStdString(search->answer.remedy);
        } catch (const InvalidScene& e) {
            search->problem = QString::fromStdString(e.problems().front().message);
            search->remedy = QString::fromStdString(e.problems().front().hint);
        }
        sendToWindow([self, search, stop] {
            if (self && !stop.stop_requested()) self->take(*search);
        });
    });
}

void OrbitFinder::refuse(const QString& reason, const QString& remedy) {
    notices_.post(
        {Notice::Kind::information, key, tr("No periodic orbit: %1.").arg(reason), remedy, {}, "orbits"});
}

void OrbitFinder::take(const Search& search) {
    isRunning_ = false;
    if (!search.problem.isEmpty()) return refuse(search.problem, search.remedy);
    if (!search.answer.isFound()) return refuse(tr("none was found"), {});
    if (search.answer.manifold) {
        std::vector<Edit> edits = editsFor(search.answer);
        const Scene& scene = workspace_.scene();
        const View* const section = sectionOf(scene);
        if (!section) return refuse(tr("the section is not among the plots any more"), {});
        View after = *section;
        after.starts = {};
        for (const auto& [x, y] : search.answer.manifold->starts)
            after.starts.points.push_back({{x, {}}, {y, {}}});
        for (Edit& edit : editsForPlot(scene, *section, after)) edits.push_back(std::move(edit));
        workspace_.edit(edits, tr("Start on a manifold"));
    }
    tell(search);
}

/// What the orbit is in the scene as it is now, which may have been edited since: its start, its end, and the
/// step of its scheme.
std::vector<Edit> OrbitFinder::editsFor(const OrbitAnswer& answer) const {
    std::vector<Edit> edits{{"/initial", *answer.scene.find("initial")},
                            {"/time/end", *answer.scene.find("time")->find("end")}};
    const auto& schemes = workspace_.scene().schemes;
    for (std::size_t i = 0; i < schemes.size(); ++i) {
        if (schemes[i].label != answer.scheme) continue;
        const std::string pointer = "/schemes/" + std::to_string(i);
        edits.push_back({pointer + "/step", answer.orbit->period / static_cast<double>(answer.steps)});
        if (!schemes[i].isEnabled) edits.push_back({pointer + "/enabled", true});
    }
    return edits;
}

/// What was found, and what can be done with it.
void OrbitFinder::tell(const Search& search) {
    const OrbitAnswer& answer = search.answer;
    const PeriodicOrbit& orbit = *answer.orbit;
    Notice notice{Notice::Kind::information, key, {}, {}, {}, "orbits"};
    if (answer.manifold) {
        notice.text = tr("%1 starts on the %2 manifold of the multiplier %3 are in the section.")
                          .arg(answer.manifold->starts.size())
                          .arg(QString::fromStdString(search.request.manifold),
                               QString::fromStdString(formatNumber(answer.manifold->multiplier, 4)));
        notice.choices.push_back({tr("Undo"), [this] { workspace_.undo(); }});
        notices_.post(std::move(notice));
        return;
    }
    notice.text = tr("Periodic orbit of %1: period %2, %3, largest multiplier %4.")
                      .arg(QString::fromStdString(answer.scheme),
                           QString::fromStdString(formatNumber(orbit.period, 10)),
                           QString::fromLatin1(name(answer.stability).data()), multiplierOf(orbit));
    notice.choices.push_back({tr("Start there"), [this, answer] {
                                  workspace_.edit(editsFor(answer), tr("Start on a periodic orbit"));
                              }});
    const bool hasSection = sectionOf(workspace_.scene());
    const bool hasManifolds =
        answer.kind == OrbitKind::conservative && hasSection && answer.stability == OrbitStability::unstable;
    if (hasManifolds)
        for (const auto& [name, text] :
             {std::pair{"unstable", tr("Unstable manifold")}, std::pair{"stable", tr("Stable manifold")}})
            notice.choices.push_back({text, [this, name = std::string(name), search] {
                                          OrbitRequest request = search.request;
                                          request.manifold = name;
                                          start(search.document, request);
                                      }});
    notices_.post(std::move(notice));
}

}  // namespace extremal
