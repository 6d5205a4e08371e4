// SPDX-License-Identifier: GPL-3.0-or-later
/// Leapfrog over a rectangle of 2048 x 2048 cells: what it reads and writes a second against a triad loop
/// a = b + s c of the same size beside it, and with the sine-Gordon potential its time against a bare loop of
/// sines. Prints ratios measured in one process.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/family/field/plane_leapfrog.hpp"
#include "engine/model/plane_field/problem.hpp"
#include "engine/model/system.hpp"
#include "tests/bench/cpu_time.hpp"

using namespace extremal;

namespace {

constexpr int side = 2048;  // more than a scene may have: the problem is made by hand
constexpr std::size_t cells = std::size_t{side} * side;

/// Seconds, the best of five.
template <class Work>
double seconds(Work&& work) {
    work();
    double best = 1e9;
    for (int k = 0; k < 5; ++k) {
        const double start = cpuSeconds();
        work();
        best = std::min(best, cpuSeconds() - start);
    }
    return best;
}

double secondsOfStep(FieldPotential potential) {
    const wave::Grid grid{{0, 1}, side, {0, 1}, side};
    System system;
    system.parts.set(PlaneField{std::make_shared<const PlaneFieldProblem>(
        grid, std::vector<FieldComponent>{{"u", 1.0}}, JointPotential(std::move(potential)))});
    State state;
    state.x.resize(2 * cells);
    for (std::size_t i = 0; i < cells; ++i)
        state.x[i] = 2 * std::sin(6.283185307179586 * static_cast<double>(i % side) / side);
    const auto integrator = makePlaneLeapfrog(system, 1e-4);
    return seconds([&] {
               for (int k = 0; k < 4; ++k) (void)advance(*integrator, state);
           }) /
           4;
}

}  // namespace

int main() {
    std::vector<double> a(cells, 0.0), b(cells, 1.0), c(cells);
    for (std::size_t i = 0; i < cells; ++i) c[i] = 1e-6 * static_cast<double>(i % 6'000'000);
    double s = 0.5;
    const double triad = seconds([&] {
        for (std::size_t i = 0; i < cells; ++i) a[i] = b[i] + s * c[i];
        s += a[cells / 2] * 1e-9;
    });
    const double sines = seconds([&] {
        for (std::size_t i = 0; i < cells; ++i) a[i] = std::sin(c[i]);
        s += a[cells / 2] * 1e-9;
    });
    const double perTriad = 3.0 * sizeof(double) * cells / triad;
    std::printf("%s, triad %.1f GB/s, %.2f ns a sine\n", std::string(name(instructionSet())).c_str(),
                1e-9 * perTriad, 1e9 * sines / cells);
    for (const char* potential : {"none", "klein-gordon", "phi4", "sine-gordon"}) {
        const double step = secondsOfStep(FieldPotential(potential, 1, "/potential"));
        // It has to read u and u_t, and to write both.
        const double rate = 4.0 * sizeof(double) * cells / step;
        std::printf("leapfrog, %-13s %.2f ns a cell, %.1f GB/s: %.2f of the triad, %.2f of the sines\n",
                    potential, 1e9 * step / cells, 1e-9 * rate, rate / perTriad, step / sines);
    }
    return s > 0 ? 0 : 1;
}
