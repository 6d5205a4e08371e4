// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/dense_equations.hpp"

#include <vector>

#include "engine/action/element_kernel.hpp"
#include "engine/solve/small_lu.hpp"

namespace extremal {
namespace {

class DenseEquations final : public MechanismEquations {
    using Rows = Mechanism::Rows;

public:
    DenseEquations(const Mechanism& mechanism, const MechanismCurve& curve)
        : mechanism_(mechanism),
          constraint_(mechanism.constraint()),
          force_(mechanism.force()),
          rolling_(mechanism.rolling()),
          curve_(curve),
          kernel_(mechanism.mechanics(), curve.table, ElementBasis::increments),
          n_(mechanism.constraints()),
          holonomic_(mechanism.holonomic()) {
        const int d = curve_.d, m = curve_.unknowns();
        lu_ = SmallLu<double>(m * (d + n_));
        residual_ = Vector::Zero(m * (d + n_));
        gradient_ = Vector::Zero((m + 1) * d);
        hessian_ = Eigen::MatrixXd::Zero((m + 1) * d, (m + 1) * d);
        forces_ = impulse_ = Vector::Zero(d);
        byState_ = Rows::Zero(d, 2 * d);
        byPlace_.assign(static_cast<std::size_t>(m + 1), Rows::Zero(n_, d));
        ofRolling_ = Rows::Zero(n_, d);
        value_ = byTime_ = Vector::Zero(n_);
        curvature_ = Rows::Zero(d, d);
        motion_ = Vector::Zero(2 * d);
        const int rolling = n_ - holonomic_;
        rollingValue_ = rollingByTime_ = Vector::Zero(rolling);
        rollingByState_.assign(static_cast<std::size_t>(m), Rows::Zero(rolling, 2 * d));
    }

    std::unique_ptr<MechanismEquations> clone() const override {
        return std::make_unique<DenseEquations>(*this);
    }

    /// G by z = (q_0, Y), its derivatives by Y, and the constraints.
    bool evaluate(double t, double h, const Vector& z, const Vector& p, const Vector& impulses) override {
        const int d = curve_.d, m = curve_.unknowns(), last = (m - 1) * d;
        if (!kernel_.evaluate(t, h, z, DerivativeOrder::second, derivatives_)) return false;
        gradient_ = derivatives_.gradient;
        hessian_ = derivatives_.hessian;
        if (force_) addForces(t, h, z);
        if (n_ > 0) addConstraints(t, h, z, impulses);
        if (rolling_) addRolling(t, h, z);
        if (!gradient_.allFinite()) return false;
        residual_.head(last) = gradient_.segment(d, last);
        residual_.segment(last, d) = p + (gradient_.head(d) - gradient_.tail(d));
        impulse_ = gradient_.head(d);
        return residual_.allFinite();
    }

    Outcome factorise() override {
        const int d = curve_.d, m = curve_.unknowns(), last = (m - 1) * d;
        const auto& H = hessian_;
        for (int c = 0; c < m * d; ++c) {
            double* const column = lu_.column(c);
            for (int r = 0; r < last; ++r) column[r] = H(d + r, d + c);
            for (int k = 0; k < d; ++k) column[last + k] = H(k, d + c) - H(m * d + k, d + c);
            const int a = c / d, i = c % d;
            for (int j = 1; j <= m; ++j) {
                double* const rows = column + m * d + (j - 1) * n_;
                for (int k = 0; k < holonomic_; ++k) rows[k] = curve_.atPlaces(j, a) * byPlaceAt(j)(k, i);
                for (int k = holonomic_; k < n_; ++k) rows[k] = rollingEntry(j - 1, k - holonomic_, a, i);
            }
        }
        for (int j = 0; j < m; ++j)
            for (int k = 0; k < n_; ++k) {
                double* const column = lu_.column(m * d + j * n_ + k);
                const Eigen::MatrixXd& at = k < holonomic_ ? curve_.atPlaces : curve_.atRolling;
                for (int a = 0; a < m; ++a) {
                    const double test = (a == m - 1 ? 1 : 0) + (a == m - 1 ? -1 : 1) * at(j, a);
                    for (int i = 0; i < d; ++i) column[a * d + i] = test * byPlaceAt(j)(k, i);
                }
                for (int r = 0; r < m * n_; ++r) column[m * d + r] = 0;
            }
        return lu_.factorise();
    }
    void solve(Vector& x) const override { lu_.solve(x.data()); }
    void solveTransposed(Vector& x) const override { lu_.solveTransposed(x.data()); }

private:
    Rows& byPlaceAt(int j) { return byPlace_[static_cast<std::size_t>(j)]; }

    void addForces(double t, double h, const Vector& z) {
        const MechanismCurve::Nodes& nodes = curve_.atForces;
        const int d = curve_.d, m = curve_.unknowns();
        for (int i = 0; i < nodes.nodes(); ++i) {
            curve_.motionAt(nodes, z, i, h, motion_);
            force_->first(force_->model.get(), t + nodes.place(i) * h, motion_.data(), motion_.data() + d,
                          forces_.data(), byState_.data());
            const double weight = h * nodes.weight(i);
            for (int a = -1; a < m; ++a) {  // -1: q_0, whose function is 1
                const double test = weight * (a < 0 ? 1 : nodes.at.value(i, a));
                gradient_.segment((a + 1) * d, d) += test * forces_;
                for (int b = 0; b < m; ++b)
                    hessian_.block((a + 1) * d, (b + 1) * d, d, d) +=
                        test * (nodes.at.value(i, b) * byState_.leftCols(d) +
                                nodes.at.slope(i, b) / h * byState_.rightCols(d));
            }
        }
    }

    void addConstraints(double start, double h, const Vector& z, const Vector& impulses) {
        const int d = curve_.d, m = curve_.unknowns();
        for (int j = 0; j <= m; ++j) {
            const double t = start + curve_.place(j) * h;
            curve_.placeAt(z, curve_.atPlaces, j, motion_);
            mechanism_.conditions(t, motion_.data(), value_, byPlaceAt(j), byTime_);
            if (j > 0) residual_.segment(m * d + (j - 1) * n_, n_) = value_;
            if (j == m) break;
            if (constraint_) addImpulses(*constraint_, {0, holonomic_, j, t}, curve_.atPlaces, impulses);
            if (!rolling_) continue;
            double there = t;
            if (curve_.isRollingAtGauss) {
                there = start + curve_.rolling.c[static_cast<std::size_t>(j)] * h;
                curve_.placeAt(z, curve_.atRolling, j, motion_);
                mechanism_.conditions(there, motion_.data(), value_, ofRolling_, byTime_);
                byPlaceAt(j).bottomRows(n_ - holonomic_) = ofRolling_.bottomRows(n_ - holonomic_);
            }
            addImpulses(*rolling_, {holonomic_, n_ - holonomic_, j, there}, curve_.atRolling, impulses);
        }
    }

    /// Rows of the conditions with multipliers at one place, where motion_ is.
    struct Multipliers {
        int first, count, node;
        double t;
    };
    template <class Part>
    void addImpulses(const Part& part, Multipliers of, const Eigen::MatrixXd& at, const Vector& impulses) {
        const int d = curve_.d, m = curve_.unknowns(), first = of.node * n_ + of.first;
        forces_.noalias() =
            byPlaceAt(of.node).middleRows(of.first, of.count).transpose() * impulses.segment(first, of.count);
        gradient_.head(d) += forces_;
        if (at.row(of.node).isZero(0)) return;
        curvature_.setZero();
        part.addCurvature(part.model.get(), of.t, motion_.data(), impulses.data() + first, curvature_.data());
        for (int a = -1; a < m; ++a) {
            const double test = a < 0 ? 1 : at(of.node, a);
            if (a >= 0) gradient_.segment((a + 1) * d, d) += test * forces_;
            for (int b = 0; b < m; ++b)
                hessian_.block((a + 1) * d, (b + 1) * d, d, d) += test * at(of.node, b) * curvature_;
        }
    }

    /// h r at the Gauss nodes, on the velocity of the curve: rows in the units of places.
    void addRolling(double start, double h, const Vector& z) {
        const int d = curve_.d, m = curve_.unknowns(), n = n_ - holonomic_;
        length_ = h;
        for (int i = 0; i < m; ++i) {
            curve_.motionAt(curve_.atGauss, z, i, h, motion_);
            rolling_->first(rolling_->model.get(), start + curve_.atGauss.place(i) * h, motion_.data(),
                            motion_.data() + d, rollingValue_.data(),
                            rollingByState_[static_cast<std::size_t>(i)].data(), rollingByTime_.data());
            residual_.segment(m * d + i * n_ + holonomic_, n) = h * rollingValue_;
        }
    }
    double rollingEntry(int node, int condition, int a, int coordinate) const {
        const Rows& byState = rollingByState_[static_cast<std::size_t>(node)];
        return length_ * curve_.atGauss.at.value(node, a) * byState(condition, coordinate) +
               curve_.atGauss.at.slope(node, a) * byState(condition, curve_.d + coordinate);
    }

    Mechanism mechanism_;
    std::optional<Constraint> constraint_;
    std::optional<Force> force_;
    std::optional<Rolling> rolling_;
    MechanismCurve curve_;
    ElementKernel<double> kernel_;
    ElementDerivatives<double> derivatives_;
    int n_, holonomic_;
    double length_ = 0;  ///< of the step
    SmallLu<double> lu_;
    Vector gradient_;  ///< G by z
    Eigen::MatrixXd hessian_;
    Rows curvature_;
    Vector forces_, motion_, value_, byTime_;  ///< motion_: (q, v) of one node
    Rows byState_;
    std::vector<Rows> byPlace_;  ///< [g_q; a] at e_j and r_j
    Rows ofRolling_;             ///< [g_q; a] at r_j
    Vector rollingValue_, rollingByTime_;
    std::vector<Rows> rollingByState_;  ///< at the Gauss nodes
};

}  // namespace

std::unique_ptr<MechanismEquations> denseEquations(const Mechanism& mechanism, const MechanismCurve& curve) {
    return std::make_unique<DenseEquations>(mechanism, curve);
}

}  // namespace extremal
