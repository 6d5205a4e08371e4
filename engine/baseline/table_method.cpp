// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/baseline/table_method.hpp"

#include <limits>

#include "engine/core/algebra/lu.hpp"
#include "engine/core/corrections.hpp"
#include "engine/step/coordinate_watch.hpp"

namespace extremal {
namespace {

/// The coefficients in double precision.
struct Coefficients {
    Eigen::MatrixXd a, aHat;
    Eigen::VectorXd b, bHat, c;
    bool isExplicit;
    bool isFirstSameAsLast;  ///< the last stage of a step is where the first one of the next begins

    explicit Coefficients(const Tableau& t)
        : a(t.A.cast<double>()),
          aHat(t.Ahat.cast<double>()),
          b(t.b.cast<double>()),
          bHat(t.bHat.cast<double>()),
          c(t.c.cast<double>()),
          isExplicit(t.isExplicit()) {
        const Eigen::Index last = b.size() - 1;
        isFirstSameAsLast = isExplicit && last > 0 && c(0) == 0 && c(last) == 1 &&
                            a.row(last).transpose() == b && aHat.row(last).transpose() == bHat;
    }
    Eigen::Index stages() const { return b.size(); }

    /// The rows of stage i in 1 - h J a, and J.
    void place(Eigen::Index i, double h, const Eigen::MatrixXd& jacobian, Eigen::MatrixXd& system,
               Eigen::MatrixXd& slopes) const {
        const Eigen::Index n = jacobian.rows(), d = n / 2;
        slopes.middleRows(n * i, n) = jacobian;
        for (Eigen::Index j = 0; j < stages(); ++j) {
            auto block = system.block(n * i, n * j, n, n);
            block.leftCols(d) -= h * a(i, j) * jacobian.leftCols(d);
            block.rightCols(d) -= h * aHat(i, j) * jacobian.rightCols(d);
        }
    }
    /// W <- M W, from the factors of 1 - h J a and from J.
    void vary(double h, const Eigen::PartialPivLU<Eigen::MatrixXd>& lu, const Eigen::MatrixXd& slopes,
              Eigen::Map<Eigen::MatrixXd>& W) const {
        const Eigen::MatrixXd rates = lu.solve((slopes * W).eval());
        const Eigen::Index d = W.rows() / 2;
        for (Eigen::Index i = 0; i < stages(); ++i) {
            W.topRows(d) += h * b(i) * rates.middleRows(2 * d * i, d);
            W.bottomRows(d) += h * bHat(i) * rates.middleRows(2 * d * i + d, d);
        }
    }
};

template <int D>
class TableMethod final : public FlowMethod<D> {
    using Base = FlowMethod<D>;
    using Vector = typename Base::Vector;
    using Stages = Eigen::Matrix<double, D, Eigen::Dynamic>;  ///< a column per stage
    static constexpr double epsilon = std::numeric_limits<double>::epsilon();

public:
    TableMethod(const Mechanics<double>& mechanics, double step, const Coefficients& table)
        : Base(mechanics, step), table_(table) {
        for (Vector* v : {&q_, &p_, &dq_, &dp_, &end_.dq, &end_.dp}) *v = Vector::Zero(this->d());
        for (Vector* v : {&end_.q, &end_.p})
            *v = Vector::Constant(this->d(), std::numeric_limits<double>::quiet_NaN());
        for (Stages* s : {&V_, &F_}) *s = Stages::Zero(this->d(), table_.stages());
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<TableMethod>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(end_.q, end_.p, end_.dq, end_.dp, end_.t);
        return true;
    }

private:
    void step(double t) override {
        if (table_.isExplicit) {
            for (Eigen::Index i = 0; i < table_.stages(); ++i) {
                stateAt(i, i);
                if (i > 0 || !takeEnd(t)) {
                    if (!evaluate(t, i)) return;
                }
                V_.col(i) = dq_;
                F_.col(i) = dp_;
            }
            if (table_.isFirstSameAsLast) noteEnd(t + this->h());
        } else if (!solve(t)) {
            return;
        }
        this->q1_ = this->q0_ + this->h() * V_.lazyProduct(table_.b);
        this->p1_ = this->p0_ + this->h() * F_.lazyProduct(table_.bHat);
    }

    /// q_, p_ of stage i from the first `known` stages.
    void stateAt(Eigen::Index i, Eigen::Index known) {
        q_ = this->q0_ + this->h() * V_.leftCols(known).lazyProduct(table_.a.row(i).head(known).transpose());
        p_ = this->p0_ +
             this->h() * F_.leftCols(known).lazyProduct(table_.aHat.row(i).head(known).transpose());
    }
    /// The slopes at (q_, p_), if that is exactly where the step before has ended.
    bool takeEnd(double t) {
        if (!table_.isFirstSameAsLast || end_.q != q_ || end_.p != p_) return false;
        if (this->mechanics_.isTimeDependent && end_.t != t) return false;
        dq_ = end_.dq;
        dp_ = end_.dp;
        return true;
    }
    void noteEnd(double t) {
        end_.q = q_;
        end_.p = p_;
        end_.dq = dq_;
        end_.dp = dp_;
        end_.t = t;
    }
    bool evaluate(double t, Eigen::Index i) {
        this->flow(t + table_.c(i) * this->h(), q_, p_, dq_, dp_);
        return this->report_.outcome == Outcome::converged;
    }

    bool solve(double t) {
        start(t);
        if (this->report_.outcome != Outcome::converged) return false;
        if (iterate(t)) return true;
        if (this->report_.outcome == Outcome::stopped) return false;
        this->report_.outcome = Outcome::converged;
        start(t);
        return this->report_.outcome == Outcome::converged && newton(t);
    }
    /// A constant field.
    void start(double t) {
        this->flow(t, this->q0_, this->p0_, dq_, dp_);
        V_.colwise() = dq_;
        F_.colwise() = dp_;
    }
    double scale() const {
        return std::max(
            {V_.cwiseAbs().maxCoeff(), F_.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min()});
    }

    /// Changes of the slopes at stage i, over the step.
    template <class Q, class P>
    void watchChange(CoordinateWatch& watch, Eigen::Index i, const Q& dV, const P& dF) const {
        const double h = this->h();
        for (int k = 0; k < this->d(); ++k) {
            watch.add(h * dV.coeff(k, 0), h * V_(k, i), this->q0_(k));
            watch.add(h * dF.coeff(k, 0), h * F_(k, i), this->p0_(k));
        }
    }

    /// Each stage with the latest of the others.
    bool iterate(double t) {
        CoordinateWatch watch;
        const CorrectionLimits limits{
            .most = 100, .roundOff = 1e3 * CorrectionLimits::epsilon, .stall = 1, .slow = 0.7};
        this->report_.outcome = solveByCorrections(limits, this->stop(), this->report_, [&](int, double) {
            double size = 0;
            for (Eigen::Index i = 0; i < table_.stages(); ++i) {
                stateAt(i, table_.stages());
                if (!evaluate(t, i)) return Correction{.outcome = this->report_.outcome};
                size = std::max(
                    {size, (dq_ - V_.col(i)).cwiseAbs().maxCoeff(), (dp_ - F_.col(i)).cwiseAbs().maxCoeff()});
                watchChange(watch, i, dq_ - V_.col(i), dp_ - F_.col(i));
                V_.col(i) = dq_;
                F_.col(i) = dp_;
            }
            return Correction{size, scale(), watch.isSettled(stallOfSweeps)};
        });
        return this->report_.outcome == Outcome::converged;
    }

    /// Unknowns (V_1, F_1, V_2, ..).
    bool newton(double t) {
        const int d = this->d();
        Eigen::VectorXd residual(2 * d * table_.stages());
        CoordinateWatch watch;
        const CorrectionLimits limits;
        this->report_.outcome = solveByCorrections(limits, this->stop(), this->report_, [&](int, double) {
            if (!assemble(t)) return Correction{.outcome = this->report_.outcome};
            for (Eigen::Index i = 0; i < table_.stages(); ++i) {
                stateAt(i, table_.stages());
                if (!evaluate(t, i)) return Correction{.outcome = this->report_.outcome};
                residual.segment(2 * d * i, d) = dq_ - V_.col(i);
                residual.segment(2 * d * i + d, d) = dp_ - F_.col(i);
            }
            residual = lu_.solve(residual);
            ++this->report_.cost.linearSolves;
            for (Eigen::Index i = 0; i < table_.stages(); ++i) {
                V_.col(i) += residual.segment(2 * d * i, d);
                F_.col(i) += residual.segment(2 * d * i + d, d);
                watchChange(watch, i, residual.segment(2 * d * i, d), residual.segment(2 * d * i + d, d));
            }
            return Correction{residual.cwiseAbs().maxCoeff(), scale(), watch.isSettled()};
        });
        return this->report_.outcome == Outcome::converged;
    }

    /// I - h J a at the stages as they are, and J beside it.
    bool assemble(double t) {
        const int d = this->d();
        const Eigen::Index n = 2 * d * table_.stages();
        system_.setIdentity(n, n);
        slopes_.resize(n, 2 * d);
        for (Eigen::Index i = 0; i < table_.stages(); ++i) {
            stateAt(i, table_.stages());
            const Eigen::MatrixXd* const jacobian = this->flowJacobian(t + table_.c(i) * this->h(), q_, p_);
            if (!jacobian) {
                this->report_.outcome = Outcome::singular;
                return false;
            }
            table_.place(i, this->h(), *jacobian, system_, slopes_);
        }
        lu_.compute(system_);
        return true;
    }

    bool tangent(double t, typename Base::Columns W) override {
        if (!assemble(t)) return false;
        table_.vary(this->h(), lu_, slopes_, W);
        return true;
    }

    /// The last stage of the last step.
    struct End {
        Vector q, p, dq, dp;
        double t = 0;
    };

    Coefficients table_;
    Vector q_, p_, dq_, dp_;
    End end_;
    Stages V_, F_;
    Eigen::MatrixXd system_, slopes_;
    Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

}  // namespace

std::unique_ptr<Integrator> makeTableMethod(const Mechanics<double>& mechanics, double step,
                                            const Tableau& tableau) {
    return makeFlowMethod<TableMethod>(mechanics, step, Coefficients(tableau));
}

}  // namespace extremal
