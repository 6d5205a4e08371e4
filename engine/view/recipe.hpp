// SPDX-License-Identifier: GPL-3.0-or-later
/// How a view is drawn, as data. Most views are a column of the results against time, or against another
/// column; a view whose picture is like no other names a recipe of its own. engine/figure interprets them.
#pragma once

#include <string>
#include <variant>

#include "engine/model/system.hpp"
#include "engine/view/view.hpp"

namespace extremal {

/// No plot: the stage.
struct NoPlot {};

/// A column of an observable against time, as it is. The subtitle says by how much it changes.
struct ColumnAgainstTime {
    std::string column;
    bool isChangeRelative = false;  ///< the change is given as a share of the first value
};

/// The size of a column that vanishes for the exact motion, on a logarithmic axis, against time or the number
/// of steps (the key "against").
struct ErrorAgainstTime {
    std::string column;
    std::string symbol;  ///< of its size; empty: that of the column, between bars
    double scale = 0;    ///< of the quantity: its round-off is drawn as a faint line; 0: none
};

/// One state column against time, out of those that ViewEntry::columns names: View::y, else the first.
struct StateAgainstTime {};

/// One column against another: a curve per scheme.
struct ColumnAgainstColumn {
    std::string (*x)(const View&, const System&);
    std::string (*y)(const View&, const System&);
};

/// engine/figure/recipes/<name>.cpp.
struct OwnRecipe {
    std::string name;
};

using Recipe = std::variant<NoPlot, ColumnAgainstTime, ErrorAgainstTime, StateAgainstTime,
                            ColumnAgainstColumn, OwnRecipe>;

}  // namespace extremal
