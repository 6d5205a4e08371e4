// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/study/wishes_edit.hpp"

#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>

#include "engine/scene/resolve.hpp"
#include "engine/study/request.hpp"
#include "ui/base/card.hpp"
#include "ui/base/theme.hpp"

namespace extremal {
namespace {

std::string withoutSpaces(const std::string& text) {
    const auto first = text.find_first_not_of(" \t\n"), last = text.find_last_not_of(" \t\n");
    return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

}  // namespace

std::vector<std::string> wishesIn(const std::string& text) {
    std::vector<std::string> all;
    std::string wish;
    int depth = 0;
    const auto add = [&] {
        if (std::string found = withoutSpaces(wish); !found.empty()) all.push_back(std::move(found));
        wish.clear();
    };
    for (const char c : text) {
        depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (c == ';' || (c == ',' && depth <= 0))
            add();
        else
            wish += c;
    }
    add();
    return all;
}

std::optional<Problem> problemOfWish(const std::string& wish, const ResolvedScene& scene) {
    StudyRequest request;
    request.kind = "cheapest";
    request.wishes = {wish};
    try {
        (void)makeStudy(knownStudy(request), request, &scene, 1);
    } catch (const InvalidScene& e) {
        return e.problems().front();
    }
    return std::nullopt;
}

WishesEdit::WishesEdit(QWidget* parent) : QWidget(parent) {
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setHorizontalSpacing(8);
    grid->setVerticalSpacing(2);
    text_ = new QLineEdit;
    text_->setObjectName("wishes");
    text_->setAccessibleName(tr("Further wishes"));
    text_->setPlaceholderText(tr("energy=1e-6, error.x/own=1e-3"));
    text_->setToolTip(
        tr("Each a metric and the value that it stays below, separated by commas; all must hold. Any column "
           "that a run writes, weights (2*error.x), scales (error.x/own, error.x/3) and sums (rms(error.x, "
           "error.y))."));
    areAlone_ = new QCheckBox(tr("these alone"));
    areAlone_->setToolTip(
        tr("In place of the wanted error of the metric, which otherwise must hold as well"));
    auto* label = makeLabel(tr("further wishes"), "caption");
    label->setBuddy(text_);
    problem_ = makeWrappedLabel({}, "caption");
    problem_->setObjectName("wishesProblem");
    problem_->setProperty("problem", true);
    problem_->hide();
    grid->addWidget(label, 0, 0);
    grid->addWidget(text_, 0, 1);
    grid->addWidget(areAlone_, 0, 2);
    grid->addWidget(problem_, 1, 1, 1, 2);
    grid->setColumnStretch(1, 1);
    connect(text_, &QLineEdit::textEdited, this, [this] { showProblem({}); });
    connect(text_, &QLineEdit::editingFinished, this, &WishesEdit::changed);
}

std::vector<std::string> WishesEdit::wishes() const { return wishesIn(text_->text().toStdString()); }

bool WishesEdit::areAlone() const { return areAlone_->isChecked() && !wishes().empty(); }

QString WishesEdit::problem() const { return problem_->isHidden() ? QString() : problem_->text(); }

bool WishesEdit::check(const ResolvedScene& scene) {
    for (const std::string& wish : wishes())
        if (const std::optional<Problem> wrong = problemOfWish(wish, scene)) {
            showProblem(
                QString::fromStdString(wrong->message + (wrong->hint.empty() ? "" : ": " + wrong->hint)));
            return false;
        }
    showProblem({});
    return true;
}

void WishesEdit::showProblem(const QString& problem) {
    problem_->setText(problem);
    problem_->setVisible(!problem.isEmpty());
    text_->setProperty("invalid", !problem.isEmpty());
    repolish(*text_);
}

}  // namespace extremal
