// SPDX-License-Identifier: GPL-3.0-or-later
/// The editor of a discretization of one's own: its functions, knots, nodes and weights as text, and beside
/// it, while one types, what they make of a step (discretization_sketch.hpp). Nothing changes in the scene
/// before "Apply".
#pragma once

#include <QTimer>
#include <QWidget>

#include <memory>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/figure/discretization_sketch.hpp"
#include "engine/inspect/written_scheme.hpp"

class QComboBox;
class QLabel;
class QPushButton;

namespace extremal {

class Card;
class FormulaEdit;
class Notices;
class PlotWidget;
struct Theme;
class Workspace;

class OwnWindow : public QWidget {
    Q_OBJECT
public:
    OwnWindow(Workspace& workspace, Notices& notices, const Theme& theme, QWidget* parent = nullptr);
    ~OwnWindow() override;
    /// Shows the selected scheme, written down where that can be; else an example, which says so.
    void open();
    void setTheme(const Theme& theme);
    /// What is typed, as a scheme of the scene.
    Value scheme() const;
    /// Whether what is shown is what is typed, with its measured order.
    bool isCurrent() const { return isCurrent_; }
    const DiscretizationSketch& sketch() const { return sketch_; }

signals:
    void keepRequested(const Value& scheme);  ///< in the user's catalogue

private:
    using Fields = std::vector<std::pair<QLabel*, FormulaEdit*>>;  ///< with their captions

    void makeForm();
    QComboBox* addChoice(const QString& caption, const char* name);
    FormulaEdit* addText(Fields& fields, const QString& caption, const char* name, const QString& example);
    void addButtons();
    void fill();
    void fillRules();
    void changed();
    void compute();
    void show(DiscretizationSketch sketch, const QString& measured, bool isComplete);
    void apply();
    Value typedSpace() const;
    Value typedRule() const;

    Workspace& workspace_;
    Notices& notices_;
    QWidget* form_;
    QLabel *whose_, *example_, *facts_, *measured_, *problem_;
    QComboBox *space_, *rule_;
    FormulaEdit *functions_, *names_, *knots_, *nodes_, *weights_;
    QPushButton *apply_, *keep_;
    PlotWidget* plots_[4];
    Card* cards_[4];  ///< of the plots
    Fields ofSpace_, ofRule_;
    QTimer delay_;
    Value original_;  ///< the scheme as the scene has it
    Value opened_;    ///< what the fields said when they were filled
    WrittenScheme written_;
    int index_ = -1;
    DiscretizationSketch sketch_;
    std::stop_source stop_{std::nostopstate};
    bool isCurrent_ = false, isFilling_ = false, isSpaceWritten_ = false, isRuleWritten_ = false;
};

}  // namespace extremal
