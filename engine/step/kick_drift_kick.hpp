// SPDX-License-Identifier: GPL-3.0-or-later
/// The explicit step of a field whose mass does not depend on its values,
///
///     v' = v + h/2 a(u, t),   u+ = u + h v',   v+ = v' + h/2 a(u+, t + h),   a = M^{-1} (-dU/du),
/// and its tangent map. The acceleration at the end of a step is that at the start of the next, as long as
/// the values are the ones that were handed out. Internal to the families and the baselines of fields.
#pragma once

#include <algorithm>
#include <cstring>
#include <vector>

#include "engine/step/field_march.hpp"

namespace extremal {

/// `March`: FieldMarch, or what is derived from it.
template <class March>
class KickDriftKick : public March {
public:
    using March::March;
    bool checkpoint(Archive& archive) override {
        archive(isKnown_, ofTime_, of_, acceleration_);
        return March::checkpoint(archive);
    }

protected:
    using March::before;
    using March::begin;
    using March::h;
    using March::n;

    /// a of n() values; 0 where they are held.
    virtual void accelerate(double t, const double* u, double* a, Cost& cost) = 0;
    virtual bool isTimeDependent() const { return false; }
    /// Of variations: d2U/du2 at the start and at the end of the step that was made; then
    /// dp -= scale d2U/du2 du with that of the `end`, and du += scale M^{-1} dp.
    virtual void linearise(const double* start, const double* end) = 0;
    enum class End { start, end };
    virtual void kick(End end, double scale, const double* du, double* dp) = 0;
    virtual void drift(double scale, const double* dp, double* du) = 0;

    void prepare() override {
        acceleration_.resize(n());
        of_.resize(n());
    }
    Outcome step(const double* x, double* next, StepReport& report) override {
        const std::size_t size = n();
        const double half = h() / 2;
        const bool isSame = isKnown_ && (!isTimeDependent() || ofTime_ == begin()) &&
                            std::memcmp(of_.data(), x, size * sizeof(double)) == 0;
        if (!isSame) keepAcceleration(begin(), x, report.cost);
        for (std::size_t i = 0; i < size; ++i) {
            next[size + i] = x[size + i] + half * acceleration_[i];
            next[i] = x[i] + h() * next[size + i];
        }
        keepAcceleration(begin() + h(), next, report.cost);
        for (std::size_t i = 0; i < size; ++i) next[size + i] += half * acceleration_[i];
        return Outcome::converged;
    }
    bool hasVariations() const final { return true; }
    bool linearise() final {
        const std::size_t size = n();
        const double* const u = before().data();
        std::vector<double> a(size), next(size);
        Cost ignored;
        accelerate(begin(), u, a.data(), ignored);
        for (std::size_t i = 0; i < size; ++i) next[i] = u[i] + h() * (u[size + i] + h() / 2 * a[i]);
        linearise(u, next.data());
        return true;
    }
    void vary(std::vector<double>& du, std::vector<double>& dp) final {
        kick(End::start, h() / 2, du.data(), dp.data());
        drift(h(), dp.data(), du.data());
        kick(End::end, h() / 2, du.data(), dp.data());
    }

private:
    void keepAcceleration(double t, const double* u, Cost& cost) {
        accelerate(t, u, acceleration_.data(), cost);
        std::copy_n(u, n(), of_.begin());
        ofTime_ = t;
        isKnown_ = true;
    }

    bool isKnown_ = false;
    double ofTime_ = 0;
    std::vector<double> acceleration_, of_;  ///< a, and the values it belongs to
};

}  // namespace extremal
