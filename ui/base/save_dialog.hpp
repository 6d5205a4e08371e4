// SPDX-License-Identifier: GPL-3.0-or-later
/// Asks for the name of a file that is to be written. The name ends as the kind of file does, whatever was
/// typed, and it is this whole name of which the user is asked whether it may be replaced.
#pragma once

#include <QFileDialog>

namespace extremal {

class SaveDialog : public QFileDialog {
    Q_OBJECT
public:
    /// `filter`: "Scenes (*.json)", or several with ";;"; the first is chosen.
    SaveDialog(QWidget* parent, const QString& title, const QString& proposal, const QString& filter);
    /// What was chosen, with its ending.
    QString path() const;

private:
    QString chosenEnding() const;
    void takeEnding();
};

/// The path, or empty: the user wants none.
QString askForSave(QWidget* parent, const QString& title, const QString& proposal, const QString& filter);

/// The path with one of the endings: "mine" and "mine.v2" get the usual one, "mine.JSON" has one.
QString withEnding(const QString& path, const QStringList& endings, const QString& usual);

}  // namespace extremal
