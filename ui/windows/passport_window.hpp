// SPDX-License-Identifier: GPL-3.0-or-later
/// The passport of a scheme as a page beside the window, with the pages and programs that can be saved from
/// it.
#pragma once

#include <QWidget>

#include <memory>
#include <stop_token>

class QLabel;
class QPushButton;

namespace extremal {

struct Document;
struct ResolvedScene;
class Notices;
class TextView;
class Workspace;

class PassportWindow : public QWidget {
    Q_OBJECT
public:
    PassportWindow(Workspace& workspace, Notices& notices, QWidget* parent = nullptr);
    ~PassportWindow() override;
    /// Shows that of the selected scheme, or of the first one: at once without what is measured, which
    /// follows.
    void open();
    /// The page in the format of the file's ending (.md, .html, .tex), or the scheme as a program (.cpp,
    /// .py).
    bool saveAs(const QString& path);
    bool isComplete() const { return isComplete_; }

private:
    void show(const Document& page, bool isComplete);
    void saveDialog(const QString& title, const QString& kinds, const QString& ending);

    Workspace& workspace_;
    Notices& notices_;
    TextView* text_;
    QPushButton *savePage_, *saveProgram_;
    std::shared_ptr<const ResolvedScene> scene_;
    std::shared_ptr<const Document> page_;
    std::size_t scheme_ = 0;
    std::stop_source stop_{std::nostopstate};
    bool isComplete_ = false;
};

}  // namespace extremal
