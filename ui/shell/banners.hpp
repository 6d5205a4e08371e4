// SPDX-License-Identifier: GPL-3.0-or-later
/// The banners above the content: notices with a text, a hint, choices, and a way to dismiss them.
#pragma once

#include <QStringList>
#include <QWidget>

class QVBoxLayout;

namespace extremal {

class Notices;

class Banners : public QWidget {
    Q_OBJECT
public:
    explicit Banners(Notices& notices, QWidget* parent = nullptr);

private:
    void rebuild();

    Notices& notices_;
    QVBoxLayout* layout_;
    QStringList said_;  ///< by the banners that are shown
};

}  // namespace extremal
