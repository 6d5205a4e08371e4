// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/step/partitioned.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "engine/core/algebra/add_scaled.hpp"
#include "engine/core/corrections.hpp"
#include "engine/integrator/many_states.hpp"
#include "engine/integrator/shared_force.hpp"
#include "engine/integrator/skips_nodes.hpp"
#include "engine/step/coordinate_watch.hpp"
#include "engine/step/flow_method.hpp"

namespace extremal {
namespace {

/// Of a kick, with f' at (q_1, p_1): dp <- dp + s (pdot_q dq + pdot_p dp), where it is implicit with the new
/// dp on the right; of a drift likewise. `isOwn`: whether the rate of what moves depends on it.
void multiply(const Eigen::MatrixXd& jacobian, bool isKick, bool isOwn, bool isImplicit, double s,
              Eigen::Map<Eigen::MatrixXd>& W) {
    const Eigen::Index d = jacobian.rows() / 2, row = isKick ? d : 0, other = d - row;
    Eigen::MatrixXd own;
    auto moved = W.middleRows(row, d);
    if (isOwn) {
        own = s * jacobian.block(row, row, d, d);
        if (!isImplicit) moved += (own * moved).eval();
    }
    moved.noalias() += s * jacobian.block(row, other, d, d).lazyProduct(W.middleRows(other, d));
    if (isImplicit) {
        own = Eigen::MatrixXd::Identity(d, d) - own;
        moved = own.partialPivLu().solve(moved).eval();
    }
}

constexpr int many = TakesManyStates::together;

template <int D>
class Partitioned final : public FlowMethod<D>,
                          public SharesForce,
                          public SkipsNodes,
                          public TakesManyStates {
    using Base = FlowMethod<D>;
    using Vector = typename Base::Vector;

public:
    Partitioned(const Mechanics<double>& mechanics, double step, const std::vector<PartitionedStage>& stages)
        : Base(mechanics, step), stages_(stages) {
        for (Vector* v : {&dq_, &dp_, &start_, &change_, &force_, &forceAt_, &inverseMass_})
            *v = Vector::Zero(this->d());
        for (const PartitionedStage& stage : stages) {
            const bool isNext = pairs_.empty() || (stage.isKick() && pairs_.back().drift != 0);
            if (stage.isKick() && isNext)
                pairs_.push_back({stage.fraction, 0});
            else if (stage.isKick())
                pairs_.back().kick += stage.fraction;
            else
                (isNext ? firstDrift_ : pairs_.back().drift) += stage.fraction;
        }
        forceAt_.setConstant(std::numeric_limits<double>::quiet_NaN());
        if (mechanics.isSeparable)
            inverseMass_ = Eigen::Map<const Vector>(mechanics.masses, this->d()).cwiseInverse();
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Partitioned>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(force_, forceAt_, forceTime_);
        return true;
    }

    void takeForce(const SharesForce& other) override {
        const auto& before = static_cast<const Partitioned&>(other);
        force_ = before.force_;
        forceAt_ = before.forceAt_;
        forceTime_ = before.forceTime_;
    }

    /// Sums A(p) + B(q) whose system takes many steps by one call.
    StepReport advanceBlock(State& state, NodeBlock& nodes, std::size_t count, const Clock& clock) override {
        count = std::min(count, nodes.capacity() - nodes.size());
        const auto& m = this->mechanics_;
        if (!m.kicksAndDrifts || m.isTimeDependent || count < 2 || nodes.measuresQuantities())
            return Base::advanceBlock(state, nodes, count, clock);
        const auto d = static_cast<std::size_t>(this->d());
        KicksAndDrifts<double> steps = stepsFrom(state.x.data());
        steps.steps = static_cast<long long>(count) - 1;
        steps.nodes = nodes.next();
        steps.stride = nodes.width();
        StepReport report;
        report.step = this->h();
        m.kicksAndDrifts(m.model.get(), steps, state.x.data(), state.x.data() + d, force_.data());
        bool isForceFresh = steps.isForceKnown;
        for (long long i = 0; i < steps.steps; ++i) {
            report.cost.evaluations = evaluations(isForceFresh);
            isForceFresh = steps.keepsForce();
            ++state.node;
            nodes.push(clock.at(state.node), state.node, report);
        }
        state.t = clock.at(state.node);
        if (isForceFresh) std::copy_n(state.x.data(), d, forceAt_.data());
        // The last one on the common path, which leaves the dense output behind.
        return Base::advanceBlock(state, nodes, 1, clock);
    }

    /// Kicks and drifts at the ends of steps are put together.
    StepReport advanceOver(State& state, long long count, const Clock& clock) override {
        const auto& m = this->mechanics_;
        if (!m.kicksAndDrifts || m.isTimeDependent || count < 3)
            return advanceByNodes(*this, state, count, clock);
        double *const q = state.x.data(), *const p = q + this->d();
        this->q0_ = typename Base::View(q, this->d());
        this->p0_ = typename Base::View(p, this->d());
        const KicksAndDrifts<double> steps = stepsFrom(q);
        takeJoined(steps, count - 1, q, p);
        if (!Base::isFinite(typename Base::View(q, this->d())) ||
            !Base::isFinite(typename Base::View(p, this->d()))) {
            std::copy_n(this->q0_.data(), this->d(), q);
            std::copy_n(this->p0_.data(), this->d(), p);
            return advanceByNodes(*this, state, count, clock);
        }
        state.node += count - 1;
        state.t = clock.at(state.node);
        StepReport report = this->advance(state, clock.at(state.node + 1));
        report.cost.evaluations +=
            evaluations(steps.isForceKnown) + static_cast<int>(count - 2) * evaluations(steps.keepsForce());
        return report;
    }

    bool advanceMany(double* x, long long steps) override {
        const auto& m = this->mechanics_;
        if (!m.isSeparable || m.isTimeDependent || !m.forces || !hasForcesOf(x)) return false;
        const std::size_t half = static_cast<std::size_t>(this->d()) * many;
        KicksAndDrifts<double> all;
        all.pairs = pairs_;
        all.firstDrift = firstDrift_;
        all.steps = steps;
        all.isForceKnown = true;
        takeEach(
            all, [&] { m.forces(m.model.get(), manyTimes_.data(), many, x, manyForces_.data()); },
            [&](double s) { addScaled(x + half, s, manyForces_.data(), half); },
            [&](double s) {
                for (std::size_t k = 0; k < half; k += many)
                    addScaled(x + k, s * inverseMass_(static_cast<Eigen::Index>(k / many)), x + half + k,
                              many);
            });
        return true;
    }

    /// The action of the step of a separable system, whose differential is p_1 dq_1 - p_0 dq_0: s T for a
    /// drift over s, -s V for a kick.
    std::span<const Quantity> quantities() const override {
        static const Quantity action{"action", "", "S", ""};
        const bool exists = this->mechanics_.isSeparable && !this->mechanics_.isTimeDependent;
        return {&action, exists ? 1u : 0u};
    }
    void measure(const State&, double* values) const override {
        const auto& m = this->mechanics_;
        const Vector zero = Vector::Zero(this->d());
        Vector q = this->q0_, p = this->p0_, force = zero;
        values[0] = 0;
        for (const PartitionedStage& stage : stages_) {
            const double s = stage.fraction * this->h();
            if (stage.isKick()) {
                m.force(m.model.get(), this->startTime_, q.data(), force.data());
                p += s * force;
                values[0] -= s * m.energy(m.model.get(), this->startTime_, q.data(), zero.data());
            } else {
                q += (s * inverseMass_).cwiseProduct(p);
                values[0] += 0.5 * s * inverseMass_.dot(p.cwiseAbs2());
            }
        }
    }

private:
    /// Whether the forces of these motions are those of each by itself; they are kept.
    bool hasForcesOf(const double* x) {
        const auto& m = this->mechanics_;
        const auto d = static_cast<std::size_t>(this->d());
        manyForces_.resize(d * many);
        manyTimes_.assign(many, 0.0);
        m.forces(m.model.get(), manyTimes_.data(), many, x, manyForces_.data());
        Vector q = inverseMass_, f = inverseMass_;
        for (std::size_t i = 0; i < many; ++i) {
            for (std::size_t k = 0; k < d; ++k) q(static_cast<Eigen::Index>(k)) = x[k * many + i];
            m.force(m.model.get(), 0.0, q.data(), f.data());
            for (std::size_t k = 0; k < d; ++k) {
                const double ofMany = manyForces_[k * many + i], alone = f(static_cast<Eigen::Index>(k));
                if (std::bit_cast<std::uint64_t>(ofMany) != std::bit_cast<std::uint64_t>(alone) &&
                    std::isfinite(alone))
                    return false;
            }
        }
        return true;
    }
    bool stepInPlace(double, double* q, double* p) override {
        const auto& m = this->mechanics_;
        if (!m.kicksAndDrifts || m.isTimeDependent) return false;
        const KicksAndDrifts<double> steps = stepsFrom(q);
        m.kicksAndDrifts(m.model.get(), steps, q, p, force_.data());
        this->report_.cost.evaluations += evaluations(steps.isForceKnown);
        if (steps.keepsForce()) std::copy_n(q, this->d(), forceAt_.data());
        return true;
    }
    void step(double t) override {
        if (!this->mechanics_.isSum() || this->mechanics_.isTimeDependent) {
            takeStages(t, [](auto&&...) { return true; });
            return;
        }
        const auto& m = this->mechanics_;
        KicksAndDrifts<double> one;
        one.pairs = pairs_;
        one.firstDrift = firstDrift_;
        one.isForceKnown = forceAt_ == this->q1_;
        takeEach(
            one,
            [&] {
                m.force(m.model.get(), t, this->q1_.data(), force_.data());
                ++this->report_.cost.evaluations;
            },
            [&](double s) {
                if constexpr (D == Eigen::Dynamic)
                    addScaled(this->p1_.data(), s, force_.data(), static_cast<std::size_t>(this->d()));
                else
                    this->p1_ += s * force_;
            },
            [&](double s) { drift(t, s, this->q1_.data(), this->p1_.data(), this->report_); });
        if (one.keepsForce()) forceAt_ = this->q1_;
    }
    /// A step from q by one call of the system, with the force of the last kick where that was at q.
    KicksAndDrifts<double> stepsFrom(const double* q) {
        const double h = this->h();
        if (h != timesOf_) {
            times_ = pairs_;
            for (KickAndDrift<double>& pair : times_) pair = {pair.kick * h, pair.drift * h};
            timesOf_ = h;
        }
        KicksAndDrifts<double> one;
        one.pairs = times_;
        one.firstDrift = firstDrift_ * h;
        one.perMass = inverseMass_.data();
        const std::size_t size = static_cast<std::size_t>(this->d()) * sizeof(double);
        one.isForceKnown = firstDrift_ == 0 && std::memcmp(forceAt_.data(), q, size) == 0;
        return one;
    }
    /// `count` >= 2 such steps, the last kick or drift of each with the first one of the next.
    void takeJoined(KicksAndDrifts<double> steps, long long count, double* q, double* p) {
        const auto take = [&](std::span<const KickAndDrift<double>> pairs, long long times) {
            steps.pairs = pairs;
            steps.steps = times;
            this->mechanics_.kicksAndDrifts(this->mechanics_.model.get(), steps, q, p, force_.data());
            steps.isForceKnown = false;
        };
        const std::span<const KickAndDrift<double>> own = steps.pairs;
        joined_.assign(own.begin(), own.end());
        if (steps.keepsForce() && own.size() > 1) {
            joined_.pop_back();
            joined_.front().kick += own.back().kick;
            take(own.first(own.size() - 1), 1);
            take(joined_, count - 1);
            take(own.last(1), 1);
            std::copy_n(q, this->d(), forceAt_.data());
        } else if (steps.firstDrift != 0 && !own.empty() && own.back().drift != 0) {
            joined_.back().drift += steps.firstDrift;
            take(joined_, 1);
            steps.firstDrift = 0;
            take(joined_, count - 2);
            take(own, 1);
        } else {
            take(own, count);
        }
    }
    int evaluations(bool isForceKnown) const { return static_cast<int>(pairs_.size()) - isForceKnown; }
    /// The kicks and drifts of steps, each by its time.
    template <class Evaluate, class Kick, class Drift>
    void takeEach(const KicksAndDrifts<double>& steps, Evaluate&& evaluate, Kick&& kick, Drift&& drift) {
        steps.take([&](double s) { drift(s * this->h()); },
                   [&](const KickAndDrift<double>& pair, bool isForceKnown) {
                       if (!isForceKnown) evaluate();
                       kick(pair.kick * this->h());
                       drift(pair.drift * this->h());
                   },
                   [](long long) {});
    }
    /// `besides(isKick, isImplicit, t, s)` before each explicit stage, and after each implicit one: where the
    /// state is that of its derivatives. Its false ends the step.
    template <class Besides>
    bool takeStages(double t, Besides&& besides) {
        double tq = t,
               tp = t;  // kicks and drifts each move their own clock: q and p are known at different times
        for (const PartitionedStage& stage : stages_) {
            const double s = stage.fraction * this->h();
            const bool isKick = stage.isKick();
            const bool isImplicit = !this->mechanics_.isSum() && (stage.map == HalfMap::kickImplicit ||
                                                                  stage.map == HalfMap::driftImplicit);
            const double at = isKick ? tq : tp;
            if (!isImplicit && !besides(isKick, false, at, s)) return false;
            if (this->mechanics_.isSum())
                ofSum(isKick, at, s);
            else if (isImplicit)
                implicitMap(isKick, at, s);
            else
                explicitMap(isKick, at, s);
            if (this->report_.outcome != Outcome::converged) return false;
            if (isImplicit && !besides(isKick, true, at, s)) return false;
            (isKick ? tp : tq) += s;
        }
        return true;
    }
    /// The product of the tangent maps of the stages, which are taken once more.
    bool tangent(double t, typename Base::Columns W) override {
        const Vector endQ = this->q1_, endP = this->p1_;
        this->q1_ = this->q0_;
        this->p1_ = this->p0_;
        const bool isKnown = takeStages(t, [&](bool isKick, bool isImplicit, double at, double s) {
            const Eigen::MatrixXd* const jacobian = this->flowJacobian(at, this->q1_, this->p1_);
            if (jacobian) multiply(*jacobian, isKick, !this->mechanics_.isSum(), isImplicit, s, W);
            return jacobian != nullptr;
        });
        this->q1_ = endQ;
        this->p1_ = endP;
        return isKnown;
    }
    void ofSum(bool isKick, double t, double s) {
        const auto& m = this->mechanics_;
        if (isKick) {
            // The last kick of a step and the first of the next one use the same force.
            if (forceAt_ != this->q1_ || (m.isTimeDependent && forceTime_ != t)) {
                m.force(m.model.get(), t, this->q1_.data(), force_.data());
                forceAt_ = this->q1_;
                forceTime_ = t;
                ++this->report_.cost.evaluations;
            }
            this->p1_ += s * force_;
        } else {
            drift(t, s, this->q1_.data(), this->p1_.data(), this->report_);
        }
    }
    /// q += s q', where the velocities are found: those of a typed Lagrangian may not be.
    void drift(double t, double s, double* q, const double* p, StepReport& report) {
        const auto& m = this->mechanics_;
        typename Base::View Q(q, this->d());
        if (!m.isSeparable) {
            if (!m.velocity(m.model.get(), t, q, p, dq_.data())) report.outcome = Outcome::singular;
            Q += s * dq_;
        } else if constexpr (D == Eigen::Dynamic) {
            addScaledProducts(q, s, inverseMass_.data(), p, static_cast<std::size_t>(this->d()));
        } else {
            Q += (s * inverseMass_).cwiseProduct(Eigen::Map<const Vector>(p, this->d()));
        }
    }
    void explicitMap(bool isKick, double t, double s) {
        this->flow(t, this->q1_, this->p1_, dq_, dp_);
        if (isKick)
            this->p1_ += s * dp_;
        else
            this->q1_ += s * dq_;
    }
    void implicitMap(bool isKick, double t, double s) {
        Vector& x = isKick ? this->p1_ : this->q1_;
        start_ = x;
        CoordinateWatch watch;
        const CorrectionLimits limits{.most = 200, .roundOff = 100 * CorrectionLimits::epsilon, .stall = 1};
        this->report_.outcome = solveByCorrections(limits, this->stop(), this->report_, [&](int, double) {
            this->flow(t, this->q1_, this->p1_, dq_, dp_);
            if (this->report_.outcome != Outcome::converged)
                return Correction{.outcome = this->report_.outcome};
            change_ = start_ + s * (isKick ? dp_ : dq_) - x;
            x += change_;
            for (int k = 0; k < this->d(); ++k) watch.add(change_(k), x(k) - start_(k), start_(k));
            return Correction{change_.cwiseAbs().maxCoeff(), x.cwiseAbs().maxCoeff(),
                              watch.isSettled(stallOfSweeps)};
        });
    }

    std::vector<PartitionedStage> stages_;
    double firstDrift_ = 0;                    ///< of a splitting that begins with one, as a part of the step
    std::vector<KickAndDrift<double>> pairs_;  ///< what follows, likewise
    std::vector<KickAndDrift<double>> times_;  ///< the same for the step timesOf_
    std::vector<KickAndDrift<double>> joined_;  ///< of a step between others
    double timesOf_ = 0;
    Vector dq_, dp_, start_, change_, force_, forceAt_, inverseMass_;
    double forceTime_ = 0;  ///< of force_, where forces depend on time
    std::vector<double> manyForces_, manyTimes_;
};

}  // namespace

std::unique_ptr<Integrator> makePartitioned(const Mechanics<double>& mechanics, double step,
                                            const std::vector<PartitionedStage>& stages) {
    return makeFlowMethod<Partitioned>(mechanics, step, stages);
}

std::vector<PartitionedStage> partitionedStages(const Splitting& splitting, bool isSum) {
    std::vector<PartitionedStage> stages;
    if (isSum) {
        for (const SplittingStage& s : splitting.stages)
            stages.push_back({s.isKick ? HalfMap::kickExplicit : HalfMap::driftExplicit, s.fraction});
        return stages;
    }
    double c = 0;
    bool isEuler = true;
    for (std::size_t i = 0; i + 1 < splitting.stages.size(); ++i, isEuler = !isEuler) {
        c = splitting.stages[i].fraction - c;
        stages.push_back({isEuler ? HalfMap::kickImplicit : HalfMap::driftImplicit, c});
        stages.push_back({isEuler ? HalfMap::driftExplicit : HalfMap::kickExplicit, c});
    }
    return stages;
}

}  // namespace extremal
