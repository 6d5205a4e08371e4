// SPDX-License-Identifier: GPL-3.0-or-later
/// The integral of the one-form over a loop that moves with the scheme: int p dq, or int theta, over a ring
/// of 64 starts around the start of the run. A symplectic step keeps it (Poincaré): it is the area of the
/// ring in phase space, whatever becomes of its shape. Others do not, however well they keep the energy.
///
/// The ring is an ellipse in the plane of the first coordinate and its momentum (of a one-form its first q
/// and y), a twentieth of the state wide. Along it x is the trigonometric polynomial through the points, so
/// that the integral is exact as long as 64 points resolve the shape of the ring.
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/clock.hpp"
#include "engine/model/first_order/one_form.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/observe/catalog.hpp"

namespace extremal::observables {
namespace {

class Ring {
public:
    static constexpr int size = 64;

    explicit Ring(const ObserveContext& context)
        : clock_{context.initial.t, context.step}, dimension_(context.system.dimension()) {
        if (const OneForm* const form = context.system.parts.find<OneForm>()) form_ = *form;
        const std::array<std::size_t, 2> plane = planeOf();
        std::array<double, 2> radius{};
        for (std::size_t k = 0; k < 2; ++k) {
            const double at = std::abs(context.initial.x[plane[k]]);
            radius[k] = part * (at > 0 ? at : 1);
        }
        for (int j = 0; j < size; ++j) {
            const double angle = 2 * pi * j / size;
            State& state = states_[static_cast<std::size_t>(j)];
            state = context.initial;
            state.memory.clear();
            state.x[plane[0]] += radius[0] * std::cos(angle);
            state.x[plane[1]] += radius[1] * std::sin(angle);
            auto scheme = context.integrator->clone();
            scheme->begin(state);
            schemes_.push_back(std::move(scheme));
        }
    }
    Ring(const Ring& other)
        : clock_(other.clock_),
          dimension_(other.dimension_),
          form_(other.form_),
          states_(other.states_),
          isLost_(other.isLost_) {
        for (const auto& scheme : other.schemes_) schemes_.push_back(scheme->clone());
    }
    Ring& operator=(const Ring&) = delete;

    /// At a node, which is not before the last one that was asked for.
    double at(long long node) {
        for (int j = 0; j < size && !isLost_; ++j) {
            State& state = states_[static_cast<std::size_t>(j)];
            while (state.node < node && !isLost_)
                isLost_ = schemes_[static_cast<std::size_t>(j)]
                              ->advance(state, clock_.at(state.node + 1))
                              .outcome != Outcome::converged;
        }
        return isLost_ || states_.front().node != node ? std::nan("") : integral();
    }
    void checkpoint(Archive& archive) {
        archive(isLost_);
        for (std::size_t j = 0; j < states_.size(); ++j) {
            State& state = states_[j];
            archive(state.t, state.node, state.x, state.memory);
            (void)schemes_[j]->checkpoint(archive);
        }
    }

private:
    static constexpr double pi = 3.14159265358979323846, part = 0.05;

    std::array<std::size_t, 2> planeOf() const {
        if (!form_) return {0, static_cast<std::size_t>(dimension_)};
        if (!form_->hasPlane()) return {0, 1};
        return {static_cast<std::size_t>(form_->places[0]), static_cast<std::size_t>(form_->free[0])};
    }
    /// sum_j theta(x_j) . x'(s_j) ds, x' of the trigonometric polynomial through the points.
    double integral() {
        const std::size_t n = states_.front().x.size();
        std::vector<double> theta(n);
        double sum = 0;
        for (int j = 0; j < size; ++j) {
            const std::vector<double>& x = states_[static_cast<std::size_t>(j)].x;
            coefficients(x, theta);
            for (int k = 1; k < size; ++k) {
                const std::vector<double>& other = states_[static_cast<std::size_t>((j + k) % size)].x;
                const double weight = (k % 2 == 0 ? -0.5 : 0.5) / std::tan(pi * k / size);
                for (std::size_t i = 0; i < n; ++i) sum += weight * theta[i] * (other[i] - x[i]);
            }
        }
        return sum * 2 * pi / size;
    }
    void coefficients(const std::vector<double>& x, std::vector<double>& theta) const {
        if (form_) return form_->form(form_->model.get(), x.data(), theta.data(), nullptr, nullptr);
        const auto d = static_cast<std::size_t>(dimension_);
        for (std::size_t i = 0; i < d; ++i) {
            theta[i] = x[d + i];
            theta[d + i] = 0;
        }
    }

    Clock clock_;
    int dimension_;
    std::optional<OneForm> form_;
    std::array<State, size> states_;
    std::vector<std::unique_ptr<Integrator>> schemes_;
    bool isLost_ = false;
};

}  // namespace

ObservableEntry loop() {
    ObservableEntry e;
    e.item = {"loop",
              "loop integral",
              "Integral of p dq, or of the one-form, over a ring of 64 starts around the start, which moves "
              "with the scheme, and its change, which is zero for symplectic steps. Costs 64 runs.",
              {},
              {},
              "a scheme with a fixed step"};
    e.takes = Takes::only<Mechanical, PhaseMechanics, OneForm>();
    e.bind = [](const ObserveContext& context) {
        Observer o;
        o.columns = {{"loop", "∮ θ", "", {}, {}}, {"loop_error", "∮ θ − ∮ θ(0)", "", {}, {}}};
        o.extreme = 1;
        const bool hasRing = context.integrator && context.integrator->grid() == TimeGrid::fixed;
        const auto ring = hasRing ? std::make_shared<Ring>(context) : nullptr;
        o.evaluate = [ring, start = ring ? ring->at(context.initial.node) : std::nan("")](
                         const State& state, const StepReport&, double* values) {
            values[0] = ring ? ring->at(state.node) : std::nan("");
            values[1] = values[0] - start;
        };
        o.checkpoint = [ring](Archive& archive) {
            if (ring) ring->checkpoint(archive);
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
