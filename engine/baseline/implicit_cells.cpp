// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/baseline/implicit_cells.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/baseline/cell_newton.hpp"
#include "engine/core/problem.hpp"
#include "engine/family/field/field_step.hpp"
#include "engine/model/density/cell_sum.hpp"

namespace extremal {
namespace {

using By = CellSum::By;

class ImplicitCells final : public FieldStep {
public:
    ImplicitCells(std::shared_ptr<const DensityProblem> problem, const Rule<double>& space,
                  const Rule<double>& time, double step)
        : FieldStep(problem->size(), step),
          problem_(problem),
          space_(space),
          time_(time),
          instant_(CellSum::ofInstant(problem, space)),
          slab_(CellSum::ofSlab(problem, space, time, step)),
          position_(*problem),
          velocity_(*problem) {
        for (auto* v : {&p_, &end_}) v->resize(n());
        for (auto* v : {&positionAt_, &velocityAt_}) v->resize(2 * n());
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<ImplicitCells>(*this); }

    std::string about() const override {
        return "Newton, " + std::to_string(n()) + " unknowns, band of " +
               std::to_string(2 * position_.reach() + 1);
    }
    /// Factors of steps before it change the last digits.
    void begin(State& state) override {
        Integrator::begin(state);
        position_.forget();
        velocity_.forget();
    }
    /// Instead of the factors, where they belong to.
    bool checkpoint(Archive& archive) override {
        FieldStep::checkpoint(archive);
        bool isKnown = position_.isFactored() && velocity_.isFactored();
        archive(isKnown, positionAt_, velocityAt_, positionTime_, velocityTime_);
        if (!archive.isReading() || !isKnown) return true;
        const auto at = [&](std::vector<double>& of) { return of.data() + n(); };
        return position_.factorise(positions(positionAt_.data(), positionTime_), at(positionAt_)) &&
               velocity_.factorise(velocities(velocityAt_.data(), velocityTime_), at(velocityAt_));
    }

private:
    using FieldStep::begin;  // of the time
    void prepare() override {
        slab_ = CellSum::ofSlab(problem_, space_, time_, h());
        position_.forget();
        velocity_.forget();
    }
    bool isHeld(std::size_t i) const override { return problem_->isFixed(i); }

    /// p_0 + dS/du_0 = 0 for u_1, with p_0 in p_. Functions that hold no more than a pointer need no memory.
    CellNewton::Equations positions(const double* u0, double t) {
        from_ = u0;
        at_ = t;
        return {[this](const double* u1, double* F) {
                    std::copy(p_.begin(), p_.end(), F);
                    slab_.addGradient(at_, from_, u1, By::first, F);
                },
                [this](const double* u1, const CellNewton::Add& add) {
                    remember(positionAt_, from_, u1);
                    positionTime_ = at_;
                    slab_.addHessian(at_, from_, u1, By::first, By::second, add);
                }};
    }
    /// dL_h/du_t - p_1 = 0 for u_t, with p_1 in p_.
    CellNewton::Equations velocities(const double* u, double t) {
        from_ = u;
        at_ = t;
        return {[this](const double* v, double* F) {
                    for (std::size_t i = 0; i < n(); ++i) F[i] = -p_[i];
                    instant_.addGradient(at_, from_, v, By::second, F);
                },
                [this](const double* v, const CellNewton::Add& add) {
                    remember(velocityAt_, from_, v);
                    velocityTime_ = at_;
                    instant_.addHessian(at_, from_, v, By::second, By::second, add);
                }};
    }
    void remember(std::vector<double>& at, const double* first, const double* second) const {
        if (at.data() == first) return;  // being read
        std::copy_n(first, n(), at.begin());
        std::copy_n(second, n(), at.begin() + static_cast<std::ptrdiff_t>(n()));
    }

    Outcome step(const double* x, double* next, StepReport& report) override {
        const std::size_t size = n();
        const double *const u = x, *const v = x + size;
        const double t = begin();
        std::fill(p_.begin(), p_.end(), 0.0);
        instant_.addGradient(t, u, v, By::second, p_.data());
        double *const u1 = next, *const v1 = next + size;
        for (std::size_t i = 0; i < size; ++i) u1[i] = problem_->isFixed(i) ? u[i] : u[i] + h() * v[i];
        const long long before = report.cost.iterations;
        Outcome found = position_.solve(positions(u, t), u1, stop(), report);
        if (found != Outcome::converged && found != Outcome::stopped) {
            // At rest a density is defined where it is not at that velocity.
            std::copy_n(u, size, u1);
            found = position_.solve(positions(u, t), u1, stop(), report);
        }
        report.cost.evaluations +=
            slab_.evaluations() * (report.cost.iterations - before) + instant_.evaluations();
        if (found != Outcome::converged) return found;
        std::copy_n(u1, size, end_.begin());
        std::fill(p_.begin(), p_.end(), 0.0);
        slab_.addGradient(t, u, u1, By::second, p_.data());
        // The mean velocity of the slab is in the domain of L, where any is.
        for (std::size_t i = 0; i < size; ++i) v1[i] = problem_->isFixed(i) ? 0 : (u1[i] - u[i]) / h();
        const long long sofar = report.cost.iterations;
        found = velocity_.solve(velocities(u1, t + h()), v1, stop(), report);
        report.cost.evaluations += instant_.evaluations() * (report.cost.iterations - sofar);
        return found;
    }

    double slabEnergy(const double* before, const double* after) const override {
        return slab_.energy(begin(), before, after) / h();
    }

    bool hasVariations() const override { return true; }
    bool linearise() override {
        const double *const u0 = before().data(), *const u1 = end_.data();
        const auto collect = [&](By row, By column, std::vector<Entry>& entries) {
            entries.clear();
            slab_.addHessian(begin(), u0, u1, row, column, [&](std::size_t i, std::size_t j, double value) {
                entries.push_back({i, j, value});
            });
        };
        collect(By::first, By::first, first_);
        collect(By::second, By::first, mixed_);
        collect(By::second, By::second, second_);
        const CellNewton::Equations equations{{}, [&](const double*, const CellNewton::Add& add) {
                                                  slab_.addHessian(begin(), u0, u1, By::first, By::second,
                                                                   add);
                                              }};
        variation_ = std::make_shared<CellNewton>(*problem_);
        return variation_->factorise(equations, u1);
    }
    /// dp_0 + S_00 du_0 + S_01 du_1 = 0, dp_1 = S_10 du_0 + S_11 du_1.
    void vary(std::vector<double>& du, std::vector<double>& dp) override {
        std::vector<double> before = du;
        for (const Entry& e : first_) dp[e.i] += e.value * du[e.j];
        for (std::size_t i = 0; i < n(); ++i) du[i] = -dp[i];
        variation_->apply(du.data());
        std::fill(dp.begin(), dp.end(), 0.0);
        for (const Entry& e : mixed_) dp[e.i] += e.value * before[e.j];
        for (const Entry& e : second_) dp[e.i] += e.value * du[e.j];
        for (std::size_t i = 0; i < n(); ++i)
            if (isHeld(i)) dp[i] = 0;
    }

    struct Entry {
        std::size_t i, j;
        double value;
    };

    std::shared_ptr<const DensityProblem> problem_;
    Rule<double> space_, time_;
    CellSum instant_, slab_;
    CellNewton position_, velocity_;
    std::vector<double> p_, end_;                  ///< end_: u_1 of the last step
    std::vector<double> positionAt_, velocityAt_;  ///< where their factors belong to
    double positionTime_ = 0, velocityTime_ = 0;
    const double* from_ = nullptr;  ///< of the equations under way: the vector that is given, and its time
    double at_ = 0;
    std::shared_ptr<CellNewton> variation_;      ///< factors of S_01
    std::vector<Entry> first_, mixed_, second_;  ///< S_00, S_10, S_11
};

}  // namespace

void requireAffordable(const DensityProblem& problem, const char* pointer) {
    const auto nodes = [&] {
        return std::to_string(problem.nodesX()) + " x " + std::to_string(problem.nodesY());
    };
    if (problem.isPlane() && (problem.nodesX() > mostCellsAlong || problem.nodesY() > mostCellsAlong))
        throw InvalidScene(pointer,
                           "takes at most 64 x 64 nodes, as each Newton matrix of a rectangle is "
                           "factorised, and this model has " +
                               nodes(),
                           "\"cells\": 64 and \"cells_y\": 64 in the model");
    constexpr double mostEntries = 1 << 26;
    const auto m = static_cast<double>(problem.components());
    const double reach = problem.isPlane() ? 2.0 * std::min(problem.nodesX(), problem.nodesY()) + 2 : 2;
    const double entries = static_cast<double>(problem.size()) * (3 * (reach * m + m) + 1);
    if (entries > mostEntries)
        throw InvalidScene(pointer,
                           "would hold matrices of " + std::to_string(static_cast<long long>(entries / 1e6)) +
                               " million entries, and at most " +
                               std::to_string(static_cast<long long>(mostEntries / 1e6)) +
                               " million are held",
                           "fewer cells in the model");
}

std::unique_ptr<Integrator> makeImplicitCells(std::shared_ptr<const DensityProblem> problem,
                                              const Rule<double>& space, const Rule<double>& time,
                                              double step) {
    return std::make_unique<ImplicitCells>(std::move(problem), space, time, step);
}

}  // namespace extremal
