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
        const int n = mechanism_.constraints();
        value_ = byTime_ = Eigen::VectorXd::Zero(n);
        byPlace_ = Mechanism::Rows::Zero(n, system.dimension());
    }
    /// lambda_k and |lambda_k dg_k/dq| of each constraint, mu_k and |mu_k a_k| of each rolling condition.
    void operator()(const State& state, const StepReport&, double* values) {
        const int d = mechanism_.dimension(), n = mechanism_.constraints();
        const auto& L = mechanism_.mechanics();
        const double* const q = state.x.data();
        std::fill_n(values, 2 * n, std::numeric_limits<double>::quiet_NaN());
        if (!L.velocity(L.model.get(), state.t, q, q + d, v_.data()) ||
            !mechanism_.accelerate(state.t, q, v_.data(), acceleration_, multipliers_))
            return;
        mechanism_.conditions(state.t, q, value_, byPlace_, byTime_);
        for (int k = 0; k < n; ++k) {
            values[2 * k] = multipliers_(k);
            values[2 * k + 1] = std::abs(multipliers_(k)) * byPlace_.row(k).norm();
        }
    }

private:
    Mechanism mechanism_;
    Eigen::VectorXd v_, acceleration_, multipliers_, value_, byTime_;
    Mechanism::Rows byPlace_;
};

}  // namespace

ObservableEntry reaction() {
    ObservableEntry e;
    e.item = {
        "reaction",
        "reaction",
        "Multipliers λ of the constraints and rolling conditions at each row, and the sizes of their forces.",
        {},
        {},
        "constraints"};
    e.takes = mechanisms();
    e.suits = [](const System& system) {
        return system.parts.find<Constraint>() || system.parts.find<Rolling>();
    };
    e.bind = [](const ObserveContext& context) {
        Observer o;
        const Mechanism mechanism(context.system.parts);
        for (int k = 0; k < mechanism.constraints(); ++k) {
            const std::string& name = mechanism.nameOf(k);
            const bool isHolonomic = k < mechanism.holonomic();
            o.columns.push_back({"reaction." + name, (isHolonomic ? "λ of " : "μ of ") + name, "", {}, {}});
            o.columns.push_back({"reaction." + name + ".force",
                                 (isHolonomic ? "|λ ∂g/∂q| of " : "|μ a| of ") + name,
                                 "",
                                 {},
                                 {}});
        }
        o.evaluate = Reactions(context.system);
        return o;
    };
    return e;
}

}  // namespace extremal::observables
