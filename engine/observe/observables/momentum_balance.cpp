// SPDX-License-Identifier: GPL-3.0-or-later
/// The balance of momenta: J - J(0) - sum J_k . xi(q_k) over the impulses J_k of forces and walls, of each
/// symmetry xi of the Lagrangian that leaves the constraints as they are.
///
/// The sum is that of the scheme itself, h sum_i b_i F . xi on the curve of each step, so that it is 0 to
/// round-off for affine symmetries, whatever the forces. Schemes that do not say the impulses leave it
/// unknown.
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "engine/mechanism/said_of_forces.hpp"
#include "engine/model/mechanisms.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/symmetry/conserved.hpp"
#include "engine/observe/step_sum.hpp"

namespace extremal::observables {
namespace {

class MomentumBalance {
public:
    MomentumBalance(const ObserveContext& context, std::vector<BalancedMomentum> momenta)
        : momenta_(std::move(momenta)),
          d_(static_cast<std::size_t>(context.system.dimension())),
          first_(context.quantity("impulse.0")),
          sums_(std::make_shared<std::vector<StepSum>>(momenta_.size())) {
        for (const BalancedMomentum& each : momenta_)
            start_.push_back(each.momentum.value(context.initial.t, context.initial.x.data()));
    }
    bool isKnown() const { return first_.has_value(); }

    void operator()(const NodeBlock& nodes, double* values, std::size_t stride) {
        for (std::size_t node = 0; node < nodes.size(); ++node, values += stride) {
            double squares = 0;
            for (std::size_t k = 0; k < momenta_.size(); ++k) {
                const double sum = first_
                                       ? (*sums_)[k].at(nodes, node, given(k, nodes.quantities(node).data()))
                                       : std::numeric_limits<double>::quiet_NaN();
                values[k + 1] = momenta_[k].momentum.value(nodes.t(node), nodes.x(node)) - start_[k] - sum;
                squares += values[k + 1] * values[k + 1];
            }
            values[0] = std::sqrt(squares);
        }
    }
    void checkpoint(Archive& archive) {
        for (StepSum& sum : *sums_) sum.checkpoint(archive);
    }

private:
    /// sum J . (A q + b + c t) over the impulses of a step.
    double given(std::size_t k, const double* quantities) const {
        const Symmetry& s = momenta_[k].symmetry;
        const double *const impulse = quantities + *first_, *const byTime = impulse + d_,
                            *const moment = byTime + d_;
        double sum = 0;
        for (std::size_t i = 0; i < d_; ++i) {
            sum += s.b[i] * impulse[i] + s.c[i] * byTime[i];
            for (std::size_t j = 0; j < d_; ++j) sum += s.A[i * d_ + j] * moment[i * d_ + j];
        }
        return sum;
    }

    std::vector<BalancedMomentum> momenta_;
    std::size_t d_;
    std::optional<std::size_t> first_;
    std::vector<double> start_;
    std::shared_ptr<std::vector<StepSum>> sums_;
};

}  // namespace

ObservableEntry momentum_balance() {
    ObservableEntry e;
    e.item = {"momentum-balance",
              "momentum balance",
              "J − J(0) less what forces and walls give, of each symmetry of the Lagrangian that constraints "
              "keep: 0 to round-off.",
              {},
              {},
              "forces or walls, a symmetry of the Lagrangian, and up to " +
                  std::to_string(SaidOfForces::mostCoordinates) + " coordinates"};
    e.takes = Takes::only<Mechanical, Constraint, Force, Wall>();
    e.suits = [](const System& system) {
        return (system.parts.find<Force>() || system.parts.find<Wall>()) &&
               system.dimension() <= SaidOfForces::mostCoordinates && !momentaBesideForces(system).empty();
    };
    e.bind = [](const ObserveContext& context) {
        Observer o;
        std::vector<BalancedMomentum> momenta = momentaBesideForces(context.system);
        o.columns.push_back({"momentum_balance", "|J - J(0) - Σ F·ξ|", "", {}, {}});
        for (const BalancedMomentum& each : momenta)
            o.columns.push_back({"momentum_balance." + each.momentum.name,
                                 each.momentum.symbol + " - " + each.momentum.symbol + "(0) - Σ F·ξ",
                                 each.momentum.unit,
                                 {},
                                 {}});
        o.extreme = 0;
        const auto balance = std::make_shared<MomentumBalance>(context, std::move(momenta));
        o.readsQuantities = balance->isKnown();
        o.evaluate = [balance](const NodeBlock& nodes, double* values, std::size_t stride) {
            (*balance)(nodes, values, stride);
        };
        o.checkpoint = [balance](Archive& archive) { balance->checkpoint(archive); };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
