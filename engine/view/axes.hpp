// SPDX-License-Identifier: GPL-3.0-or-later
/// What is known of the axes of a view before there are results: the format of scenes checks `range` and
/// `curve` by it.
#pragma once

#include <string>

#include "engine/model/system.hpp"
#include "engine/view/view.hpp"

namespace extremal {

struct ViewAxes {
    bool hasScales = true;  ///< numbers along both axes: not the stage, nor a matrix
    bool isXLog = false, isYLog = false;
    std::string
        variable;  ///< what x is, where a curve may be given as a function of it: "t", "x"; else empty
};

/// The axes of a view of viewCatalog().
ViewAxes axesOf(const View& view, const System& system);

/// The key "against" of views of errors: what is along x, time or the number of steps done.
FieldInfo againstField();
bool isAgainstSteps(const View& view);

/// Whether doubles can tell places between two ends of an axis apart: finite, increasing and far enough from
/// each other. In the space of the axis, which is the logarithm of the values on a logarithmic one.
bool isDrawable(double low, double high, bool isLog);

}  // namespace extremal
