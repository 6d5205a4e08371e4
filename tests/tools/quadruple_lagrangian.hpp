// SPDX-License-Identifier: GPL-3.0-or-later
/// The motion of a scene whose model says its Lagrangian, in quadruple precision: the formula's own first
/// derivatives, evaluated on numbers of 113 bits, and extrapolation with steps under an error control. No
/// integrator and no reference of the program takes part.
#pragma once

#include <boost/multiprecision/float128.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "engine/model/typed/tape/tape.hpp"
#include "engine/model/typed/typed_mechanics.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/scene/write/typed_scene.hpp"
#include "tests/tools/quadruple_motion.hpp"

namespace extremal {

class QuadrupleLagrangian {
public:
    using Number = boost::multiprecision::float128;

    explicit QuadrupleLagrangian(const ResolvedScene& scene) {
        // The formula alone: a scheme or a reference may need what only the model knows.
        Value document = scene.scene.model.type == "lagrangian" ? toValue(scene.scene) : typedScene(scene);
        document.set("schemes", Value(Value::Array{Value(Value::Object{
                                    {"label", "none"}, {"scheme", "midpoint"}, {"step", 0.1}})}));
        document.set("reference", Value(Value::Object{{"type", "none"}}));
        document.set("observe", Value(Value::Array{}));
        const ReadScene read = readScene(document);
        if (!read.resolved) throw std::runtime_error(read.errors.front().message);
        typed_ = read.resolved;
        tape_ = typed::gradientTapeOf(*typed_->system->parts.find<Mechanical>());
        d_ = typed_->system->coordinates.size();
        registers_.resize(tape_->registers());
        velocity_.assign(d_, 0);
        t_ = scene.initial.t;
        x_.assign(scene.initial.x.begin(), scene.initial.x.end());
    }

    /// At a time that is not before the last one.
    void at(double until, double* x) {
        constexpr double tolerance = 1e-21, safety = 0.8;
        while (t_ < until) {
            const Number left = Number(until) - t_, h = std::min(step_, left);
            const auto rate = [this](const Number& t, const Vector& state, Vector& slope) {
                rateAt(t, state, slope);
            };
            const Vector once = extrapolatedStep(rate, t_, x_, h);
            if (3 * h < step_) {  // much shorter than need be: the last step of a row
                x_ = once;
                t_ += h;
                continue;
            }
            const Vector half = extrapolatedStep(rate, t_, x_, h / 2);
            const Vector twice = extrapolatedStep(rate, t_ + h / 2, half, h / 2);
            double worst = 1e-40;
            for (std::size_t i = 0; i < x_.size(); ++i)
                worst = std::max(worst, static_cast<double>(abs(twice[i] - once[i]) / (1 + abs(twice[i]))));
            if (worst <= tolerance) {
                x_ = twice;
                t_ += h;
            }
            const double factor = safety * std::pow(tolerance / worst, 1.0 / 25);
            if (h == step_ || worst > tolerance) step_ = h * std::clamp(factor, 0.2, 2.0);
        }
        for (std::size_t i = 0; i < x_.size(); ++i) x[i] = static_cast<double>(x_[i]);
    }

private:
    using Vector = std::vector<Number>;

    /// L_q and L_v at (q, v), in that order.
    const Number& slopeOf(std::size_t i) const { return tape_->output(i, registers_.data()); }
    void evaluate(const Number& t, const Number* q, const Vector& v) {
        for (std::size_t i = 0; i < d_; ++i) registers_[i] = q[i], registers_[d_ + i] = v[i];
        registers_[2 * d_] = t;
        run();
    }

    /// q' = v with L_v(q, v) = p, p' = L_q.
    void rateAt(const Number& t, const Vector& x, Vector& slope) {
        const Number small = Number(1) / (Number(1LL << 56));
        Vector off(d_), matrix(d_ * d_);
        evaluate(t, x.data(), velocity_);
        Vector here(d_);
        for (std::size_t i = 0; i < d_; ++i) here[i] = slopeOf(d_ + i);
        for (std::size_t j = 0; j < d_; ++j) {
            Vector moved = velocity_;
            moved[j] += small;
            evaluate(t, x.data(), moved);
            for (std::size_t i = 0; i < d_; ++i) matrix[i * d_ + j] = (slopeOf(d_ + i) - here[i]) / small;
        }
        invert(matrix);
        for (int k = 0; k < 20; ++k) {
            evaluate(t, x.data(), velocity_);
            Number most = 0;
            for (std::size_t i = 0; i < d_; ++i) off[i] = x[d_ + i] - slopeOf(d_ + i);
            for (std::size_t i = 0; i < d_; ++i) {
                Number change = 0;
                for (std::size_t j = 0; j < d_; ++j) change += matrix[i * d_ + j] * off[j];
                velocity_[i] += change;
                if (abs(change) > most) most = abs(change);
            }
            if (most < Number(1e-30)) break;
        }
        evaluate(t, x.data(), velocity_);
        slope.resize(2 * d_);
        for (std::size_t i = 0; i < d_; ++i) slope[i] = velocity_[i], slope[d_ + i] = slopeOf(i);
    }

    /// By Gauss and Jordan, with the largest pivots.
    void invert(Vector& a) const {
        Vector inverse(d_ * d_, Number(0));
        for (std::size_t i = 0; i < d_; ++i) inverse[i * d_ + i] = 1;
        for (std::size_t c = 0; c < d_; ++c) {
            std::size_t pivot = c;
            for (std::size_t r = c + 1; r < d_; ++r)
                if (abs(a[r * d_ + c]) > abs(a[pivot * d_ + c])) pivot = r;
            for (std::size_t k = 0; k < d_; ++k) {
                std::swap(a[c * d_ + k], a[pivot * d_ + k]);
                std::swap(inverse[c * d_ + k], inverse[pivot * d_ + k]);
            }
            const Number by = 1 / a[c * d_ + c];
            for (std::size_t k = 0; k < d_; ++k) a[c * d_ + k] *= by, inverse[c * d_ + k] *= by;
            for (std::size_t r = 0; r < d_; ++r) {
                if (r == c) continue;
                const Number part = a[r * d_ + c];
                for (std::size_t k = 0; k < d_; ++k) {
                    a[r * d_ + k] -= part * a[c * d_ + k];
                    inverse[r * d_ + k] -= part * inverse[c * d_ + k];
                }
            }
        }
        a.swap(inverse);
    }

    static Number called(typed::Function function, const Number& a) {
        using typed::Function;
        switch (function) {
            case Function::exp:
                return exp(a);
            case Function::log:
                return log(a);
            case Function::tan:
                return tan(a);
            case Function::tanh:
                return tanh(a);
            case Function::sin:
                return sin(a);
            case Function::cos:
                return cos(a);
            default:
                throw std::runtime_error("a function without a value in quadruple precision");
        }
    }
    void run() {
        using typed::Op;
        Number* const r = registers_.data();
        Number* constant = r + tape_->inputs();
        for (const double value : tape_->constants()) *constant++ = Number(value);
        for (const typed::Instruction& i : tape_->code()) {
            const Number a = r[i.a];
            switch (i.op) {
                case Op::add:
                    r[i.to] = a + r[i.b];
                    break;
                case Op::subtract:
                    r[i.to] = a - r[i.b];
                    break;
                case Op::multiply:
                    r[i.to] = a * r[i.b];
                    break;
                case Op::multiplyAdd:
                    r[i.to] = a * r[i.b] + r[i.c];
                    break;
                case Op::multiplySubtract:
                    r[i.to] = a * r[i.b] - r[i.c];
                    break;
                case Op::subtractProduct:
                    r[i.to] = r[i.c] - a * r[i.b];
                    break;
                case Op::negate:
                    r[i.to] = -a;
                    break;
                case Op::reciprocal:
                    r[i.to] = 1 / a;
                    break;
                case Op::sqrt:
                    r[i.to] = sqrt(a);
                    break;
                case Op::sinCos:
                    r[i.to] = sin(a);
                    r[i.c] = cos(a);
                    break;
                case Op::call:
                    r[i.to] = called(static_cast<typed::Function>(i.c), a);
                    break;
                default:
                    throw std::runtime_error("an instruction without a value in quadruple precision");
            }
        }
    }

    std::shared_ptr<const ResolvedScene> typed_;
    const typed::Tape* tape_ = nullptr;
    std::size_t d_ = 0;
    Vector registers_, velocity_, x_;
    Number t_ = 0, step_ = Number(1) / 100;
};

}  // namespace extremal
