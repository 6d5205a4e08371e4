// SPDX-License-Identifier: GPL-3.0-or-later
/// Tao's explicit symplectic method for Hamiltonians that do not split into kinetic and potential energy, by
/// a copy (x, y) of (q, p) and a spring between the two:
///     Hbar = H(q, y) + H(x, p) + omega/2 (|q - x|^2 + |p - y|^2).
/// Each part has an explicit flow: A moves p and x, B moves q and y, C turns (q - x, p - y) by 2 omega h. The
/// step of order 2 is A(h/2) B(h/2) C(h) B(h/2) A(h/2), that of order 4 three of them (Yoshida 1990). The
/// copy begins where the motion does, and is the memory of the scheme.
///
/// Symplectic in the phase space of twice the dimension, and not as a map of (q, p): the energy error stays
/// bounded while the copy stays close, which omega sees to (Tao 2016, Phys. Rev. E 94, 043303).
#include <cmath>
#include <string>
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/step/flow_method.hpp"

namespace extremal::baselines {
namespace {

template <int D>
class Tao final : public FlowMethod<D> {
    using Base = FlowMethod<D>;
    using Vector = typename Base::Vector;
    using View = typename Base::View;

public:
    Tao(const Mechanics<double>& mechanics, double step, int order, double omega)
        : Base(mechanics, step), omega_(omega) {
        for (Vector* v : {&x_, &y_, &dq_, &dp_, &apartQ_, &apartP_}) *v = Vector::Zero(this->d());
        if (order == 4) {
            const double outer = 1 / (2 - std::cbrt(2.0));
            fractions_ = {outer, 1 - 2 * outer, outer};
        }
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Tao>(*this); }
    std::vector<MemoryPart> memoryParts() const override {
        const auto d = static_cast<std::size_t>(this->d());
        return {{"copy of q", d}, {"copy of p", d}};
    }
    void begin(State& state) override { state.memory = state.x; }

    std::size_t tangentSize() const override { return 0; }
    std::string tangentProblem() const override { return "its steps move a copy of the state as well"; }

private:
    void recall(State& state) override {
        if (state.memory.size() != state.x.size()) begin(state);
        x_ = View(state.memory.data(), this->d());
        y_ = View(state.memory.data() + this->d(), this->d());
        state_ = &state;
    }
    void step(double t) override {
        double at = t;
        for (const double fraction : fractions_) {
            const double h = fraction * this->h(), middle = at + h / 2;
            move(middle, h / 2, true);
            move(middle, h / 2, false);
            turn(h);
            move(middle, h / 2, false);
            move(middle, h / 2, true);
            at += h;
            if (this->report_.outcome != Outcome::converged) return;
        }
        const bool isFinite =
            this->q1_.allFinite() && this->p1_.allFinite() && x_.allFinite() && y_.allFinite();
        if (!isFinite) {
            this->report_.outcome = Outcome::notFinite;
            return;
        }
        View(state_->memory.data(), this->d()) = x_;
        View(state_->memory.data() + this->d(), this->d()) = y_;
    }
    /// By H(q, y), which moves p and x; else by H(x, p).
    void move(double t, double h, bool isOfPosition) {
        if (isOfPosition) {
            this->flow(t, this->q1_, y_, dq_, dp_);
            this->p1_ += h * dp_;
            x_ += h * dq_;
        } else {
            this->flow(t, x_, this->p1_, dq_, dp_);
            this->q1_ += h * dq_;
            y_ += h * dp_;
        }
    }
    void turn(double h) {
        const double angle = 2 * omega_ * h, c = std::cos(angle), s = std::sin(angle);
        apartQ_ = (this->q1_ - x_) / 2;
        apartP_ = (this->p1_ - y_) / 2;
        x_ = (this->q1_ + x_) / 2;
        y_ = (this->p1_ + y_) / 2;
        dq_ = c * apartQ_ + s * apartP_;
        dp_ = c * apartP_ - s * apartQ_;
        this->q1_ = x_ + dq_;
        this->p1_ = y_ + dp_;
        x_ -= dq_;
        y_ -= dp_;
    }
    bool tangent(double, typename Base::Columns) override { return false; }

    double omega_;
    std::vector<double> fractions_{1};
    Vector x_, y_, dq_, dp_, apartQ_, apartP_;
    State* state_ = nullptr;  ///< within a step
};

}  // namespace

BaselineEntry tao() {
    constexpr int usual = 2;
    BaselineEntry e;
    e.item = {
        "tao",
        "Tao's extended phase space",
        "Explicit for any Hamiltonian, by a copy of the state and a spring between the two: symplectic in "
        "the phase space of both.",
        {integerChoice("order", {"2", "4"}, usual, "4: by three steps of order 2."),
         positive("spring", "spring", "", 10,
                  "How fast the copy turns around the state, in radians per unit of time: large enough "
                  "to hold it, and small against 1/step.")},
        Claims{usual, false, false, {}, false},
        ""};
    e.parts.set(ClaimsOfKeys{[](const Settings& settings) {
        return Claims{settings.integer("order") < 4 ? 2 : 4, false, false, {}, false};
    }});
    e.takes = flowProblems();
    e.make = [](const System& system, const BaselineOptions& options) {
        return makeFlowMethod<Tao>(flowOf(system), options.step, options.settings.integer("order"),
                                   options.settings.number("spring"));
    };
    return e;
}

}  // namespace extremal::baselines
