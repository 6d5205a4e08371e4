// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/modal_splitting.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "engine/core/algebra/add_scaled.hpp"
#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/lanes_trigonometry.hpp"
#include "engine/family/fourier_grid.hpp"
#include "engine/family/modal_march.hpp"
#include "engine/integrator/skips_nodes.hpp"

namespace extremal {
namespace {

/// u <- own u + other v, v <- back u + own v.
void turnRows(double* u, double* v, const double* own, const double* other, const double* back,
              std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
        const double before = u[i];
        u[i] = own[i] * before + other[i] * v[i];
        v[i] = back[i] * before + own[i] * v[i];
    }
}
/// The same after v <- v + kick g.
void kickAndTurnRows(double kick, const double* g, double* u, double* v, const double* own,
                     const double* other, const double* back, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
        const double before = u[i], kicked = v[i] + kick * g[i];
        u[i] = own[i] * before + other[i] * kicked;
        v[i] = back[i] * before + own[i] * kicked;
    }
}

class ModalSplitting final : public ModalMarch<FourierGrid>, public SkipsNodes {
public:
    ModalSplitting(const SpectralDomain& domain, const Splitting& splitting, double step)
        : ModalMarch(FourierGrid(domain, domain.nx, domain.ny), domain, step),
          stages_(splitting.stages),
          joined_(stages_.front().fraction) {
        // Of two neighbouring steps the free motions that meet are one.
        if (!stages_.front().isKick && !stages_.back().isKick) joined_ += stages_.back().fraction;
        kicks_ = static_cast<std::size_t>(
            std::count_if(stages_.begin(), stages_.end(), [](const SplittingStage& s) { return s.isKick; }));
        known_.resize(2 * n());
        for (auto* row : {&U_, &V_, &G_, &dU_, &dV_}) row->resize(linear_.size());
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<ModalSplitting>(*this); }
    /// The first step makes modes of the state, the last one leaves what can be asked of it.
    StepReport advanceOver(State& state, long long count, const Clock& clock) override {
        if (count < 3) return advanceByNodes(*this, state, count, clock);
        StepReport report = advance(state, clock.at(state.node + 1));
        if (report.outcome != Outcome::converged) return report;
        Cost cost = report.cost;
        report = {.outcome = takeSteps(count - 2, cost), .step = h()};
        if (report.outcome == Outcome::converged) {
            toKnown();
            if (!isFinite(known_)) report.outcome = Outcome::notFinite;
        }
        if (report.outcome == Outcome::converged) {
            std::copy(known_.begin(), known_.end(), state.x.begin());
            state.node += count - 2;
            state.t = clock.at(state.node);
            report = advance(state, clock.at(state.node + 1));
            cost += report.cost;
        } else {
            isKnown_ = false;
        }
        report.cost = cost;
        return report;
    }
    bool checkpoint(Archive& archive) override {
        const bool isWhole = FieldMarch::checkpoint(archive);
        archive(isKnown_, hasForce_, known_, U_, V_, G_);
        return isWhole;
    }

private:
    /// The free motions of a step, one for each length that occurs.
    struct Turn {
        double fraction;
        std::vector<double> own, other, back;
    };

    void prepare() override {
        turns_.clear();
        for (const SplittingStage& s : stages_)
            if (!s.isKick && !turnOver(s.fraction)) turns_.push_back(makeTurn(s.fraction));
        if (!stages_.front().isKick && !turnOver(joined_)) turns_.push_back(makeTurn(joined_));
        isKnown_ = false;
    }
    Turn makeTurn(double fraction) const {
        Turn turn{fraction, {}, {}, {}};
        const double time = fraction * h();
        for (std::size_t first = 0; first < linear_.size(); first += Lanes::size) {
            const std::size_t count = std::min(Lanes::size, linear_.size() - first);
            Lanes w;
            for (std::size_t i = 0; i < count; ++i) w.lane[i] = std::sqrt(linear_[first + i]);
            const Lanes angle = Lanes(time) * w, c = cos(angle), s = sin(angle);
            for (std::size_t i = 0; i < count; ++i) {
                turn.own.push_back(c.lane[i]);
                turn.other.push_back(w.lane[i] > 0 ? s.lane[i] / w.lane[i] : time);
                turn.back.push_back(-w.lane[i] * s.lane[i]);
            }
        }
        return turn;
    }
    const Turn* turnOver(double fraction) const {
        const auto found =
            std::find_if(turns_.begin(), turns_.end(), [&](const Turn& t) { return t.fraction == fraction; });
        return found == turns_.end() ? nullptr : &*found;
    }

    Outcome step(const double* x, double* next, StepReport& report) override {
        const std::size_t size = n();
        if (!isKnown_ || std::memcmp(known_.data(), x, 2 * size * sizeof(double)) != 0) {
            toModes(x, U_.data());
            toModes(x + size, V_.data());
            hasForce_ = false;
        }
        isKnown_ = false;  // until the step is done
        const Outcome outcome = takeSteps(1, report.cost);
        if (outcome != Outcome::converged) return outcome;
        toKnown();
        std::copy(known_.begin(), known_.end(), next);
        return outcome;
    }
    void toKnown() {
        toNodes(U_.data(), known_.data());
        toNodes(V_.data(), known_.data() + n());
        isKnown_ = true;
    }
    /// A kick is done together with the free motion that follows it.
    Outcome takeSteps(long long count, Cost& cost) {
        Due due;
        for (long long i = 0; i < count; ++i) {
            if (stop().stop_requested()) return Outcome::stopped;
            for (std::size_t k = 0; k < stages_.size(); ++k) {
                const SplittingStage& s = stages_[k];
                if (!s.isKick) {
                    if (k > 0 && due.motion != 0) settle(due);
                    due.motion += s.fraction;  // the first to the last one of the step before, if any
                    continue;
                }
                if (due.motion != 0) settle(due);
                // The first kick has the force of the last one of the step before.
                if (!hasForce_) {
                    evaluateForce();
                    cost.evaluations += static_cast<long long>(points_);
                }
                hasForce_ = true;
                due.kick += s.fraction;
            }
        }
        settle(due);
        return Outcome::converged;
    }
    /// What U_ and V_ are still to go through: a kick by G_, then a free motion; parts of a step.
    struct Due {
        double kick = 0, motion = 0;
    };
    void settle(Due& due) {
        static const auto both = ForThisMachine<&kickAndTurnRows>::call();
        if (due.motion == 0) {
            if (due.kick != 0) kick(due.kick, V_);
        } else {
            const Turn& by = *turnOver(due.motion);
            if (due.kick != 0)
                both(due.kick * h(), G_.data(), U_.data(), V_.data(), by.own.data(), by.other.data(),
                     by.back.data(), U_.size());
            else
                move(due.motion, U_, V_);
            hasForce_ = false;
        }
        due = {};
    }
    void evaluateForce() {
        toPoints(U_.data());
        evaluateSlope();
        forceToModes(G_.data());
    }
    void move(double fraction, std::vector<double>& u, std::vector<double>& v) const {
        static const auto turn = ForThisMachine<&turnRows>::call();
        const Turn& by = *turnOver(fraction);
        turn(u.data(), v.data(), by.own.data(), by.other.data(), by.back.data(), u.size());
    }
    void kick(double fraction, std::vector<double>& v) const {
        addScaled(v.data(), fraction * h(), G_.data(), v.size());
    }

    /// W'' at every kick of the last step, which is taken once more.
    bool linearise() override {
        const std::size_t size = curvatureRows() * stride_;
        curvature_.resize(size * kicks_);
        std::vector<double> U(U_), V(V_), G(G_);
        toModes(before().data(), U_.data());
        toModes(before().data() + n(), V_.data());
        double* at = curvature_.data();
        for (const SplittingStage& s : stages_) {
            if (!s.isKick) {
                move(s.fraction, U_, V_);
                continue;
            }
            toPoints(U_.data());
            evaluateCurvature(values_.data(), at);
            at += size;
            evaluateForce();
            kick(s.fraction, V_);
        }
        U_ = std::move(U);
        V_ = std::move(V);
        G_ = std::move(G);
        return isKnown_;
    }
    void vary(std::vector<double>& du, std::vector<double>& dp) override {
        toModes(du.data(), dU_.data());
        momentaToModes(dp, dV_.data());
        before_.swap(G_);  // that of the step stays for the next one
        G_.resize(linear_.size());
        const double* curvature = curvature_.data();
        for (const SplittingStage& s : stages_) {
            if (!s.isKick) {
                move(s.fraction, dU_, dV_);
                continue;
            }
            toPoints(dU_.data());
            applyCurvature(curvature);
            curvature += curvatureRows() * stride_;
            forceToModes(G_.data());
            kick(s.fraction, dV_);
        }
        before_.swap(G_);
        toNodes(dU_.data(), du.data());
        modesToMomenta(dV_.data(), dp);
    }

    std::vector<SplittingStage> stages_;
    double joined_;
    std::size_t kicks_ = 0;
    std::vector<Turn> turns_;
    bool isKnown_ = false, hasForce_ = false;  ///< G_ is that of U_
    std::vector<double> known_;                ///< the values that U_ and V_ belong to
    std::vector<double> U_, V_, G_, before_;   ///< modes of u, u_t and the rest of the force
    std::vector<double> dU_, dV_, curvature_;  ///< of variations
};

}  // namespace

std::unique_ptr<Integrator> makeModalSplitting(const SpectralDomain& domain, const Splitting& splitting,
                                               double step) {
    return std::make_unique<ModalSplitting>(domain, splitting, step);
}

}  // namespace extremal
