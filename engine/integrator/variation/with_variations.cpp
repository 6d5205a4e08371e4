// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/variation/with_variations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/algebra/lu.hpp"
#include "engine/integrator/variation/accompanied.hpp"
#include "engine/model/first_order/one_form.hpp"
#include "engine/model/first_order/poisson.hpp"
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

/// How many variations are carried along: of Q, all of them or some representatives, and w.
struct Size {
    Size(std::size_t tangent, std::size_t allowed, const VariationPlan& plan)
        : n(tangent),
          free(allowed),
          isWhole(n <= mostColumns),
          columns(!plan.map ? 0
                  : isWhole ? free
                            : std::min(representatives, free)),
          vectors(plan.vector ? 1 : 0) {}
    std::size_t n, free;  ///< numbers of a variation, and how many are independent
    bool isWhole;         ///< all variations are carried, and M is known
    std::size_t columns, vectors;

    /// What is carried: the numbers of `Number`, the forms at the start, Q column after column, w.
    std::size_t carried() const { return numbers + columns * columns + (columns + vectors) * n; }
    enum Number : std::size_t { startTime, power, sumOfLogs, weightedSum, integralOfMegno, area, numbers };
};

/// In the order of `Said`, the traces between the volume and the exponent; of a one-form the area behind
/// them.
std::vector<std::string> namesOf(const System& system, const Size& size) {
    std::vector<std::string> names;
    if (size.columns > 0) {
        names = {"symplecticity", "symplecticity_accumulated", "volume", "floquet_trace"};
        if (size.n == 2 * system.coordinates.size() && size.free == size.n)
            for (const Coordinate& c : system.coordinates) names.push_back("floquet_trace." + c.name);
        if (system.parts.find<OneForm>()) names.push_back("area");
    }
    if (size.vectors > 0) names.insert(names.end(), {"lyapunov", "megno"});
    return names;
}

std::optional<PoissonEquations> bracketOf(const System& system) {
    const PoissonStructure* const found = system.parts.find<PoissonStructure>();
    return found ? std::optional<PoissonEquations>(*found) : std::nullopt;
}

class WithVariations final : public Accompanied {
public:
    WithVariations(std::unique_ptr<Integrator> scheme, const System& system, const Size& size,
                   TangentBasis basis)
        : Accompanied(std::move(scheme), size.carried(), namesOf(system, size)),
          form_(system),
          isUnitary_(system.isUnitary),
          hasArea_(size.columns > 0 && system.parts.find<OneForm>()),
          size_(size),
          basis_(std::move(basis)),
          bracket_(bracketOf(system)) {
        const auto n = static_cast<Index>(size.n);
        const std::size_t moved = isMapKnown() ? size.columns : size.columns + size.vectors;
        M_ = Matrix::Zero(n, static_cast<Index>(moved));
        product_ = Matrix::Zero(n, static_cast<Index>(size.columns));
        before_.assign(size.columns * size.columns, 0);
        if (size.isWhole) lu_ = Eigen::PartialPivLU<Matrix>(static_cast<Index>(size.free));
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<WithVariations>(*this); }

private:
    enum Said : std::size_t { step, accumulated, volume, traces };
    struct Carried {
        double *number, *form, *Q, *w;
    };
    Carried parts(std::span<double> carried) const {
        double* const form = carried.data() + Size::numbers;
        double* const Q = form + size_.columns * size_.columns;
        return {carried.data(), form, Q, Q + size_.columns * size_.n};
    }
    /// Whether M is computed as a matrix of all variations.
    bool isMapKnown() const { return size_.isWhole && size_.columns > 0 && !basis_; }
    std::size_t areaPlace() const { return values_.size() - 2 * size_.vectors - (hasArea_ ? 1 : 0); }
    std::span<double> tracesSaid() { return std::span(values_).subspan(traces, areaPlace() - traces); }

    void startCarrying(const State& state, std::span<double> carried) override {
        const Carried all = parts(carried);
        all.number[Size::startTime] = state.t;
        for (std::size_t j = 0; j < size_.columns; ++j)
            if (size_.isWhole && !basis_)
                all.Q[j * size_.n + j] = 1;
            else
                fillIrregularly(all.Q + j * size_.n, size_.n, j + 1);
        if (size_.vectors > 0) fillIrregularly(all.w, size_.n, 0);
        if (basis_) startOnManifold(state, all);
        forms(state.x.data(), all.Q, all.form);
    }
    void carry(const State& before, const State& after, const StepReport& report,
               std::span<double> carried) override {
        const Carried all = parts(carried);
        const auto n = static_cast<Index>(size_.n), columns = static_cast<Index>(size_.columns);
        Eigen::Map<Matrix> Q(all.Q, n, columns);
        Eigen::Map<Eigen::VectorXd> w(all.w, size_.vectors > 0 ? n : 0);
        std::fill(values_.begin(), values_.end(), unknown);
        if (basis_ && size_.isWhole && columns > 0) measureOnManifold(before, after, report);
        if (isMapKnown()) {
            M_.setIdentity();
        } else {
            M_.leftCols(columns) = Q;
            if (size_.vectors > 0) M_.col(columns) = w;
        }
        const std::span<double> moved(M_.data(), static_cast<std::size_t>(M_.size()));
        if (report.event != StepEvent::none || !applyTangent(moved)) M_.setConstant(unknown);
        if (columns > 0) {
            if (isMapKnown()) {
                measureStep(before.x.data(), after.x.data());
                if (hasArea_) values_[areaPlace()] = all.number[Size::area] += growthOfArea();
                product_.noalias() = M_.lazyProduct(Q);
                Q = product_;
            } else if (size_.isWhole) {
                Q = M_.leftCols(columns);
            } else {
                before_.assign(size_.columns * size_.columns, 0);
                forms(before.x.data(), all.Q, before_.data());
                values_[step] = defect(after.x.data(), M_.data(), before_.data(), 1) /
                                std::pow(Q.colwise().norm().maxCoeff(), 2);
                Q = M_.leftCols(columns);
            }
            measureProduct(after.x.data(), all, Q);
        }
        if (size_.vectors == 0) return;
        if (isMapKnown())
            w = (M_.lazyProduct(w)).eval();
        else
            w = M_.col(columns);
        grow(after.t, all.number, w, report.step);
    }

    Matrix basisAt(const State& state) const {
        const std::vector<double> columns = basis_(state.t, state.x.data());
        const auto n = static_cast<Index>(size_.n);
        return Eigen::Map<const Matrix>(columns.data(), n, static_cast<Index>(columns.size()) / n);
    }
    /// Of what begins at random the part along the manifold; of Q, where all are carried, the basis.
    void startOnManifold(const State& state, const Carried& all) {
        const auto n = static_cast<Index>(size_.n), columns = static_cast<Index>(size_.columns);
        const Matrix basis = basisAt(state);
        Eigen::Map<Matrix> Q(all.Q, n, columns);
        if (size_.isWhole)
            Q = basis.leftCols(columns);
        else
            Q = (basis * (basis.transpose() * Q)).colwise().normalized().eval();
        Eigen::Map<Eigen::VectorXd> w(all.w, size_.vectors > 0 ? n : 0);
        if (size_.vectors > 0) w = (basis * (basis.transpose() * w)).normalized().eval();
    }
    /// The step on a basis of variations along the manifold.
    void measureOnManifold(const State& before, const State& after, const StepReport& report) {
        Matrix moved = basisAt(before);
        const auto free = static_cast<Index>(size_.free);
        before_.assign(size_.columns * size_.columns, 0);
        forms(before.x.data(), moved.data(), before_.data());
        const double form = skewDeterminant(before_, free);
        const std::span<double> columns(moved.data(), static_cast<std::size_t>(moved.size()));
        if (report.event != StepEvent::none || !applyTangent(columns)) return;
        values_[step] = defect(after.x.data(), moved.data(), before_.data(), 1);
        values_[volume] = std::sqrt(skewDeterminant(now_, free) / form) - 1;
    }
    /// The determinant of the skew matrix whose upper half forms() has filled.
    double skewDeterminant(const std::vector<double>& upper, Index n) {
        Matrix skew = Matrix::Zero(n, n);
        for (Index i = 0; i < n; ++i)
            for (Index j = i + 1; j < n; ++j) {
                skew(i, j) = upper[static_cast<std::size_t>(i * n + j)];
                skew(j, i) = -skew(i, j);
            }
        return lu_.compute(skew).determinant();
    }

    /// w(a_i, a_j) of columns into (i, j), i < j; of a unitary space the inner products into (j, i).
    void forms(const double* x, const double* a, double* all) const {
        for (std::size_t i = 0; i < size_.columns; ++i)
            for (std::size_t j = i + 1; j < size_.columns; ++j) {
                const double *const u = a + i * size_.n, *const v = a + j * size_.n;
                all[i * size_.columns + j] = form_(x, u, v, size_.n);
                if (!isUnitary_) continue;
                double inner = 0;
                for (std::size_t k = 0; k < size_.n; ++k) inner += u[k] * v[k];
                all[j * size_.columns + i] = inner;
            }
    }
    /// The largest |w(a_i, a_j) - scale * all(i, j)|.
    double defect(const double* x, const double* a, const double* all, double scale) {
        now_.assign(size_.columns * size_.columns, 0);
        forms(x, a, now_.data());
        double largest = 0;
        for (std::size_t i = 0; i < size_.columns * size_.columns; ++i) {
            const double each = std::abs(now_[i] - scale * all[i]);
            if (!(each <= largest)) largest = each;
        }
        return largest;
    }

    /// M in M_, of the step from x to y.
    void measureStep(const double* x, const double* y) {
        product_.setIdentity();
        before_.assign(size_.columns * size_.columns, 0);
        forms(x, product_.data(), before_.data());
        values_[step] = bracket_ ? bracketDefect(x, y) : defect(y, M_.data(), before_.data(), 1);
        if (grid() == TimeGrid::free) values_[step] /= std::pow(M_.cwiseAbs().maxCoeff(), 2);
        lu_.compute(M_);
        values_[volume] = lu_.determinant() - 1;
    }
    /// ln det M + ln det Om(y) / 2 - ln det Om(x) / 2, of what measureStep() has left: the determinant of
    /// M^T Om(y) M over that of Om(x).
    double growthOfArea() {
        const auto n = static_cast<Index>(size_.n);
        const double after = skewDeterminant(now_, n), before = skewDeterminant(before_, n);
        return std::log(after / before) / 2;
    }
    /// The largest entry of M J(x) M^T - J(y): a bracket moves with its covectors.
    double bracketDefect(const double* x, const double* y) {
        product_.noalias() = M_ * bracket_->structure(x);
        moved_.noalias() = product_ * M_.transpose();
        return (moved_ - bracket_->structure(y)).cwiseAbs().maxCoeff();
    }
    void measureProduct(const double* y, const Carried& all, Eigen::Map<Matrix>& Q) {
        constexpr int longest = 200;
        double& power = all.number[Size::power];
        const double size = size_.isWhole ? Q.cwiseAbs().maxCoeff() : Q.colwise().norm().maxCoeff();
        if (!bracket_)
            values_[accumulated] = defect(y, all.Q, all.form, std::exp2(-2 * power)) / (size * size);
        if (isMapKnown()) {
            const double unit = std::exp2(power);
            const std::span<double> said = tracesSaid();
            said[0] = unit * Q.trace();
            for (std::size_t k = 1; k < said.size(); ++k) {
                const auto q = static_cast<Index>(k - 1), p = q + Q.rows() / 2;
                said[k] = unit * (Q(q, q) + Q(p, p));
            }
        }
        if (!(size > std::exp2(longest))) return;
        Q *= std::exp2(-longest);
        power += longest;
    }
    /// The sums, from w after a step to time t, which is brought back to length 1.
    void grow(double t, double* number, Eigen::Map<Eigen::VectorXd>& w, double stepSize) {
        const double length = w.norm(), time = t - number[Size::startTime], rate = std::log(length);
        w /= length;
        number[Size::sumOfLogs] += rate;
        number[Size::weightedSum] += time * rate;
        number[Size::integralOfMegno] += stepSize * 2 / time * number[Size::weightedSum];
        const std::size_t exponent = values_.size() - 2, megno = values_.size() - 1;
        values_[exponent] = number[Size::sumOfLogs] / std::abs(time);
        values_[megno] = number[Size::integralOfMegno] / time;
    }

    SymplecticForm form_;
    bool isUnitary_, hasArea_;
    Size size_;
    TangentBasis basis_;
    std::optional<PoissonEquations> bracket_;  ///< its buffers
    Matrix M_, product_, moved_;
    Eigen::PartialPivLU<Matrix> lu_;
    std::vector<double> before_, now_;
};

}  // namespace

std::unique_ptr<Integrator> withVariations(std::unique_ptr<Integrator> scheme, const System& system,
                                           const VariationPlan& plan, TangentBasis basis, int free) {
    if (!(plan.map || plan.vector) || scheme->tangentSize() == 0) return scheme;
    const std::size_t n = scheme->tangentSize();
    const Size size(n, basis ? static_cast<std::size_t>(free) : n, plan);
    return std::make_unique<WithVariations>(std::move(scheme), system, size, std::move(basis));
}

}  // namespace extremal
