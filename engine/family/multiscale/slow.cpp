// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/multiscale/slow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/multiscale/slow_step.hpp"
#include "engine/family/rule_choices.hpp"
#include "engine/family/table_of.hpp"
#include "engine/model/slow/slow_models.hpp"

namespace extremal {
namespace {

/// The polynomials of the slow coordinates.
Settings polynomials(const Settings& space) {
    return namedScheme("galerkin-gauss-" + std::to_string(space.integer("degree")))->space;
}

/// The largest distance of the coordinates that are not fast between a model and the next finer one (of the
/// finest the next cruder one), over some swings.
double partingOf(const System& system, const SlowModel& model, const State& start, double duration) {
    constexpr int steps = 60;
    constexpr double longest = 20;
    const std::vector<SlowModel>& all = system.parts.find<SlowModels>()->all;
    const SlowModel& other = &model == &all.back() ? all[all.size() - 2] : *(&model + 1);
    const Discretization d = slowScheme("", 4);
    const Table<double> table = tableOf(polynomials(d.space), d.quadrature);
    const double h = std::clamp(duration, -longest, longest) / steps;
    const auto one = slowStep(model, table, h, {}), two = slowStep(other, table, h, {});
    State a = start, b = start;
    double parting = 0;
    for (int k = 1; k <= steps; ++k) {
        const double t = start.t + k * h;
        if (one->advance(a, t).outcome != Outcome::converged ||
            two->advance(b, t).outcome != Outcome::converged)
            return std::numeric_limits<double>::infinity();
        for (int i = 0; i < system.dimension(); ++i) {
            const auto& fast = system.fast.coordinates;
            if (std::find(fast.begin(), fast.end(), i) != fast.end()) continue;
            const auto at = static_cast<std::size_t>(i);
            parting = std::max(parting, std::abs(a.x[at] - b.x[at]));
        }
    }
    return parting;
}

}  // namespace

SpaceEntry slowSpace() {
    FieldInfo degree =
        integerField("degree", "s", 1, 12, 4.0, "Degree of the slow coordinates in time within one step.");
    degree.whyLimits = "a slow motion of degree 0 stands still; above 12 more steps are cheaper";
    SpaceEntry e;
    e.item = {
        "slow",
        "slow model",
        "A slow model in place of the system, without its fast oscillation, or with its phase known in "
        "closed form: steps that do not see the oscillation.",
        {choiceField("model", "model", {"rod", "averaged", "normal-form-1", "normal-form-2", "normal-form-3"},
                     "What stands in place of the oscillation: nothing, its mean, or its normal form "
                     "with so many corrections."),
         degree},
        {},
        ""};
    return e;
}

bool isSlow(const Settings& space) { return space.type == "slow"; }

Settings completeSlowRule(const Settings& space, const Settings& quadrature) {
    return completePlainRule(quadrature, std::max(1, space.integer("degree")), 1);
}

Properties describeSlow(const Settings& space, const Settings& quadrature) {
    const Properties inTime = describe(polynomials(space), quadrature);
    Properties p;
    // Of the system: the model's error has no order. Of the model: laws.slow_models.
    p.claims.isOneStep = false;
    p.refusal = inTime.refusal;
    p.hint = inTime.hint;
    p.place = inTime.place;
    p.instability = inTime.instability;
    p.stabilityLimit = std::numeric_limits<double>::infinity();
    p.space = "a slow model, polynomials of degree " + std::to_string(space.integer("degree"));
    p.knownAs = "slow model: " + space.text("model");
    p.shortName = "slow";
    p.remark = "a model in place of the system, symplectic and of order " +
               std::to_string(inTime.claims.order) + " in its own variables";
    return p;
}

std::string slowMismatch(const Settings& space, const System& system) {
    if (findSlowModel(system, space.text("model"))) return {};
    const auto* const models = system.parts.find<SlowModels>();
    if (!models || models->all.empty()) return system.id + " has no slow models";
    std::vector<std::string> known;
    for (const SlowModel& m : models->all) known.push_back(m.id);
    return system.id + " has no slow model \"" + space.text("model") + "\": it has " + joinNames(known);
}

std::string slowTitle(const Settings& space, const System& system) {
    const SlowModel* const model = findSlowModel(system, space.text("model"));
    return model ? model->title : std::string();
}

WrittenAction writtenSlow(const Settings&) {
    return {
        "q and p are those of the slow model with the Hamiltonian K: q is a polynomial of degree s, p one "
        "of degree s - 1. The state of the system at a node is the one that the model stands for.",
        {{"S(q_0, q_1) = ext h Σ_i b_i [P_i·V_i − K(Q_i, P_i)]",
          "S(q_0, q_1) = \\operatorname*{ext}\\; h \\sum_i b_i \\bigl[ P_i \\cdot V_i - K(Q_i, P_i) "
          "\\bigr]"}},
        {{"Σ_i b_i φ_a′(c_i) (V_i − ∂K/∂p(i)) = 0,  Σ_i b_i (φ_a′(c_i) P_i − h φ_a(c_i) ∂K/∂q(i)) = "
          "φ_a(1) p_1,  p_1 = p_0 − h Σ_i b_i ∂K/∂q(i)",
          "\\sum_i b_i \\varphi_a'(c_i) \\Bigl( V_i - \\frac{\\partial K}{\\partial p}\\Big|_i \\Bigr) = "
          "0, \\quad \\sum_i b_i \\Bigl( \\varphi_a'(c_i) P_i - h \\varphi_a(c_i) \\frac{\\partial "
          "K}{\\partial q}\\Big|_i \\Bigr) = \\varphi_a(1) p_1, \\quad p_1 = p_0 - h \\sum_i b_i "
          "\\frac{\\partial K}{\\partial q}\\Big|_i"}}};
}

void checkSlow(const SchemeCase& scheme, Findings& findings) {
    constexpr double tooFar = 0.1;
    const Settings& space = scheme.discretization.space;
    const SlowModel* const model = findSlowModel(scheme.system, space.text("model"));
    const double duration = scheme.end - scheme.initial.t;
    if (!model || duration == 0 || !std::isfinite(duration)) return;
    const double parting = partingOf(scheme.system, *model, scheme.initial, duration);
    if (parting <= tooFar) return;
    findings.warning("/space/model",
                     "leaves too much out for this motion: the next better model parts from it by " +
                         (std::isfinite(parting) ? formatNumber(parting, 2) : "more than can be computed"),
                     "a scheme that keeps the oscillation, such as multiscale-r2", {}, "slow-models");
}

std::unique_ptr<Integrator> makeSlowStep(const System& system, const Discretization& d, double step,
                                         const SolverPolicy& policy) {
    const SlowModel* const model = findSlowModel(system, d.space.text("model"));
    if (!model) throw InvalidScene("/space/model", slowMismatch(d.space, system));
    return slowStep(*model, cellOf(polynomials(d.space), d.quadrature), step, policy);
}

Discretization slowScheme(const char* model, int degree) {
    Discretization d;
    d.space = {"slow", {{"model", model}, {"degree", static_cast<double>(degree)}}, {}};
    d.quadrature = {"gauss", {{"nodes", static_cast<double>(degree)}, {"panels", 1.0}}, {}};
    return d;
}

}  // namespace extremal
