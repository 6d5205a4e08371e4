// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/field/slab_actions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/algebra/sparse.hpp"
#include "engine/core/corrections.hpp"
#include "engine/family/field/field_step.hpp"
#include "engine/family/field/mass_matrix.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {
namespace {

using SparseLevels = Eigen::SparseMatrix<double>;

/// The levels of one slab between given ends, and their equations.
class SlabLevels {
public:
    SlabLevels(const SpatialForm& form, const TimeTable& time, double step, const double* u0,
               const double* u1)
        : form_(form),
          time_(time),
          h_(step),
          n_(static_cast<std::size_t>(form.size())),
          inner_(time.degree() - 1) {
        for (int l = 0; l <= time.degree(); ++l)
            for (std::size_t i = 0; i < n_; ++i) U_.push_back(u0[i] + time.level(l) * (u1[i] - u0[i]));
        at_.resize(n_);
        work_.resize(n_);
    }

    bool solve() {
        if (inner_ == 0) return true;
        StepReport report;
        const CorrectionLimits limits{.roundOff = 1e-12};
        return solveByCorrections(limits, {}, report, [&](int, double) {
                   const Eigen::VectorXd F = residual();
                   Eigen::VectorXd delta;
                   const Outcome found = solveSparse(jacobian(), -F, delta);
                   if (found != Outcome::converged) return Correction{.outcome = found};
                   double size = 0;
                   for (std::size_t i = 0; i < n_; ++i)
                       for (int l = 1; l <= inner_; ++l)
                           level(l)[i] += delta(unknown(static_cast<int>(i), l));
                   for (const double u : U_) size = std::max(size, std::abs(u));
                   return Correction{delta.cwiseAbs().maxCoeff(), size};
               }) == Outcome::converged;
    }

    const std::vector<double>& levels() const { return U_; }

    FieldAction action() {
        FieldAction sum;
        for (int q = 0; q < time_.points(); ++q) {
            placeAt(q);
            const double U = form_.energy(at_.data());
            std::fill(at_.begin(), at_.end(), 0.0);
            for (int l = 0; l <= time_.degree(); ++l)
                for (std::size_t i = 0; i < n_; ++i)
                    at_[i] += time_.slope(q, l) / h_ * (level(l)[i] - level(0)[i]);
            const double T = form_.kineticEnergy(at_.data());
            sum.value += h_ * time_.weight(q) * (T - U);
            sum.size += h_ * std::abs(time_.weight(q)) * (T + std::abs(U));
        }
        return sum;
    }

private:
    double* level(int l) { return U_.data() + static_cast<std::size_t>(l) * n_; }
    int unknown(int i, int l) const { return i * inner_ + l - 1; }
    void placeAt(int q) {
        std::fill(at_.begin(), at_.end(), 0.0);
        for (int l = 0; l <= time_.degree(); ++l)
            for (std::size_t i = 0; i < n_; ++i) at_[i] += time_.value(q, l) * level(l)[i];
    }
    /// dS/dU_l of the inner levels. Slopes of all levels sum to 0, so that differences from the first do.
    Eigen::VectorXd residual() {
        Eigen::VectorXd F = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n_) * inner_);
        for (int l = 1; l <= inner_; ++l) {
            std::fill(at_.begin(), at_.end(), 0.0);
            for (int m = 1; m <= time_.degree(); ++m)
                for (std::size_t i = 0; i < n_; ++i)
                    at_[i] += time_.mass(l, m) / h_ * (level(m)[i] - level(0)[i]);
            form_.applyMass(at_.data(), work_.data());
            for (std::size_t i = 0; i < n_; ++i) F(unknown(static_cast<int>(i), l)) += work_[i];
        }
        for (int q = 0; q < time_.points(); ++q) {
            placeAt(q);
            std::fill(work_.begin(), work_.end(), 0.0);
            form_.addForce(at_.data(), h_ * time_.weight(q), work_.data());
            for (int l = 1; l <= inner_; ++l)
                for (std::size_t i = 0; i < n_; ++i)
                    F(unknown(static_cast<int>(i), l)) += time_.value(q, l) * work_[i];
        }
        for (std::size_t i = 0; i < n_; ++i)
            for (int l = 1; l <= inner_; ++l)
                if (isFixed(i)) F(unknown(static_cast<int>(i), l)) = 0;
        return F;
    }
    SparseLevels jacobian() {
        std::vector<Eigen::Triplet<double, int>> entries;
        const FieldNodes& nodes = form_.problem().nodes;
        const int width = form_.width();
        const auto add = [&](int i, int j, int l, int m, double value) {
            const bool isHeld = isFixed(static_cast<std::size_t>(i));
            if (isHeld) value = i == j && l == m ? 1 : 0;
            entries.emplace_back(unknown(i, l), unknown(j, m), value);
        };
        forEachPair(nodes, [&](int i, int j, int a, int b, int e) {
            const double mass = form_.elementSize(e) * form_.elementMass(e)[a * width + b];
            for (int l = 1; l <= inner_; ++l)
                for (int m = 1; m <= inner_; ++m) add(i, j, l, m, time_.mass(l, m) / h_ * mass);
        });
        std::vector<double> H(static_cast<std::size_t>(nodes.elements * width * width));
        for (int q = 0; q < time_.points(); ++q) {
            placeAt(q);
            form_.hessians(at_.data(), H.data());
            forEachPair(nodes, [&](int i, int j, int a, int b, int e) {
                if (isFixed(static_cast<std::size_t>(i))) return;
                const double slope = H[static_cast<std::size_t>((e * width + a) * width + b)];
                for (int l = 1; l <= inner_; ++l)
                    for (int m = 1; m <= inner_; ++m)
                        add(i, j, l, m,
                            -h_ * time_.weight(q) * time_.value(q, l) * time_.value(q, m) * slope);
            });
        }
        const auto size = static_cast<Eigen::Index>(n_) * inner_;
        SparseLevels J(size, size);
        J.setFromTriplets(entries.begin(), entries.end());
        return J;
    }
    bool isFixed(std::size_t i) const { return form_.problem().isFixed(static_cast<int>(i)); }

    const SpatialForm& form_;
    const TimeTable& time_;
    double h_;
    std::size_t n_;
    int inner_;
    std::vector<double> U_, at_, work_;
};

/// The motion from a state over the time h, in equal pieces with a Gauss sum each.
struct FieldMotion {
    std::vector<double> end;
    FieldAction action;
};
std::optional<FieldMotion> motionOf(const std::shared_ptr<const SpatialForm>& form, const State& start,
                                    double h, int pieces, const std::stop_token& stop) {
    constexpr int degree = 4;
    static const Rule<double> rule = gauss<double>(degree);
    const auto n = static_cast<std::size_t>(form->size());
    const auto integrator = makeImplicitField(form, TimeTable(degree, gauss<double>(degree)), h / pieces,
                                              std::numeric_limits<double>::epsilon(), 50);
    integrator->setStop(stop);
    State state = start;
    FieldMotion motion;
    const auto go = [&](double share) {
        integrator->setStep(share * h / pieces);
        return integrator->advance(state, state.t + share * h / pieces).outcome == Outcome::converged;
    };
    for (int k = 0; k < pieces; ++k) {
        double last = 0;
        for (std::size_t q = 0; q < rule.c.size(); ++q) {
            if (!go(rule.c[q] - last)) return {};
            last = rule.c[q];
            const double T = form->kineticEnergy(state.x.data() + n), U = form->energy(state.x.data());
            motion.action.value += h / pieces * rule.b[q] * (T - U);
            motion.action.size += h / pieces * rule.b[q] * (T + std::abs(U));
        }
        if (!go(1 - last)) return {};
    }
    motion.end.assign(state.x.begin(), state.x.begin() + static_cast<std::ptrdiff_t>(n));
    return motion;
}

}  // namespace

std::optional<std::vector<double>> slabLevels(const SpatialForm& form, const TimeTable& time, double step,
                                              const double* u0, const double* u1) {
    SlabLevels levels(form, time, step, u0, u1);
    if (!levels.solve()) return {};
    return levels.levels();
}

std::optional<FieldAction> slabAction(const SpatialForm& form, const TimeTable& time, double step,
                                      const double* u0, const double* u1) {
    SlabLevels levels(form, time, step, u0, u1);
    if (!levels.solve()) return {};
    return levels.action();
}

ActionPairs slabActions(std::shared_ptr<const SpatialForm> form, const TimeTable& time, const State& start) {
    return [form = std::move(form), time, start](double h,
                                                 const std::stop_token& stop) -> std::optional<ActionPair> {
        constexpr int fewest = 4, most = 64;
        auto coarse = motionOf(form, start, h, fewest, stop);
        for (int pieces = 2 * fewest; coarse && pieces <= most; pieces *= 2) {
            const auto fine = motionOf(form, start, h, pieces, stop);
            if (!fine) return {};
            const double change = std::abs(fine->action.value - coarse->action.value),
                         roundOff = 16 * std::numeric_limits<double>::epsilon() * fine->action.size;
            coarse = fine;
            if (change > roundOff && pieces < most) continue;
            const auto made = slabAction(*form, time, h, start.x.data(), fine->end.data());
            if (!made) return {};
            return ActionPair{made->value, fine->action.value, std::max(change, roundOff)};
        }
        return {};
    };
}

}  // namespace extremal
