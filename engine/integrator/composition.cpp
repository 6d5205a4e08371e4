// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/composition.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "engine/integrator/shared_force.hpp"
#include "engine/integrator/variation/transposed_step.hpp"

namespace extremal {
namespace {

constexpr int highestOrder = 24, mostLevels = 4;

FieldInfo orderField(const char* whatIsLeftOut) {
    FieldInfo f = integerField("order", "", 4, highestOrder, nullptr,
                               std::string("order of the composition, even; left out: ") + whatIsLeftOut);
    f.isOptional = true;
    f.whyLimits = "compositions of order 2 gain nothing, and above 24 round-off hides what is gained";
    return f;
}

constexpr const char* kahanLi = "kahan-li";

/// Of kahan-li: the first parts; the one in the middle follows from their sum.
const std::vector<double>* firstParts(int order) {
    static const std::vector<double> six = {0.39216144400731413927925056, 0.33259913678935943859974864,
                                            -0.70624617255763935980996482, 0.08221359629355080023149045};
    static const std::vector<double> eight = {0.13020248308889008087881763,  0.56116298177510838456196441,
                                              -0.38947496264484728640807860, 0.15884190655515560089621075,
                                              -0.39590389413323757733623154, 0.18453964097831570709183254,
                                              0.25837438768632204729397911,  0.29501172360931029887096624};
    return order == 6 ? &six : order == 8 ? &eight : nullptr;
}

class Composition final : public Integrator, public TransposedStep {
public:
    Composition(std::vector<double> parts, const Integrator& scheme)
        : parts_(std::move(parts)), h_(scheme.stepSize()) {
        for (std::size_t i = 0; i < parts_.size(); ++i) addScheme(scheme);
        setStep(h_);
    }
    Composition(const Composition& other)
        : Integrator(other), parts_(other.parts_), h_(other.h_), start_(other.start_), end_(other.end_) {
        for (const auto& scheme : other.schemes_) addScheme(*scheme);
    }
    Composition& operator=(const Composition&) = delete;

    double stepSize() const override { return h_; }
    void setStep(double h) override {
        h_ = h;
        for (std::size_t i = 0; i < parts_.size(); ++i) schemes_[i]->setStep(parts_[i] * h_);
        shorter_.clear();
    }

    void begin(State& state) override {
        for (const auto& scheme : schemes_) scheme->begin(state);
    }

    StepReport advance(State& state, double until) override {
        work_ = state;
        const StepReport report = compose(work_, until);
        if (report.outcome != Outcome::converged) return report;
        start_ = state;
        std::swap(state.x, work_.x);
        state.t = until;
        ++state.node;
        end_ = state;
        return report;
    }

    void denseOutput(double tau, std::span<double> x) const override {
        constexpr std::size_t most = 64;
        if (tau <= 0 || tau >= 1) {
            const std::vector<double>& at = tau <= 0 ? start_.x : end_.x;
            std::copy(at.begin(), at.end(), x.begin());
            return;
        }
        // Those who look inside every step tend to ask for the same places.
        if (shorter_.size() >= most) shorter_.clear();
        std::unique_ptr<Composition>& part = shorter_[tau];
        if (!part) {
            part = std::make_unique<Composition>(*this);
            part->setStep(tau * h_);
        }
        State at = start_;
        part->begin(at);  // what it remembers of other steps does not change what is seen of this one
        advanceForDenseOutput(*part, at, start_.t + tau * h_);
        std::copy(at.x.begin(), at.x.end(), x.begin());
    }

    /// Tangent maps multiply; every part has its own last step.
    std::size_t tangentSize() const override { return schemes_.front()->tangentSize(); }
    std::string tangentProblem() const override { return schemes_.front()->tangentProblem(); }
    bool applyTangent(std::span<double> W) override {
        return std::all_of(schemes_.begin(), schemes_.end(),
                           [&](const auto& scheme) { return scheme->applyTangent(W); });
    }
    bool applyTransposed(std::span<double> W) override {
        return std::all_of(schemes_.rbegin(), schemes_.rend(),
                           [&](const auto& scheme) { return extremal::applyTransposed(*scheme, W); });
    }

    /// The actions of the parts add.
    std::span<const Quantity> quantities() const override {
        const std::span<const Quantity> all = schemes_.front()->quantities();
        const auto action = indexOf(all, "action");
        return action ? all.subspan(*action, 1) : std::span<const Quantity>();
    }
    void measure(const State&, double* values) const override {
        const std::span<const Quantity> all = schemes_.front()->quantities();
        const std::optional<std::size_t> action = indexOf(all, "action");
        if (!action) return;  // nothing to say
        std::vector<double> each(all.size());
        values[0] = 0;
        for (const auto& scheme : schemes_) {
            scheme->measure(end_, each.data());
            values[0] += each[*action];
        }
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Composition>(*this); }
    bool checkpoint(Archive& archive) override {
        return std::all_of(schemes_.begin(), schemes_.end(),
                           [&](const auto& scheme) { return scheme->checkpoint(archive); });
    }

private:
    void addScheme(const Integrator& scheme) {
        schemes_.push_back(scheme.clone());
        sharing_.push_back(dynamic_cast<SharesForce*>(schemes_.back().get()));
    }
    /// All parts, from state.t to `until`; state.node is that of the composition.
    StepReport compose(State& state, double until) {
        StepReport report;
        report.step = h_;
        const double start = state.t;
        const long long node = state.node;
        double passed = 0;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            Integrator& scheme = *schemes_[i];
            scheme.setStop(stop());
            scheme.begin(state);  // its last step ended elsewhere
            if (sharing_[i]) sharing_[i]->takeForce(*sharing_[i > 0 ? i - 1 : parts_.size() - 1]);
            passed += parts_[i];
            const bool isLast = i + 1 == parts_.size();
            const StepReport part = scheme.advance(state, isLast ? until : start + passed * h_);
            report.cost += part.cost;
            if (part.event != StepEvent::none) report.event = part.event;
            report.residual = std::max(report.residual, part.residual);
            report.outcome = part.outcome;
            if (report.outcome != Outcome::converged) break;
            state.node = node;
        }
        return report;
    }

    std::vector<double> parts_;
    double h_;
    std::vector<std::unique_ptr<Integrator>> schemes_;
    std::vector<SharesForce*> sharing_;  ///< the same, or null where they share nothing
    State work_, start_, end_;
    mutable std::map<double, std::unique_ptr<Composition>> shorter_;
};

}  // namespace

const std::vector<CatalogItem>& compositionCatalog() {
    static const std::vector<CatalogItem> catalog = {
        {"yoshida",
         "Yoshida",
         "three steps of a symmetric scheme for two orders more, the middle one backwards",
         {orderField("two more than the scheme has")},
         {},
         "a symmetric scheme with a fixed step"},
        {"suzuki",
         "Suzuki",
         "five shorter steps of a symmetric scheme for two orders more, with a smaller error",
         {orderField("two more than the scheme has")},
         {},
         "a symmetric scheme with a fixed step"},
        {kahanLi,
         "Kahan-Li",
         "nine or seventeen steps of a symmetric scheme of order 2 for order 6 or 8, with a much smaller "
         "error",
         {orderField("6")},
         {},
         "a symmetric scheme of order 2 with a fixed step"}};
    return catalog;
}

int defaultOrder(const std::string& composition, const Claims& scheme) {
    return composition == kahanLi ? 6 : scheme.order + 2;
}

std::string compositionRefusal(const Settings& composition, const Claims& scheme, std::string& hint) {
    const int order = composition.integer("order");
    if (!scheme.isOneStep) {
        hint = "a one-step scheme, or no composition";
        return "needs a one-step method: this scheme carries more than the state from step to step, and the "
               "parts of a composition are of different lengths";
    }
    if (!scheme.isSymmetric) {
        hint =
            "compose a symmetric scheme, or two that are adjoint as one: stormer-verlet in place of "
            "symplectic-euler";
        return "needs a symmetric scheme: the error of others has odd powers of the step, which these parts "
               "do not remove";
    }
    if (scheme.order == 0) {
        hint = "the scheme as it is";
        return "gains nothing: the error of this scheme does not follow a power of the step";
    }
    if (composition.type == kahanLi) {
        hint = "yoshida or suzuki";
        if (scheme.order != 2)
            return "needs a scheme of order 2, and this one has order " + std::to_string(scheme.order);
        if (firstParts(order)) return {};
        hint = "6 or 8, or " + hint;
        return "must be 6 or 8 for kahan-li, got " + std::to_string(order);
    }
    if (order % 2 != 0) {
        hint = "take " + std::to_string(order + 1);
        return "must be even, as the order of every symmetric scheme, got " + std::to_string(order);
    }
    if (order <= scheme.order) {
        hint = "from " + std::to_string(scheme.order + 2) + " on";
        return "must be above the order of the scheme, which is " + std::to_string(scheme.order) + ", got " +
               std::to_string(order);
    }
    if (order > scheme.order + 2 * mostLevels || order > highestOrder) {
        hint = "a scheme of higher order";
        return "is too far above the order of the scheme, which is " + std::to_string(scheme.order) +
               ": at most " + std::to_string(std::min(highestOrder, scheme.order + 2 * mostLevels)) +
               ", got " + std::to_string(order);
    }
    return {};
}

bool isComposableBy(const std::string& composition, const Claims& scheme) {
    std::string hint;
    const auto order = static_cast<double>(defaultOrder(composition, scheme));
    return compositionRefusal({composition, {{"order", order}}, {}}, scheme, hint).empty();
}

std::vector<double> compositionParts(const Settings& composition, int from) {
    if (composition.type == kahanLi) {
        std::vector<double> parts = *firstParts(composition.integer("order"));
        const std::vector<double> last(parts.rbegin(), parts.rend());
        parts.push_back(1 - 2 * std::accumulate(parts.begin(), parts.end(), 0.0));
        parts.insert(parts.end(), last.begin(), last.end());
        return parts;
    }
    const bool isYoshida = composition.type == "yoshida";
    const double twins = isYoshida ? 2 : 4;
    std::vector<double> parts{1};
    for (int p = from; p < composition.integer("order"); p += 2) {
        const double outer = 1 / (twins - std::pow(twins, 1.0 / (p + 1))), middle = 1 - twins * outer;
        std::vector<double> next;
        const auto append = [&](double factor) {
            for (const double g : parts) next.push_back(factor * g);
        };
        for (int i = 0; i < static_cast<int>(twins) / 2; ++i) append(outer);
        append(middle);
        for (int i = 0; i < static_cast<int>(twins) / 2; ++i) append(outer);
        parts = std::move(next);
    }
    return parts;
}

Claims composedClaims(const Settings& composition, Claims scheme) {
    scheme.order = composition.integer("order");
    return scheme;
}

std::unique_ptr<Integrator> composed(const std::vector<double>& parts, const Integrator& scheme) {
    return std::make_unique<Composition>(parts, scheme);
}

}  // namespace extremal
