// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/own/own_list.hpp"

#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QVBoxLayout>

#include "engine/core/text/text.hpp"
#include "engine/run/files/export.hpp"
#include "engine/scene/read/json.hpp"
#include "ui/base/card.hpp"
#include "ui/base/notices.hpp"
#include "ui/base/save_dialog.hpp"
#include "ui/base/tool_window.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

QString reasonOf(const std::exception& e) { return QString::fromUtf8(e.what()); }

/// "typed, nodes": what a scheme is, in a line.
QString kindOf(const Value& scheme) {
    const auto typeOf = [](const Value* part) -> QString {
        if (!part) return {};
        if (part->isString()) return QString::fromStdString(part->asString());
        const Value* type = part->find("type");
        return type && type->isString() ? QString::fromStdString(type->asString())
                                        : QStringLiteral("a rule for each term");
    };
    for (const char* kind : {"baseline", "scheme"})
        if (scheme.find(kind)) return typeOf(scheme.find(kind));
    const QString rule = typeOf(scheme.find("quadrature"));
    return typeOf(scheme.find("space")) + (rule.isEmpty() ? QString() : " × " + rule);
}

}  // namespace

OwnList::OwnList(Workspace& workspace, Notices& notices, QWidget* parent)
    : QWidget(parent, Qt::Window), workspace_(workspace), notices_(notices) {
    setObjectName("ownSchemes");
    setWindowTitle(tr("Your schemes"));
    setProperty("ground", "window");
    resize(480, 420);
    closeOnEscape(*this);
    auto* column = new QVBoxLayout(this);
    list_ = new QListWidget;
    list_->setObjectName("ownNamesList");
    list_->setAccessibleName(tr("Your schemes"));
    list_->setEditTriggers(QAbstractItemView::EditKeyPressed);
    column->addWidget(list_, 1);
    faults_ = makeLabel({}, "problem");
    faults_->setObjectName("ownFaults");
    faults_->setWordWrap(true);
    faults_->setTextFormat(Qt::PlainText);
    column->addWidget(faults_);
    auto* row = new QHBoxLayout;
    const auto addButton = [&](const QString& text, const char* name, auto act) {
        auto* button = new QPushButton(text);
        button->setObjectName(name);
        row->addWidget(button);
        connect(button, &QPushButton::clicked, this, act);
        return button;
    };
    add_ = addButton(tr("Add to the scene"), "ownAdd", [this] { addToScene(); });
    rename_ = addButton(tr("Rename"), "ownRename", [this] { list_->editItem(list_->currentItem()); });
    remove_ = addButton(tr("Remove"), "ownRemove", [this] {
        const std::string name = current().toStdString();
        change([&](OwnSchemes& all) { all.remove(name); });
    });
    row->addStretch();
    addButton(tr("Import..."), "ownImport", [this] { importDialog(); });
    export_ = addButton(tr("Export..."), "ownExport", [this] { exportDialog(); });
    column->addLayout(row);
    connect(list_, &QListWidget::itemChanged, this,
            [this](QListWidgetItem* item) { rename(list_->row(item)); });
    connect(list_, &QListWidget::itemActivated, this, [this] { addToScene(); });
    connect(list_, &QListWidget::currentRowChanged, this, [this](int at) {
        for (QPushButton* button : {add_, rename_, remove_, export_}) button->setEnabled(at >= 0);
    });
}

void OwnList::open() {
    fill();
    show();
    raise();
    activateWindow();
}

QString OwnList::current() const {
    return list_->currentItem() ? list_->currentItem()->data(Qt::UserRole).toString() : QString();
}

void OwnList::fill() {
    const QString before = current();
    isFilling_ = true;
    list_->clear();
    QStringList faults;
    try {
        schemes_ = OwnSchemes::load(ownSchemesFile());
        for (const Problem& p : schemes_.faults())
            faults << QString::fromStdString(ownSchemesFile() + ":" + p.pointer + ": " + p.message);
    } catch (const InvalidScene& e) {
        schemes_ = {};
        faults << reasonOf(e);
    }
    for (const std::string& name : schemes_.names()) {
        auto* item = new QListWidgetItem(QString::fromStdString(name), list_);
        item->setData(Qt::UserRole, QString::fromStdString(name));
        item->setToolTip(kindOf(*schemes_.find(name)));
        item->setFlags(item->flags() | Qt::ItemIsEditable);
        if (item->text() == before) list_->setCurrentItem(item);
    }
    if (!list_->currentItem() && list_->count() > 0) list_->setCurrentRow(0);
    if (faults.isEmpty() && list_->count() == 0)
        faults << tr("Nothing is kept yet. \"Keep\" in the editor of a space and a rule puts it here.");
    faults_->setText(faults.join('\n'));
    faults_->setVisible(!faults.isEmpty());
    for (QPushButton* button : {add_, rename_, remove_, export_}) button->setEnabled(list_->currentItem());
    isFilling_ = false;
}

bool OwnList::change(const std::function<void(OwnSchemes&)>& how) {
    QString reason;
    try {
        OwnSchemes next = OwnSchemes::load(ownSchemesFile());  // another window may have changed it
        how(next);
        next.save(ownSchemesFile());
    } catch (const std::exception& e) {
        reason = reasonOf(e);
    }
    if (!reason.isEmpty())
        notices_.post({Notice::Kind::error,
                       QStringLiteral("ownSchemes"),
                       tr("Your catalogue of schemes was not changed"),
                       reason,
                       {}});
    fill();
    return reason.isEmpty();
}

void OwnList::keep(const Value& scheme) {
    const Value* const label = scheme.find("label");
    const std::string wish = label && label->isString() ? label->asString() : "my scheme";
    std::string name;
    const bool isKept = change([&](OwnSchemes& all) {
        name = wish;
        for (int k = 2; all.find(name); ++k) name = wish + " (" + std::to_string(k) + ")";
        all.add(name, scheme);
    });
    open();
    for (int i = 0; isKept && i < list_->count(); ++i)
        if (list_->item(i)->text().toStdString() == name) {
            list_->setCurrentRow(i);
            list_->editItem(list_->item(i));
        }
}

void OwnList::rename(int row) {
    if (isFilling_ || row < 0) return;
    const std::string name = list_->item(row)->data(Qt::UserRole).toString().toStdString(),
                      next = list_->item(row)->text().trimmed().toStdString();
    if (name == next) return;
    // The list is made anew, which it cannot be while an editor of it is open.
    QMetaObject::invokeMethod(
        this, [=, this] { change([&](OwnSchemes& all) { all.rename(name, next); }); }, Qt::QueuedConnection);
}

void OwnList::addToScene() {
    const Value* const scheme = schemes_.find(current().toStdString());
    if (!scheme || !workspace_.hasScene()) return;
    const QString name = current();
    const std::vector<Problem> problems = workspace_.tryEdit(
        editsForAdding(workspace_.scene(), newOwn(workspace_.scene(), *scheme)), tr("Add %1").arg(name));
    if (problems.empty())
        return workspace_.selectScheme(static_cast<int>(workspace_.scene().schemes.size()) - 1);
    notices_.post({Notice::Kind::error,
                   QStringLiteral("ownSchemes"),
                   tr("%1 cannot be used in this scene").arg(name),
                   QString::fromStdString(problems.front().message),
                   {}});
}

bool OwnList::importFrom(const QString& file) {
    return change([&](OwnSchemes& all) {
        const OwnSchemes other = OwnSchemes::load(file.toStdString());
        if (!other.faults().empty()) throw InvalidScene(other.faults());
        all.import(other);
    });
}

bool OwnList::exportTo(const QString& file) {
    try {
        schemes_.only(current().toStdString()).save(file.toStdString());
        return true;
    } catch (const std::exception& e) {
        notices_.post({Notice::Kind::error,
                       QStringLiteral("ownSchemes"),
                       tr("%1 was not saved").arg(file),
                       reasonOf(e),
                       {}});
        return false;
    }
}

void OwnList::importDialog() {
    const QString file = QFileDialog::getOpenFileName(this, tr("Import schemes"), {}, tr("Schemes (*.json)"));
    if (!file.isEmpty()) importFrom(file);
}

void OwnList::exportDialog() {
    const QString file =
        askForSave(this, tr("Export the scheme"),
                   QString::fromStdString(slug(current().toStdString())) + ".json", tr("Schemes (*.json)"));
    if (file.isEmpty()) return;
    exportTo(file);
}

}  // namespace extremal
