// SPDX-License-Identifier: GPL-3.0-or-later
/// The wanted error: one number for the whole window, which the bar at the top, the plots, the studies, the
/// race and the card of what the scene needs show and change.
#pragma once

#include <QObject>

namespace extremal {

class Wanted : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;

    static constexpr int lowestPower = -15, highestPower = 2;  ///< of ten

    double error() const { return error_; }
    /// To two digits, from 1e-15 to 100; a value that is not above 0 changes nothing.
    void setError(double error);

signals:
    void changed(double error);

private:
    double error_ = 1e-6;
};

}  // namespace extremal
