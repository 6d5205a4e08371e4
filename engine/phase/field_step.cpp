// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/phase/field_step.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "engine/phase/phase_step.hpp"

namespace extremal {
namespace {

class FieldStep final : public Integrator {
public:
    FieldStep(const FirstOrder& of, const SharedCell& cell, double step, const SolverPolicy& policy)
        : m_(static_cast<std::size_t>(of.variables)), cell_(makePhaseStep(fieldOf(of), cell, step, policy)) {
        inner_.x.assign(2 * m_, 0);
    }
    FieldStep(const FieldStep& other)
        : Integrator(other), m_(other.m_), cell_(other.cell_->clone()), inner_(other.inner_) {}
    FieldStep& operator=(const FieldStep&) = delete;

    double stepSize() const override { return cell_->stepSize(); }
    void setStep(double h) override { cell_->setStep(h); }
    void begin(State& state) override {
        state.memory.clear();
        cell_->begin(inner_);
    }
    StepReport advance(State& state, double until) override {
        cell_->setStop(stop());
        std::copy(state.x.begin(), state.x.end(), inner_.x.begin());
        std::fill(inner_.x.begin() + static_cast<std::ptrdiff_t>(m_), inner_.x.end(), 0.0);
        inner_.t = state.t;
        inner_.node = state.node;
        const StepReport report = cell_->advance(inner_, until);
        if (report.outcome != Outcome::converged) return report;
        std::copy_n(inner_.x.begin(), m_, state.x.begin());
        state.t = until;
        ++state.node;
        return report;
    }
    void denseOutput(double tau, std::span<double> x) const override {
        std::vector<double> both(2 * m_);
        cell_->denseOutput(tau, both);
        std::copy_n(both.begin(), m_, x.begin());
    }
    std::size_t tangentSize() const override { return m_; }
    bool applyTangent(std::span<double> W) override {
        const std::size_t columns = W.size() / m_;
        std::vector<double> both(2 * W.size(), 0);
        for (std::size_t j = 0; j < columns; ++j)
            std::copy_n(W.begin() + static_cast<std::ptrdiff_t>(j * m_), m_,
                        both.begin() + static_cast<std::ptrdiff_t>(2 * j * m_));
        if (!cell_->applyTangent(both)) return false;
        for (std::size_t j = 0; j < columns; ++j)
            std::copy_n(both.begin() + static_cast<std::ptrdiff_t>(2 * j * m_), m_,
                        W.begin() + static_cast<std::ptrdiff_t>(j * m_));
        return true;
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<FieldStep>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(inner_.x);
        return cell_->checkpoint(archive);
    }

private:
    std::size_t m_;
    std::unique_ptr<Integrator> cell_;
    State inner_;
};

}  // namespace

std::unique_ptr<Integrator> makeFieldStep(const FirstOrder& of, const SharedCell& cell, double step,
                                          const SolverPolicy& policy) {
    return std::make_unique<FieldStep>(of, cell, step, policy);
}

}  // namespace extremal
