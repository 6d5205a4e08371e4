// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/windows/folder_dialog.hpp"

#include <QAbstractButton>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/base/card.hpp"

namespace extremal {
namespace {

/// The path itself or the nearest one above it that exists.
QFileInfo existingPart(const QString& path) {
    QString part = QDir::cleanPath(path);
    while (!QFileInfo::exists(part) && part != QFileInfo(part).path()) part = QFileInfo(part).path();
    return QFileInfo(part);
}

}  // namespace

QString problemOfFolder(const QString& path) {
    if (path.trimmed().isEmpty()) return FolderDialog::tr("A folder needs a name.");
    const QFileInfo there = existingPart(path);
    if (!there.isDir()) return FolderDialog::tr("%1 is a file.").arg(there.filePath());
    if (!there.isWritable()) return FolderDialog::tr("%1 cannot be written to.").arg(there.filePath());
    return {};
}

FolderDialog::FolderDialog(const QString& title, const QString& proposed, QWidget* parent) : QDialog(parent) {
    setWindowTitle(title);
    setObjectName("folderDialog");
    constexpr int width = 560;
    setMinimumWidth(width);
    auto* column = new QVBoxLayout(this);
    column->addWidget(makeLabel(title, "title", this));
    auto* row = new QHBoxLayout;
    path_ = new QLineEdit(QDir::toNativeSeparators(proposed), this);
    path_->setObjectName("folder");
    path_->setAccessibleName(tr("Folder"));
    auto* choose = new QPushButton(tr("Browse..."), this);
    choose->setAutoDefault(false);
    row->addWidget(path_, 1);
    row->addWidget(choose);
    column->addLayout(row);
    note_ = makeLabel({}, "caption", this);
    note_->setObjectName("folderNote");
    note_->setWordWrap(true);
    column->addWidget(note_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
    for (QAbstractButton* button : buttons->buttons()) button->setIcon({});
    accept_ = buttons->button(QDialogButtonBox::Ok);
    accept_->setText(tr("Export"));
    column->addWidget(buttons);
    connect(choose, &QPushButton::clicked, this, &FolderDialog::browse);
    connect(path_, &QLineEdit::textChanged, this, &FolderDialog::showNote);
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    showNote();
    path_->selectAll();
}

QString FolderDialog::folder() const {
    return QDir::cleanPath(
        QDir::current().absoluteFilePath(QDir::fromNativeSeparators(path_->text().trimmed())));
}

void FolderDialog::showNote() {
    const QString path = path_->text().trimmed().isEmpty() ? QString() : folder();
    const QString problem = problemOfFolder(path);
    accept_->setEnabled(problem.isEmpty());
    const QFileInfo there(path);
    note_->setText(!problem.isEmpty() ? problem
                   : !there.isDir()   ? tr("This folder will be made.")
                   : QDir(path).isEmpty()
                       ? tr("The folder exists and is empty.")
                       : tr("The folder exists. Files in it that have the names of exported "
                            "ones are replaced."));
}

void FolderDialog::browse() {
    const QString chosen =
        QFileDialog::getExistingDirectory(this, windowTitle(), existingPart(folder()).absoluteFilePath());
    if (!chosen.isEmpty()) path_->setText(QDir::toNativeSeparators(chosen));
}

}  // namespace extremal
