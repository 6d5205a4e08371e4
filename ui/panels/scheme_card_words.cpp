// SPDX-License-Identifier: GPL-3.0-or-later
/// What a row says besides its numbers: warnings, refusals, and why a run failed.
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>

#include <algorithm>
#include <cmath>

#include "engine/scene/outlook/topics.hpp"
#include "ui/base/format.hpp"
#include "ui/base/scrub_label.hpp"
#include "ui/base/theme.hpp"
#include "ui/panels/problem_text.hpp"
#include "ui/panels/scheme_card.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

/// The first warning that concerns a scheme.
const Problem* cautionOf(const std::vector<Problem>& warnings, int index) {
    const std::string place = "/schemes/" + std::to_string(index);
    for (const Problem& p : warnings)
        if (p.pointer == place || p.pointer.starts_with(place + "/")) return &p;
    return nullptr;
}

}  // namespace

/// A warning is shown in the row of its scheme; a remedy is offered, but never applied automatically.
void SchemeCard::showCaution() {
    const Problem* caution = spec().isEnabled ? cautionOf(workspace_.warnings(), index_) : nullptr;
    caution_->setVisible(caution);
    setHelp(*this, caution ? handbookPlace(*caution) : std::string());
    remedy_->setVisible(caution && !caution->remedy.isNull());
    if (!caution) return;
    Problem shown = *caution;
    if (!shown.remedy.isNull()) shown.hint.clear();  // it is on the button
    caution_->setText(problemText(shown, tr("Warning: ")));
    remedy_->setText(tr("Take %1").arg(QString::fromStdString(caution->hint)));
}

void SchemeCard::takeRemedy() {
    const Problem* caution = cautionOf(workspace_.warnings(), index_);
    if (!caution || caution->remedy.isNull()) return;
    const Problem taken = *caution;
    workspace_.edit({{taken.pointer, taken.remedy}}, tr("Take %1").arg(QString::fromStdString(taken.hint)));
}

void SchemeCard::showFailure(const Summary& summary) {
    const bool hasFailed = summary.status == RunStatus::failed;
    const QVariant banner = hasFailed ? QVariant("warning") : QVariant();
    if (property("banner") != banner) {
        setProperty("banner", banner);
        setProperty("card", !hasFailed);
        repolish(*this);
    }
    const bool wasStopped = summary.status == RunStatus::partial;
    failure_->setVisible(hasFailed || wasStopped);
    const std::string& words = hasFailed ? summary.advice : summary.caution;
    advice_->setVisible(!words.empty());
    const std::string place = hasFailed ? handbookPlace(summary.cause) : std::string();
    advice_->setText(QString::fromStdString(words).toHtmlEscaped() + QStringLiteral(" ") +
                     handbookLink(place));
    if (hasFailed) setHelp(*this, place);
    if (wasStopped)
        failure_->setText(std::isfinite(summary.tEnd)
                              ? tr("stopped at t = %1").arg(shortNumber(summary.tEnd, 3))
                              : tr("stopped"));
    if (!hasFailed) return;
    const std::string_view cause = name(summary.cause);
    QString text = QString::fromUtf8(cause.data(), static_cast<qsizetype>(cause.size())).replace('-', ' ');
    if (std::isfinite(summary.failedAt)) text += tr(" at t = %1").arg(shortNumber(summary.failedAt, 3));
    failure_->setText(text);
}

/// A step that was refused stays in its field, marked; the words stand below the name, also those about what
/// was refused in the editor that is closed now.
void SchemeCard::showRefusal() {
    const std::string all = "/schemes/" + std::to_string(index_);
    if (index_ >= static_cast<int>(workspace_.scene().schemes.size())) return;
    const auto& drafts = workspace_.drafts();
    const bool isOwn = !editor_ && std::any_of(drafts.begin(), drafts.end(), [&](const auto& d) {
        return d.first == all || d.first.starts_with(all + "/");
    });
    const Value* const draft = isOwn ? workspace_.draftAt(stepPlace()) : nullptr;
    const bool wasRefused = stepEdit_->property("invalid").toBool();
    if (draft) {
        stepEdit_->setText(fieldText(*draft));
        step_->hide();
        stepEdit_->show();
    } else if (wasRefused) {
        stepEdit_->hide();
        step_->show();
    }
    if (wasRefused != (draft != nullptr)) {
        stepEdit_->setProperty("invalid", draft != nullptr);
        repolish(*stepEdit_);
    }
    refusal_->setVisible(isOwn);
    if (!isOwn) return;
    refusal_->setText(refusalText(workspace_, draft ? stepPlace() : all));
    if (!isSentAway(*this)) workspace_.claimRefusal(all);
}

}  // namespace extremal
