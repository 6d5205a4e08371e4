// SPDX-License-Identifier: GPL-3.0-or-later
/// The form of one scheme, unfolded inside its card: what it is, its parameters, its step, its solver. All
/// from descriptors.
#pragma once

#include <QWidget>
#include <string>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/core/settings.hpp"

class QComboBox;
class QLabel;
class QVBoxLayout;

namespace extremal {

class Form;
class TermStrip;
class Workspace;
struct FormField;
struct SchemeSpec;

class SchemeEditor : public QWidget {
    Q_OBJECT
public:
    SchemeEditor(Workspace& workspace, int index, QWidget* parent = nullptr);
    /// The scheme has this place now.
    void setIndex(int index);

signals:
    void closed();

private:
    void refresh();
    void showRefusal();
    void showChoices();
    void rebuild();
    void changeKind(int kind);
    void change(const Value& scheme);
    QComboBox* addChoice(const QString& title, const QString& name);
    void addComposition(std::vector<FormField>& fields) const;
    void addKeep(std::vector<FormField>& fields) const;
    void addImpact(std::vector<FormField>& fields) const;
    void addMonitor(std::vector<FormField>& fields) const;
    std::string signature() const;
    const SchemeSpec& spec() const;
    Settings shownRule() const;
    std::string placeOfRule() const;
    std::string place() const { return "/schemes/" + std::to_string(index_); }

    Workspace& workspace_;
    int index_;
    QComboBox *kind_, *first_, *rule_;
    QWidget* ruleRow_ = nullptr;
    Form* form_;
    TermStrip* terms_;
    QLabel* problem_;
    QVBoxLayout* layout_;
    std::string shown_;
};

}  // namespace extremal
