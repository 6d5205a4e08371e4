// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/linked_equations.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace extremal {
namespace {

/// m x m numbers of the matrix: (a, b) at `first` + b `stride` + a.
struct Patch {
    std::size_t first, stride;
};

class LinkedEquations final : public MechanismEquations {
    using Matrix = Eigen::MatrixXd;

public:
    LinkedEquations(const LinkedParts& parts, const MechanismCurve& curve)
        : parts_(parts), curve_(curve), lu_(Linkage(parts).solver(curve.unknowns())) {
        const int d = parts_.d, m = curve_.unknowns(), n = parts_.n;
        residual_ = Vector::Zero(m * (d + n));
        z_ = Vector::Zero((m + 1) * d);
        impulses_ = Vector::Zero(m * n);
        impulse_ = forces_ = masses_ = Vector::Zero(d);
        gradient_ = motion_ = Vector::Zero(2 * d);
        value_ = byTime_ = Vector::Zero(n);
        hessian_.resize(parts_.lagrangian.hessian.size());
        for (const MatrixEntry& e : parts_.lagrangian.hessian) {
            ofHessian_.push_back(derivative(e.row, e.column));
            mirrored_.push_back(derivative(e.column, e.row));
        }
        for (Matrix* w : {&qq_, &qv_, &vq_, &vv_}) *w = Matrix::Zero(m, m);
        if (parts_.force) {
            for (const MatrixEntry& e : parts_.force->entries->first)
                ofForces_.push_back(derivative(e.row, e.column));
            byState_.resize(parts_.force->entries->first.size());
        }
        if (!parts_.constraint) return;
        const Constraint::Entries& g = *parts_.constraint->entries;
        byPlace_.resize(g.byPlace.size() * static_cast<std::size_t>(m + 1));
        curvature_.resize(g.curvature.size());
        for (const MatrixEntry& e : g.byPlace) {
            reactions_.push_back({lu_.place(e.column, m * d + e.row), lu_.stride(e.column)});
            rates_.push_back({lu_.place(m * d + e.row, e.column), lu_.stride(m * d + e.row)});
        }
        for (const Constraint::Entries::Second& e : g.curvature) {
            ofCurvature_.push_back(patch(e.row, e.column));
            mirroredCurvature_.push_back(patch(e.column, e.row));
        }
    }
    std::unique_ptr<MechanismEquations> clone() const override {
        return std::make_unique<LinkedEquations>(*this);
    }

    bool evaluate(double t, double h, const Vector& z, const Vector& p, const Vector& impulses) override {
        const int d = parts_.d, m = curve_.unknowns();
        t_ = t;
        h_ = h;
        z_ = z;
        impulses_ = impulses;
        residual_.setZero();
        impulse_.setZero();
        for (int i = 0; i < curve_.table.nodes(); ++i) addLagrangian(i);
        if (parts_.force)
            for (int i = 0; i < curve_.atForces.nodes(); ++i) addForces(i);
        if (parts_.constraint)
            for (int j = 0; j <= m; ++j) addConstraints(j);
        residual_.segment((m - 1) * d, d) += p;
        return residual_.allFinite() && impulse_.allFinite();
    }
    Outcome factorise() override {
        const int m = curve_.unknowns();
        lu_.clear();
        masses_.setZero();
        for (int i = 0; i < curve_.table.nodes(); ++i) differentiateLagrangian(i);
        if (parts_.force)
            for (int i = 0; i < curve_.atForces.nodes(); ++i) differentiateForces(i);
        if (parts_.constraint)
            for (int j = 0; j <= m; ++j) differentiateConstraints(j);
        return lu_.factorise();
    }
    void solve(Vector& x) const override { lu_.solve(x.data()); }
    void solveTransposed(Vector& x) const override { lu_.solveTransposed(x.data()); }
    void reactions(const double* impulses, Vector& to) const override {
        to.setZero();
        if (!parts_.constraint) return;
        const auto& entries = parts_.constraint->entries->byPlace;
        const double* byPlace = byPlace_.data();
        for (int j = 0; j < curve_.unknowns(); ++j, impulses += parts_.n)
            for (const MatrixEntry& e : entries) to(e.column) += *byPlace++ * impulses[e.row];
    }
    std::string about() const override {
        return std::to_string(lu_.blocks()) + " blocks of " +
               (lu_.largest() == 1 ? "one unknown" : "up to " + std::to_string(lu_.largest()) + " unknowns");
    }

private:
    Patch patch(int i, int k) const { return {lu_.place(i, k), lu_.stride(i)}; }

    /// Of a derivative of L or F by (q, v): its patch, and which of the weights.
    struct Derivative {
        Patch patch;
        Matrix LinkedEquations::*weight;
    };
    Derivative derivative(int row, int column) const {
        const int d = parts_.d;
        return {patch(row % d, column % d),
                row < d ? (column < d ? &LinkedEquations::qq_ : &LinkedEquations::qv_)
                        : (column < d ? &LinkedEquations::vq_ : &LinkedEquations::vv_)};
    }
    void add(const Patch& to, const Matrix& weight, double value) {
        double* const at = lu_.values() + to.first;
        const int m = curve_.unknowns();
        for (int b = 0; b < m; ++b)
            for (int a = 0; a < m; ++a)
                at[static_cast<std::size_t>(b) * to.stride + static_cast<std::size_t>(a)] +=
                    value * weight(a, b);
    }
    /// chi_a and its derivative, from phi_a.
    double test(int a, double phi) const { return a < curve_.unknowns() - 1 ? phi : 1 - phi; }
    double testSlope(int a, double slope) const { return a < curve_.unknowns() - 1 ? slope : -slope; }

    double timeAt(const MechanismCurve::Nodes& nodes, int i) const { return t_ + nodes.place(i) * h_; }

    /// L at node i of the rule.
    void addLagrangian(int i) {
        const Table<double>& table = curve_.table;
        const int d = parts_.d, m = curve_.unknowns();
        const double b = table.weight(i);
        curve_.motionAt(curve_.atLagrangian, z_, i, h_, motion_);
        const Mechanics<double>& L = parts_.mechanics;
        L.gradient(L.model.get(), timeAt(curve_.atLagrangian, i), motion_.data(), motion_.data() + d,
                   gradient_.data());
        impulse_ += b * h_ * gradient_.head(d);
        for (int a = 0; a < m; ++a)
            residual_.segment(a * d, d) += b * h_ * test(a, table.value(i, a)) * gradient_.head(d) +
                                           b * testSlope(a, table.derivative(i, a)) * gradient_.tail(d);
    }
    void differentiateLagrangian(int i) {
        const Table<double>& table = curve_.table;
        const int d = parts_.d, m = curve_.unknowns();
        const double b = table.weight(i);
        curve_.motionAt(curve_.atLagrangian, z_, i, h_, motion_);
        const LagrangianEntries& L = parts_.lagrangian;
        L.jet(L.model.get(), timeAt(curve_.atLagrangian, i), motion_.data(), motion_.data() + d,
              gradient_.data(), hessian_.data());
        for (int a = 0; a < m; ++a) {
            const double chi = test(a, table.value(i, a)), slope = testSlope(a, table.derivative(i, a));
            for (int c = 0; c < m; ++c) {
                const double phi = table.value(i, c), phiSlope = table.derivative(i, c);
                qq_(a, c) = b * h_ * chi * phi;
                qv_(a, c) = b * chi * phiSlope;
                vq_(a, c) = b * slope * phi;
                vv_(a, c) = b * slope * phiSlope / h_;
            }
        }
        for (std::size_t e = 0; e < hessian_.size(); ++e) {
            const MatrixEntry& at = L.hessian[e];
            add(ofHessian_[e].patch, this->*ofHessian_[e].weight, hessian_[e]);
            if (at.row != at.column) add(mirrored_[e].patch, this->*mirrored_[e].weight, hessian_[e]);
            if (at.row == at.column && at.row >= d)
                masses_(at.row - d) = std::max(masses_(at.row - d), std::abs(hessian_[e]));
        }
    }

    /// F at node i of its rule.
    void addForces(int i) {
        const MechanismCurve::Nodes& nodes = curve_.atForces;
        const int d = parts_.d;
        const double weight = nodes.weight(i) * h_;
        const Force& force = *parts_.force;
        curve_.motionAt(nodes, z_, i, h_, motion_);
        force.value(force.model.get(), timeAt(nodes, i), motion_.data(), motion_.data() + d, forces_.data());
        impulse_ += weight * forces_;
        for (int a = 0; a < curve_.unknowns(); ++a)
            residual_.segment(a * d, d) += weight * test(a, nodes.at.value(i, a)) * forces_;
    }
    void differentiateForces(int i) {
        const MechanismCurve::Nodes& nodes = curve_.atForces;
        const int d = parts_.d, m = curve_.unknowns();
        const double b = nodes.weight(i);
        const Force& force = *parts_.force;
        curve_.motionAt(nodes, z_, i, h_, motion_);
        force.entries->values(force.model.get(), timeAt(nodes, i), motion_.data(), motion_.data() + d,
                              forces_.data(), byState_.data());
        for (int a = 0; a < m; ++a) {
            const double chi = test(a, nodes.at.value(i, a));
            for (int c = 0; c < m; ++c) {
                qq_(a, c) = b * h_ * chi * nodes.at.value(i, c);
                qv_(a, c) = b * chi * nodes.at.slope(i, c);
            }
        }
        for (std::size_t e = 0; e < byState_.size(); ++e)
            add(ofForces_[e].patch, this->*ofForces_[e].weight, byState_[e]);
    }

    /// g and its reactions at e_j; its derivatives there are kept.
    void addConstraints(int j) {
        const Constraint& g = *parts_.constraint;
        const int d = parts_.d, m = curve_.unknowns(), n = parts_.n;
        const auto& entries = g.entries->byPlace;
        double* const byPlace = byPlace_.data() + static_cast<std::size_t>(j) * entries.size();
        curve_.placeAt(z_, curve_.atPlaces, j, motion_);
        g.entries->first(g.model.get(), t_ + curve_.place(j) * h_, motion_.data(), value_.data(), byPlace,
                         byTime_.data());
        if (j > 0) residual_.segment(m * d + (j - 1) * n, n) = value_;
        if (j == m) return;
        const double* const lambda = impulses_.data() + j * n;
        for (std::size_t e = 0; e < entries.size(); ++e) {
            const double force = byPlace[e] * lambda[entries[e].row];
            impulse_(entries[e].column) += force;
            for (int a = 0; a < m; ++a)
                residual_(a * d + entries[e].column) += test(a, curve_.atPlaces(j, a)) * force;
        }
    }
    void differentiateConstraints(int j) {
        const Constraint& g = *parts_.constraint;
        const int m = curve_.unknowns(), n = parts_.n;
        const auto& entries = g.entries->byPlace;
        const double* const byPlace = byPlace_.data() + static_cast<std::size_t>(j) * entries.size();
        double* const to = lu_.values();
        const auto place = [](const Patch& patch, int row, int column) {
            return patch.first + static_cast<std::size_t>(column) * patch.stride +
                   static_cast<std::size_t>(row);
        };
        for (std::size_t e = 0; e < entries.size(); ++e)
            for (int a = 0; a < m; ++a) {
                if (j > 0) to[place(rates_[e], j - 1, a)] = curve_.atPlaces(j, a) * byPlace[e];
                if (j < m) to[place(reactions_[e], a, j)] = test(a, curve_.atPlaces(j, a)) * byPlace[e];
            }
        if (j == 0 || j == m) return;  // at 0 the functions are 0, and at the end no multiplier is in R
        for (int a = 0; a < m; ++a)
            for (int b = 0; b < m; ++b) qq_(a, b) = test(a, curve_.atPlaces(j, a)) * curve_.atPlaces(j, b);
        curve_.placeAt(z_, curve_.atPlaces, j, motion_);
        g.entries->second(g.model.get(), t_ + curve_.place(j) * h_, motion_.data(), curvature_.data());
        const auto& second = g.entries->curvature;
        for (std::size_t e = 0; e < second.size(); ++e) {
            const double value = impulses_(j * n + second[e].constraint) * curvature_[e];
            add(ofCurvature_[e], qq_, value);
            if (second[e].row != second[e].column) add(mirroredCurvature_[e], qq_, value);
        }
    }

    LinkedParts parts_;
    MechanismCurve curve_;
    BlockLu lu_;
    Vector gradient_, motion_, forces_, value_, byTime_;
    double t_ = 0, h_ = 0;  ///< of the last evaluation, as z_ and impulses_
    Vector z_, impulses_;
    std::vector<double> hessian_, byState_, curvature_;  ///< entries at one node
    std::vector<double> byPlace_;                        ///< entries at all e_j
    std::vector<Derivative> ofHessian_, mirrored_, ofForces_;
    std::vector<Patch> reactions_, rates_, ofCurvature_, mirroredCurvature_;
    Matrix qq_, qv_, vq_, vv_;  ///< (a, b): what a derivative by q or v adds, at one node
};

}  // namespace

std::unique_ptr<MechanismEquations> linkedEquations(const LinkedParts& parts, const MechanismCurve& curve) {
    return std::make_unique<LinkedEquations>(parts, curve);
}

}  // namespace extremal
