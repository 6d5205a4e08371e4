// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/laws/form_defects.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/model/first_order/one_form.hpp"
#include "engine/model/first_order/poisson.hpp"
#include "engine/model/group/lie_group.hpp"
#include "engine/model/group/spheres.hpp"
#include "engine/model/spins/spins.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/jacobian.hpp"
#include "tests/tools/tangent.hpp"

namespace extremal::laws {
namespace {

constexpr double notKnown = std::numeric_limits<double>::quiet_NaN();

/// The derivative of one step by differences, with every variable in its own size, and its end.
struct DifferencedStep {
    DifferencedStep(const Trial& trial, double each) {
        const Subject& on = trial.on;
        const auto integrator = trial.make(on.time / each);
        const auto step = [&](State from) {
            integrator->begin(from);
            return after(*integrator, from, 1);
        };
        end = step(on.start);
        const auto M = jacobianOf(step, on.start, 5e-4, on.own);
        if (!M || !end) return;
        const auto n = static_cast<Eigen::Index>(M->size);
        map = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
            M->entries.data(), n, n);
    }
    bool isKnown() const { return map.size() > 0; }
    std::optional<State> end;
    Eigen::MatrixXd map;
};

/// M^T Om(x_1) M - Om(x_0), whose entries depend on the place, in the sizes of the variables; relative to the
/// largest entries of Om and of M.
double oneFormDefect(const Trial& trial, double each, const OneForm& form) {
    const DifferencedStep step(trial, each);
    if (!step.isKnown()) return notKnown;
    const Eigen::Map<const Eigen::VectorXd> own(trial.on.own.data(), step.map.rows());
    OneFormEquations equations(form);
    const auto formAt = [&](const State& at) -> Eigen::MatrixXd {
        return own.asDiagonal() * equations.form(at.x.data()) * own.asDiagonal();
    };
    const Eigen::MatrixXd first = formAt(trial.on.start), last = formAt(*step.end);
    return (step.map.transpose() * last * step.map - first).cwiseAbs().maxCoeff() /
           (first.cwiseAbs().maxCoeff() * step.map.cwiseAbs().maxCoeff());
}

/// M J(x_0) M^T - J(x_1), likewise.
double bracketDefect(const Trial& trial, double each, const PoissonStructure& structure) {
    const DifferencedStep step(trial, each);
    if (!step.isKnown()) return notKnown;
    const Eigen::Map<const Eigen::VectorXd> own(trial.on.own.data(), step.map.rows());
    PoissonEquations equations(structure);
    const auto bracketAt = [&](const State& at) -> Eigen::MatrixXd {
        return own.cwiseInverse().asDiagonal() * equations.structure(at.x.data()) *
               own.cwiseInverse().asDiagonal();
    };
    const Eigen::MatrixXd first = bracketAt(trial.on.start), last = bracketAt(*step.end);
    return (step.map * first * step.map.transpose() - last).cwiseAbs().maxCoeff() /
           (first.cwiseAbs().maxCoeff() * step.map.cwiseAbs().maxCoeff());
}

/// {x_i, pi_j} = e_ijk x_k and {pi_i, pi_j} = e_ijk pi_k of each sphere. What it makes of any function is
/// tangent to the phase space, so that a step may do off it what it likes.
Eigen::MatrixXd bracketOnSpheres(const std::vector<double>& x) {
    const auto d = static_cast<Eigen::Index>(x.size() / 2);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2 * d, 2 * d);
    for (Eigen::Index k = 0; k < d; k += 3)
        for (Eigen::Index i = 0; i < 3; ++i) {
            const Eigen::Index j = (i + 1) % 3, other = (i + 2) % 3;
            const double place = x[static_cast<std::size_t>(k + other)],
                         momentum = x[static_cast<std::size_t>(d + k + other)];
            J(k + i, d + k + j) = J(d + k + i, k + j) = place;
            J(k + j, d + k + i) = J(d + k + j, k + i) = -place;
            J(d + k + i, d + k + j) = momentum;
            J(d + k + j, d + k + i) = -momentum;
        }
    return J;
}
double sphereDefect(const Trial& trial, double each) {
    const DifferencedStep step(trial, each);
    if (!step.isKnown()) return notKnown;
    const Eigen::Map<const Eigen::VectorXd> own(trial.on.own.data(), step.map.rows());
    const auto bracketAt = [&](const State& at) -> Eigen::MatrixXd {
        return own.cwiseInverse().asDiagonal() * bracketOnSpheres(at.x) * own.cwiseInverse().asDiagonal();
    };
    const Eigen::MatrixXd first = bracketAt(trial.on.start), last = bracketAt(*step.end);
    return (step.map * first * step.map.transpose() - last).cwiseAbs().maxCoeff() /
           (first.cwiseAbs().maxCoeff() * step.map.cwiseAbs().maxCoeff());
}

/// The derivative of the spins by the coordinates above them (model/spins/spins.hpp), rows s_1 .. of each.
Eigen::MatrixXd slopeOfSpins(const SpinModel& model, const std::vector<double>& x) {
    const Eigen::Index n = model.count();
    Eigen::MatrixXd D = Eigen::MatrixXd::Zero(3 * n, 4 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double w = 4 * model.weights[static_cast<std::size_t>(i)];
        const auto at = [&](Eigen::Index k) { return x[static_cast<std::size_t>(k)]; };
        const Eigen::Index A = 2 * i, C = A + 1, B = 2 * n + A, E = B + 1;
        const double a = at(A), c = at(C), b = at(B) / w, d = at(E) / w;
        const Eigen::Index row = 3 * i;
        D(row, A) = 2 * c;
        D(row, C) = 2 * a;
        D(row, B) = 2 * d / w;
        D(row, E) = 2 * b / w;
        D(row + 1, A) = 2 * d;
        D(row + 1, C) = -2 * b;
        D(row + 1, B) = -2 * c / w;
        D(row + 1, E) = 2 * a / w;
        D(row + 2, A) = 2 * a;
        D(row + 2, C) = -2 * c;
        D(row + 2, B) = 2 * b / w;
        D(row + 2, E) = -2 * d / w;
    }
    return D;
}
/// The canonical bracket of the spins after a step against {s_j, s_k} = e_jkl s_l / w there: what a step does
/// to phases above the spheres is its own affair.
double spinDefect(const Trial& trial, double each, const SpinModel& model) {
    const DifferencedStep step(trial, each);
    if (!step.isKnown()) return notKnown;
    const Eigen::Map<const Eigen::VectorXd> own(trial.on.own.data(), step.map.rows());
    const Eigen::Index n = model.count();
    const Eigen::MatrixXd M = own.asDiagonal() * step.map * own.cwiseInverse().asDiagonal();
    const Eigen::MatrixXd D = slopeOfSpins(model, step.end->x) * M;
    Eigen::MatrixXd defect = D.leftCols(2 * n) * D.rightCols(2 * n).transpose();
    defect -= defect.transpose().eval();
    std::vector<double> s(static_cast<std::size_t>(3 * n));
    spins::spinsOf(model, step.end->x.data(), step.end->x.data() + 2 * n, s.data());
    double largest = 0;
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < 3; ++j) {
            const Eigen::Index k = (j + 1) % 3, l = (j + 2) % 3;
            const double bracket =
                s[static_cast<std::size_t>(3 * i + l)] / model.weights[static_cast<std::size_t>(i)];
            defect(3 * i + j, 3 * i + k) -= bracket;
            defect(3 * i + k, 3 * i + j) += bracket;
            largest = std::max(largest, std::abs(bracket));
        }
    return defect.cwiseAbs().maxCoeff() / largest;
}

/// With the tangent map of the step itself, which laws.matrix_groups compares with differences.
double groupDefect(const Trial& trial, double each) {
    const Subject& on = trial.on;
    const auto integrator = trial.make(on.time / each);
    State state = on.start;
    integrator->begin(state);
    if (advance(*integrator, state).outcome != Outcome::converged) return notKnown;
    const auto M = tangentMap(*integrator);
    return M ? formDefect(SymplecticForm(on.system), on.start.x.data(), state.x.data(), *M) : notKnown;
}

}  // namespace

std::optional<double> ownFormDefect(const Trial& trial, double each) {
    const Parts& parts = trial.on.system.parts;
    if (const OneForm* const form = parts.find<OneForm>()) return oneFormDefect(trial, each, *form);
    if (const auto* const bracket = parts.find<PoissonStructure>())
        return bracketDefect(trial, each, *bracket);
    if (parts.find<LieGroup>()) return groupDefect(trial, each);
    if (parts.find<Spheres>()) return sphereDefect(trial, each);
    if (const Spins* const spins = parts.find<Spins>()) return spinDefect(trial, each, *spins->model);
    return {};
}

}  // namespace extremal::laws
