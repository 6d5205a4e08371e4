// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/spins/spins.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/core/own_buffers.hpp"
#include "engine/model/system.hpp"

namespace extremal::spins {
namespace {

using Four = Eigen::Vector4d;
using FieldView = Eigen::Map<const Eigen::Vector3d>;

struct OwnedModel {
    std::shared_ptr<const SpinModel> of;
    long long id;
};
const OwnedModel& modelAt(const void* p) { return *static_cast<const OwnedModel*>(p); }

/// Of one thread.
struct SpinValues {
    explicit SpinValues(int count) : s(3 * static_cast<std::size_t>(count)), b(s.size()) {}
    std::vector<double> s, b;
};
struct SpinBuffers : SpinValues {
    explicit SpinBuffers(int count) : SpinValues(count), second(s.size(), s.size()) {}
    Eigen::MatrixXd second;
};

/// z = (a, b, c, d) of spin i.
Four zAt(const SpinModel& model, int i, const double* q, const double* p) {
    const double scale = 1 / (4 * model.weights[static_cast<std::size_t>(i)]);
    return {q[2 * i], scale * p[2 * i], q[2 * i + 1], scale * p[2 * i + 1]};
}

/// b . s = z^T M z: half the derivative of it by z is M z.
Eigen::Matrix4d matrixOf(const Eigen::Vector3d& b) {
    Eigen::Matrix4d M;
    M << b(2), 0, b(0), b(1),   //
        0, b(2), -b(1), b(0),   //
        b(0), -b(1), -b(2), 0,  //
        b(1), b(0), 0, -b(2);
    return M;
}

/// ds/dz.
Eigen::Matrix<double, 3, 4> slopeOf(const Four& z) {
    Eigen::Matrix<double, 3, 4> J;
    for (int k = 0; k < 3; ++k) J.row(k) = 2 * (matrixOf(Eigen::Vector3d::Unit(k)) * z).transpose();
    return J;
}

/// The places of (a, b, c, d) of spin i among (q, p), and the derivatives of z by these.
struct Places {
    std::array<Eigen::Index, 4> at;
    Four scale;
    Places(const SpinModel& model, int i) {
        const int d = 2 * model.count();
        const double scaled = 1 / (4 * model.weights[static_cast<std::size_t>(i)]);
        at = {2 * i, d + 2 * i, 2 * i + 1, d + 2 * i + 1};
        scale = {1, scaled, 1, scaled};
    }
};

double energyCall(const void* p, double, const double* q, const double* momenta) {
    const SpinModel& model = *modelAt(p).of;
    SpinValues& own = ownBuffers<SpinValues>(modelAt(p).id, model.count());
    spinsOf(model, q, momenta, own.s.data());
    return energyOf(model, own.s.data(), nullptr);
}

void gradientCall(const void* p, double, const double* q, const double* momenta, double* gradient) {
    const SpinModel& model = *modelAt(p).of;
    SpinValues& own = ownBuffers<SpinValues>(modelAt(p).id, model.count());
    spinsOf(model, q, momenta, own.s.data());
    energyOf(model, own.s.data(), own.b.data());
    for (int i = 0; i < model.count(); ++i) {
        const Places places(model, i);
        const Four slope = 2 * (matrixOf(FieldView(own.b.data() + 3 * i)) * zAt(model, i, q, momenta));
        for (std::size_t k = 0; k < 4; ++k) {
            const auto n = static_cast<Eigen::Index>(k);
            gradient[places.at[k]] = places.scale(n) * slope(n);
        }
    }
}

/// d2H/ds2 into a square of 3 n.
void secondOf(const SpinModel& model, const double* s, Eigen::MatrixXd& second) {
    second.setZero();
    double value = 0;
    std::array<double, 6> y{}, slope{};
    std::array<double, 21> triangle{};
    for (const SpinModel::Bond& bond : model.bonds) {
        std::copy_n(s + 3 * bond.i, 3, y.begin());
        std::copy_n(s + 3 * bond.j, 3, y.begin() + 3);
        model.pair->evaluate(y.data(), &value, slope.data(), triangle.data());
        const auto place = [&](int k) { return k < 3 ? 3 * bond.i + k : 3 * bond.j + k - 3; };
        for (int k = 0, n = 0; k < 6; ++k)
            for (int l = 0; l <= k; ++l, ++n) {
                const double entry = bond.factor * triangle[static_cast<std::size_t>(n)];
                second(place(k), place(l)) += entry;
                if (k != l) second(place(l), place(k)) += entry;
            }
    }
    for (int i = 0; model.site && i < model.count(); ++i) {
        model.site->evaluate(s + 3 * i, &value, slope.data(), triangle.data());
        for (int k = 0, n = 0; k < 3; ++k)
            for (int l = 0; l <= k; ++l, ++n) {
                second(3 * i + k, 3 * i + l) += triangle[static_cast<std::size_t>(n)];
                if (k != l) second(3 * i + l, 3 * i + k) += triangle[static_cast<std::size_t>(n)];
            }
    }
}

void hessianCall(const void* p, double, const double* q, const double* momenta, double* hessian) {
    const SpinModel& model = *modelAt(p).of;
    const int n = model.count(), d = 4 * n;
    SpinBuffers& own = ownBuffers<SpinBuffers>(modelAt(p).id, n);
    spinsOf(model, q, momenta, own.s.data());
    energyOf(model, own.s.data(), own.b.data());
    secondOf(model, own.s.data(), own.second);
    Eigen::Map<Eigen::MatrixXd> H(hessian, d, d);
    H.setZero();
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const auto block = own.second.block<3, 3>(3 * i, 3 * j);
            if (i != j && block.isZero(0)) continue;
            const Places rows(model, i), columns(model, j);
            Eigen::Matrix4d part =
                slopeOf(zAt(model, i, q, momenta)).transpose() * block * slopeOf(zAt(model, j, q, momenta));
            if (i == j) part += 2 * matrixOf(FieldView(own.b.data() + 3 * i));
            part = (rows.scale.asDiagonal() * part * columns.scale.asDiagonal()).eval();
            for (std::size_t k = 0; k < 4; ++k)
                for (std::size_t l = 0; l < 4; ++l)
                    H(rows.at[k], columns.at[l]) =
                        part(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l));
        }
}

}  // namespace

void spinsOf(const SpinModel& model, const double* q, const double* p, double* s) {
    for (int i = 0; i < model.count(); ++i, s += 3) {
        const Four z = zAt(model, i, q, p);
        s[0] = 2 * (z(0) * z(2) + z(1) * z(3));
        s[1] = 2 * (z(0) * z(3) - z(1) * z(2));
        s[2] = z(0) * z(0) + z(1) * z(1) - z(2) * z(2) - z(3) * z(3);
    }
}

std::vector<double> stateOf(const SpinModel& model, const double* s) {
    const auto d = static_cast<std::size_t>(2 * model.count());
    std::vector<double> x(2 * d);
    for (std::size_t i = 0; i < d / 2; ++i, s += 3) {
        // The larger of the two entries is real.
        const double large = std::sqrt((1 + std::abs(s[2])) / 2), re = s[0] / (2 * large),
                     im = s[1] / (2 * large), w = 4 * model.weights[i];
        const bool isUpper = s[2] >= 0;
        x[2 * i] = isUpper ? large : re;
        x[2 * i + 1] = isUpper ? re : large;
        x[d + 2 * i] = isUpper ? 0 : -w * im;
        x[d + 2 * i + 1] = isUpper ? w * im : 0;
    }
    return x;
}

double energyOf(const SpinModel& model, const double* s, double* b) {
    if (b) std::fill_n(b, 3 * model.count(), 0.0);
    double sum = 0, value = 0;
    std::array<double, 6> y{}, slope{};
    for (const SpinModel::Bond& bond : model.bonds) {
        std::copy_n(s + 3 * bond.i, 3, y.begin());
        std::copy_n(s + 3 * bond.j, 3, y.begin() + 3);
        model.pair->evaluate(y.data(), &value, b ? slope.data() : nullptr, nullptr);
        sum += bond.factor * value;
        for (std::size_t k = 0; b && k < 3; ++k) {
            b[3 * static_cast<std::size_t>(bond.i) + k] += bond.factor * slope[k];
            b[3 * static_cast<std::size_t>(bond.j) + k] += bond.factor * slope[k + 3];
        }
    }
    for (int i = 0; model.site && i < model.count(); ++i) {
        model.site->evaluate(s + 3 * i, &value, b ? slope.data() : nullptr, nullptr);
        sum += value;
        for (int k = 0; b && k < 3; ++k) b[3 * i + k] += slope[static_cast<std::size_t>(k)];
    }
    return sum;
}

PhaseMechanics mechanicsOf(std::shared_ptr<const SpinModel> model) {
    PhaseMechanics made;
    made.dimension = 2 * model->count();
    made.model = std::make_shared<const OwnedModel>(OwnedModel{std::move(model), nextModelId()});
    made.energy = energyCall;
    made.gradient = gradientCall;
    made.hessian = hessianCall;
    return made;
}

void claimLengths(const System& system, Claims& claims) {
    const auto& kept = claims.conserves;
    if (system.parts.find<Spins>() &&
        std::find(kept.begin(), kept.end(), "quadratic invariants") != kept.end())
        claims.conserves.emplace_back("norm");
}

}  // namespace extremal::spins
