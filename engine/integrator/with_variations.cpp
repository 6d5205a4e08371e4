#include "engine/integrator/with_variations.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/model/symplectic_form.hpp"

namespace extremal {
namespace {

using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t mostColumns = 64, representatives = 4;

/// A vector of length 1 without a symmetry that a system might have.
void fillIrregularly(double* w, std::size_t n, std::size_t which) {
    constexpr double golden = 0.6180339887498949;
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double place = golden * static_cast<double>(i + 1 + which * n);
        w[i] = 0.5 + (place - std::floor(place));
        if (which > 0 && (i / which) % 2 == 1) w[i] = -w[i];
        sum += w[i] * w[i];
    }
    for (std::size_t i = 0; i < n; ++i) w[i] /= std::sqrt(sum);
}

class WithVariations final : public Integrator {
public:
    WithVariations(std::unique_ptr<Integrator> scheme, const System& system, const VariationPlan& plan)
        : scheme_(std::move(scheme)),
          form_(system),
          isUnitary_(isWave(system)),
          plan_(plan),
          n_(scheme_->tangentSize()),
          isWhole_(n_ <= mostColumns),
          columns_(!plan.map  ? 0
                   : isWhole_ ? n_
                              : representatives) {
        const auto n = static_cast<Index>(n_);
        const Index moved = static_cast<Index>(isWhole_ ? columns_ : columns_ + vectors());
        M_ = Matrix::Zero(n, columns_ == 0 ? static_cast<Index>(vectors()) : moved);
        product_ = Matrix::Zero(n, static_cast<Index>(columns_));
        before_.assign(columns_ * columns_, 0);
        if (isWhole_) lu_ = Eigen::PartialPivLU<Matrix>(n);
        quantities_.assign(scheme_->quantities().begin(), scheme_->quantities().end());
        own_ = quantities_.size();
        if (plan_.map) {
            quantities_.push_back({"symplecticity", "", "", ""});
            quantities_.push_back({"symplecticity_accumulated", "", "", ""});
            quantities_.push_back({"volume", "", "", ""});
            quantities_.push_back({"floquet_trace", "", "", ""});
            if (isMechanical(system) && n_ == 2 * system.coordinates.size())
                for (const Coordinate& c : system.coordinates)
                    quantities_.push_back({"floquet_trace." + c.name, "", "", ""});
            traces_.assign(quantities_.size() - own_ - 3, unknown);
        }
        if (plan_.vector) {
            quantities_.push_back({"lyapunov", "", "", ""});
            quantities_.push_back({"megno", "", "", ""});
        }
    }
    WithVariations(const WithVariations& other)
        : Integrator(other),
          scheme_(other.scheme_->clone()),
          form_(other.form_),
          isUnitary_(other.isUnitary_),
          plan_(other.plan_),
          n_(other.n_),
          isWhole_(other.isWhole_),
          columns_(other.columns_),
          own_(other.own_),
          inner_(other.inner_),
          M_(other.M_),
          product_(other.product_),
          lu_(other.lu_),
          before_(other.before_),
          quantities_(other.quantities_),
          state_(other.state_),
          values_(other.values_),
          traces_(other.traces_) {}
    WithVariations& operator=(const WithVariations&) = delete;

    TimeGrid grid() const override { return scheme_->grid(); }
    double stepSize() const override { return scheme_->stepSize(); }
    void setStep(double h) override { scheme_->setStep(h); }
    bool checksFinite() const override { return scheme_->checksFinite(); }
    std::size_t tangentSize() const override { return n_; }
    bool applyTangent(std::span<double> W) override { return scheme_->applyTangent(W); }
    void denseOutput(double tau, std::span<double> x) const override { scheme_->denseOutput(tau, x); }
    double periodsPerStep() const override { return scheme_->periodsPerStep(); }
    std::string about() const override { return scheme_->about(); }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<WithVariations>(*this); }

    std::vector<MemoryPart> memoryParts() const override {
        std::vector<MemoryPart> parts = scheme_->memoryParts();
        parts.push_back({"start of the variations", numbers});
        parts.push_back({"their forms at the start", columns_ * columns_});
        parts.push_back({"variations", (columns_ + vectors()) * n_});
        return parts;
    }
    void begin(State& state) override {
        scheme_->begin(state);
        state_.memory = state.memory;
        inner_ = state.memory.size();
        state.memory.resize(inner_ + numbers + columns_ * columns_ + (columns_ + vectors()) * n_, 0);
        const Memory memory = memoryOf(state);
        std::fill_n(memory.number, static_cast<std::size_t>(numbers), 0.0);
        memory.number[startTime] = state.t;
        for (std::size_t j = 0; j < columns_; ++j)
            if (isWhole_)
                for (std::size_t i = 0; i < n_; ++i) memory.Q[j * n_ + i] = i == j ? 1 : 0;
            else
                fillIrregularly(memory.Q + j * n_, n_, j + 1);
        if (plan_.vector) fillIrregularly(memory.w, n_, 0);
        forms(state.x.data(), memory.Q, memory.form);
    }

    StepReport advance(State& state, double until) override {
        if (state.memory.empty()) begin(state);
        inner_ = state.memory.size() - numbers - columns_ * columns_ - (columns_ + vectors()) * n_;
        scheme_->setStop(stop());
        state_.t = state.t;
        state_.node = state.node;
        state_.x.assign(state.x.begin(), state.x.end());
        state_.memory.assign(state.memory.begin(),
                             state.memory.begin() + static_cast<std::ptrdiff_t>(inner_));
        const StepReport report = scheme_->advance(state_, until);
        if (report.outcome != Outcome::converged) return report;
        move(memoryOf(state), state.x.data(), report);
        state.t = state_.t;
        state.node = state_.node;
        state.x.swap(state_.x);
        std::copy(state_.memory.begin(), state_.memory.end(), state.memory.begin());
        return report;
    }

    std::span<const Quantity> quantities() const override { return quantities_; }
    void measure(const State& state, double* values) const override {
        if (own_ > 0) {
            State inner = state;
            inner.memory.resize(inner_);
            scheme_->measure(inner, values);
        }
        values += own_;
        if (plan_.map) {
            *values++ = values_.step;
            *values++ = values_.accumulated;
            *values++ = values_.volume;
            values = std::copy(traces_.begin(), traces_.end(), values);
        }
        if (plan_.vector) {
            *values++ = values_.exponent;
            *values++ = values_.megno;
        }
    }

private:
    /// In State::memory, behind that of the scheme.
    enum Number : std::size_t { startTime, power, sumOfLogs, weightedSum, integralOfMegno, numbers };
    struct Memory {
        double *number, *form, *Q, *w;
    };
    struct Values {
        double step = unknown, accumulated = unknown, volume = unknown, exponent = unknown, megno = unknown;
    };

    std::size_t vectors() const { return plan_.vector ? 1 : 0; }
    Memory memoryOf(State& state) const {
        double* const number = state.memory.data() + inner_;
        double* const form = number + numbers;
        double* const Q = form + columns_ * columns_;
        return {number, form, Q, Q + columns_ * n_};
    }
    /// w(a_i, a_j) of columns into (i, j), i < j; of a unitary space the inner products into (j, i).
    void forms(const double* x, const double* a, double* all) const {
        for (std::size_t i = 0; i < columns_; ++i)
            for (std::size_t j = i + 1; j < columns_; ++j) {
                const double *const u = a + i * n_, *const v = a + j * n_;
                all[i * columns_ + j] = form_(x, u, v, n_);
                if (!isUnitary_) continue;
                double inner = 0;
                for (std::size_t k = 0; k < n_; ++k) inner += u[k] * v[k];
                all[j * columns_ + i] = inner;
            }
    }
    /// The largest |w(a_i, a_j) - scale * all(i, j)|.
    double defect(const double* x, const double* a, const double* all, double scale) {
        now_.assign(columns_ * columns_, 0);
        forms(x, a, now_.data());
        double largest = 0;
        for (std::size_t i = 0; i < columns_ * columns_; ++i) {
            const double each = std::abs(now_[i] - scale * all[i]);
            if (!(each <= largest)) largest = each;
        }
        return largest;
    }

    /// The variations by one step from x to state_.x.
    void move(const Memory& memory, const double* x, const StepReport& report) {
        const auto n = static_cast<Index>(n_), columns = static_cast<Index>(columns_);
        Eigen::Map<Matrix> Q(memory.Q, n, columns);
        Eigen::Map<Eigen::VectorXd> w(memory.w, plan_.vector ? n : 0);
        values_ = {};
        if (isWhole_ && columns_ > 0) {
            M_.setIdentity();
        } else {
            M_.leftCols(columns) = Q;
            if (plan_.vector) M_.col(columns) = w;
        }
        const std::span<double> all(M_.data(), static_cast<std::size_t>(M_.size()));
        if (report.event != StepEvent::none || !scheme_->applyTangent(all)) M_.setConstant(unknown);
        if (plan_.map) {
            if (isWhole_) {
                measureStep(x);
                product_.noalias() = M_.lazyProduct(Q);
                Q = product_;
            } else {
                before_.assign(columns_ * columns_, 0);
                forms(x, memory.Q, before_.data());
                values_.step = defect(state_.x.data(), M_.data(), before_.data(), 1) /
                               std::pow(Q.colwise().norm().maxCoeff(), 2);
                Q = M_.leftCols(columns);
            }
            measureProduct(memory, Q);
        }
        if (!plan_.vector) return;
        if (isWhole_ && columns_ > 0)
            w = (M_.lazyProduct(w)).eval();
        else
            w = M_.col(columns);
        grow(memory, w, report.step);
    }
    /// M in M_, of the step from x.
    void measureStep(const double* x) {
        product_.setIdentity();
        before_.assign(columns_ * columns_, 0);
        forms(x, product_.data(), before_.data());
        values_.step = defect(state_.x.data(), M_.data(), before_.data(), 1);
        if (grid() == TimeGrid::free) values_.step /= std::pow(M_.cwiseAbs().maxCoeff(), 2);
        lu_.compute(M_);
        values_.volume = lu_.determinant() - 1;
    }
    void measureProduct(const Memory& memory, Eigen::Map<Matrix>& Q) {
        constexpr int longest = 200;
        const double start = std::exp2(-2 * memory.number[power]);
        const double size = isWhole_ ? Q.cwiseAbs().maxCoeff() : Q.colwise().norm().maxCoeff();
        values_.accumulated = defect(state_.x.data(), memory.Q, memory.form, start) / (size * size);
        if (isWhole_) {
            const double unit = std::exp2(memory.number[power]);
            traces_[0] = unit * Q.trace();
            for (std::size_t k = 1; k < traces_.size(); ++k) {
                const auto q = static_cast<Index>(k - 1), p = q + Q.rows() / 2;
                traces_[k] = unit * (Q(q, q) + Q(p, p));
            }
        }
        if (!(size > std::exp2(longest))) return;
        Q *= std::exp2(-longest);
        memory.number[power] += longest;
    }
    /// The sums, from w after a step, which is brought back to length 1.
    void grow(const Memory& memory, Eigen::Map<Eigen::VectorXd>& w, double step) {
        double* const number = memory.number;
        const double length = w.norm(), time = state_.t - number[startTime], rate = std::log(length);
        w /= length;
        number[sumOfLogs] += rate;
        number[weightedSum] += time * rate;
        number[integralOfMegno] += step * 2 / time * number[weightedSum];
        values_.exponent = number[sumOfLogs] / std::abs(time);
        values_.megno = number[integralOfMegno] / time;
    }

    std::unique_ptr<Integrator> scheme_;
    SymplecticForm form_;
    bool isUnitary_;
    VariationPlan plan_;
    std::size_t n_;
    bool isWhole_;                     ///< all variations are carried, and M is known
    std::size_t columns_;              ///< of Q
    std::size_t own_ = 0, inner_ = 0;  ///< quantities, and memory, of the scheme
    Matrix M_, product_;
    Eigen::PartialPivLU<Matrix> lu_;
    std::vector<double> before_, now_;
    std::vector<Quantity> quantities_;
    State state_;  ///< of the scheme
    Values values_;
    std::vector<double> traces_;  ///< of P, and of its blocks of one coordinate and its momentum
};

}  // namespace

std::unique_ptr<Integrator> withVariations(std::unique_ptr<Integrator> scheme, const System& system,
                                           const VariationPlan& plan) {
    if (!(plan.map || plan.vector) || scheme->tangentSize() == 0) return scheme;
    return std::make_unique<WithVariations>(std::move(scheme), system, plan);
}

}  // namespace extremal
