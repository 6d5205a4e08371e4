// SPDX-License-Identifier: GPL-3.0-or-later
/// The scene's card: the model, its parameters, the initial data, the end of time, the reference and the
/// events, as forms from descriptors.
#pragma once

#include "ui/base/card.hpp"

class QComboBox;

namespace extremal {

class Form;
class TypedModelEditor;
class Workspace;

class ScenePanel : public Card {
    Q_OBJECT
public:
    explicit ScenePanel(Workspace& workspace, QWidget* parent = nullptr);

private:
    void rebuild();
    void changeModel(int index);
    void startFromTwoPositions();
    void startFromMomentum();
    void addEvent();
    void compareWithFile();
    void compareWithSelected();

    Workspace& workspace_;
    QComboBox* model_;
    Form *parameters_, *initial_, *time_, *reference_, *events_;
    QLabel *initialTitle_, *timeTitle_, *eventsTitle_;
    TypedModelEditor* typed_;
    std::string shownModel_;
    std::string shownInitial_;  ///< which keys of the initial data are shown
    std::string shownReference_;
    std::string shownEvents_;
};

}  // namespace extremal
