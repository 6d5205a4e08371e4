// SPDX-License-Identifier: GPL-3.0-or-later
/// The user's catalogue as a window: its schemes with what they are, to be added to the scene, renamed,
/// removed, exported and imported. What is wrong in the file is named below the list.
#pragma once

#include <QWidget>

#include <functional>

#include "ui/workspace/own_schemes.hpp"

class QLabel;
class QListWidget;
class QPushButton;

namespace extremal {

class Notices;
class Workspace;

class OwnList : public QWidget {
    Q_OBJECT
public:
    OwnList(Workspace& workspace, Notices& notices, QWidget* parent = nullptr);
    void open();
    /// Adds a scheme to the catalogue under its label, or, where that is taken, with a number; opens the
    /// window with its name to be edited.
    void keep(const Value& scheme);
    /// Files of schemes, of the user's or of others. False, with a notice, if that fails.
    bool importFrom(const QString& file);
    bool exportTo(const QString& file);
    const OwnSchemes& schemes() const { return schemes_; }

private:
    void fill();
    QString current() const;
    /// Changes the catalogue and writes it; a notice says what was wrong.
    bool change(const std::function<void(OwnSchemes&)>& how);
    void addToScene();
    void rename(int row);
    void importDialog();
    void exportDialog();

    Workspace& workspace_;
    Notices& notices_;
    OwnSchemes schemes_;
    QListWidget* list_;
    QLabel* faults_;
    QPushButton *add_, *rename_, *remove_, *export_;
    bool isFilling_ = false;
};

}  // namespace extremal
