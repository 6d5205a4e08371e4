// SPDX-License-Identifier: GPL-3.0-or-later
/// Joint wishes as a line of text, in the words of the command line:
///
///     energy=1e-6, error.theta=1e-3, rms(2*error.x/own, error.y/own)=1e-4
///
/// Each is a metric and the value that it stays below. What is wrong with one stands below the line.
#pragma once

#include <QWidget>

#include <optional>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"

class QCheckBox;
class QLabel;
class QLineEdit;

namespace extremal {

struct ResolvedScene;

/// The wishes of a text: separated by commas outside parentheses, or by semicolons.
std::vector<std::string> wishesIn(const std::string& text);
/// What is wrong with one of them in this scene, by the check of the command line; nothing where it is right.
std::optional<Problem> problemOfWish(const std::string& wish, const ResolvedScene& scene);

class WishesEdit : public QWidget {
    Q_OBJECT
public:
    explicit WishesEdit(QWidget* parent = nullptr);

    std::vector<std::string> wishes() const;
    /// Whether they stand in place of the wanted error, and do not join it.
    bool areAlone() const;
    /// Shows what is wrong with the first that is; false if one is.
    bool check(const ResolvedScene& scene);
    QString problem() const;

signals:
    void changed();  ///< another text was entered

private:
    void showProblem(const QString& problem);

    QLineEdit* text_;
    QCheckBox* areAlone_;
    QLabel* problem_;
};

}  // namespace extremal
