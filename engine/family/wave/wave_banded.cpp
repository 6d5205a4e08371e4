/// The one-step scheme by elimination in Fourier space (solve/banded_poles.hpp).
#include <utility>

#include "engine/family/wave/pade.hpp"
#include "engine/family/wave/wave_solve.hpp"
#include "engine/family/wave/wave_step.hpp"

namespace extremal {
namespace {

class BandedWave final : public WaveStep {
public:
    BandedWave(std::shared_ptr<const Hamiltonian> hamiltonian, const Clock& clock, double shift, int degree,
               int together)
        : WaveStep(std::move(hamiltonian), clock, shift), degree_(degree), together_(together) {}

private:
    void prepare() override {
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
    void step(double, Complex* v, StepReport& report) override {
        for (const BandedPoles& g : groups_) g.apply(v);
        report.cost.linearSolves = degree_;
    }
    std::unique_ptr<WaveStep> withStep(const Clock& clock, double shift) const override {
        return makeBandedWave(shared(), clock, shift, degree_, together_);
    }

    int degree_, together_;
    std::vector<BandedPoles> groups_;
};

}  // namespace

std::unique_ptr<WaveStep> makeBandedWave(std::shared_ptr<const Hamiltonian> hamiltonian, const Clock& clock,
                                         double shift, int degree, int together) {
    return std::make_unique<BandedWave>(std::move(hamiltonian), clock, shift, degree, together);
}

}  // namespace extremal
