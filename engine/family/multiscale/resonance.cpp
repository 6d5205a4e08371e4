// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/multiscale/resonance.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/memo_cache.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/multiscale/oscillatory.hpp"

namespace extremal {
namespace {

/// The system of a step for its unknowns, given (q_0, p_0), on L = (v^2 - z^2 q^2)/2 with h = 1, rows and
/// columns scaled.
Eigen::MatrixXd stepSystem(const Table<double>& t, double z) {
    const Eigen::MatrixXd weighted = t.weight.asDiagonal() * t.testValue;
    Eigen::MatrixXd A = t.testDerivative.transpose() * t.weight.asDiagonal() * t.derivative;
    A -= z * z * weighted.transpose() * t.value;
    for (int pass = 0; pass < 3; ++pass) {
        const Eigen::VectorXd rows = A.rowwise().norm().cwiseInverse();
        A = rows.asDiagonal() * A;
        const Eigen::VectorXd columns = A.colwise().norm().cwiseInverse();
        A = A * columns.asDiagonal();
    }
    return A;
}

double conditioningOf(const Table<double>& t, double z) {
    const Eigen::VectorXd s = dense::singularValues(stepSystem(t, z));
    return s(0) / s(s.size() - 1);
}

bool isFast(const System& system, int coordinate) {
    const auto& fast = system.fast.coordinates;
    return fast.empty() || std::find(fast.begin(), fast.end(), coordinate) != fast.end();
}

/// Signs of the determinants of a step's systems: of fast coordinates, each as an oscillator, and of the
/// others, each as a free particle. A singular step lies between two steps of different signs.
struct Signs {
    std::vector<bool> fast, others;
};

/// Signs at the steps h + n * spacing, computed when they are asked for.
class StepLine {
public:
    /// Of half a period of the fastest motion.
    static constexpr double spacing = 0.05;

    StepLine(const System& system, const Discretization& discretization, double step)
        : system_(system), discretization_(discretization), step_(step) {
        const Phases<double> z = oscillatoryPhases(system, discretization.space, step);
        const double fastest = std::max(std::abs(z[0]), std::abs(z[1])) / std::numbers::pi;
        unit_ = fastest > 0 ? spacing * step / fastest : 0;
    }
    double unit() const { return unit_; }
    double at(int n) const { return step_ + n * unit_; }

    Signs signsOf(double step) const {
        Signs signs;
        const Phases<double> z = oscillatoryPhases(system_, discretization_.space, step);
        const std::vector<Table<double>> tables = oscillatoryTables(system_, discretization_, step);
        for (std::size_t k = 0; k < tables.size(); ++k) {
            const auto isNegative = [&](double phase) {
                return dense::Lu<double>(stepSystem(tables[k], phase)).hasNegativeDeterminant();
            };
            if (!isFast(system_, static_cast<int>(k)))
                signs.others.push_back(isNegative(0));
            else
                for (const double phase : z)
                    if (phase != 0) signs.fast.push_back(isNegative(phase));
        }
        return signs;
    }

    /// The places between which lies a singular step that is too near to the place n, if there is one. Errors
    /// are ten times the usual ones up to 0.01 of half a period from those of fast coordinates, and up to 0.1
    /// from those of the others, which are the more severe.
    /// `margin`: so many places further, for a step that is to be suggested.
    std::optional<std::pair<int, int>> singularNear(int n, int margin = 0) {
        const int nearFast = 1 + margin, nearOthers = 2 + margin;
        for (int i = n - nearOthers; i < n + nearOthers; ++i) {
            const Signs &a = known(i), &b = known(i + 1);
            const bool isInner = i >= n - nearFast && i < n + nearFast;
            if (a.others != b.others || (isInner && a.fast != b.fast)) return std::pair(i, i + 1);
        }
        return {};
    }

private:
    const Signs& known(int n) {
        const auto found = known_.find(n);
        return found != known_.end() ? found->second : known_.emplace(n, signsOf(at(n))).first->second;
    }

    const System& system_;
    const Discretization& discretization_;
    double step_, unit_ = 0;
    std::map<int, Signs> known_;
};

/// The singular step between two places, by bisection to some digits.
double locate(const StepLine& line, std::pair<int, int> places) {
    double a = line.at(places.first), b = line.at(places.second);
    const Signs before = line.signsOf(a);
    for (int i = 0; i < 8; ++i) {
        const double middle = (a + b) / 2;
        const Signs signs = line.signsOf(middle);
        (signs.fast == before.fast && signs.others == before.others ? a : b) = middle;
    }
    return (a + b) / 2;
}

/// The shortest decimal that is still away from singular steps.
double fewDigits(const System& system, const Discretization& discretization, double step, double tolerance) {
    for (int digits = 2; digits < 17; ++digits) {
        const auto rounded = parseNumber(formatNumber(step, digits));
        if (!rounded || std::abs(*rounded - step) > tolerance) continue;
        if (!StepLine(system, discretization, *rounded).singularNear(0, 1)) return *rounded;
    }
    return step;
}

std::optional<Resonance> foundResonance(const System& system, const Discretization& discretization,
                                        double step) {
    StepLine line(system, discretization, step);
    if (!(line.unit() > 0)) return {};
    const auto singular = line.singularNear(0);
    if (!singular) return {};
    Resonance r;
    r.at = locate(line, *singular);
    constexpr int farthest = 60;  // three half periods
    for (int n = 1; n <= farthest && r.near == 0; ++n)
        for (const int place : {-n, n})
            if (r.near == 0 && line.at(place - 3) > 0 && !line.singularNear(place, 1))
                r.near = fewDigits(system, discretization, line.at(place), line.unit());
    return r;
}

/// All that the tables of steps near this one depend on.
struct ResonanceKey {
    std::vector<OscillatoryBasis> bases;
    std::vector<int> fast;
    Settings quadrature;
    Phases<double> z;
    double step;
    bool operator==(const ResonanceKey&) const = default;
};

}  // namespace

double stepConditioning(const System& system, const Discretization& discretization, double step) {
    if (!isOscillatory(discretization.space)) return 0;
    // Coordinates that follow the fast ones are not oscillators; where none is known to be fast, all may be.
    const std::vector<Table<double>> tables = oscillatoryTables(system, discretization, step);
    double worst = 0;
    for (const double z : oscillatoryPhases(system, discretization.space, step)) {
        if (z == 0) continue;
        for (const int k : system.fast.coordinates)
            worst = std::max(worst, conditioningOf(tables[static_cast<std::size_t>(k)], z));
        if (system.fast.coordinates.empty())
            for (const Table<double>& t : tables) worst = std::max(worst, conditioningOf(t, z));
    }
    return worst;
}

std::optional<Resonance> resonanceOf(const System& system, const Discretization& discretization,
                                     double step) {
    if (!isOscillatory(discretization.space) || !(step > 0)) return {};
    // A dozen tables or more, and a scene is checked after every edit.
    static MemoCache<ResonanceKey, std::optional<Resonance>> known(64);
    const ResonanceKey key{oscillatoryBases(discretization.space, system), system.fast.coordinates,
                           discretization.quadrature, oscillatoryPhases(system, discretization.space, step),
                           step};
    return known.get(key, [&] { return foundResonance(system, discretization, step); });
}

}  // namespace extremal
