// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/dense_equations.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "engine/mechanism/node_lanes.hpp"
#include "engine/mechanism/rolling_rows.hpp"
#include "engine/solve/small_lu.hpp"

namespace extremal {
namespace {

/// R, A and their derivatives are sums over the nodes of three rules: of h L_q and L_v, of h F, and of the
/// impulses of the multipliers.
class DenseEquations final : public MechanismEquations {
    using Matrix = Eigen::MatrixXd;
    using Rows = Mechanism::Rows;

public:
    DenseEquations(const Mechanism& mechanism, const MechanismCurve& curve)
        : mechanics_(mechanism.mechanics()),
          constraint_(mechanism.constraint()),
          force_(mechanism.force()),
          curve_(curve),
          n_(mechanism.constraints()),
          holonomic_(mechanism.holonomic()),
          inside_(curve.atLagrangian.rule.c, curve.atLagrangian.at, curve.d),
          ofInside_(curve.atLagrangian.rule.b, curve.atLagrangian.at),
          insideQq_(ofInside_.value(), curve.atLagrangian.at.value),
          insideQv_(ofInside_.value(), curve.atLagrangian.at.slope),
          insideVq_(ofInside_.slope(), curve.atLagrangian.at.value),
          insideVv_(ofInside_.slope(), curve.atLagrangian.at.slope),
          forced_(curve.atForces.rule.c, curve.atForces.at, curve.d),
          ofForces_(curve.atForces.rule.b, curve.atForces.at),
          forcesQ_(ofForces_.value(), curve.atForces.at.value),
          forcesV_(ofForces_.value(), curve.atForces.at.slope),
          places_(curve.places, {curve.atPlaces, {}}, curve.d),
          ofImpulses_(ones(), {curve.atPlaces, {}}),
          impulsesQ_(ofImpulses_.value(), curve.atPlaces),
          ofRolling_(ones(), {curve.atRolling, {}}),
          rollingQ_(ofRolling_.value(), curve.atRolling),
          lu_(curve.unknowns() * (curve.d + n_)) {
        const int d = curve_.d, m = curve_.unknowns();
        if (mechanism.rolling()) rolling_.emplace(*mechanism.rolling(), curve);
        residual_ = Vector::Zero(m * (d + n_));
        impulse_ = masses_ = Vector::Zero(d);
        z_ = Vector::Zero((m + 1) * d);
        impulses_ = Vector::Zero(m * n_);
        Y_ = Matrix::Zero(m, d);
        kicks_ = shifts_ = Matrix::Zero(m + 1, d);
        gradients_ = inside_.room(2 * d);
        hessians_ = inside_.room(4 * d * d);
        gradient_ = Vector::Zero(2 * d);
        if (force_) {
            forces_ = forced_.room(d);
            byState_ = forced_.room(2 * d * d);
        }
        firsts_ = places_.room(holonomic_ * (1 + d));
        multipliers_ = places_.room(holonomic_);
        reactions_ = places_.room(d);
        curvatures_ = places_.room(constraint_ ? d * d : 0);
        rollingReactions_ = Matrix::Zero(m, d);
        rollingCurvatures_ = Matrix::Zero(m, rolling_ ? d * d : 0);
        curvature_ = Rows::Zero(d, d);
        byTime_ = Vector::Zero(holonomic_);
        block_ = Matrix::Zero(m + 1, m);
        impulseBy_ = Matrix::Zero(d, m * (d + n_));
    }

    std::unique_ptr<MechanismEquations> clone() const override {
        return std::make_unique<DenseEquations>(*this);
    }

    bool evaluate(double t, double h, const Vector& z, const Vector& p, const Vector& impulses) override {
        const int d = curve_.d, m = curve_.unknowns();
        h_ = h;
        z_ = z;
        impulses_ = impulses;
        for (int a = 0; a < m; ++a) Y_.row(a) = z.segment((a + 1) * d, d).transpose();
        kicks_.setZero();
        shifts_.setZero();
        addLagrangian(t);
        if (force_) addForces(t);
        if (constraint_) addConstraints(t);
        if (rolling_) addRolling(t);
        for (int a = 0; a < m; ++a)
            residual_.segment(a * d, d) = (h * kicks_.row(a) + shifts_.row(a)).transpose();
        residual_.segment((m - 1) * d, d) += p;
        impulse_ = (h * kicks_.row(m) + shifts_.row(m)).transpose();
        return residual_.allFinite() && impulse_.allFinite();
    }

    Outcome factorise() override {
        const int d = curve_.d, m = curve_.unknowns();
        findSecondDerivatives();
        lu_.clear();
        impulseBy_.setZero();
        for (int k = 0; k < d; ++k)
            for (int l = 0; l < d; ++l) addPair(k, l);
        for (int j = 0; j < m; ++j) {
            if (constraint_) setConstraints(j);
            if (rolling_) setRolling(j);
        }
        return lu_.factorise();
    }
    void solve(Vector& x) const override { lu_.solve(x.data()); }
    void solveTransposed(Vector& x) const override { lu_.solveTransposed(x.data()); }
    void reactions(const double* impulses, Vector& to) const override {
        const int count = curve_.unknowns() * n_;
        to.noalias() = impulseBy_.rightCols(count) * Eigen::Map<const Vector>(impulses, count);
    }
    bool moveImpulse(const Vector& correction) override {
        impulse_.noalias() -= impulseBy_ * correction;
        return true;
    }

private:
    std::vector<double> ones() const {
        return std::vector<double>(static_cast<std::size_t>(curve_.unknowns()), 1.0);
    }

    void addLagrangian(double t) {
        const int d = curve_.d, stride = inside_.stride();
        inside_.moveTo(t, h_, z_.data(), Y_);
        const auto* const model = mechanics_.model.get();
        if (mechanics_.gradients)
            mechanics_.gradients(model, inside_.times(), stride, inside_.q(), inside_.v(), gradients_.data());
        else
            inside_.oneByOne(gradients_, [&](double time, const double* q, const double* v, double* to) {
                mechanics_.gradient(model, time, q, v, to);
            });
        ofInside_.addValues(gradients_.data(), stride, kicks_);
        ofInside_.addSlopes(gradients_.col(d).data(), stride, shifts_);
    }

    void addForces(double t) {
        const int stride = forced_.stride();
        forced_.moveTo(t, h_, z_.data(), Y_);
        const auto* const model = force_->model.get();
        if (force_->values)
            force_->values(model, forced_.times(), stride, forced_.q(), forced_.v(), forces_.data());
        else
            forced_.oneByOne(forces_, [&](double time, const double* q, const double* v, double* to) {
                force_->value(model, time, q, v, to);
            });
        ofForces_.addValues(forces_.data(), stride, kicks_);
    }

    /// Column of g_q in firsts_.
    int byPlace(int constraint, int i) const { return holonomic_ + constraint * curve_.d + i; }

    void addConstraints(double t) {
        const int d = curve_.d, m = curve_.unknowns(), stride = places_.stride();
        places_.moveTo(t, h_, z_.data(), Y_);
        const auto* const model = constraint_->model.get();
        if (constraint_->firsts)
            constraint_->firsts(model, places_.times(), stride, places_.q(), firsts_.data());
        else
            places_.oneByOne(firsts_, [&](double time, const double* q, const double*, double* to) {
                constraint_->first(model, time, q, to, to + holonomic_, byTime_.data());
            });
        for (int j = 0; j < m; ++j) {
            residual_.segment(m * d + j * n_, holonomic_) = firsts_.row(j + 1).head(holonomic_).transpose();
            multipliers_.row(j) = impulses_.segment(j * n_, holonomic_).transpose();
        }
        reactions_.setZero();
        for (int c = 0; c < holonomic_; ++c)
            for (int k = 0; k < d; ++k)
                reactions_.col(k) += multipliers_.col(c).cwiseProduct(firsts_.col(byPlace(c, k)));
        ofImpulses_.addValues(reactions_.data(), stride, shifts_);
    }

    void addRolling(double t) {
        const int d = curve_.d, m = curve_.unknowns(), n = n_ - holonomic_;
        rolling_->evaluate(t, h_, z_);
        for (int j = 0; j < m; ++j) {
            residual_.segment(m * d + j * n_ + holonomic_, n) = rolling_->residual(j);
            rollingReactions_.row(j).noalias() =
                impulses_.segment(j * n_ + holonomic_, n).transpose() * rolling_->reaction(j);
        }
        ofRolling_.addValues(rollingReactions_.data(), m, shifts_);
    }

    /// At the places of the last evaluation.
    void findSecondDerivatives() {
        const int d = curve_.d;
        const auto* const model = mechanics_.model.get();
        if (mechanics_.hessians)
            mechanics_.hessians(model, inside_.times(), inside_.stride(), inside_.q(), inside_.v(),
                                hessians_.data());
        else
            inside_.oneByOne(hessians_, [&](double t, const double* q, const double* v, double* to) {
                double value = 0;
                mechanics_.jet(model, t, q, v, &value, gradient_.data(), to);
            });
        for (int k = 0; k < d; ++k)
            masses_(k) = hessians_.col(entry(d + k, d + k)).head(inside_.nodes()).cwiseAbs().maxCoeff();
        if (force_ && force_->derivatives)
            force_->derivatives(force_->model.get(), forced_.times(), forced_.stride(), forced_.q(),
                                forced_.v(), byState_.data());
        else if (force_)
            forced_.oneByOne(byState_, [&](double t, const double* q, const double* v, double* to) {
                force_->first(force_->model.get(), t, q, v, gradient_.data(), to);
            });
        for (int j = 1; constraint_ && j < curve_.unknowns(); ++j) {
            curvature_.setZero();
            constraint_->addCurvature(constraint_->model.get(), places_.times()[j], places_.placeOf(j),
                                      impulses_.data() + j * n_, curvature_.data());
            curvatures_.row(j) = Eigen::Map<const Eigen::RowVectorXd>(curvature_.data(), d * d);
        }
        for (int j = 0; rolling_ && j < curve_.unknowns(); ++j) {
            const Rows& curvature = rolling_->curvature(j, z_, impulses_.data() + j * n_ + holonomic_);
            rollingCurvatures_.row(j) = Eigen::Map<const Eigen::RowVectorXd>(curvature.data(), d * d);
        }
    }
    int entry(int row, int column) const { return 2 * curve_.d * row + column; }

    /// dR(k) / dY(l) and dA(k) / dY(l), of all functions.
    void addPair(int k, int l) {
        const int d = curve_.d, m = curve_.unknowns();
        const auto hessian = [&](int row, int column) { return hessians_.col(entry(row, column)).data(); };
        block_.setZero();
        bool isPresent = insideQq_.add(hessian(k, l), h_, block_);
        isPresent |= insideQv_.add(hessian(k, d + l), 1, block_);
        isPresent |= insideVq_.add(hessian(d + k, l), 1, block_);
        isPresent |= insideVv_.add(hessian(d + k, d + l), 1 / h_, block_);
        if (force_) {
            isPresent |= forcesQ_.add(byState_.col(entry(k, l)).data(), h_, block_);
            isPresent |= forcesV_.add(byState_.col(entry(k, d + l)).data(), 1, block_);
        }
        if (constraint_) isPresent |= impulsesQ_.add(curvatures_.col(k * d + l).data(), 1, block_);
        if (rolling_) isPresent |= rollingQ_.add(rollingCurvatures_.col(k * d + l).data(), 1, block_);
        if (!isPresent) return;
        for (int b = 0; b < m; ++b) {
            double* const column = lu_.column(b * d + l);
            for (int a = 0; a < m; ++a) column[a * d + k] = block_(a, b);
            impulseBy_(k, b * d + l) = block_(m, b);
        }
    }

    /// Reactions at e_j, and g at e_(j+1).
    void setConstraints(int j) {
        const int d = curve_.d, m = curve_.unknowns();
        for (int c = 0; c < holonomic_; ++c) {
            double* const column = lu_.column(m * d + j * n_ + c);
            for (int i = 0; i < d; ++i) {
                const double reaction = firsts_(j, byPlace(c, i)), rate = firsts_(j + 1, byPlace(c, i));
                impulseBy_(i, m * d + j * n_ + c) = reaction;
                for (int a = 0; a < m; ++a) {
                    column[a * d + i] = ofImpulses_.value()(a, j) * reaction;
                    lu_.column(a * d + i)[m * d + j * n_ + c] = curve_.atPlaces(j + 1, a) * rate;
                }
            }
        }
    }
    void setRolling(int j) {
        const int d = curve_.d, m = curve_.unknowns();
        for (int c = 0; c < rolling_->count(); ++c) {
            const int row = m * d + j * n_ + holonomic_ + c;
            double* const column = lu_.column(row);
            impulseBy_.col(row) = rolling_->reaction(j).row(c).transpose();
            for (int a = 0; a < m; ++a)
                for (int i = 0; i < d; ++i) {
                    column[a * d + i] = ofRolling_.value()(a, j) * rolling_->reaction(j)(c, i);
                    lu_.column(a * d + i)[row] = rolling_->rate(j, c, a, i);
                }
        }
    }

    Mechanics<double> mechanics_;
    std::optional<Constraint> constraint_;
    std::optional<Force> force_;
    std::optional<RollingRows> rolling_;
    MechanismCurve curve_;
    int n_, holonomic_;
    NodeLanes inside_;  ///< the nodes of L
    NodeTests ofInside_;
    NodePairs insideQq_, insideQv_, insideVq_, insideVv_;  ///< by which L is differentiated, twice
    NodeLanes forced_;
    NodeTests ofForces_;
    NodePairs forcesQ_, forcesV_;
    NodeLanes places_;      ///< e_j
    NodeTests ofImpulses_;  ///< at e_j, j < m
    NodePairs impulsesQ_;
    NodeTests ofRolling_;  ///< at r_j
    NodePairs rollingQ_;
    SmallLu<double> lu_;
    double h_ = 0;  ///< of the last evaluation, as z_ and impulses_
    Vector z_, impulses_;
    Matrix Y_;               ///< (a, i)
    Matrix kicks_, shifts_;  ///< (a, i), a = m for the function 1: what is multiplied by h, and what is not
    Matrix gradients_, hessians_, forces_, byState_;  ///< side by side
    Matrix firsts_, multipliers_, reactions_, curvatures_;
    Matrix rollingReactions_, rollingCurvatures_;
    Matrix block_;      ///< (a, b), a = m for the function 1
    Matrix impulseBy_;  ///< dA by the unknowns
    Rows curvature_;
    Vector gradient_, byTime_;  ///< not asked for
};

}  // namespace

std::unique_ptr<MechanismEquations> denseEquations(const Mechanism& mechanism, const MechanismCurve& curve) {
    return std::make_unique<DenseEquations>(mechanism, curve);
}

}  // namespace extremal
