// SPDX-License-Identifier: GPL-3.0-or-later
/// Asks for a folder to write into. It need not exist: the dialog says what will be made, and accepts only a
/// place at which a folder can be.
#pragma once

#include <QDialog>

class QLabel;
class QLineEdit;
class QPushButton;

namespace extremal {

/// Why no folder can be at the path; empty: it is there and writable, or can be made.
QString problemOfFolder(const QString& path);

class FolderDialog : public QDialog {
    Q_OBJECT
public:
    FolderDialog(const QString& title, const QString& proposed, QWidget* parent);
    /// Absolute; it may not exist yet.
    QString folder() const;

private:
    void showNote();
    void browse();

    QLineEdit* path_;
    QLabel* note_;
    QPushButton* accept_;
};

}  // namespace extremal
