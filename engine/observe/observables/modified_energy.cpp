// SPDX-License-Identifier: GPL-3.0-or-later
/// The energy that a symplectic scheme nearly conserves, and its change from the first known value: by the
/// form and the order that vary least over a trial of some hundred steps (observe/modified_energy.hpp). At
/// nodes with too few neighbours, and for schemes that do not know the action of their steps, it is unknown.
#include "engine/observe/modified_energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "engine/observe/catalog.hpp"

namespace extremal::observables {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// What can be computed, node by node.
struct Form {
    ModifiedEnergyForm form = ModifiedEnergyForm::local;
    int r = 0;  ///< half the window

    std::string text() const {
        if (form == ModifiedEnergyForm::local) return "inside each step";
        return std::string(form == ModifiedEnergyForm::legendre ? "Legendre" : "homogeneous") +
               " form of order " + std::to_string(2 * r);
    }
};

/// Values of one form along consecutive nodes.
class Sequence {
public:
    Sequence(const Form& form, const ObserveContext& context)
        : form_(form),
          order_(context.order),
          action_(context.quantity("action")),
          discrete_(context.quantity("discrete_energy")),
          energy_(energyOf(context.system)),
          d_(static_cast<std::size_t>(context.system.dimension())),
          window_(form.form, form.r, context.system.dimension(), context.step) {}

    /// Of the node r before this one. `said`: what the integrator said of the step to it.
    double next(double t, const double* x, std::span<const double> said) {
        if (form_.form != ModifiedEnergyForm::local)
            return window_.next(x, x + d_, action_ ? said[*action_] : unknown);
        const double now = energy_(t, x), before = std::exchange(last_, now);
        return discrete_ ? localModifiedEnergy(order_, before, now, said[*discrete_]) : unknown;
    }
    void clear() {
        window_.clear();
        last_ = unknown;
    }
    void checkpoint(Archive& archive) { archive(window_, last_); }

private:
    Form form_;
    int order_;
    std::optional<std::size_t> action_, discrete_;
    EnergyFunction energy_;
    std::size_t d_;
    ModifiedEnergyWindow window_;
    double last_ = unknown;
};

/// A run, as far as it has been seen.
struct Along {
    Sequence sequence;
    double start = unknown;  ///< the first known value
    long long last = -1;     ///< node
};

std::vector<Form> formsOf(const ObserveContext& context) {
    std::vector<Form> forms;
    if (!context.integrator || context.integrator->grid() != TimeGrid::fixed) return forms;
    if (context.quantity("action"))
        for (const int r : {12, 8, 6, 3})
            for (const auto form : {ModifiedEnergyForm::legendre, ModifiedEnergyForm::homogeneous})
                forms.push_back({form, r});
    if (context.quantity("discrete_energy") && context.order > 0)
        forms.push_back({ModifiedEnergyForm::local, 0});
    return forms;
}

/// The form whose values differ least over a trial run.
std::optional<Form> narrowest(const ObserveContext& context) {
    constexpr int steps = 400, fewest = 10;
    struct Candidate {
        Form form;
        Sequence values;
        double low = std::numeric_limits<double>::infinity(), high = -low;
        int count = 0;
    };
    std::vector<Candidate> all;
    for (const Form& form : formsOf(context)) all.push_back({form, Sequence(form, context)});
    if (all.empty()) return {};
    const auto trial = context.integrator->clone();
    State state = context.initial;
    state.memory.clear();
    trial->begin(state);
    std::vector<double> said(context.quantities.size(), unknown);
    const auto look = [&] {
        for (Candidate& each : all) {
            const double value = each.values.next(state.t, state.x.data(), said);
            if (!std::isfinite(value)) continue;
            each.low = std::min(each.low, value);
            each.high = std::max(each.high, value);
            ++each.count;
        }
    };
    look();
    for (int k = 0; k < steps; ++k) {
        if (advance(*trial, state).outcome != Outcome::converged) break;
        trial->measure(state, said.data());
        look();
    }
    std::optional<Form> best;
    double least = std::numeric_limits<double>::infinity();
    for (const Candidate& each : all)
        if (each.count >= fewest && each.high - each.low < least) {
            least = each.high - each.low;
            best = each.form;
        }
    return best;
}

}  // namespace

ObservableEntry modified_energy() {
    ObservableEntry e;
    e.item = {
        "modified-energy",
        "modified energy",
        "Energy that a symplectic scheme nearly conserves, from its nodes and the actions of its steps, "
        "and its change; of discretizations, splittings, compositions and RK4.",
        {},
        {},
        "coordinates"};
    e.takes = Takes::only<Mechanical>();
    e.bind = [](const ObserveContext& context) {
        Observer o;
        const std::string& unit = context.system.energyUnit;
        o.columns = {{"modified_energy", "H_h", unit, {}, {}},
                     {"modified_energy_error", "H_h - H_h(0)", unit, {}, {}}};
        o.extreme = 1;
        const std::optional<Form> form = narrowest(context);
        if (!form) {
            o.evaluate = [](const NodeBlock& nodes, double* values, std::size_t stride) {
                for (std::size_t i = 0; i < nodes.size(); ++i, values += stride)
                    values[0] = values[1] = unknown;
            };
            return o;
        }
        o.readsQuantities = true;
        o.delay = form->r;
        o.about = "modified energy: " + form->text();
        const auto along = std::make_shared<Along>(Along{Sequence(*form, context)});
        o.evaluate = [along](const NodeBlock& nodes, double* values, std::size_t stride) {
            for (std::size_t i = 0; i < nodes.size(); ++i, values += stride) {
                values[0] = values[1] = unknown;
                const long long node = nodes.node(i);
                if (node == along->last) continue;  // a row beside the nodes
                if (node != along->last + 1) along->sequence.clear();
                along->last = node;
                values[0] = along->sequence.next(nodes.t(i), nodes.x(i), nodes.quantities(i));
                if (std::isnan(along->start)) along->start = values[0];
                values[1] = values[0] - along->start;
            }
        };
        o.checkpoint = [along](Archive& archive) { archive(along->sequence, along->start, along->last); };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
