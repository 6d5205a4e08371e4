// SPDX-License-Identifier: GPL-3.0-or-later
/// The command palette: type a few letters, find what to do, Return does it.
#pragma once

#include <QDialog>

#include <functional>
#include <vector>

class QLabel;
class QLineEdit;
class QListWidget;

namespace extremal {

/// Something that can be done.
struct PaletteEntry {
    QString text;  ///< what is searched: "Change stiffness k"
    QString note;  ///< beside it: the key
    bool isEnabled = true;
    std::function<void()> act;
    QString group = {};  ///< above the entries of its kind, while nothing is searched
    QString about = {};  ///< below the list, for the entry that is chosen: what it is for; searched as well
};

class PaletteDialog : public QDialog {
    Q_OBJECT
public:
    /// `prompt`: in the empty field.
    PaletteDialog(std::vector<PaletteEntry> entries, QWidget* parent, const QString& prompt = {});

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void filter(const QString& text);
    void choose();
    void addRow(int entry);
    void addGroup(const QString& name);
    void move(int by);
    void showAbout();

    std::vector<PaletteEntry> entries_;
    struct Sought {
        QString text, about;
    };
    std::vector<Sought> sought_;  ///< of each entry, in the letters of a keyboard
    QLineEdit* input_;
    QListWidget* list_;
    QLabel* about_;
};

}  // namespace extremal
