// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/linked_equations.hpp"

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
        impulse_ = forces_ = Vector::Zero(d);
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
        byPlace_.resize(g.byPlace.size());
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
        lu_.clear();
        residual_.setZero();
        impulse_.setZero();
        for (int i = 0; i < curve_.table.nodes(); ++i) addNode(t, h, z, i);
        if (parts_.force)
            for (int i = 0; i < curve_.atForces.nodes(); ++i) addForces(t, h, z, i);
        if (parts_.constraint)
            for (int j = 0; j <= m; ++j) addConstraints(t, h, z, impulses, j);
        residual_.segment((m - 1) * d, d) += p;
        return residual_.allFinite() && impulse_.allFinite();
    }
    Outcome factorise() override { return lu_.factorise(); }
    void solve(Vector& x) const override { lu_.solve(x.data()); }
    void solveTransposed(Vector& x) const override { lu_.solveTransposed(x.data()); }
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

    /// L at node i of the rule.
    void addNode(double start, double h, const Vector& z, int i) {
        const Table<double>& table = curve_.table;
        const int d = parts_.d, m = curve_.unknowns();
        const double t = start + table.node(i) * h, b = table.weight(i);
        auto places = motion_.head(d), velocities = motion_.tail(d);
        places = z.head(d);
        velocities.setZero();
        for (int a = 0; a < m; ++a) {
            places += table.value(i, a) * z.segment((a + 1) * d, d);
            velocities += table.derivative(i, a) / h * z.segment((a + 1) * d, d);
        }
        const LagrangianEntries& L = parts_.lagrangian;
        L.jet(L.model.get(), t, motion_.data(), motion_.data() + d, gradient_.data(), hessian_.data());
        impulse_ += b * h * gradient_.head(d);
        for (int a = 0; a < m; ++a) {
            const double chi = test(a, table.value(i, a)), slope = testSlope(a, table.derivative(i, a));
            residual_.segment(a * d, d) += b * h * chi * gradient_.head(d) + b * slope * gradient_.tail(d);
            for (int c = 0; c < m; ++c) {
                const double phi = table.value(i, c), phiSlope = table.derivative(i, c);
                qq_(a, c) = b * h * chi * phi;
                qv_(a, c) = b * chi * phiSlope;
                vq_(a, c) = b * slope * phi;
                vv_(a, c) = b * slope * phiSlope / h;
            }
        }
        for (std::size_t e = 0; e < hessian_.size(); ++e) {
            add(ofHessian_[e].patch, this->*ofHessian_[e].weight, hessian_[e]);
            if (L.hessian[e].row != L.hessian[e].column)
                add(mirrored_[e].patch, this->*mirrored_[e].weight, hessian_[e]);
        }
    }

    /// F at node i of its rule.
    void addForces(double start, double h, const Vector& z, int i) {
        const MechanismCurve::Nodes& nodes = curve_.atForces;
        const int d = parts_.d, m = curve_.unknowns();
        const double b = nodes.weight(i);
        const Force& force = *parts_.force;
        curve_.motionAt(nodes, z, i, h, motion_);
        force.entries->values(force.model.get(), start + nodes.place(i) * h, motion_.data(),
                              motion_.data() + d, forces_.data(), byState_.data());
        impulse_ += b * h * forces_;
        for (int a = 0; a < m; ++a) {
            const double chi = test(a, nodes.at.value(i, a));
            residual_.segment(a * d, d) += b * h * chi * forces_;
            for (int c = 0; c < m; ++c) {
                qq_(a, c) = b * h * chi * nodes.at.value(i, c);
                qv_(a, c) = b * chi * nodes.at.slope(i, c);
            }
        }
        for (std::size_t e = 0; e < byState_.size(); ++e)
            add(ofForces_[e].patch, this->*ofForces_[e].weight, byState_[e]);
    }

    /// g, its reactions and its curvature at e_j.
    void addConstraints(double start, double h, const Vector& z, const Vector& impulses, int j) {
        const Constraint& g = *parts_.constraint;
        const int d = parts_.d, m = curve_.unknowns(), n = parts_.n;
        const auto& entries = g.entries->byPlace;
        const double t = start + curve_.place(j) * h;
        curve_.placeAt(z, curve_.atPlaces, j, motion_);
        g.entries->first(g.model.get(), t, motion_.data(), value_.data(), byPlace_.data(), byTime_.data());
        double* const to = lu_.values();
        if (j > 0) {
            residual_.segment(m * d + (j - 1) * n, n) = value_;
            for (std::size_t e = 0; e < entries.size(); ++e)
                for (int a = 0; a < m; ++a)
                    to[rates_[e].first + static_cast<std::size_t>(a) * rates_[e].stride +
                       static_cast<std::size_t>(j - 1)] = curve_.atPlaces(j, a) * byPlace_[e];
        }
        if (j == m) return;
        const double* const lambda = impulses.data() + j * n;
        for (std::size_t e = 0; e < entries.size(); ++e) {
            const double force = byPlace_[e] * lambda[entries[e].row];
            impulse_(entries[e].column) += force;
            for (int a = 0; a < m; ++a) {
                const double chi = test(a, curve_.atPlaces(j, a));
                residual_(a * d + entries[e].column) += chi * force;
                to[reactions_[e].first + static_cast<std::size_t>(j) * reactions_[e].stride +
                   static_cast<std::size_t>(a)] = chi * byPlace_[e];
            }
        }
        if (j == 0) return;  // there the functions are 0
        for (int a = 0; a < m; ++a)
            for (int b = 0; b < m; ++b) qq_(a, b) = test(a, curve_.atPlaces(j, a)) * curve_.atPlaces(j, b);
        g.entries->second(g.model.get(), t, motion_.data(), curvature_.data());
        const auto& second = g.entries->curvature;
        for (std::size_t e = 0; e < second.size(); ++e) {
            const double value = lambda[second[e].constraint] * curvature_[e];
            add(ofCurvature_[e], qq_, value);
            if (second[e].row != second[e].column) add(mirroredCurvature_[e], qq_, value);
        }
    }

    LinkedParts parts_;
    MechanismCurve curve_;
    BlockLu lu_;
    Vector gradient_, motion_, forces_, value_, byTime_;
    std::vector<double> hessian_, byState_, byPlace_, curvature_;  ///< entries at one node
    std::vector<Derivative> ofHessian_, mirrored_, ofForces_;
    std::vector<Patch> reactions_, rates_, ofCurvature_, mirroredCurvature_;
    Matrix qq_, qv_, vq_, vv_;  ///< (a, b): what a derivative by q or v adds, at one node
};

}  // namespace

std::unique_ptr<MechanismEquations> linkedEquations(const LinkedParts& parts, const MechanismCurve& curve) {
    return std::make_unique<LinkedEquations>(parts, curve);
}

}  // namespace extremal
