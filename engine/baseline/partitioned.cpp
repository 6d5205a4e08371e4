#include "engine/baseline/partitioned.hpp"

#include <limits>
#include <utility>

#include "engine/baseline/flow_method.hpp"

namespace extremal {
namespace {

template <int D>
class Partitioned final : public FlowMethod<D> {
    using Base = FlowMethod<D>;
    using Vector = typename Base::Vector;

public:
    Partitioned(const Mechanics<double>& mechanics, double step, const std::vector<PartitionedStage>& stages)
        : Base(mechanics, step), stages_(stages) {
        for (Vector* v : {&dq_, &dp_, &start_, &change_, &force_, &forceAt_, &inverseMass_})
            *v = Vector::Zero(this->d());
        forceAt_.setConstant(std::numeric_limits<double>::quiet_NaN());
        if (mechanics.isSeparable)
            inverseMass_ = Eigen::Map<const Vector>(mechanics.masses, this->d()).cwiseInverse();
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Partitioned>(*this); }

    /// Separable systems: the same maps on local copies, without a call per step.
    StepReport advanceBlock(State& state, NodeBlock& nodes, std::size_t count, const Clock& clock) override {
        count = std::min(count, nodes.capacity() - nodes.size());
        if (!this->mechanics_.isSeparable || this->mechanics_.isTimeDependent || count < 2)
            return Base::advanceBlock(state, nodes, count, clock);
        const auto d = static_cast<std::size_t>(this->d());
        StepReport report;
        report.step = this->h();
        Vector q = typename Base::View(state.x.data(), this->d()),
               p = typename Base::View(state.x.data() + d, this->d());
        bool isForceFresh = forceAt_ == q;  // else the cost would depend on where blocks begin
        for (std::size_t i = 0; i + 1 < count; ++i) {
            report.cost.evaluations = 0;
            for (const PartitionedStage& stage : stages_) {
                const double s = stage.fraction * this->h();
                if (stage.map == HalfMap::kickImplicit || stage.map == HalfMap::kickExplicit) {
                    if (!isForceFresh) {
                        this->mechanics_.force(this->mechanics_.model.get(), state.t, q.data(),
                                               force_.data());
                        ++report.cost.evaluations;
                        isForceFresh = true;
                    }
                    p += s * force_;
                } else {
                    q += (s * inverseMass_).cwiseProduct(p);
                    isForceFresh = false;
                }
            }
            state.t = clock.at(++state.node);
            std::copy_n(q.data(), d, state.x.data());
            std::copy_n(p.data(), d, state.x.data() + d);
            nodes.push(state, report);
        }
        if (isForceFresh) forceAt_ = q;
        // The last one on the common path, which leaves the dense output behind.
        return Base::advanceBlock(state, nodes, 1, clock);
    }

private:
    void step(double t) override {
        double tq = t,
               tp = t;  // kicks and drifts each move their own clock: q and p are known at different times
        for (const PartitionedStage& stage : stages_) {
            const double s = stage.fraction * this->h();
            const bool isKick = stage.map == HalfMap::kickImplicit || stage.map == HalfMap::kickExplicit;
            if (this->mechanics_.isSeparable)
                separable(isKick, tq, s);
            else if (stage.map == HalfMap::kickExplicit || stage.map == HalfMap::driftExplicit)
                explicitMap(isKick, isKick ? tq : tp, s);
            else
                implicitMap(isKick, isKick ? tq : tp, s);
            (isKick ? tp : tq) += s;
            if (this->report_.outcome != Outcome::converged) return;
        }
    }
    void separable(bool isKick, double t, double s) {
        if (isKick) {
            const auto& m = this->mechanics_;
            // The last kick of a step and the first of the next one use the same force.
            if (m.isTimeDependent || forceAt_ != this->q1_) {
                m.force(m.model.get(), t, this->q1_.data(), force_.data());
                forceAt_ = this->q1_;
                ++this->report_.cost.evaluations;
            }
            this->p1_ += s * force_;
        } else {
            this->q1_ += (s * inverseMass_).cwiseProduct(this->p1_);
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
        double last = std::numeric_limits<double>::infinity();
        constexpr double epsilon = std::numeric_limits<double>::epsilon();
        for (int iteration = 0; iteration < 200; ++iteration) {
            if (this->stop().stop_requested()) {
                this->report_.outcome = Outcome::stopped;
                return;
            }
            this->flow(t, this->q1_, this->p1_, dq_, dp_);
            if (this->report_.outcome != Outcome::converged) return;
            ++this->report_.cost.iterations;
            change_ = start_ + s * (isKick ? dp_ : dq_) - x;
            x += change_;
            const double size = change_.cwiseAbs().maxCoeff(), scale = x.cwiseAbs().maxCoeff();
            this->report_.residual = scale > 0 ? size / scale : size;
            if (!(size < std::numeric_limits<double>::infinity())) {
                this->report_.outcome = Outcome::notFinite;
                return;
            }
            if (size <= epsilon * scale || (size < 100 * epsilon * scale && size >= last)) return;
            last = size;
        }
        this->report_.outcome = Outcome::diverged;
    }

    std::vector<PartitionedStage> stages_;
    Vector dq_, dp_, start_, change_, force_, forceAt_, inverseMass_;
};

}  // namespace

std::unique_ptr<Integrator> makePartitioned(const Mechanics<double>& mechanics, double step,
                                            const std::vector<PartitionedStage>& stages) {
    return makeFlowMethod<Partitioned>(mechanics, step, stages);
}

BaselineEntry partitionedBaseline(CatalogItem item, std::vector<PartitionedStage> stages) {
    BaselineEntry e;
    e.item = std::move(item);
    e.stabilityLimit = 2;
    e.make = [stages = std::move(stages)](const System& system, const BaselineOptions& options) {
        return makePartitioned(system.mechanics(), options.step, stages);
    };
    return e;
}

}  // namespace extremal
