// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/variation/held_coordinates.hpp"

#include <algorithm>
#include <utility>

namespace extremal {

struct HeldCoordinates::Model {
    Mechanics<double> whole;
    std::optional<Force> force;
    std::vector<double> values;
    std::size_t d, D;
    /// Room of a call, which reads and writes all d + u coordinates.
    std::vector<double> q, v, first, second;
    std::vector<double> manyQ, manyV, manyFirst, manySecond;  ///< of many nodes
};

namespace {

/// The calls of both parts.
struct OfHeld {
    using Model = HeldCoordinates::Model;

    static Model& at(const void* p) { return *static_cast<Model*>(const_cast<void*>(p)); }

    /// (q, u) and (v, 0), or (p, 0).
    static Model& placed(const void* model, const double* q, const double* v) {
        Model& m = at(model);
        std::copy_n(q, m.d, m.q.begin());
        std::copy_n(v, m.d, m.v.begin());
        std::copy(m.values.begin(), m.values.end(), m.q.begin() + static_cast<std::ptrdiff_t>(m.d));
        return m;
    }
    /// The first d of both halves of a vector, or of one row of a matrix.
    static void takeHalves(const Model& m, const double* from, double* to) {
        std::copy_n(from, m.d, to);
        std::copy_n(from + m.D, m.d, to + m.d);
    }

    static void jet(const void* model, const double& t, const double* q, const double* v, double* value,
                    double* gradient, double* hessian) {
        Model& m = placed(model, q, v);
        m.whole.jet(m.whole.model.get(), t, m.q.data(), m.v.data(), value, m.first.data(), m.second.data());
        takeHalves(m, m.first.data(), gradient);
        for (std::size_t i = 0; i < 2 * m.d; ++i)
            takeHalves(m, m.second.data() + (i < m.d ? i : i + m.D - m.d) * 2 * m.D, hessian + i * 2 * m.d);
    }
    static void gradient(const void* model, const double& t, const double* q, const double* v, double* to) {
        Model& m = placed(model, q, v);
        m.whole.gradient(m.whole.model.get(), t, m.q.data(), m.v.data(), m.first.data());
        takeHalves(m, m.first.data(), to);
    }
    static bool velocity(const void* model, const double& t, const double* q, const double* p, double* v) {
        Model& m = placed(model, q, p);
        const bool isFound = m.whole.velocity(m.whole.model.get(), t, m.q.data(), m.v.data(), m.first.data());
        std::copy_n(m.first.begin(), m.d, v);
        return isFound;
    }
    static double energy(const void* model, const double& t, const double* q, const double* p) {
        Model& m = placed(model, q, p);
        return m.whole.energy(m.whole.model.get(), t, m.q.data(), m.v.data());
    }
    static bool flow(const void* model, const double& t, const double* q, const double* p, double* qdot,
                     double* pdot) {
        Model& m = placed(model, q, p);
        double* const rates = m.first.data();
        const bool isFound = m.whole.flow(m.whole.model.get(), t, m.q.data(), m.v.data(), rates, rates + m.D);
        std::copy_n(rates, m.d, qdot);
        std::copy_n(rates + m.D, m.d, pdot);
        return isFound;
    }
    static void forceOfPotential(const void* model, const double& t, const double* q, double* f) {
        Model& m = placed(model, q, q);
        m.whole.force(m.whole.model.get(), t, m.q.data(), m.first.data());
        std::copy_n(m.first.begin(), m.d, f);
    }

    /// Many nodes together: coordinate k of node i at k * nodes + i.
    static Model& placedNodes(const void* model, int nodes, const double* q, const double* v) {
        Model& m = at(model);
        const auto n = static_cast<std::size_t>(nodes);
        m.manyQ.resize(m.D * n);
        m.manyV.assign(m.D * n, 0);
        m.manyFirst.resize(2 * m.D * n);
        std::copy_n(q, m.d * n, m.manyQ.begin());
        if (v) std::copy_n(v, m.d * n, m.manyV.begin());
        for (std::size_t k = m.d; k < m.D; ++k) std::fill_n(m.manyQ.data() + k * n, n, m.values[k - m.d]);
        return m;
    }
    static void forces(const void* model, const double* t, int nodes, const double* q, double* f) {
        Model& m = placedNodes(model, nodes, q, nullptr);
        m.whole.forces(m.whole.model.get(), t, nodes, m.manyQ.data(), m.manyFirst.data());
        std::copy_n(m.manyFirst.begin(), m.d * static_cast<std::size_t>(nodes), f);
    }
    static void gradients(const void* model, const double* t, int nodes, const double* q, const double* v,
                          double* to) {
        Model& m = placedNodes(model, nodes, q, v);
        const auto n = static_cast<std::size_t>(nodes);
        m.whole.gradients(m.whole.model.get(), t, nodes, m.manyQ.data(), m.manyV.data(), m.manyFirst.data());
        std::copy_n(m.manyFirst.data(), m.d * n, to);
        std::copy_n(m.manyFirst.data() + m.D * n, m.d * n, to + m.d * n);
    }
    static void hessians(const void* model, const double* t, int nodes, const double* q, const double* v,
                         double* to) {
        Model& m = placedNodes(model, nodes, q, v);
        const auto n = static_cast<std::size_t>(nodes);
        m.manySecond.resize(4 * m.D * m.D * n);
        m.whole.hessians(m.whole.model.get(), t, nodes, m.manyQ.data(), m.manyV.data(), m.manySecond.data());
        const auto whole = [&](std::size_t i) { return i < m.d ? i : i + m.D - m.d; };
        for (std::size_t i = 0; i < 2 * m.d; ++i)
            for (std::size_t j = 0; j < 2 * m.d; ++j)
                std::copy_n(m.manySecond.data() + (whole(i) * 2 * m.D + whole(j)) * n, n,
                            to + (i * 2 * m.d + j) * n);
    }

    static void valueOfForce(const void* model, double t, const double* q, const double* v, double* f) {
        Model& m = placed(model, q, v);
        m.force->value(m.force->model.get(), t, m.q.data(), m.v.data(), m.first.data());
        std::copy_n(m.first.begin(), m.d, f);
    }
    static void firstOfForce(const void* model, double t, const double* q, const double* v, double* f,
                             double* derivatives) {
        Model& m = placed(model, q, v);
        m.force->first(m.force->model.get(), t, m.q.data(), m.v.data(), m.first.data(), m.second.data());
        std::copy_n(m.first.begin(), m.d, f);
        for (std::size_t i = 0; i < m.d; ++i)
            takeHalves(m, m.second.data() + i * 2 * m.D, derivatives + i * 2 * m.d);
    }
};

}  // namespace

HeldCoordinates::HeldCoordinates(Mechanics<double> whole, std::optional<Force> force,
                                 std::span<const double> values)
    : model_(std::make_shared<Model>()) {
    Model& m = *model_;
    m.D = static_cast<std::size_t>(whole.dimension);
    m.d = m.D - values.size();
    m.whole = std::move(whole);
    m.force = std::move(force);
    m.values.assign(values.begin(), values.end());
    m.q.resize(m.D);
    m.v.assign(m.D, 0);
    m.first.resize(2 * m.D);
    m.second.resize(4 * m.D * m.D);
}

int HeldCoordinates::dimension() const { return static_cast<int>(model_->d); }
int HeldCoordinates::held() const { return static_cast<int>(model_->values.size()); }
std::span<double> HeldCoordinates::values() const { return model_->values; }
const Mechanics<double>& HeldCoordinates::whole() const { return model_->whole; }
const std::optional<Force>& HeldCoordinates::wholeForce() const { return model_->force; }

Mechanics<double> HeldCoordinates::mechanics() const {
    const Mechanics<double>& whole = model_->whole;
    Mechanics<double> m = whole;  // what is said of all coordinates holds for the first of them
    m.dimension = dimension();
    m.model = model_;
    m.jet = OfHeld::jet;
    m.gradient = OfHeld::gradient;
    m.velocity = OfHeld::velocity;
    m.energy = OfHeld::energy;
    m.flow = OfHeld::flow;
    m.force = whole.force ? OfHeld::forceOfPotential : nullptr;
    m.forces = whole.forces ? OfHeld::forces : nullptr;
    m.kicksAndDrifts = nullptr;
    m.gradients = whole.gradients ? OfHeld::gradients : nullptr;
    m.hessians = whole.hessians ? OfHeld::hessians : nullptr;
    m.terms = {};
    return m;
}

std::optional<Force> HeldCoordinates::force() const {
    if (!model_->force) return {};
    Force f;  // what it offers besides, many nodes or entries, is that of the whole model
    f.model = model_;
    f.isTimeDependent = model_->force->isTimeDependent;
    f.kinks = model_->force->kinks;
    f.value = OfHeld::valueOfForce;
    f.first = OfHeld::firstOfForce;
    return f;
}

}  // namespace extremal
