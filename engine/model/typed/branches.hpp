// SPDX-License-Identifier: GPL-3.0-or-later
/// A typed Lagrangian with the branches of its kinks and jumps held fixed, so that it is smooth.
///
/// abs, sign, heaviside, max, min, comparisons, floor, ceil, round, mod, table and spline have each an
/// argument s(t, q, v) and limits of it between which the formula is smooth: a cell. The cell of
///     abs(s), sign(s), heaviside(s); a - b of max(a, b), min(a, b), a < b: the sign -1, 1, or 0 at rest on
///         s = 0;
///     floor(s), ceil(s), round(s); s = a/b of mod(a, b): the whole number n with n <= s < n + 1, of round
///         n - 1/2 <= s < n + 1/2;
///     table(s; ...), spline(s; ...): the piece (core/algebra/interpolant.hpp).
/// In a cell the formula goes on beyond the limits as it is inside: abs(x) as x or -x.
/// Operators == and != differ from a constant at single points only and are left as they are.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/algebra/interpolant.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/model/typed/formula.hpp"

namespace extremal::typed {

class Branches {
public:
    /// One cell for each switch.
    using Cells = std::vector<double>;

    /// Null where the formula has no kink and no jump that depends on the motion.
    static std::shared_ptr<const Branches> of(const Formula& formula);

    std::size_t size() const { return switches_.size(); }
    int dimension() const { return frozen_.dimension(); }
    /// Whether s depends on the time alone; on velocities.
    bool isOfTime(std::size_t k) const { return switches_[k].isOfTime; }
    bool hasVelocities(std::size_t k) const { return switches_[k].hasVelocities; }
    /// Whether s moves in a cell, and not with the cells of the switches inside it alone: mod(floor(t), 2).
    bool moves(std::size_t k) const { return switches_[k].moves; }
    /// s of switch k at (q, v, t), where the switches inside s are in these cells.
    double argument(std::size_t k, const double* inputs, const Cells& cells) const;
    /// The cell that a value of s is in.
    double cellOf(std::size_t k, double s) const;
    /// The limits of a cell, infinite where it has none; equal where the cell is a point.
    std::pair<double, double> limits(std::size_t k, double cell) const;
    /// The cell beyond the upper or the lower limit.
    double next(std::size_t k, double cell, bool isUpper) const;

    /// The Lagrangian in these cells. Throws ExpressionError.
    Mechanics<double> in(const Cells& cells) const;

private:
    enum class Kind { sign, steps, table };
    struct Switch {
        Kind kind = Kind::sign;
        std::string text;          ///< of the argument, with marks
        ResolvedFormula argument;  ///< the same
        double offset = 0;         ///< of steps: the limits are n + offset
        std::shared_ptr<const Interpolant> table;
        std::size_t firstMark = 0;  ///< its parameters in the formula
        bool isOfTime = false, hasVelocities = false, moves = false;
    };
    friend class BranchReader;

    /// The values of the parameters that stand for a cell.
    void mark(const Switch& s, double cell, double* values) const;

    Formula frozen_;                 ///< with parameters, the marks, that say which cell it is in
    std::size_t ownParameters_ = 0;  ///< of the formula without marks
    std::vector<Switch> switches_;   ///< arguments of later ones may contain earlier ones
};

/// Those of a typed Lagrangian; null where it is smooth or not typed.
std::shared_ptr<const Branches> branchesOf(const Mechanics<double>& mechanics);

}  // namespace extremal::typed
