// SPDX-License-Identifier: GPL-3.0-or-later
/// Help: the handbook's pages, in the order in which its index links to them, with a search through all of
/// them, the way back, and links that open the presets which a page names.
#pragma once

#include <QStringList>
#include <QTextCursor>
#include <QWidget>

#include <vector>

class QLabel;
class QLineEdit;
class QListWidget;
class QPushButton;
class QTextBrowser;
class QUrl;

namespace extremal {

class HelpWindow : public QWidget {
    Q_OBJECT
public:
    explicit HelpWindow(QWidget* parent = nullptr);
    /// A page, or a heading of it: "tour", "scenes#time".
    void open(const QString& place);
    QString page() const;
    void back();
    void forward();
    void search(const QString& text);
    void focusSearch();

signals:
    void presetRequested(const QString& id);

private:
    struct Place {
        QString page;
        int scroll = 0;
    };
    void goTo(const QString& place);
    void showPage(const QString& page);
    void follow(const QUrl& url);
    void filter();
    void mark(const QStringList& words);
    QTextCursor nextMark(int position) const;
    void findNext();
    void leave();  ///< remembers where the reader is
    void go(int by);

    QLineEdit* search_;
    QLabel* found_;
    QListWidget* pages_;
    QTextBrowser* text_;
    QPushButton *back_, *forward_;
    std::vector<Place> places_;
    int at_ = -1;
};

/// A page with links to the presets that it names: preset:NAME in code, and names after "preset".
QString withPresetLinks(const QString& markdown);

/// The page for a widget: the property "help" of it, or of the nearest one around it; else that of the other
/// widget, or the index.
QString helpPageOf(const QWidget* widget, const QWidget* otherwise = nullptr);

}  // namespace extremal
