// SPDX-License-Identifier: GPL-3.0-or-later
/// The equations of a family as they are written: its discrete action, and what makes it stationary. Plain
/// text in Unicode for pages and the window, and LaTeX.
#pragma once

#include <string>
#include <vector>

namespace extremal {

struct WrittenFormula {
    std::string plain, tex;
};

struct WrittenAction {
    std::string meaning;  ///< a sentence that names the unknowns
    std::vector<WrittenFormula> action, stationarity;
};

}  // namespace extremal
