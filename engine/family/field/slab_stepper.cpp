// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/field/slab_stepper.hpp"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/core/algebra/sparse.hpp"
#include "engine/core/corrections.hpp"
#include "engine/family/field/field_step.hpp"
#include "engine/family/field/mass_matrix.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Entries = std::vector<Eigen::Triplet<double, int>>;

class SlabStepper final : public FieldStep {
public:
    SlabStepper(std::shared_ptr<const FieldProblem> problem, int timeDegree, const Rule<double>& space,
                const Rule<double>& time, double step)
        : FieldStep(std::make_shared<const SpatialForm>(problem, space), step),
          problem_(std::move(problem)),
          cell_(*problem_, timeDegree, space, time),
          mass_(form()) {
        assignNumbers();
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<SlabStepper>(*this); }

private:
    /// A row of constraints: z_first - z_second = 0, or z_first = the value at a node.
    struct Constraint {
        int first, second;  ///< local unknowns; second -1: a value
        int node;           ///< of the value
    };
    int local(int e, int a, int l) const { return e * cell_.unknowns() + cell_.unknown(a, l); }

    void assignNumbers() {
        const FieldNodes& nodes = problem_->nodes;
        const int s = cell_.timeDegree(), r = nodes.degree;
        unknowns_ = nodes.elements * cell_.unknowns();
        owner_.assign(static_cast<std::size_t>(nodes.size()), -1);
        for (int e = 0; e < nodes.elements; ++e)
            for (int a = 0; a <= r; ++a) {
                int& owner = owner_[static_cast<std::size_t>(nodes.node(e, a))];
                const int mine = e * (r + 1) + a;
                if (owner < 0) {
                    owner = mine;
                    continue;
                }
                for (int l = 0; l <= s; ++l)
                    continuity_.push_back({local(e, a, l), local(owner / (r + 1), owner % (r + 1), l), -1});
            }
        for (int i = 0; i < nodes.size(); ++i) {
            const int e = ownerElement(i), a = ownerPlace(i);
            start_.push_back({local(e, a, 0), -1, i});
            if (problem_->isFixed(i))
                for (int l = 1; l <= s; ++l) continuity_.push_back({local(e, a, l), -1, i});
        }
        // z, multipliers, and what belongs to the ends: p' of free nodes and the reactions of fixed ones.
        size_ = unknowns_ + static_cast<int>(continuity_.size()) + nodes.size();
    }
    int ownerElement(int i) const { return owner_[static_cast<std::size_t>(i)] / form().width(); }
    int ownerPlace(int i) const { return owner_[static_cast<std::size_t>(i)] % form().width(); }

    Outcome step(const double* u, double* next, StepReport& report) override {
        const std::size_t size = n();
        const double* v = u + size;
        std::vector<double> p(size);
        form().applyMass(v, p.data());
        Eigen::VectorXd x = Eigen::VectorXd::Zero(size_), F(size_);
        const FieldNodes& nodes = problem_->nodes;
        const LobattoBasis levels(cell_.timeDegree());
        for (int e = 0; e < nodes.elements; ++e)
            for (int a = 0; a <= nodes.degree; ++a)
                for (int l = 0; l <= cell_.timeDegree(); ++l) {
                    const auto i = static_cast<std::size_t>(nodes.node(e, a));
                    const double tau = levels.reference[static_cast<std::size_t>(l)];
                    x(local(e, a, l)) =
                        u[i] + (problem_->isFixed(static_cast<int>(i)) ? 0 : tau * h() * v[i]);
                }
        const CorrectionLimits limits{.roundOff = 1e-12};
        const Outcome solved = solveByCorrections(limits, stop(), report, [&](int, double) {
            Sparse J(size_, size_);
            assemble(x, u, p.data(), F, J);
            Eigen::VectorXd delta;
            const Outcome found = solveSparse(J, -F, delta);
            if (found != Outcome::converged) return Correction{.outcome = found};
            x += delta;
            ++report.cost.linearSolves;
            return Correction{delta.head(unknowns_).cwiseAbs().maxCoeff(),
                              x.head(unknowns_).cwiseAbs().maxCoeff()};
        });
        if (solved != Outcome::converged) return solved;
        finish(x, next);
        return Outcome::converged;
    }

    void assemble(const Eigen::VectorXd& x, const double* u, const double* p, Eigen::VectorXd& F, Sparse& J) {
        const auto m = static_cast<std::size_t>(cell_.unknowns());
        std::vector<double> gradient(m), hessian(m * m);
        Entries entries;
        F.setZero();
        for (int e = 0; e < problem_->nodes.elements; ++e) {
            const int at = e * cell_.unknowns();
            (void)cell_.evaluate(e, h(), x.data() + at, gradient.data(), hessian.data());
            for (int k = 0; k < cell_.unknowns(); ++k) {
                F(at + k) += gradient[static_cast<std::size_t>(k)];
                for (int j = 0; j < cell_.unknowns(); ++j)
                    entries.emplace_back(
                        at + k, at + j,
                        hessian[static_cast<std::size_t>(k) * m + static_cast<std::size_t>(j)]);
            }
        }
        int row = unknowns_;
        const auto constrain = [&](const Constraint& c, int column) {
            const double multiplier = x(column);
            F(c.first) += multiplier;
            F(row) = x(c.first) - (c.second < 0 ? u[c.node] : x(c.second));
            entries.emplace_back(c.first, column, 1.0);
            entries.emplace_back(row, c.first, 1.0);
            if (c.second >= 0) {
                F(c.second) -= multiplier;
                entries.emplace_back(c.second, column, -1.0);
                entries.emplace_back(row, c.second, -1.0);
            }
            ++row;
        };
        for (const Constraint& c : continuity_) constrain(c, row);
        // s-(z) = u: what stands against it is p of a free node, known, and the reaction of a fixed one. The
        // column that belongs to the row is p' of a free node.
        const int firstColumn = row, s = cell_.timeDegree();
        for (const Constraint& c : start_) {
            const int column = firstColumn + c.node;
            F(row) = x(c.first) - u[c.node];
            entries.emplace_back(row, c.first, 1.0);
            if (problem_->isFixed(c.node)) {
                F(c.first) += x(column);
                entries.emplace_back(c.first, column, 1.0);
            } else {
                F(c.first) += p[c.node];
                const int end = local(ownerElement(c.node), ownerPlace(c.node), s);
                F(end) -= x(column);
                entries.emplace_back(end, column, -1.0);
            }
            ++row;
        }
        J.setFromTriplets(entries.begin(), entries.end());
    }

    double slabEnergy(const double*, const double*) const override { return energy_; }

    /// -dS/dh by a difference of the action in h: for comparison alone.
    double energyOf(const Eigen::VectorXd& x) const {
        const double epsilon = 1e-5 * h();
        double low = 0, high = 0;
        for (int e = 0; e < problem_->nodes.elements; ++e) {
            const double* z = x.data() + e * cell_.unknowns();
            high += cell_.evaluate(e, h() + epsilon, z, nullptr, nullptr);
            low += cell_.evaluate(e, h() - epsilon, z, nullptr, nullptr);
        }
        return -(high - low) / (2 * epsilon);
    }

    void finish(const Eigen::VectorXd& x, double* next) {
        energy_ = energyOf(x);
        const std::size_t size = n();
        const int firstColumn = unknowns_ + static_cast<int>(continuity_.size());
        double* v = next + size;
        for (std::size_t i = 0; i < size; ++i) {
            const auto node = static_cast<int>(i);
            next[i] = x(local(ownerElement(node), ownerPlace(node), cell_.timeDegree()));
            v[i] = problem_->isFixed(node) ? 0 : x(firstColumn + node);
        }
        mass_.solve(v);
    }

    std::shared_ptr<const FieldProblem> problem_;
    FieldCell cell_;
    MassMatrix mass_;
    int unknowns_ = 0, size_ = 0;
    double energy_ = 0;
    std::vector<int> owner_;  ///< element (r + 1) + place of the cell that a node belongs to
    std::vector<Constraint> continuity_, start_;
};

}  // namespace

std::unique_ptr<Integrator> makeSlabStepper(std::shared_ptr<const FieldProblem> problem, int timeDegree,
                                            const Rule<double>& space, const Rule<double>& time,
                                            double step) {
    return std::make_unique<SlabStepper>(std::move(problem), timeDegree, space, time, step);
}

}  // namespace extremal
