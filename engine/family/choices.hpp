// SPDX-License-Identifier: GPL-3.0-or-later
/// The discretizations of a family that the window offers side by side: rows x columns of cells.
#pragma once

#include <string>
#include <vector>

#include "engine/family/discretization.hpp"

namespace extremal {

struct ChoiceGrid {
    struct Heading {
        std::string text;         ///< "poly 3", "Gauss"
        std::string description;  ///< "polynomials of degree 3"
        bool operator==(const Heading&) const = default;
    };
    struct Cell {
        Discretization discretization;  ///< complete
        std::string id;                 ///< unique in the grid: "3.gauss"
        std::string text, superscript;  ///< "G" and "6"; "mid"
        std::string title;  ///< "polynomials of degree 3, Gauss-Legendre": without colour or place
        /// Its functions or nodes are formulas to begin with: every scheme of this kind of space, degree and
        /// kind of rule is in this cell.
        bool isOwn = false;
        bool operator==(const Cell&) const = default;
    };
    std::string subtitle = "space × quadrature";
    std::vector<Heading> rows, columns;  ///< columns may be empty: then without headings
    std::vector<Cell> cells;             ///< row by row

    bool operator==(const ChoiceGrid&) const = default;
    std::size_t width() const { return rows.empty() ? 0 : cells.size() / rows.size(); }
};

}  // namespace extremal
