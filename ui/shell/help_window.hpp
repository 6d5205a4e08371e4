/// Help: the handbook's pages and the list of keys.
#pragma once

#include <QWidget>

class QListWidget;
class QTextBrowser;

namespace extremal {

class HelpWindow : public QWidget {
    Q_OBJECT
public:
    /// `keys`: Markdown made from the actions.
    explicit HelpWindow(const QString& keys, QWidget* parent = nullptr);
    void open(const QString& page);

private:
    QString keys_;
    QListWidget* pages_;
    QTextBrowser* text_;
};

}  // namespace extremal
