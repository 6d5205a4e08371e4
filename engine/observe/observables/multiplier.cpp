// SPDX-License-Identifier: GPL-3.0-or-later
/// The multiplier of continuity between the element that begins at the node and the one before it: lambda_k
/// of the augmented action, from the full saddle-point system without condensation (solve/multipliers.hpp).
///
/// From (q_k, p_k) one step of the discretization gives q_{k+1}; the system is then solved between q_k and
/// q_{k+1}, without p_k, and its first multiplier is -D_1 L_d(q_k, q_{k+1}). That it equals the momentum is
/// what `multiplier_error` shows.
///
/// Of a field on a moving mesh the largest multiplier of equidistribution, which would be 0 if the action
/// were stationary in the places of the nodes as well.
#include <Eigen/Core>

#include <cmath>
#include <limits>
#include <memory>

#include "engine/family/scheme.hpp"
#include "engine/family/table_of.hpp"
#include "engine/observe/quantity_observable.hpp"
#include "engine/solve/multipliers.hpp"

namespace extremal::observables {
namespace {

class MultiplierOfNode {
public:
    MultiplierOfNode(const System& system, const Discretization& discretization, double step)
        : system_(system),
          discretization_(discretization),
          step_(step),
          assembled_(system.mechanics(), tableOf(discretization.space, discretization.quadrature), step, 1) {}

    /// |lambda|, |lambda - p| and lambda; NaN where the step fails.
    void operator()(const State& state, const StepReport&, double* values) const {
        const int d = system_.dimension();
        std::fill_n(values, d + 2, std::numeric_limits<double>::quiet_NaN());
        State next = state;
        next.node = 0;
        const auto integrator = makeIntegrator(system_, discretization_, Clock{state.t, step_});
        if (advance(*integrator, next).outcome != Outcome::converged) return;
        Eigen::MatrixXd ends(d, 2);
        ends << Eigen::Map<const Eigen::VectorXd>(state.x.data(), d),
            Eigen::Map<const Eigen::VectorXd>(next.x.data(), d);
        const AssembledElements found = solveBetween(assembled_, state.t, ends);
        if (found.outcome != Outcome::converged) return;
        const Eigen::VectorXd lambda = found.multipliers.col(0);
        values[0] = lambda.norm();
        values[1] = (lambda - Eigen::Map<const Eigen::VectorXd>(state.x.data() + d, d)).norm();
        for (int i = 0; i < d; ++i) values[2 + i] = lambda(i);
    }

private:
    System system_;
    Discretization discretization_;
    double step_;
    SaddlePoint assembled_;
};

}  // namespace

ObservableEntry multiplier() {
    ObservableEntry e;
    e.item = {"multiplier",
              "multiplier",
              "Multiplier of continuity from the full saddle-point system of a discretization, and its "
              "distance from the momentum; of moving meshes the largest multiplier of equidistribution in "
              "the step that ended at each row.",
              {},
              {},
              "coordinates, or a field"};
    e.takes = Takes::only<Mechanical, ScalarField>();
    e.bind = [](const ObserveContext& context) {
        if (!context.system.hasCoordinates())
            return observeQuantity(context, {"multiplier", "max |λ|", "", {}, {}});
        Observer o;
        const auto& coordinates = context.system.coordinates;
        const std::string unit = coordinates.size() == 1 ? coordinates.front().momentumUnit : "";
        o.columns = {{"multiplier", "|λ|", unit, {}, {}}, {"multiplier_error", "|λ - p|", unit, {}, {}}};
        for (const Coordinate& c : coordinates)
            o.columns.push_back({"multiplier." + c.name, "λ_" + c.symbol, c.momentumUnit, {}, {}});
        if (!context.discretization || !isFor(*context.discretization, context.system) ||
            !hasTable(*context.discretization)) {
            o.evaluate = [n = o.columns.size()](const State&, const StepReport&, double* values) {
                std::fill_n(values, n, std::numeric_limits<double>::quiet_NaN());
            };
            return o;
        }
        o.evaluate = [look = std::make_shared<const MultiplierOfNode>(context.system, *context.discretization,
                                                                      context.step)](
                         const State& state, const StepReport& report, double* values) {
            (*look)(state, report, values);
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
