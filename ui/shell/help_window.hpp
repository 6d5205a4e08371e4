/// Help: the handbook's pages, in the order in which its index links to them.
#pragma once

#include <QWidget>

class QListWidget;
class QTextBrowser;

namespace extremal {

class HelpWindow : public QWidget {
    Q_OBJECT
public:
    explicit HelpWindow(QWidget* parent = nullptr);
    void open(const QString& page);

private:
    QListWidget* pages_;
    QTextBrowser* text_;
};

}  // namespace extremal
