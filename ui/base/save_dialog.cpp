// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/save_dialog.hpp"

#include <QFileInfo>
#include <QMessageBox>
#include <QPointer>
#include <QRegularExpression>

namespace extremal {
namespace {

/// "Picture (*.png);;PDF (*.pdf)" -> png, pdf.
QStringList endingsOf(const QString& filter) {
    static const QRegularExpression ending(QStringLiteral(R"(\*\.(\w+))"));
    QStringList endings;
    for (const QRegularExpressionMatch& match : ending.globalMatch(filter)) endings << match.captured(1);
    return endings;
}

}  // namespace

QString withEnding(const QString& path, const QStringList& endings, const QString& usual) {
    if (path.isEmpty() || endings.contains(QFileInfo(path).suffix(), Qt::CaseInsensitive)) return path;
    return path.endsWith('.') ? path + usual : path + '.' + usual;
}

SaveDialog::SaveDialog(QWidget* parent, const QString& title, const QString& proposal, const QString& filter)
    : QFileDialog(parent, title, {}, filter) {
    setAcceptMode(QFileDialog::AcceptSave);
    setFileMode(QFileDialog::AnyFile);
    selectFile(proposal);
    setDefaultSuffix(chosenEnding());
    connect(this, &QFileDialog::filterSelected, this, &SaveDialog::takeEnding);
}

QString SaveDialog::chosenEnding() const { return endingsOf(selectedNameFilter()).value(0); }

/// Another kind of file was chosen: the name follows it.
void SaveDialog::takeEnding() {
    setDefaultSuffix(chosenEnding());
    const QFileInfo now(selectedFiles().value(0));
    if (endingsOf(nameFilters().join(' ')).contains(now.suffix(), Qt::CaseInsensitive))
        selectFile(now.completeBaseName() + '.' + chosenEnding());
}

QString SaveDialog::path() const {
    return withEnding(selectedFiles().value(0), endingsOf(nameFilters().join(' ')), chosenEnding());
}

QString askForSave(QWidget* parent, const QString& title, const QString& proposal, const QString& filter) {
    // What asks may go away while the dialog is open, and takes it along.
    const QPointer<SaveDialog> dialog(new SaveDialog(parent, title, proposal, filter));
    QString chosen;
    while (dialog->exec() == QDialog::Accepted && dialog) {
        const QString path = dialog->path();
        // The dialog has asked about the name that was typed.
        const bool isAsked = path == dialog->selectedFiles().value(0) || !QFileInfo::exists(path);
        if (isAsked ||
            QMessageBox::question(dialog->parentWidget(), title,
                                  SaveDialog::tr("%1 exists. Replace it?").arg(QFileInfo(path).fileName())) ==
                QMessageBox::Yes)
            chosen = path;
        if (!dialog || !chosen.isEmpty()) break;
    }
    delete dialog;
    return chosen;
}

}  // namespace extremal
