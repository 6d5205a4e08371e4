/// The command palette: type a few letters, find an action or a preset, Return does it.
#pragma once

#include <QDialog>

class QLineEdit;
class QListWidget;

namespace extremal {

class Actions;

class PaletteDialog : public QDialog {
    Q_OBJECT
public:
    PaletteDialog(const Actions& actions, QWidget* parent);

signals:
    void presetChosen(const QString& name);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void filter(const QString& text);
    void choose();

    const Actions& actions_;
    QLineEdit* input_;
    QListWidget* list_;
};

}  // namespace extremal
