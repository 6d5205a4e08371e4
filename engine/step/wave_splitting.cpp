// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/step/wave_splitting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/algebra/complex_vectors.hpp"
#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/lanes_trigonometry.hpp"
#include "engine/core/algebra/registers.hpp"
#include "engine/model/wave/interaction.hpp"
#include "engine/step/wave_step.hpp"

namespace extremal {
namespace {

using Places = registers::Mask<registers::Eight>;

/// Eight real and eight imaginary parts, which take turns in memory. hasEight: the machine has registers of
/// eight numbers; the compiler makes no shuffles of these loops.
template <bool hasEight>
inline void readParts(const double* from, Lanes& re, Lanes& im) {
    if constexpr (hasEight) {
        registers::Eight low, high;
        registers::load(low, from);
        registers::load(high, from + 8);
        registers::store(re.lane.data(), __builtin_shuffle(low, high, Places{0, 2, 4, 6, 8, 10, 12, 14}));
        registers::store(im.lane.data(), __builtin_shuffle(low, high, Places{1, 3, 5, 7, 9, 11, 13, 15}));
    } else {
        for (std::size_t k = 0; k < Lanes::size; ++k) {
            re.lane[k] = from[2 * k];
            im.lane[k] = from[2 * k + 1];
        }
    }
}
template <bool hasEight>
inline void writeParts(const Lanes& re, const Lanes& im, double* to) {
    if constexpr (hasEight) {
        registers::Eight x, y;
        registers::load(x, re.lane.data());
        registers::load(y, im.lane.data());
        registers::store(to, __builtin_shuffle(x, y, Places{0, 8, 1, 9, 2, 10, 3, 11}));
        registers::store(to + 8, __builtin_shuffle(x, y, Places{4, 12, 5, 13, 6, 14, 7, 15}));
    } else {
        for (std::size_t k = 0; k < Lanes::size; ++k) {
            to[2 * k] = re.lane[k];
            to[2 * k + 1] = im.lane[k];
        }
    }
}
/// psi_j *= scale exp(i factor (V_j + density |psi_j|^2)) of eight.
template <bool hasEight>
inline void kickEight(const double* V, double density, double factor, double scale, double* psi) {
    Lanes x, y;
    readParts<hasEight>(psi, x, y);
    const Lanes angle = Lanes(factor) * (Lanes::load(V) + Lanes(density) * (x * x + y * y)),
                c = Lanes(scale) * cos(angle), s = Lanes(scale) * sin(angle);
    writeParts<hasEight>(x * c - y * s, x * s + y * c, psi);
}
/// The same of n.
template <bool hasEight>
inline void kickLanes(const double* V, double density, double factor, double scale, std::size_t n,
                      double* psi) {
    constexpr std::size_t all = Lanes::size;
    const std::size_t rest = n % all, whole = n - rest;
    for (std::size_t first = 0; first < whole; first += all)
        kickEight<hasEight>(V + first, density, factor, scale, psi + 2 * first);
    if (rest == 0) return;
    std::array<double, all> lastV{};
    std::array<double, 2 * all> last{};
    std::copy_n(V + whole, rest, lastV.data());
    std::copy_n(psi + 2 * whole, 2 * rest, last.data());
    kickEight<hasEight>(lastV.data(), density, factor, scale, last.data());
    std::copy_n(last.data(), 2 * rest, psi + 2 * whole);
}

class WaveSplitting final : public WaveStep {
public:
    /// |psi| does not change in a kick, so that g |psi|^2 acts as V does; a rotation commutes with the
    /// kinetic part.
    WaveSplitting(std::shared_ptr<const Hamiltonian> hamiltonian, double step, const Splitting& splitting,
                  Coupling coupling)
        : WaveStep(std::move(hamiltonian), step, 0),
          splitting_(splitting),
          omega_(coupling.omega),
          density_(coupling.g / shared()->grid().measure()),
          psi_(static_cast<std::size_t>(n())) {}

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<WaveSplitting>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(hasNodes_, psi_);
        return WaveStep::checkpoint(archive);
    }

private:
    bool isLinear() const override { return density_ == 0; }
    /// The same fraction of an earlier stage, or this one.
    std::size_t firstLike(std::size_t k) const {
        std::size_t same = 0;
        const auto& stages = splitting_.stages;
        while (stages[same].isKick != stages[k].isKick || stages[same].fraction != stages[k].fraction) ++same;
        return same;
    }
    bool hasFixedKicks() const { return density_ == 0 && !shared()->isTimeDependent(); }
    void prepare() override {
        phases_.clear();
        const Hamiltonian& h = *shared();
        const double unit = dt() / h.hbar();
        for (const SplittingStage& s : splitting_.stages) {
            if (stop().stop_requested()) return;
            if (s.isKick && !hasFixedKicks()) {
                phases_.emplace_back();
                continue;
            }
            // Equal fractions share their phases: a table has each twice.
            if (const std::size_t same = firstLike(phases_.size()); same < phases_.size()) {
                phases_.push_back(phases_[same]);
                continue;
            }
            auto phases = std::make_shared<std::vector<Complex>>();
            for (const double E : s.isKick ? h.potential() : h.kinetic())
                phases->push_back(std::polar(s.isKick ? 1.0 / h.size() : 1.0, -s.fraction * unit * E));
            phases_.push_back(std::move(phases));
        }
        if (!hasFixedKicks()) V_ = h.potential();
        prepareTurns();
    }
    void prepareTurns() {
        turns_.clear();
        for (std::size_t k = 0; omega_ != 0 && k < splitting_.stages.size(); ++k) {
            if (stop().stop_requested()) return;
            const SplittingStage& s = splitting_.stages[k];
            const std::size_t first = firstLike(k);
            turns_.push_back(s.isKick ? nullptr
                             : first < k
                                 ? turns_[first]
                                 : std::make_shared<const PlaneTurn>(*shared(), s.fraction * dt() * omega_));
        }
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
                if (!turns_.empty()) turns_[k]->apply(v);
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
        if (hasFixedKicks()) return multiply(psi_.data(), *phases_[k]);
        if (shared()->isTimeDependent()) shared()->potentialAt(t, V_.data());
        static const auto call =
            ForThisMachine<&kickLanes<true>, &kickLanes<false>, &kickLanes<false>>::call();
        call(V_.data(), density_, -splitting_.stages[k].fraction * dt() / shared()->hbar(), 1.0 / n(),
             psi_.size(), reinterpret_cast<double*>(psi_.data()));
    }
    static void multiply(Complex* v, const std::vector<Complex>& phases) {
        ComplexVectors::ofThisMachine().multiply(v, phases.data(), phases.size());
    }

    Splitting splitting_;
    double omega_;    ///< of the rotating frame
    double density_;  ///< g |psi|^2 over the square of what psi_ holds
    std::vector<std::shared_ptr<const std::vector<Complex>>> phases_;
    std::vector<std::shared_ptr<const PlaneTurn>> turns_;  ///< of drifts, where there is a rotation
    std::vector<Complex> psi_;  ///< at the nodes, without the factor of the transform
    std::vector<double> V_;
    bool hasNodes_ = false;
};

}  // namespace

std::unique_ptr<Integrator> makeWaveSplitting(const System& system, double step, const Splitting& splitting) {
    return std::make_unique<WaveSplitting>(system.hamiltonian(), step, splitting, couplingOf(system.parts));
}

}  // namespace extremal
