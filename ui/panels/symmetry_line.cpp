// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/symmetry_line.hpp"

#include <QApplication>
#include <QPointer>

#include "engine/core/library_exceptions.hpp"
#include "engine/core/problem.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/symmetry/symmetry.hpp"
#include "ui/base/background.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

constexpr int debounceMs = 250;

/// Empty where a Lagrangian in coordinates is not all that moves the system.
std::string textFor(const System& system) {
    if (!system.isMovedOnlyBy<Mechanical>()) return {};
    try {
        return contained("/model", [&] { return symmetryText(system); });
    } catch (const InvalidScene&) {
        return {};
    }
}

}  // namespace

SymmetryLine::SymmetryLine(Workspace& workspace, QWidget* parent) : QLabel(parent), workspace_(workspace) {
    setObjectName("symmetries");
    setProperty("role", "body");
    setAccessibleName(tr("Symmetries of the Lagrangian"));
    setToolTip(
        tr("The affine symmetries of the Lagrangian. Noether's theorem gives each a momentum, which the "
           "observable momentum measures. Handbook: What is kept, and how one sees it."));
    setWordWrap(true);
    setTextFormat(Qt::PlainText);
    setTextInteractionFlags(Qt::TextSelectableByMouse);
    hide();
    debounce_.setSingleShot(true);
    debounce_.setInterval(debounceMs);
    connect(&debounce_, &QTimer::timeout, this, &SymmetryLine::search);
    connect(&workspace_, &Workspace::sceneChanged, &debounce_, qOverload<>(&QTimer::start));
}

void SymmetryLine::search() {
    if (!workspace_.hasScene() || workspace_.scene().model == shown_) return;
    runInBackground(
        [self = QPointer(this), model = workspace_.scene().model, system = workspace_.resolved()->system] {
            const QString text = QString::fromStdString(textFor(*system));
            sendToWindow([self, model, text] {
                if (self) self->take(model, text);
            });
        });
}

void SymmetryLine::take(const Settings& model, const QString& text) {
    if (!workspace_.hasScene() || !(workspace_.scene().model == model)) return;
    shown_ = model;
    setText(tr("Symmetries: %1").arg(text));
    setVisible(!text.isEmpty());
}

}  // namespace extremal
