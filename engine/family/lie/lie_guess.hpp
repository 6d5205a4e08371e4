// SPDX-License-Identifier: GPL-3.0-or-later
/// A first guess for the step of a Lie group integrator: the motion of the body by the classical Runge-Kutta
/// method, from one point of the curve to the next.
///
///     q' = q (0, w) / 2,   Pi' = Pi x w + torque,   x' = p / m,   p' = R force,      w = I^{-1} Pi
/// in variables that mix neither turning and moving nor light axes and heavy ones: a small body on a long way
/// has a momentum in the chart, way x p, that dwarfs its spin, and of a thin rod the momentum along itself is
/// a small difference of those in space. The momentum of these poses is that in the body. Nothing of the
/// result depends on the guess but the number of iterations.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "engine/family/lie/lie_groups.hpp"
#include "engine/model/body/body.hpp"

namespace extremal {

/// p + t slope, component by component.
template <class T>
Pose<T> advanced(const Pose<T>& p, const T& t, const Pose<T>& slope) {
    Pose<T> r;
    r.attitude = p.attitude + t * slope.attitude;
    r.momentum = p.momentum + t * slope.momentum;
    r.position = p.position + t * slope.position;
    r.linear = p.linear + t * slope.linear;
    return r;
}

template <class T>
Pose<T> rateOf(const BodyMechanics<T>& body, const Pose<T>& p) {
    const so3::Vector<T> w = p.momentum.cwiseQuotient(so3::Vector<T>(body.inertia.data()));
    Pose<T> rate;
    rate.momentum = so3::cross(p.momentum, w);
    rate.attitude = so3::product(p.attitude, so3::Quaternion<T>(T(0), w(0) / T(2), w(1) / T(2), w(2) / T(2)));
    if (body.dimension == 6) rate.position = p.linear / body.inertia[3];
    if (body.isFree()) return rate;
    const so3::Matrix<T> R = so3::matrix(so3::normalised(p.attitude));
    std::array<T, 6> f{};
    body.potential(body.model.get(), R.data(), body.dimension == 6 ? p.position.data() : nullptr, nullptr,
                   f.data(), nullptr);
    rate.momentum += so3::Vector<T>(f.data());
    if (body.dimension == 6) rate.linear = R * so3::Vector<T>(f.data() + 3);
    return rate;
}

/// False where the potential has no force: in a singularity.
template <class T>
bool isRateFinite(const BodyMechanics<T>& body, const Pose<T>& p) {
    using std::isfinite;
    const Pose<T> rate = rateOf(body, p);
    return isfinite(T(rate.momentum.squaredNorm() + rate.linear.squaredNorm()));
}

/// The pose after the time t.
template <class T>
Pose<T> guessedAfter(const BodyMechanics<T>& body, const Pose<T>& p, const T& t) {
    const T half = t / T(2), sixth = t / T(6), third = t / T(3);
    const Pose<T> k1 = rateOf(body, p), k2 = rateOf(body, advanced(p, half, k1));
    const Pose<T> k3 = rateOf(body, advanced(p, half, k2)), k4 = rateOf(body, advanced(p, t, k3));
    Pose<T> r = advanced(advanced(advanced(advanced(p, sixth, k1), third, k2), third, k3), sixth, k4);
    r.attitude = so3::normalised(r.attitude);
    return r;
}

/// The rotation vector from one attitude to another: of those that differ by full turns, the one next to
/// `near`.
template <class T>
so3::Vector<T> turnBetween(const so3::Quaternion<T>& from, const so3::Quaternion<T>& to,
                           const so3::Vector<T>& near) {
    const so3::Vector<T> omega = so3::log(so3::product(so3::conjugate(from), to));
    using std::acos;
    const T size = omega.norm(), full = T(4) * acos(T(0));
    so3::Vector<T> best = omega;
    for (const int turns : {-1, 1}) {
        if (!(size > T(0))) break;
        const so3::Vector<T> other = omega * (T(1) + T(turns) * full / size);
        if ((other - near).norm() < (best - near).norm()) best = other;
    }
    return best;
}

/// The guess of a step on G: a body's. Of groups given as data: data_lagrangian.hpp.
template <class T, class G>
class StepGuess {
public:
    using Vector = typename G::Vector;

    StepGuess(const G& group, const BodyMechanics<T>& body) : group_(group), body_(body) {}

    /// Fills the columns of `points` with the coordinates of the curve at the times (ascending, in steps from
    /// the start on), seen from the base point of the chart, which is that at the time `base`; mu: momentum
    /// in the body at the start.
    template <class Columns>
    void curve(const Pose<T>& known, const Vector& mu, const std::vector<T>& times, const T& base,
               const T& step, Columns& points) {
        start_ = known;
        start_.momentum = mu.template head<3>();
        places_.resize(times.size());
        Pose<T> at = start_, atBase = start_;
        T reached(0);
        const auto to = [&](const T& time) -> const Pose<T>& {
            if (time != reached) at = guessedAfter(body_, at, T((time - reached) * step));
            reached = time;
            return at;
        };
        bool isBaseKnown = false;
        for (std::size_t k = 0; k < times.size(); ++k) {
            if (!isBaseKnown && times[k] > base) {
                atBase = to(base);
                isBaseKnown = true;
            }
            places_[k] = to(times[k]);
        }
        if (!isBaseKnown) atBase = to(base);
        const Vector w = rate(body_, {}, mu);
        for (std::size_t k = 0; k < times.size(); ++k)
            points.col(static_cast<Eigen::Index>(k)) =
                coordinates(group_, atBase, places_[k], Vector((step * (times[k] - base)) * w));
    }
    /// False where the potential has no force at the start: in a singularity.
    bool isRateFinite() const { return extremal::isRateFinite(body_, start_); }

    /// The angular velocity of a momentum in the body, as coordinates per unit of time.
    static Vector rate(const BodyMechanics<T>& body, const typename G::Element&, const Vector& mu) {
        Vector w = mu;
        for (int i = 0; i < G::n; ++i)
            w(i) = i < 3 ? mu(i) / body.inertia[static_cast<std::size_t>(i)] : T(0);
        return w;
    }
    /// xi of a place seen from the base point: of those that differ by full turns the one next to `near`.
    static Vector coordinates(const G&, const Pose<T>& base, const Pose<T>& place, const Vector& near) {
        return G::coordinates(base, place,
                              turnBetween<T>(base.attitude, place.attitude, near.template head<3>()));
    }

private:
    G group_;
    BodyMechanics<T> body_;
    Pose<T> start_;
    std::vector<Pose<T>> places_;
};

}  // namespace extremal
