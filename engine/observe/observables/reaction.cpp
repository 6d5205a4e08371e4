// SPDX-License-Identifier: GPL-3.0-or-later
/// Reactions of constraints: the multipliers lambda of the state, by which g_q^T lambda is the force that
/// keeps it on them, and the size of that force.
///
/// They are those of the equations at the state (constraints differentiated twice), as accurate as the state;
/// the multipliers of a step are impulses at its nodes, and of low order one by one.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/mechanism/mechanism.hpp"
#include "engine/model/mechanisms.hpp"
#include "engine/observe/catalog.hpp"

namespace extremal::observables {
namespace {

class Reactions {
public:
    explicit Reactions(const System& system)
        : mechanism_(system.parts), v_(Eigen::VectorXd::Zero(system.dimension())) {
        const auto n = static_cast<std::size_t>(mechanism_.constraints());
        g_.resize(n);
        byTime_.resize(n);
        byPlace_.resize(n * static_cast<std::size_t>(system.dimension()));
    }
    /// lambda_k and |lambda_k dg_k/dq| of each constraint.
    void operator()(const State& state, const StepReport&, double* values) {
        const int d = mechanism_.dimension(), n = mechanism_.constraints();
        const auto& L = mechanism_.mechanics();
        const Constraint& g = *mechanism_.constraint();
        const double* const q = state.x.data();
        std::fill_n(values, 2 * n, std::numeric_limits<double>::quiet_NaN());
        if (!L.velocity(L.model.get(), state.t, q, q + d, v_.data()) ||
            !mechanism_.accelerate(state.t, q, v_.data(), acceleration_, multipliers_))
            return;
        g.first(g.model.get(), state.t, q, g_.data(), byPlace_.data(), byTime_.data());
        for (int k = 0; k < n; ++k) {
            const Eigen::Map<const Eigen::VectorXd> row(byPlace_.data() + k * d, d);
            values[2 * k] = multipliers_(k);
            values[2 * k + 1] = std::abs(multipliers_(k)) * row.norm();
        }
    }

private:
    Mechanism mechanism_;
    Eigen::VectorXd v_, acceleration_, multipliers_;
    std::vector<double> g_, byTime_, byPlace_;
};

}  // namespace

ObservableEntry reaction() {
    ObservableEntry e;
    e.item = {"reaction",
              "reaction",
              "Multipliers λ of the constraints at each row, and the sizes of the forces λ dg/dq.",
              {},
              {},
              "constraints"};
    e.takes = mechanisms();
    e.suits = [](const System& system) { return system.parts.find<Constraint>() != nullptr; };
    e.bind = [](const ObserveContext& context) {
        Observer o;
        for (const std::string& name : context.system.part<Constraint>().names) {
            o.columns.push_back({"reaction." + name, "λ_" + name, "", {}, {}});
            o.columns.push_back({"reaction." + name + ".force", "|λ ∂g/∂q| of " + name, "", {}, {}});
        }
        o.evaluate = Reactions(context.system);
        return o;
    };
    return e;
}

}  // namespace extremal::observables
