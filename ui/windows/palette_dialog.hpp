// SPDX-License-Identifier: GPL-3.0-or-later
/// The command palette: type a few letters, find what to do, Return does it.
#pragma once

#include <QDialog>

#include <functional>
#include <vector>

class QLineEdit;
class QListWidget;

namespace extremal {

/// Something that can be done.
struct PaletteEntry {
    QString text;  ///< what is searched: "Change stiffness k"
    QString note;  ///< beside it: the key
    bool isEnabled = true;
    std::function<void()> act;
};

class PaletteDialog : public QDialog {
    Q_OBJECT
public:
    PaletteDialog(std::vector<PaletteEntry> entries, QWidget* parent);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void filter(const QString& text);
    void choose();

    std::vector<PaletteEntry> entries_;
    QLineEdit* input_;
    QListWidget* list_;
};

}  // namespace extremal
