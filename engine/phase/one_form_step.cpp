// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/phase/one_form_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "engine/core/algebra/lu.hpp"
#include "engine/phase/phase_step.hpp"

namespace extremal {
namespace {

class OneFormStep final : public Integrator {
public:
    OneFormStep(const OneForm& form, const SharedCell& cell, double step, const SolverPolicy& policy)
        : form_(form),
          canonical_(canonicalOf(form)),
          cell_(makePhaseStep(canonical_, cell, step, policy)),
          n_(form.places.size()) {
        y0_.assign(n_, 0);
        p_.assign(n_, 0);
        before_.assign(2 * n_, 0);
        slopes_.assign(4 * n_ * n_, 0);
        theta_.assign(2 * n_, 0);
        first_ = last_ = Eigen::MatrixXd::Zero(size(), size());
    }
    OneFormStep(const OneFormStep& other)
        : Integrator(other),
          form_(other.form_),
          canonical_(other.canonical_),
          cell_(other.cell_->clone()),
          n_(other.n_),
          y0_(other.y0_),
          p_(other.p_),
          before_(other.before_),
          after_(other.after_),
          slopes_(other.slopes_),
          theta_(other.theta_),
          inner_(other.inner_),
          first_(other.first_),
          last_(other.last_) {}
    OneFormStep& operator=(const OneFormStep&) = delete;

    double stepSize() const override { return cell_->stepSize(); }
    void setStep(double h) override { cell_->setStep(h); }
    void begin(State& state) override {
        state.memory.clear();
        after_.clear();
        cell_->begin(inner_);
    }

    StepReport advance(State& state, double until) override {
        cell_->setStop(stop());
        before_ = state.x;
        for (std::size_t j = 0; j < n_; ++j) y0_[j] = before_[placeOfFree(j)];
        setGuess(canonical_, y0_.data());
        // Where a step goes on, p is what the cell has left, with all its digits.
        if (before_ != after_) {
            momenta(before_.data());
            inner_.x.resize(2 * n_);
            for (std::size_t j = 0; j < n_; ++j) {
                inner_.x[j] = before_[placeOf(j)];
                inner_.x[n_ + j] = p_[j];
            }
        }
        inner_.t = state.t;
        inner_.node = state.node;
        StepReport report = cell_->advance(inner_, until);
        if (report.outcome == Outcome::converged &&
            !freeVariables(canonical_, inner_.x.data(), inner_.x.data() + n_, p_.data()))
            report.outcome = Outcome::singular;
        if (report.outcome != Outcome::converged) {
            after_.clear();
            return report;
        }
        for (std::size_t j = 0; j < n_; ++j) {
            state.x[placeOf(j)] = inner_.x[j];
            state.x[placeOfFree(j)] = p_[j];
        }
        after_ = state.x;
        state.t = until;
        ++state.node;
        return report;
    }

    void denseOutput(double tau, std::span<double> x) const override {
        if (tau <= 0 || tau >= 1) {
            const std::vector<double>& end = tau <= 0 ? before_ : after_;
            std::copy(end.begin(), end.end(), x.begin());
            return;
        }
        std::vector<double> inside(2 * n_), y(n_);
        setGuess(canonical_, y0_.data());
        cell_->denseOutput(tau, inside);
        if (!freeVariables(canonical_, inside.data(), inside.data() + n_, y.data()))
            std::fill(y.begin(), y.end(), std::numeric_limits<double>::quiet_NaN());
        for (std::size_t j = 0; j < n_; ++j) {
            x[placeOf(j)] = inside[j];
            x[placeOfFree(j)] = y[j];
        }
    }

    std::size_t tangentSize() const override { return 2 * n_; }
    bool applyTangent(std::span<double> W) override {
        const Eigen::Index columns = static_cast<Eigen::Index>(W.size()) / size();
        Eigen::Map<Eigen::MatrixXd> w(W.data(), size(), columns);
        toMomenta(before_.data(), first_);
        toMomenta(after_.data(), last_);
        Eigen::MatrixXd moved = first_ * w;
        setGuess(canonical_, y0_.data());
        if (!cell_->applyTangent({moved.data(), W.size()})) return false;
        w = last_.partialPivLu().solve(moved);
        return w.allFinite();
    }

    std::span<const Quantity> quantities() const override { return cell_->quantities(); }
    void measure(const State&, double* values) const override {
        setGuess(canonical_, y0_.data());
        cell_->measure(inner_, values);
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<OneFormStep>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(y0_, before_, after_, inner_.x);
        return cell_->checkpoint(archive);
    }

private:
    Eigen::Index size() const { return static_cast<Eigen::Index>(2 * n_); }
    std::size_t placeOf(std::size_t j) const { return static_cast<std::size_t>(form_.places[j]); }
    std::size_t placeOfFree(std::size_t j) const { return static_cast<std::size_t>(form_.free[j]); }

    /// P(q, y).
    void momenta(const double* x) {
        form_.form(form_.planeModel(), x, theta_.data(), slopes_.data(), nullptr);
        for (std::size_t j = 0; j < n_; ++j) p_[j] = theta_[placeOf(j)];
    }
    /// D: from dx, in the order of the variables, to (dq, dp).
    void toMomenta(const double* x, Eigen::MatrixXd& D) {
        momenta(x);
        D.setZero();
        for (std::size_t j = 0; j < n_; ++j) {
            D(static_cast<Eigen::Index>(j), form_.places[j]) = 1;
            for (std::size_t k = 0; k < 2 * n_; ++k)
                D(static_cast<Eigen::Index>(n_ + j), static_cast<Eigen::Index>(k)) =
                    slopes_[placeOf(j) * 2 * n_ + k];
        }
    }

    OneForm form_;
    PhaseMechanics canonical_;
    std::unique_ptr<Integrator> cell_;
    std::size_t n_;
    std::vector<double> y0_, p_;          ///< y at the start of the step; room for p and y
    std::vector<double> before_, after_;  ///< x at the ends of the last step; after_ empty: there was none
    std::vector<double> slopes_, theta_;
    State inner_;  ///< (q, p)
    Eigen::MatrixXd first_, last_;
};

}  // namespace

std::unique_ptr<Integrator> makeOneFormStep(const OneForm& form, const SharedCell& cell, double step,
                                            const SolverPolicy& policy) {
    return std::make_unique<OneFormStep>(form, cell, step, policy);
}

}  // namespace extremal
