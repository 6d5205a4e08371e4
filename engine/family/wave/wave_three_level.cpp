// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/wave/wave_three_level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/family/wave/gauss_waves.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {
namespace {

std::unique_ptr<WaveStep> gaussStep(const std::shared_ptr<const Hamiltonian>& h, double step, double shift,
                                    int degree, const ThreeLevel& form) {
    if (form.solver == WaveSolver::banded) return makeBandedWave(h, step, shift, degree, 2);
    if (form.solver == WaveSolver::dense) return makeDenseWave(h, step, shift, degree);
    return makeKrylovWave(h, step, shift, degree, form.tolerance, form.maxIterations);
}

class ThreeLevelWave final : public WaveStep {
public:
    ThreeLevelWave(std::shared_ptr<const Hamiltonian> hamiltonian, double step, double shift,
                   const ThreeLevel& form)
        : WaveStep(std::move(hamiltonian), step, shift), form_(form) {
        for (auto* v : {&next_, &image_, &work_}) v->resize(static_cast<std::size_t>(n()));
        first_.x.resize(2 * next_.size());
    }
    ThreeLevelWave(const ThreeLevelWave& other)
        : WaveStep(other),
          form_(other.form_),
          next_(other.next_),
          image_(other.image_),
          work_(other.work_),
          first_(other.first_) {
        if (other.inverse_ || other.starter_) prepare();
    }
    ThreeLevelWave& operator=(const ThreeLevelWave&) = delete;

    std::string tangentProblem() const override {
        return "it goes on from two levels of time, and the form that it keeps is one of both, not of a "
               "state";
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<ThreeLevelWave>(*this); }
    std::span<const Quantity> quantities() const override { return quantities_; }
    void measure(const State& state, double* values) const override {
        values[0] = bilinearForm(coefficients(state.memory.data()));
    }
    /// The level before in the gauge that the last three numbers tell; 0 levels before the first step.
    std::vector<MemoryPart> memoryParts() const override {
        return {{"level before", 2 * next_.size()},
                {"energy shift", 1},
                {"origin of the gauge", 1},
                {"levels", 1}};
    }

private:
    /// J of the last step, from v^l; v^{l+1} is in next_.
    double bilinearForm(const Complex* v) const {
        const Hamiltonian& h = hamiltonian();
        h.apply(h.potential().data(), v, image_.data(), work_.data());
        for (int i = 0; i < n(); ++i) image_[i] -= shift() * v[i];
        return innerProduct(next_.data(), v, n()).real() +
               2 * form_.alpha * dt() / h.hbar() * innerProduct(next_.data(), image_.data(), n()).imag();
    }
    void prepare() override {
        if (form_.alpha > 0)
            inverse_ = makeShiftedInverse(form_.solver, shared(), dt(), shift(), 1 / (2 * form_.alpha),
                                          form_.tolerance, form_.maxIterations);
        // Both shifts are the same and the gauge is known: the step is in v, so its own phase is taken out
        // again.
        if (form_.start != WaveStart::variational)
            starter_ = gaussStep(shared(), dt(), shift(), form_.start == WaveStart::gauss ? 2 : 8, form_);
    }
    void remember(State& state) const override {
        state.memory.assign(2 * next_.size(), 0);
        state.memory.insert(state.memory.end(), {shift(), state.t, 0});
    }
    Gauge gaugeOf(const State& state) const override {
        if (state.memory.empty()) return {shift(), state.t};
        const double* gauge = state.memory.data() + 2 * next_.size();
        return {gauge[0], gauge[1]};
    }

    void step(double, Complex* v, std::vector<double>& memory, StepReport& report) override {
        Complex* previous = coefficients(memory.data());
        double& levels = memory.back();
        report.outcome = levels > 0 ? later(previous, v, report) : first(v, report);
        if (report.outcome != Outcome::converged) return;
        std::copy(v, v + n(), previous);
        std::copy(next_.begin(), next_.end(), v);
        levels = 1;
    }
    /// next_ <- v^{l+1}.
    Outcome later(const Complex* previous, const Complex* v, StepReport& report) {
        const std::size_t size = next_.size();
        if (form_.alpha == 0) {
            image(v, report);
            for (std::size_t i = 0; i < size; ++i) {
                const Complex change(2 * next_[i].imag(), -2 * next_[i].real());  // -2i Y v
                next_[i] = previous[i] + change;
            }
            return Outcome::converged;
        }
        const double zeta = 1 / (2 * form_.alpha), k = (1 - 2 * form_.alpha) / form_.alpha;
        for (std::size_t i = 0; i < size; ++i) next_[i] = zeta * (2.0 * previous[i] + k * v[i]);
        const Outcome outcome = inverse_->apply(next_.data(), report, stop());
        for (std::size_t i = 0; i < size; ++i) next_[i] -= previous[i] + k * v[i];
        return outcome;
    }
    /// next_ <- v^1.
    Outcome first(const Complex* v, StepReport& report) {
        const std::size_t size = next_.size();
        if (starter_) {
            first_.t = 0;
            first_.node = 0;
            std::copy_n(reinterpret_cast<const double*>(v), 2 * size, first_.x.begin());
            const StepReport own = starter_->advance(first_, dt());
            report.cost += own.cost;
            const Complex back = std::polar(1.0, shift() * dt() / hamiltonian().hbar());
            for (std::size_t i = 0; i < size; ++i) next_[i] = back * coefficients(first_.x.data())[i];
            return own.outcome;
        }
        if (form_.alpha == 0) {
            image(v, report);
            for (std::size_t i = 0; i < size; ++i)
                next_[i] = v[i] + Complex(next_[i].imag(), -next_[i].real());
            return Outcome::converged;
        }
        const double zeta = 1 / (2 * form_.alpha), c = (1 - 2 * form_.alpha) / (2 * form_.alpha);
        for (std::size_t i = 0; i < size; ++i) next_[i] = zeta * (1 + c) * v[i];
        const Outcome outcome = inverse_->apply(next_.data(), report, stop());
        for (std::size_t i = 0; i < size; ++i) next_[i] -= c * v[i];
        return outcome;
    }
    /// next_ <- Y v.
    void image(const Complex* v, StepReport& report) {
        hamiltonian().apply(hamiltonian().potential().data(), v, next_.data(), work_.data());
        ++report.cost.evaluations;
        const double factor = dt() / hamiltonian().hbar();
        for (std::size_t i = 0; i < next_.size(); ++i) next_[i] = factor * (next_[i] - shift() * v[i]);
    }
    std::unique_ptr<Integrator> inside() const override {
        return gaussStep(shared(), dt(), shift(), 2, form_);
    }

    ThreeLevel form_;
    std::unique_ptr<ShiftedInverse> inverse_;
    std::unique_ptr<WaveStep> starter_;
    std::vector<Complex> next_;
    mutable std::vector<Complex> image_, work_;
    State first_;
    std::vector<Quantity> quantities_ = {{"bilinear_form", "bilinear form", "J", ""}};
};

}  // namespace

std::unique_ptr<WaveStep> makeThreeLevelWave(std::shared_ptr<const Hamiltonian> hamiltonian, double step,
                                             double shift, const ThreeLevel& form) {
    return std::make_unique<ThreeLevelWave>(std::move(hamiltonian), step, shift, form);
}

double threeLevelAlpha(const Settings& quadrature) {
    if (quadrature.type == "exact") return 1.0 / 6;
    const Rule<double> rule = makeRule<double>(quadrature);
    double alpha = 0;
    for (std::size_t i = 0; i < rule.c.size(); ++i) alpha += rule.b[i] * rule.c[i] * (1 - rule.c[i]);
    return std::abs(alpha) < 1e-14 ? 0 : std::abs(alpha - 1.0 / 6) < 1e-14 ? 1.0 / 6 : alpha;
}

double threeLevelLimit(double alpha) {
    return alpha < 0.25 - 1e-14 ? 1 / std::sqrt(1 - 4 * alpha) : std::numeric_limits<double>::infinity();
}

}  // namespace extremal
