// SPDX-License-Identifier: GPL-3.0-or-later
/// The one view of texts that come from a scene: notes, steps of a lesson, and pages of the engine in which
/// labels of the scene stand. What it shows loads nothing (foreign_text.hpp), and a link opens only after a
/// click that names its target.
#pragma once

#include <QTextBrowser>

namespace extremal {

struct Document;

class TextView : public QTextBrowser {
    Q_OBJECT
public:
    explicit TextView(QWidget* parent = nullptr);

    /// Markdown of a scene, with formulas between dollar signs.
    void showText(const QString& markdown);
    /// A page of the engine; `ending`: Markdown that follows.
    void showPage(const Document& page, const QString& ending = {});
    /// As high as its text, without a frame, in place of a view with bars; higher texts scroll.
    void setFitted(int mostLines);

protected:
    QVariant loadResource(int, const QUrl&) override { return {}; }
    void doSetSource(const QUrl&, QTextDocument::ResourceType) override {}  // links are followLink's
    void resizeEvent(QResizeEvent* event) override;

private:
    void fit();

    int mostLines_ = 0;  ///< 0: it takes the room it gets
};

}  // namespace extremal
