// SPDX-License-Identifier: GPL-3.0-or-later
/// Errors of Filon's rules on int_0^h e^x e^{iwx} dx, measured: the regimes in h and in h w, and a table
/// against h w.
///
/// The table is of the program's own rule in double precision. Slopes fall below its round-off; they are
/// measured in quadruple precision, with weights by another route: the cardinal polynomials multiplied out,
/// times the integrals of x^j e^{izx} by power series (z < 8) or by parts. The exact value is h (e^s - 1)/s,
/// s = h + i h w.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/quadrature/filon.hpp"

namespace extremal::tools {

/// |Q - I| of the program's rule; the sum in double precision, its exact value in quadruple.
double filonError(FilonNodes nodes, int count, double h, double z);
/// The same in quadruple precision throughout, by weights of its own.
double wideFilonError(FilonNodes nodes, int count, double h, double z);
/// The largest difference of a weight of the program from that in quadruple precision.
double filonWeightError(FilonNodes nodes, int count, double z);

struct FilonSlopes {
    double still = 0;  ///< in h, as h w -> 0 (h w = 1e-9)
    double one = 0;    ///< in h, at h w = 1
    double fast = 0;   ///< in h, at h w = 1000
    double inFrequency =
        0;  ///< in h w at h = 1, of the largest error over a turn of the phase, from 1e3 to 1e5
};
FilonSlopes measureSlopes(FilonNodes nodes, int count);

/// The rules of the table, in the order of its columns, and the values of h w in its rows.
struct FilonColumn {
    FilonNodes nodes;
    int count;
    std::string name;  ///< "Gauss 3"
};
const std::vector<FilonColumn>& filonColumns();
const std::vector<double>& filonRows();

/// Errors below are round-off of double precision.
inline constexpr double filonFloor = 1e-15;

/// The page of the handbook, with everything measured anew.
std::string filonPage();

}  // namespace extremal::tools
