// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/dense_equations.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/algebra/dense.hpp"
#include "engine/mechanism/node_lanes.hpp"
#include "engine/mechanism/rolling_rows.hpp"
#include "engine/solve/null_space_lu.hpp"
#include "engine/solve/small_lu.hpp"

namespace extremal {
namespace {

/// Curves by their values at the Lobatto nodes e_1..e_m behind the start, Y_a = sum_j fit(a, j) u_j, and
/// tests by theirs at e_0..e_{m-1}: constraints and impulses are then those of one node each, and Newton's
/// system is solved on what constraints leave free (null_space_lu.hpp).
struct NodalCurve {
    using Matrix = Eigen::MatrixXd;
    using Rows = Mechanism::Rows;

    NodalCurve(const MechanismCurve& curve, const Matrix& testsAtPlaces, int constraints)
        : m(curve.unknowns()),
          d(curve.d),
          fromNodes(curve.fit),
          toNodes(curve.atPlaces.bottomRows(m)),
          tests(dense::inverse<double>(Matrix(testsAtPlaces.topLeftCorner(m, m)))),
          lu(m, d, constraints),
          values(Matrix::Zero(m, d)) {}

    /// Tests or functions, row by row or column by column, in place of those of the table.
    Matrix testing(Matrix all) const {
        all.topRows(m) = (tests * all.topRows(m)).eval();
        return all;
    }
    Matrix curves(const Matrix& all) const { return all.cols() > 0 ? Matrix(all * fromNodes) : all; }

    void solve(double* x) {
        const Eigen::Map<Rows> given(x, m, d);
        values = tests.lazyProduct(given);
        lu.solve(values.data(), x + m * d);
        Eigen::Map<Rows>(x, m, d) = fromNodes.lazyProduct(values);
    }
    void solveTransposed(double* x) {
        const Eigen::Map<Rows> given(x, m, d);
        values = fromNodes.transpose().lazyProduct(given);
        lu.solveTransposed(values.data(), x + m * d);
        Eigen::Map<Rows>(x, m, d) = tests.transpose().lazyProduct(values);
    }

    int m, d;
    Matrix fromNodes, toNodes, tests;
    NullSpaceLu lu;
    Matrix values;  ///< (j, k)
};

/// R, A and their derivatives are sums over the nodes of three rules: of h L_q and L_v, of h F, and of the
/// impulses of the multipliers.
class DenseEquations final : public MechanismEquations {
    using Matrix = Eigen::MatrixXd;
    using Rows = Mechanism::Rows;

public:
    DenseEquations(const Mechanism& mechanism, SharedCurve shared)
        : shared_(std::move(shared)),
          mechanics_(mechanism.mechanics()),
          constraint_(mechanism.constraint()),
          force_(mechanism.force()),
          curve_(*shared_),
          n_(mechanism.constraints()),
          holonomic_(mechanism.holonomic()),
          places_(curve_.places, {curve_.atPlaces, {}}, curve_.d),
          ofImpulses_(ones(), {curve_.atPlaces, {}}),
          nodal_(nodalCurve(mechanism)),
          impulsesQ_(pairs(ofImpulses_.value(), constraint_ && !nodal_ ? curve_.atPlaces : none())),
          inside_(curve_.atLagrangian.rule.c, curve_.atLagrangian.at, curve_.d),
          ofInside_(curve_.atLagrangian.rule.b, curve_.atLagrangian.at),
          insideQq_(pairs(ofInside_.value(), curve_.atLagrangian.at.value)),
          insideQv_(pairs(ofInside_.value(), curve_.atLagrangian.at.slope)),
          insideVq_(pairs(ofInside_.slope(), curve_.atLagrangian.at.value)),
          insideVv_(pairs(ofInside_.slope(), curve_.atLagrangian.at.slope)),
          isForcedInside_(curve_.areForcesInside()),
          forced_(curve_.atForces.rule.c, curve_.atForces.at, curve_.d),
          ofForces_(curve_.atForces.rule.b, curve_.atForces.at),
          forcesQ_(pairs(ofForces_.value(), isForcedInside_ ? none() : curve_.atForces.at.value)),
          forcesV_(pairs(ofForces_.value(), isForcedInside_ ? none() : curve_.atForces.at.slope)),
          ofRolling_(ones(), {curve_.atRolling, {}}),
          rollingQ_(pairs(ofRolling_.value(), mechanism.rolling() ? curve_.atRolling : none())),
          lu_(nodal_ ? 0 : curve_.unknowns() * (curve_.d + n_)) {
        const int d = curve_.d, m = curve_.unknowns();
        if (mechanism.rolling()) rolling_.emplace(*mechanism.rolling(), curve_);
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
        moved_ = residual_;
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
        Y_ = Eigen::Map<const Rows>(z.data() + d, m, d);
        kicks_.setZero();
        shifts_.setZero();
        addLagrangian(t);
        if (force_ && !isForcedInside_) addForces(t);
        if (constraint_) addConstraints(t);
        if (rolling_) addRolling(t);
        shifts_ += h * kicks_;
        Eigen::Map<Rows>(residual_.data(), m, d) = shifts_.topRows(m);
        residual_.segment((m - 1) * d, d) += p;
        impulse_ = shifts_.row(m).transpose();
        return residual_.allFinite() && impulse_.allFinite();
    }

    Outcome factorise() override {
        const int d = curve_.d, m = curve_.unknowns();
        findSecondDerivatives();
        if (nodal_)
            nodal_->lu.clear();
        else
            lu_.clear();
        impulseBy_.setZero();
        for (int k = 0; k < d; ++k)
            for (int l = 0; l < d; ++l) addPair(k, l);
        for (int j = 0; j < m; ++j) {
            if (constraint_) setConstraints(j);
            if (rolling_) setRolling(j);
        }
        if (!nodal_) return lu_.factorise();
        for (int j = 0; j <= m; ++j)
            Eigen::Map<Rows>(nodal_->lu.constraints(j), n_, d) =
                Eigen::Map<const Rows, 0, Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>>(
                    firsts_.data() + byPlace(0, 0) * firsts_.rows() + j, n_, d,
                    {d * firsts_.rows(), firsts_.rows()});
        return nodal_->lu.factorise();
    }
    void solve(Vector& x) const override {
        if (nodal_)
            nodal_->solve(x.data());
        else
            lu_.solve(x.data());
    }
    void solveTransposed(Vector& x) const override {
        if (nodal_)
            nodal_->solveTransposed(x.data());
        else
            lu_.solveTransposed(x.data());
    }
    void reactions(const double* impulses, Vector& to) const override {
        const int count = curve_.unknowns() * n_;
        to.noalias() = impulseBy_.rightCols(count) * Eigen::Map<const Vector>(impulses, count);
    }
    bool moveImpulse(const Vector& correction) override {
        const int d = curve_.d, m = curve_.unknowns();
        moved_ = correction;
        if (nodal_)
            Eigen::Map<Rows>(moved_.data(), m, d) =
                nodal_->toNodes.lazyProduct(Eigen::Map<const Rows>(correction.data(), m, d));
        impulse_.noalias() -= impulseBy_ * moved_;
        return true;
    }

private:
    std::vector<double> ones() const {
        return std::vector<double>(static_cast<std::size_t>(curve_.unknowns()), 1.0);
    }
    std::optional<NodalCurve> nodalCurve(const Mechanism& mechanism) const {
        if (mechanism.rolling() || n_ == 0 || !NullSpaceLu::isWorthwhile(curve_.d, n_)) return {};
        return NodalCurve(curve_, ofImpulses_.value(), n_);
    }
    static Matrix none() { return {}; }  ///< where there is nothing to differentiate
    /// Of the functions that the matrix is of.
    NodePairs pairs(const Matrix& tests, const Matrix& functions) const {
        return nodal_ ? NodePairs(nodal_->testing(tests), nodal_->curves(functions))
                      : NodePairs(tests, functions);
    }

    void addLagrangian(double t) {
        const int d = curve_.d, stride = inside_.stride();
        inside_.moveTo(t, h_, z_.data(), Y_);
        const auto* const model = mechanics_.model.get();
        if (const auto* const both = withLagrangian())
            both->gradients(force_->model.get(), inside_.times(), stride, inside_.q(), inside_.v(),
                            gradients_.data());
        else if (mechanics_.gradients)
            mechanics_.gradients(model, inside_.times(), stride, inside_.q(), inside_.v(), gradients_.data());
        else
            inside_.oneByOne(gradients_, [&](double time, const double* q, const double* v, double* to) {
                mechanics_.gradient(model, time, q, v, to);
            });
        if (force_ && isForcedInside_ && !withLagrangian()) {
            takeForces(inside_);
            gradients_.leftCols(d) += forces_;
        }
        ofInside_.addValues(gradients_.data(), stride, kicks_);
        ofInside_.addSlopes(gradients_.col(d).data(), stride, shifts_);
    }

    /// The force together with the Lagrangian at hand, where they have the same nodes; null else.
    const Force::WithLagrangian* withLagrangian() const {
        const auto* const both = force_ && isForcedInside_ ? force_->withLagrangian.get() : nullptr;
        return both && both->lagrangian == mechanics_.model.get() ? both : nullptr;
    }

    /// Forces at nodes of their own.
    void addForces(double t) {
        forced_.moveTo(t, h_, z_.data(), Y_);
        takeForces(forced_);
        ofForces_.addValues(forces_.data(), forced_.stride(), kicks_);
    }
    void takeForces(NodeLanes& nodes) {
        const auto* const model = force_->model.get();
        if (force_->values)
            force_->values(model, nodes.times(), nodes.stride(), nodes.q(), nodes.v(), forces_.data());
        else
            nodes.oneByOne(forces_, [&](double time, const double* q, const double* v, double* to) {
                force_->value(model, time, q, v, to);
            });
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
        if (const auto* const both = withLagrangian())
            both->hessians(force_->model.get(), inside_.times(), inside_.stride(), inside_.q(), inside_.v(),
                           hessians_.data());
        else if (mechanics_.hessians)
            mechanics_.hessians(model, inside_.times(), inside_.stride(), inside_.q(), inside_.v(),
                                hessians_.data());
        else
            inside_.oneByOne(hessians_, [&](double t, const double* q, const double* v, double* to) {
                double value = 0;
                mechanics_.jet(model, t, q, v, &value, gradient_.data(), to);
            });
        for (int k = 0; k < d; ++k)
            masses_(k) = hessians_.col(entry(d + k, d + k)).head(inside_.nodes()).cwiseAbs().maxCoeff();
        if (force_ && isForcedInside_ && !withLagrangian()) {
            // Where L_q and F are one term of the equations, so are their derivatives: the first d of 2 d
            // rows.
            differentiateForces(inside_);
            hessians_.leftCols(2 * d * d) += byState_;
        } else if (force_ && !isForcedInside_) {
            differentiateForces(forced_);
        }
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
    void differentiateForces(NodeLanes& nodes) {
        const auto* const model = force_->model.get();
        if (force_->derivatives)
            force_->derivatives(model, nodes.times(), nodes.stride(), nodes.q(), nodes.v(), byState_.data());
        else
            nodes.oneByOne(byState_, [&](double t, const double* q, const double* v, double* to) {
                force_->first(model, t, q, v, gradient_.data(), to);
            });
    }
    int entry(int row, int column) const { return 2 * curve_.d * row + column; }

    /// Of the reactions, by the places that they belong to: of nodal functions each is one entry.
    bool addCurvature(const double* data) {
        if (!nodal_) return impulsesQ_.add(data, 1, block_);
        const int m = curve_.unknowns();
        bool isThere = false;
        for (int j = 1; j < m; ++j) {
            block_(j, j - 1) += data[j];
            block_(m, j - 1) += data[j];
            isThere |= data[j] != 0;
        }
        return isThere;
    }

    /// dR(k) / dY(l) and dA(k) / dY(l), of all functions.
    void addPair(int k, int l) {
        const int d = curve_.d, m = curve_.unknowns();
        const auto hessian = [&](int row, int column) { return hessians_.col(entry(row, column)).data(); };
        block_.setZero();
        bool isPresent = insideQq_.add(hessian(k, l), h_, block_);
        isPresent |= insideQv_.add(hessian(k, d + l), 1, block_);
        isPresent |= insideVq_.add(hessian(d + k, l), 1, block_);
        isPresent |= insideVv_.add(hessian(d + k, d + l), 1 / h_, block_);
        if (force_ && !isForcedInside_) {
            isPresent |= forcesQ_.add(byState_.col(entry(k, l)).data(), h_, block_);
            isPresent |= forcesV_.add(byState_.col(entry(k, d + l)).data(), 1, block_);
        }
        if (constraint_) isPresent |= addCurvature(curvatures_.col(k * d + l).data());
        if (rolling_) isPresent |= rollingQ_.add(rollingCurvatures_.col(k * d + l).data(), 1, block_);
        if (!isPresent) return;
        for (int b = 0; b < m; ++b) {
            impulseBy_(k, b * d + l) = block_(m, b);
            if (nodal_) {
                std::copy_n(block_.col(b).data(), m, nodal_->lu.column(l, b) + k * m);
                continue;
            }
            double* const column = lu_.column(b * d + l);
            for (int a = 0; a < m; ++a) column[a * d + k] = block_(a, b);
        }
    }

    /// Reactions at e_j, and g at e_(j+1).
    void setConstraints(int j) {
        const int d = curve_.d, m = curve_.unknowns();
        for (int c = 0; c < holonomic_; ++c) {
            for (int i = 0; i < d; ++i) impulseBy_(i, m * d + j * n_ + c) = firsts_(j, byPlace(c, i));
            if (nodal_) continue;
            double* const column = lu_.column(m * d + j * n_ + c);
            for (int i = 0; i < d; ++i) {
                const double reaction = firsts_(j, byPlace(c, i)), rate = firsts_(j + 1, byPlace(c, i));
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

    SharedCurve shared_;
    Mechanics<double> mechanics_;
    std::optional<Constraint> constraint_;
    std::optional<Force> force_;
    std::optional<RollingRows> rolling_;
    const MechanismCurve& curve_;
    int n_, holonomic_;
    NodeLanes places_;                         ///< e_j
    NodeTests ofImpulses_;                     ///< at e_j, j < m
    mutable std::optional<NodalCurve> nodal_;  ///< in place of lu_; what is mutable is room for a solution
    NodePairs impulsesQ_;
    NodeLanes inside_;  ///< the nodes of L
    NodeTests ofInside_;
    NodePairs insideQq_, insideQv_, insideVq_, insideVv_;  ///< by which L is differentiated, twice
    /// Forces have the nodes of L, and are added to L_q there.
    bool isForcedInside_;
    NodeLanes forced_;  ///< the nodes of the forces
    NodeTests ofForces_;
    NodePairs forcesQ_, forcesV_;
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
    Vector moved_;              ///< a correction, of the functions of the matrix
    Vector gradient_, byTime_;  ///< not asked for
};

}  // namespace

std::unique_ptr<MechanismEquations> denseEquations(const Mechanism& mechanism, SharedCurve curve) {
    return std::make_unique<DenseEquations>(mechanism, std::move(curve));
}

}  // namespace extremal
