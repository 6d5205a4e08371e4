// SPDX-License-Identifier: GPL-3.0-or-later
/// An exact solution from given initial data: fills the state x at given times.
///
/// Made from a callable `(double t, std::span<double> x)`, or, where many times at once are cheaper, from a
/// callable
/// `(std::span<const double> t, double* x)` with the state of time i at x + i * width. It may keep a warm
/// start between calls, so each thread makes its own. Empty where there is none. The solution of a field may
/// be known at all places besides: states whose nodes are elsewhere at every time are compared with that.
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>

#include "engine/core/text/archive.hpp"

namespace extremal {

class ExactSolution {
public:
    ExactSolution() = default;

    template <class F>
    requires std::invocable<F&, double, std::span<double>> ExactSolution(F each) {
        many_ = [each = std::move(each)](std::span<const double> t, double* x, std::size_t width) mutable {
            for (std::size_t i = 0; i < t.size(); ++i) each(t[i], std::span<double>(x + i * width, width));
        };
    }
    template <class F>
    requires std::invocable < F&, std::span<const double>,
    double* > ExactSolution(F many) {
        many_ = [many = std::move(many)](std::span<const double> t, double* x, std::size_t) mutable {
            many(t, x);
        };
    }

    /// Of a field, where it is known at all places: u at each of them, then u_t. Places ascend. Else empty.
    using AtPlaces = std::function<void(double t, std::span<const double> places, double* values)>;
    const AtPlaces& atPlaces() const { return atPlaces_; }
    void setAtPlaces(AtPlaces at) { atPlaces_ = std::move(at); }

    /// For solutions that are stepped along: writes or reads where they are, so that one just made need not
    /// come from the start again. Of others nothing.
    void checkpoint(Archive& archive) {
        if (checkpoint_) checkpoint_(archive);
    }
    void setCheckpoint(std::function<void(Archive&)> checkpoint) { checkpoint_ = std::move(checkpoint); }

    /// Of solutions that are stepped along: the step [first, second] that has t in it, whose times may then
    /// be asked for in any order without coming from the start again; not a number where it did not get
    /// there.
    using StepAt = std::function<std::pair<double, double>(double t)>;
    const StepAt& stepAt() const { return stepAt_; }  ///< of others empty
    void setStepAt(StepAt stepAt) { stepAt_ = std::move(stepAt); }

    explicit operator bool() const { return static_cast<bool>(many_); }

    void operator()(double t, std::span<double> x) const { many_({&t, 1}, x.data(), x.size()); }
    /// The states at all t, `width` apart.
    void operator()(std::span<const double> t, double* x, std::size_t width) const { many_(t, x, width); }

private:
    std::function<void(std::span<const double> t, double* x, std::size_t width)> many_;
    AtPlaces atPlaces_;
    std::function<void(Archive&)> checkpoint_;
    StepAt stepAt_;
};

}  // namespace extremal
