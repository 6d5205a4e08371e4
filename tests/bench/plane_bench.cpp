// SPDX-License-Identifier: GPL-3.0-or-later
/// Wave functions in the plane: transforms, and work against precision, in one process.
///
/// Transforms: ours, by rows and then a few columns at a time, against one estimated and one measured plan of
/// FFTW for the whole. P: V = 20 (2 - cos x - cos y) + 10 cos(x - y), which couples x and y, 128 x 128 modes,
/// T = 1. Reference: Chebyshev's series.

#include <fftw3.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "engine/model/wave/basis/fourier.hpp"
#include "engine/model/wave/hamiltonian.hpp"
#include "tests/bench/wave_costs.hpp"

using namespace extremal;
using namespace extremal::bench;

namespace {

/// Microseconds: the best of some.
template <class Run>
double microseconds(Run&& run) {
    run();
    double best = 1e300;
    for (int i = 0; i < 40; ++i) {
        const double start = cpuSeconds();
        for (int k = 0; k < 5; ++k) run();
        best = std::min(best, (cpuSeconds() - start) / 5);
    }
    return 1e6 * best;
}

void compareTransforms(int n) {
    const auto size = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
    std::vector<Complex> from(size, Complex(1)), to(size);
    const auto raw = [](std::vector<Complex>& v) { return reinterpret_cast<fftw_complex*>(v.data()); };
    const auto whole = [&](unsigned how) {
        const fftw_plan plan =
            fftw_plan_dft_2d(n, n, raw(from), raw(to), FFTW_FORWARD, how | FFTW_PRESERVE_INPUT);
        std::fill(from.begin(), from.end(), Complex(1));
        const double time = microseconds([&] { fftw_execute(plan); });
        fftw_destroy_plan(plan);
        return time;
    };
    const Fourier fourier({{0, 1}, n, {0, 1}, n}, Fourier::Planning::estimated);
    const double own = microseconds([&] { fourier.rawToCoefficients(from.data(), to.data()); });
    const double estimated = whole(FFTW_ESTIMATE), measured = whole(FFTW_MEASURE);
    std::printf("%4d x %-4d ours %8.1f us, over estimated %.2f, over measured %.2f\n", n, n, own,
                own / estimated, own / measured);
}

}  // namespace

int main() {
    for (const int n : {64, 128, 256, 512}) compareTransforms(n);

    WaveProblem p{"P",
                  makeSystem("schrodinger-2d", {{"potential", "20*(2 - cos(x) - cos(y)) + 10*cos(x - y)"},
                                                {"modes", 128.0},
                                                {"modes_y", 128.0}}),
                  {},
                  1,
                  {},
                  1e-12,
                  2};
    p.start = makeStart(p.system, {{"packet", "periodic-gaussian"},
                                   {"kappa", 10.0},
                                   {"centre", 1.2},
                                   {"wave_number", 3.0},
                                   {"kappa_y", 8.0},
                                   {"centre_y", 0.5},
                                   {"wave_number_y", -2.0}});
    p.exact = baselineMethod("chebyshev-propagation")(p, 16);
    const double targets[] = {1e-3, 1e-6, 1e-9};
    double splitting[3], gaussian[3];
    std::fill(splitting, splitting + 3, 1e300);
    std::fill(gaussian, gaussian + 3, 1e300);
    printHeading(p, targets);
    for (const char* id : {"srkn-14a", "srkn-11b", "blanes-moan-s10", "suzuki-4", "strang"})
        printCosts(p, id, baselineMethod(id), targets, splitting);
    printCosts(p, "chebyshev-propagation", baselineMethod("chebyshev-propagation"), targets, nullptr);
    for (const int degree : {2, 4, 8})
        for (const double tolerance : {1e-7, 1e-10})
            printCosts(p,
                       "Gauss " + std::to_string(2 * degree) +
                           (tolerance > 1e-9 ? ", krylov to 1e-7" : ", krylov to 1e-10"),
                       pairMethod(degree, "krylov", tolerance), targets, gaussian);
    std::printf("%-34s", "best Gauss / best splitting");
    for (int i = 0; i < 3; ++i)
        if (gaussian[i] < 1e300)
            std::printf("%12.1f", gaussian[i] / splitting[i]);
        else
            std::printf("%12s", "-");
    std::printf("\n");
    return 0;
}
