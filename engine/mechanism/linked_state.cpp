// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "engine/mechanism/state_equations.hpp"

namespace extremal {
namespace {

class LinkedState final : public StateEquations {
public:
    explicit LinkedState(const LinkedParts& parts)
        : parts_(parts), d_(parts.d), n_(parts.n), lu_(Linkage(parts).solver(1)) {
        hessian_ = Vector::Zero(static_cast<Eigen::Index>(parts_.lagrangian.hessian.size()));
        gradient_ = Vector::Zero(2 * d_);
        forces_ = Vector::Zero(d_);
        value_ = byTime_ = Vector::Zero(n_);
        for (std::size_t e = 0; e < parts_.lagrangian.hessian.size(); ++e) {
            const auto [row, column] = parts_.lagrangian.hessian[e];
            const int i = row - d_, j = column - d_;
            if (j < 0 && i >= 0) massRates_.push_back({i, column, e});
            if (j < 0) continue;
            masses_.push_back({lu_.place(i, j), e});
            if (i == j) diagonal_.push_back({i, e});
            if (i != j) masses_.push_back({lu_.place(j, i), e});
        }
        std::sort(diagonal_.begin(), diagonal_.end());
        if (!parts_.constraint) return;
        const Constraint::Entries& g = *parts_.constraint->entries;
        byPlace_ = Vector::Zero(static_cast<Eigen::Index>(g.byPlace.size()));
        for (const MatrixEntry& e : g.byPlace)
            constraints_.push_back({lu_.place(e.column, d_ + e.row), lu_.place(d_ + e.row, e.column)});
    }
    std::unique_ptr<StateEquations> clone() const override { return std::make_unique<LinkedState>(*this); }

    void evaluate(double t, const double* q, const double* v) override {
        const LagrangianEntries& L = parts_.lagrangian;
        L.jet(L.model.get(), t, q, v, gradient_.data(), hessian_.data());
        forces_.setZero();
        if (parts_.force) parts_.force->value(parts_.force->model.get(), t, q, v, forces_.data());
        evaluateConstraint(t, q);
    }
    void evaluateConstraint(double t, const double* q) override {
        if (!parts_.constraint) return;
        const Constraint& g = *parts_.constraint;
        g.entries->first(g.model.get(), t, q, value_.data(), byPlace_.data(), byTime_.data());
    }
    void rates(double t, const double* q, const double* v, Vector& to) override {
        if (!parts_.constraint) return;
        parts_.constraint->rates(parts_.constraint->model.get(), t, q, v, to.data());
    }
    void reaction(const Vector& lambda, Vector& to) const override {
        to.setZero();
        if (!parts_.constraint) return;
        const auto& entries = parts_.constraint->entries->byPlace;
        for (std::size_t e = 0; e < entries.size(); ++e)
            to(entries[e].column) += byPlace_(static_cast<Eigen::Index>(e)) * lambda(entries[e].row);
    }
    void rate(const double* v, Vector& to) const override {
        to.setZero();
        if (!parts_.constraint) return;
        const auto& entries = parts_.constraint->entries->byPlace;
        for (std::size_t e = 0; e < entries.size(); ++e)
            to(entries[e].row) += byPlace_(static_cast<Eigen::Index>(e)) * v[entries[e].column];
    }
    void massRate(const double* v, Vector& to) const override {
        to.setZero();
        for (const MassRate& e : massRates_) to(e.row) += hessianAt(e.entry) * v[e.column];
    }
    double mass(int k) const override {
        const auto found = std::lower_bound(diagonal_.begin(), diagonal_.end(), std::pair(k, std::size_t{0}));
        return found != diagonal_.end() && found->first == k ? hessianAt(found->second) : 0;
    }

    bool factorise() override {
        lu_.clear();
        double* const to = lu_.values();
        for (const Mass& e : masses_) to[e.place] = hessianAt(e.entry);
        for (std::size_t e = 0; e < constraints_.size(); ++e) {
            const double value = byPlace_(static_cast<Eigen::Index>(e));
            to[constraints_[e].reaction] = -value;
            to[constraints_[e].rate] = value;
        }
        return lu_.factorise() == Outcome::converged;
    }
    void solve(Vector& x) const override { lu_.solve(x.data()); }

    /// With the masses of the diagonal alone, which is all where they do not couple: a measure, and not more,
    /// of what depends on what.
    Vector ownParts() const override {
        Vector own = Vector::Ones(n_);
        if (!parts_.constraint) return own;
        const auto& entries = parts_.constraint->entries->byPlace;
        std::vector<std::vector<std::pair<int, double>>> of(static_cast<std::size_t>(d_));
        for (std::size_t e = 0; e < entries.size(); ++e)
            of[static_cast<std::size_t>(entries[e].column)].push_back(
                {entries[e].row, byPlace_(static_cast<Eigen::Index>(e))});
        // Rows from the diagonal on.
        std::vector<std::map<int, double>> gram(static_cast<std::size_t>(n_));
        for (int i = 0; i < d_; ++i)
            for (const auto& [j, left] : of[static_cast<std::size_t>(i)])
                for (const auto& [k, right] : of[static_cast<std::size_t>(i)])
                    if (k >= j) gram[static_cast<std::size_t>(j)][k] += left * right / mass(i);
        Vector size(n_);
        for (int k = 0; k < n_; ++k) size(k) = 1 / std::sqrt(gram[static_cast<std::size_t>(k)][k]);
        for (int j = 0; j < n_; ++j) {
            auto& row = gram[static_cast<std::size_t>(j)];
            for (auto& [k, value] : row) value *= size(j) * size(k);
        }
        for (int j = 0; j < n_; ++j) {
            const auto& row = gram[static_cast<std::size_t>(j)];
            const double pivot = row.at(j);
            own(j) = std::sqrt(std::max(0.0, pivot));
            if (!(pivot > 0)) continue;
            for (auto k = std::next(row.begin()); k != row.end(); ++k)
                for (auto l = k; l != row.end(); ++l)
                    gram[static_cast<std::size_t>(k->first)][l->first] -= k->second / pivot * l->second;
        }
        return own;
    }

private:
    double hessianAt(std::size_t entry) const { return hessian_(static_cast<Eigen::Index>(entry)); }

    struct Mass {
        std::size_t place, entry;
    };
    struct MassRate {
        int row, column;
        std::size_t entry;
    };
    struct Row {
        std::size_t reaction, rate;  ///< places of -g_q^T and g_q
    };

    LinkedParts parts_;
    int d_, n_;
    BlockLu lu_;
    Vector hessian_, byPlace_;
    std::vector<Mass> masses_;
    std::vector<MassRate> massRates_;
    std::vector<std::pair<int, std::size_t>> diagonal_;  ///< (coordinate, entry)
    std::vector<Row> constraints_;                       ///< by entry of g_q
};

}  // namespace

std::unique_ptr<StateEquations> linkedState(const LinkedParts& parts) {
    return std::make_unique<LinkedState>(parts);
}

}  // namespace extremal
