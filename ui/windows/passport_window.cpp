// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/windows/passport_window.hpp"

#include <QHBoxLayout>
#include <QPointer>
#include <QPushButton>
#include <QScrollBar>
#include <QVBoxLayout>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/passport/passport.hpp"
#include "engine/passport/program.hpp"
#include "engine/run/files/export.hpp"
#include "ui/base/background.hpp"
#include "ui/base/notices.hpp"
#include "ui/base/save_dialog.hpp"
#include "ui/base/tool_window.hpp"
#include "ui/text/text_view.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

PassportWindow::PassportWindow(Workspace& workspace, Notices& notices, QWidget* parent)
    : QWidget(parent, Qt::Window), workspace_(workspace), notices_(notices) {
    setObjectName("passport");
    resize(860, 720);
    closeOnEscape(*this);
    auto* layout = new QVBoxLayout(this);
    text_ = new TextView(this);
    text_->setAccessibleName(tr("Passport of the scheme"));
    layout->addWidget(text_);
    auto* row = new QHBoxLayout;
    savePage_ = new QPushButton(tr("Save page..."), this);
    saveProgram_ = new QPushButton(tr("Save program..."), this);
    saveProgram_->setToolTip(tr("The scheme and the equations of the system as one C++ or Python file."));
    row->addStretch();
    row->addWidget(savePage_);
    row->addWidget(saveProgram_);
    layout->addLayout(row);
    connect(savePage_, &QPushButton::clicked, this, [this] {
        saveDialog(tr("Save the page"), tr("LaTeX (*.tex);;HTML (*.html);;Markdown (*.md)"),
                   QStringLiteral("tex"));
    });
    connect(saveProgram_, &QPushButton::clicked, this, [this] {
        saveDialog(tr("Save the program"), tr("C++ (*.cpp);;Python (*.py)"), QStringLiteral("cpp"));
    });
}

PassportWindow::~PassportWindow() { stop_.request_stop(); }

void PassportWindow::open() {
    if (!workspace_.hasScene() || workspace_.scene().schemes.empty()) return;
    stop_.request_stop();
    stop_ = std::stop_source();
    scheme_ = static_cast<std::size_t>(std::max(0, workspace_.selectedScheme()));
    try {
        scene_ = workspace_.resolved();
        show(passportOf(*scene_, scheme_, {.isMeasured = false}), false);
    } catch (const InvalidScene& e) {
        notices_.post({Notice::Kind::error,
                       QStringLiteral("passport"),
                       tr("There is no passport of this scheme"),
                       QString::fromUtf8(e.what()),
                       {}});
        return;
    }
    QWidget::show();
    raise();
    activateWindow();
    runInBackground([self = QPointer(this), scene = scene_, scheme = scheme_, stop = stop_.get_token()] {
        const auto page = std::make_shared<const Document>(passportOf(*scene, scheme, {}, stop));
        sendToWindow([self, page, stop] {
            if (self && !stop.stop_requested()) self->show(*page, true);
        });
    });
}

void PassportWindow::show(const Document& page, bool isComplete) {
    page_ = std::make_shared<const Document>(page);
    isComplete_ = isComplete;
    setWindowTitle(tr("Passport: %1").arg(QString::fromStdString(page.title)));
    const int place = text_->verticalScrollBar()->value();
    text_->showPage(page, isComplete ? QString() : tr("\n*Orders and costs are being measured ...*\n"));
    text_->verticalScrollBar()->setValue(place);
}

bool PassportWindow::saveAs(const QString& path) {
    try {
        std::string text;
        if (path.endsWith(".cpp") || path.endsWith(".py"))
            text = programOf(*scene_, scheme_,
                             path.endsWith(".py") ? ProgramLanguage::python : ProgramLanguage::cpp);
        else
            text = writtenForFile(*page_, path.endsWith(".html")  ? PageFormat::html
                                          : path.endsWith(".tex") ? PageFormat::latex
                                                                  : PageFormat::markdown);
        writeFile(path.toStdString(), text, {.isForced = true});  // the dialog has asked
        return true;
    } catch (const std::exception& e) {
        notices_.post({Notice::Kind::error,
                       QStringLiteral("passport"),
                       tr("%1 was not saved").arg(path),
                       QString::fromUtf8(e.what()),
                       {}});
        return false;
    }
}

void PassportWindow::saveDialog(const QString& title, const QString& kinds, const QString& ending) {
    if (!page_) return;
    const QString path =
        askForSave(this, title, QString::fromStdString(slug(page_->title)) + "." + ending, kinds);
    if (!path.isEmpty()) saveAs(path);
}

}  // namespace extremal
