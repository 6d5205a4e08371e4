// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/shell/theme_switch.hpp"

#include <QApplication>
#include <QStyle>
#include <QWidget>

#include "engine/core/thread_clock.hpp"

namespace extremal {
namespace {

constexpr double turnSeconds = 0.01;  // of processor time

}  // namespace

ThemeSwitch::ThemeSwitch(QObject* parent) : QObject(parent) {
    timer_.setInterval(0);
    connect(&timer_, &QTimer::timeout, this, &ThemeSwitch::work);
}

ThemeSwitch::~ThemeSwitch() {
    while (!unpolished_.empty()) polishSome();
    paintAgain();
}

void ThemeSwitch::start(const Theme& theme, const std::vector<std::function<void()>>& parts) {
    for (QWidget* window : QApplication::topLevelWidgets())
        if (window->isVisible() && window->updatesEnabled()) {
            window->setUpdatesEnabled(false);
            windows_.emplace_back(window);
        }
    while (!unpolished_.empty()) polishSome();
    steps_.clear();
    steps_.emplace_back([] { qApp->setStyleSheet(QString()); });
    steps_.emplace_back([this, theme] { setSheet(theme); });
    steps_.insert(steps_.end(), parts.begin(), parts.end());
    timer_.start();
}

void ThemeSwitch::work() {
    const std::function<void()> step = std::move(steps_.front());
    steps_.pop_front();
    step();
    if (!steps_.empty()) return;
    timer_.stop();
    paintAgain();
}

/// Qt gives the rules of a new sheet to all widgets that are polished, within one event: they are marked as
/// not polished, and polished afterwards, some in each turn.
void ThemeSwitch::setSheet(const Theme& theme) {
    for (QWidget* widget : QApplication::allWidgets())
        if (widget->testAttribute(Qt::WA_WState_Polished) && widget->style() == QApplication::style()) {
            widget->setAttribute(Qt::WA_WState_Polished, false);
            unpolished_.emplace_back(widget);
        }
    applyTheme(*qApp, theme);
    steps_.emplace_front([this] { polishSome(); });
}

void ThemeSwitch::polishSome() {
    const double end = threadSeconds() + turnSeconds;
    while (!unpolished_.empty() && threadSeconds() < end) {
        if (QWidget* const widget = unpolished_.back()) {
            widget->setAttribute(Qt::WA_WState_Polished, true);
            widget->style()->polish(widget);
        }
        unpolished_.pop_back();
    }
    if (!unpolished_.empty()) steps_.emplace_front([this] { polishSome(); });
}

void ThemeSwitch::paintAgain() {
    for (const auto& window : windows_)
        if (window) window->setUpdatesEnabled(true);
    windows_.clear();
}

}  // namespace extremal
