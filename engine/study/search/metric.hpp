// SPDX-License-Identifier: GPL-3.0-or-later
/// What a study measures of a run: one number, from the columns that the run would write.
///
///     NAME                      the largest size, over all nodes or at the last one, of the extreme of an
///                               observable ("error", "energy", "momentum", "norm", "phase", ...), or of any
///                               other column ("error.theta", "q.x", "momentum.z")
///     column:NAME               that column itself, also where NAME is an observable ("column:energy")
///     2*NAME, NAME/own, NAME/3  weighed; over the largest size of the quantity in the reference; over a
///                               scale of one's own
///     rms(TERM, TERM, ...)      the root of the mean of their squares at each node
///
/// "error" of coordinates in different units is rms(error.x/own, error.y/own, ...) over all of them: lengths
/// and angles are not added. The size of an angle is 1 rad, however often it turns. Terms of different units
/// are refused unless each has a scale.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/observe/catalog.hpp"

namespace extremal {

struct MetricTerm {
    double weight = 1;
    std::string column;                           ///< its name in files
    std::string symbol, unit;                     ///< in plots
    const ObservableEntry* observable = nullptr;  ///< null: an entry of the state
    std::size_t index = 0;                        ///< of its columns, or of the state
    bool isOverOwn = false, hasScale = false;     ///< divided by its own size, by any scale
    /// The size that the quantity has at a state, of which the largest in the reference is its own; empty:
    /// not known.
    std::function<double(double t, const double* x)> size = {};
    double own = 0;  ///< the largest of them: withSizes(); 0: not known
};

struct Metric {
    std::string name;               ///< as it was given
    std::vector<MetricTerm> terms;  ///< one, or those of rms(...)
    bool isAtEnd = false;           ///< at the last node in place of the maximum
    bool isSum = false;             ///< the root of the mean of squares

    bool needsReference() const;
    /// Whether it divides by a size in the reference.
    bool needsSizes() const;
    /// Whether it reads columns of this observable.
    bool reads(std::string_view observable) const;
    std::string unit() const;   ///< empty of sums over scales
    std::string title() const;  ///< the symbol for plots
    /// Of the values of its terms at one node.
    double combined(std::span<const double> values) const;
    /// Where errors end that a reference with this error of its own lets be seen; 0 where the metric needs no
    /// reference, or its error is not known.
    double floorBy(double referenceError) const;
    /// The size of what it measures, beyond a fifth of which an error says nothing any more; infinity where
    /// it is not known.
    double size() const;
};

/// The names of what can be measured for a system, in the order of the catalogue; then the errors of single
/// coordinates.
std::vector<std::string> metricNames(const System& system, const State& start);

/// Throws InvalidScene (pointer "--metric") where the system has no such column, or where quantities of
/// different units would be added; the hint lists what can be measured.
Metric metricOf(const std::string& name, bool isAtEnd, const System& system, const State& start);

/// The metric with the sizes of its quantities in a reference, at places spread over the run.
Metric withSizes(Metric metric, const ExactSolution& reference, double start, double end, std::size_t width);

}  // namespace extremal
