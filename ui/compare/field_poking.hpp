// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields that are struck on the stage: with Shift, or while poking is on, a click adds a pulse to u where
/// the field is at the time of the cursor, and the scene starts from there. It plays on if it was playing.
///
/// The pulse is A exp(-r^2/(2 w^2)) around the place, w a twenty-fifth of the shorter side. A graph is pulled
/// to the pointer; over a plane A is the largest |u| at that time. Values that are held stay.
#pragma once

#include <QObject>
#include <QPointF>

#include <optional>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/run/comparison.hpp"
#include "ui/compare/starting.hpp"

namespace extremal {

class Playback;
class RunControl;
class StageWidget;
class Workspace;

/// A place on the stage in the coordinates of the field, and for graphs the value that u is pulled to.
struct PokedPlace {
    double x = 0, y = 0;
    std::optional<double> u;
};

/// Whether a field of this system can be poked: its state is u and u_t.
bool canBePoked(const System& system);

/// The scene started from where a scheme is at a time, with a pulse; or why not.
StartEdits editsForPoke(const System& system, const SchemeResult& result, double t, const PokedPlace& place);

class FieldPoking : public QObject {
    Q_OBJECT
public:
    FieldPoking(Workspace& workspace, RunControl& run, Playback& playback, StageWidget& stage,
                QObject* parent);
    void setOn(bool isOn);
    bool isOn() const { return isOn_; }

signals:
    void onChanged(bool isOn);
    void refused(const QString& reason);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    const System* system() const;  ///< of the results, if it can be poked
    void pokeAt(QPointF place);    ///< of the stage

    Workspace& workspace_;
    RunControl& run_;
    Playback& playback_;
    StageWidget& stage_;
    bool isOn_ = false;
    std::optional<QPointF> pressed_;
};

}  // namespace extremal
