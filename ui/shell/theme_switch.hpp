// SPDX-License-Identifier: GPL-3.0-or-later
/// Puts another theme on the windows that are there, in several turns of the event loop, between which the
/// program answers. They are painted again when everything has its new colours.
#pragma once

#include <QObject>
#include <QPointer>
#include <QTimer>

#include <deque>
#include <functional>
#include <vector>

#include "ui/base/theme.hpp"

class QWidget;

namespace extremal {

class ThemeSwitch : public QObject {
    Q_OBJECT
public:
    explicit ThemeSwitch(QObject* parent);
    ~ThemeSwitch() override;
    /// `parts`: of the windows, what draws with the theme itself; each has a turn after the style sheet.
    /// While an earlier switch goes on, this one takes its place.
    void start(const Theme& theme, const std::vector<std::function<void()>>& parts);
    bool isRunning() const { return !steps_.empty(); }

private:
    void work();
    void setSheet(const Theme& theme);
    void polishSome();
    void paintAgain();

    QTimer timer_;
    std::deque<std::function<void()>> steps_;
    std::vector<QPointer<QWidget>> windows_;     ///< that are not painted meanwhile
    std::vector<QPointer<QWidget>> unpolished_;  ///< that do not know the new sheet yet
};

}  // namespace extremal
