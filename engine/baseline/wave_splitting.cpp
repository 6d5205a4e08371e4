// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/baseline/wave_splitting.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "engine/baseline/parts.hpp"
#include "engine/family/wave/wave.hpp"
#include "engine/family/wave/wave_step.hpp"

namespace extremal {
namespace {

class WaveSplitting final : public WaveStep {
public:
    WaveSplitting(std::shared_ptr<const Hamiltonian> hamiltonian, double step, const Splitting& splitting)
        : WaveStep(std::move(hamiltonian), step, 0),
          splitting_(splitting),
          psi_(static_cast<std::size_t>(n())) {}

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<WaveSplitting>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(hasNodes_, psi_);
        return WaveStep::checkpoint(archive);
    }

private:
    void prepare() override {
        phases_.clear();
        const Hamiltonian& h = *shared();
        const double unit = dt() / h.hbar();
        for (const SplittingStage& s : splitting_.stages) {
            if (stop().stop_requested()) return;
            if (s.isKick && h.isTimeDependent()) {
                phases_.emplace_back();
                continue;
            }
            // Equal fractions share their phases: a table has each twice.
            std::size_t same = 0;
            while (same < phases_.size() &&
                   !(splitting_.stages[same].isKick == s.isKick &&
                     splitting_.stages[same].fraction == s.fraction && !phases_[same]->empty()))
                ++same;
            if (same < phases_.size()) {
                phases_.push_back(phases_[same]);
                continue;
            }
            auto phases = std::make_shared<std::vector<Complex>>();
            for (const double E : s.isKick ? h.potential() : h.kinetic())
                phases->push_back(std::polar(s.isKick ? 1.0 / h.size() : 1.0, -s.fraction * unit * E));
            phases_.push_back(std::move(phases));
        }
        if (h.isTimeDependent()) V_.resize(psi_.size());
    }
    void forget() override { hasNodes_ = false; }
    void step(double t, Complex* v, std::vector<double>&, StepReport& report) override {
        const auto& stages = splitting_.stages;
        for (std::size_t k = 0; k < stages.size(); ++k) {
            if (stop().stop_requested()) {
                report.outcome = Outcome::stopped;
                return;
            }
            if (!stages[k].isKick) {
                multiply(v, *phases_[k]);
                t += stages[k].fraction * dt();
                continue;
            }
            if (k > 0 || !hasNodes_) shared()->fourier().rawToNodes(v, psi_.data());
            kick(k, t);
            shared()->fourier().rawToCoefficients(psi_.data(), v);
            ++report.cost.evaluations;
        }
        hasNodes_ = stages.front().isKick && stages.back().isKick;
        // What goes through both transforms once more gains a factor N.
        if (hasNodes_)
            for (Complex& x : psi_) x *= static_cast<double>(n());
    }
    void kick(std::size_t k, double t) {
        if (!shared()->isTimeDependent()) return multiply(psi_.data(), *phases_[k]);
        shared()->potentialAt(t, V_.data());
        const double factor = -splitting_.stages[k].fraction * dt() / shared()->hbar();
        for (std::size_t j = 0; j < psi_.size(); ++j) psi_[j] *= std::polar(1.0 / n(), factor * V_[j]);
    }
    static void multiply(Complex* v, const std::vector<Complex>& phases) {
        double* x = reinterpret_cast<double*>(v);
        const double* p = reinterpret_cast<const double*>(phases.data());
        for (std::size_t i = 0; i < 2 * phases.size(); i += 2) {
            const double re = x[i], im = x[i + 1];
            x[i] = re * p[i] - im * p[i + 1];
            x[i + 1] = re * p[i + 1] + im * p[i];
        }
    }

    Splitting splitting_;
    std::vector<std::shared_ptr<const std::vector<Complex>>> phases_;
    std::vector<Complex> psi_;  ///< at the nodes, without the factor of the transform
    std::vector<double> V_;
    bool hasNodes_ = false;
};

}  // namespace

std::unique_ptr<Integrator> makeWaveSplitting(const System& system, double step, const Splitting& splitting) {
    requireSplit(system, "/baseline", "split-step",
                 "schrodinger-gauss-8, crank-nicolson or chebyshev-propagation");
    return std::make_unique<WaveSplitting>(system.hamiltonian(), step, splitting);
}

BaselineEntry waveSplittingBaseline(std::string id, std::string title, std::string description,
                                    const Splitting& splitting) {
    BaselineEntry e;
    e.item = {std::move(id),
              std::move(title),
              std::move(description),
              {},
              Claims{splitting.order, true, true, {"norm"}},
              "a wave function"};
    e.takes = Takes::only<Wave>();
    e.parts.set(OscillatorLimit(std::numeric_limits<double>::infinity()));
    e.make = [splitting](const System& system, const BaselineOptions& options) {
        return makeWaveSplitting(system, options.step, splitting);
    };
    return e;
}

}  // namespace extremal
