// SPDX-License-Identifier: GPL-3.0-or-later
/// The one-step scheme by elimination in Fourier space (solve/banded_poles.hpp).
#include <utility>

#include "engine/family/wave/gauss_waves.hpp"
#include "engine/family/wave/pade.hpp"
#include "engine/family/wave/wave_solve.hpp"
#include "engine/step/wave_step.hpp"

namespace extremal {
namespace {

class BandedWave final : public WaveStep {
public:
    BandedWave(std::shared_ptr<const Hamiltonian> hamiltonian, double step, double shift, int degree,
               int together)
        : WaveStep(std::move(hamiltonian), step, shift), degree_(degree), together_(together) {}

    BandedWave(const BandedWave& other)
        : WaveStep(other), degree_(other.degree_), together_(other.together_) {
        if (!other.groups_.empty()) prepare();
    }
    BandedWave& operator=(const BandedWave&) = delete;

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<BandedWave>(*this); }

private:
    /// Without the factors of this step size.
    std::unique_ptr<Integrator> inside() const override {
        return makeBandedWave(shared(), dt(), shift(), degree_, together_);
    }
    void prepare() override {
        groups_.clear();
        const CyclicBand Y = cyclicBand(hamiltonian(), dt(), shift());
        for (const PoleGroup& g : padeGroups(degree_, together_)) {
            // Groups of three, where s is odd, have no lanes of their own.
            if (g.zeta.size() == 3) {
                const auto pair = padeGroups(degree_, 2);
                for (auto it = pair.end() - 2; it != pair.end(); ++it)
                    groups_.emplace_back(Y, it->zeta, it->residue, it->sign);
                continue;
            }
            groups_.emplace_back(Y, g.zeta, g.residue, g.sign);
        }
    }
    void step(double, Complex* v, std::vector<double>&, StepReport& report) override {
        for (const BandedPoles& g : groups_) g.apply(v);
        report.cost.linearSolves = degree_;
    }

    int degree_, together_;
    std::vector<BandedPoles> groups_;
};

}  // namespace

std::unique_ptr<WaveStep> makeBandedWave(std::shared_ptr<const Hamiltonian> hamiltonian, double step,
                                         double shift, int degree, int together) {
    return std::make_unique<BandedWave>(std::move(hamiltonian), step, shift, degree, together);
}

}  // namespace extremal
