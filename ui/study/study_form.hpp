// SPDX-License-Identifier: GPL-3.0-or-later
/// What study is wanted: its kind, and what this kind needs besides the scene.
#pragma once

#include "ui/base/card.hpp"
#include "ui/study/study_job.hpp"

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;

namespace extremal {

struct StudyEntry;
class MetricBox;
class VariedNumberEdit;
class WishesEdit;

class StudyForm : public Card {
    Q_OBJECT
public:
    explicit StudyForm(QWidget* parent = nullptr);

    const StudyEntry& chosen() const;
    void choose(const char* study);
    void openChoices();
    /// The metrics and numbers that the scene has.
    void offer(const ResolvedScene& resolved);
    /// The study as it is chosen. Throws InvalidScene where the options do not fit the scene.
    Study study(const ResolvedScene& resolved, double wantedError) const;
    void showState(const StudyJob& job, const QString& text);
    /// Whether all wishes can be measured in the scene; what is wrong with one stands below their field.
    bool checkWishes(const ResolvedScene& resolved);

signals:
    void runRequested();
    void chosenChanged();
    void wishesChanged();

private:
    void showOptions();
    void addCases();
    Study search(const ResolvedScene& resolved, double wantedError) const;

    QComboBox *kind_, *of_;
    MetricBox* metric_;
    QLabel *metricLabel_, *overLabel_, *state_;
    QCheckBox *isAtEnd_, *findsLimits_, *areAll_;
    QLineEdit* over_;
    VariedNumberEdit *x_, *y_;
    WishesEdit* wishes_;
    QPushButton* run_;
    QProgressBar* progress_;
};

}  // namespace extremal
