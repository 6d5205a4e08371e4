// SPDX-License-Identifier: GPL-3.0-or-later
/// How many motions a second one core computes in the lanes of vector instructions, against one after the
/// other through the same function, and against runs by hand-written loops: Kepler and Henon-Heiles with
/// Störmer-Verlet and a splitting of order 6. Prints ratios measured in one process.
#include <cmath>
#include <cstdio>
#include <string>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/run/cases/many_run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/bench/cpu_time.hpp"

using namespace extremal;

namespace {

/// A loop as one would write it: kick, drift, kick.
template <class Force>
double byHand(std::vector<std::vector<double>> starts, double h, long long steps, Force&& force) {
    double sum = 0;
    for (auto& s : starts) {
        double x = s[0], y = s[1], u = s[2], v = s[3], ax, ay;
        force(x, y, ax, ay);
        for (long long k = 0; k < steps; ++k) {
            u += h / 2 * ax, v += h / 2 * ay;
            x += h * u, y += h * v;
            force(x, y, ax, ay);
            u += h / 2 * ax, v += h / 2 * ay;
        }
        sum += x;
    }
    return sum;
}

}  // namespace

int main() {
    std::printf("%s\n", std::string(name(instructionSet())).c_str());
    for (const char* model : {"kepler", "henon-heiles"})
        for (const char* scheme : {"stormer-verlet", "srkn-11b"}) {
            const ReadScene read = readScene(std::string(R"({"extremal":1,"model":{"type":")") + model +
                                             R"("},"time":{"end":100},"reference":"none","observe":[],)" +
                                             R"("schemes":[{"step":0.01,"baseline":")" + scheme + "\"}]}");
            const ResolvedScene& scene = *read.resolved;
            std::vector<std::vector<double>> starts(640, scene.initial.x);
            for (std::size_t i = 0; i < starts.size(); ++i) starts[i][0] *= 1 + 1e-4 * static_cast<double>(i);
            const auto seconds = [&](bool isTogether) {
                double best = 1e9;
                for (int k = 0; k < 3; ++k) {
                    const double start = cpuSeconds();
                    const ManyMotions many = runMany(scene, 0, starts, {1, isTogether, {}}, {});
                    best = std::min(best, cpuSeconds() - start);
                    if (many.together != (isTogether ? starts.size() : 0)) std::printf("not together\n");
                }
                return best;
            };
            const double steps = 1e4 * static_cast<double>(starts.size());
            const double alone = seconds(false), together = seconds(true);
            double hand = std::nan("");
            if (std::string(scheme) == "stormer-verlet") {
                volatile double sum = 0;
                const double start = cpuSeconds();
                if (std::string(model) == "kepler")
                    sum = byHand(starts, 0.01, 10000, [](double x, double y, double& ax, double& ay) {
                        const double r2 = x * x + y * y, w = -1 / (r2 * std::sqrt(r2));
                        ax = w * x, ay = w * y;
                    });
                else
                    sum = byHand(starts, 0.01, 10000, [](double x, double y, double& ax, double& ay) {
                        ax = -x - 2 * x * y, ay = -y - x * x + y * y;
                    });
                (void)sum;
                hand = cpuSeconds() - start;
            }
            std::printf(
                "%-13s %-15s %6.1f ns a step alone, %5.2f together: %4.1f times as many; by hand %5.1f\n",
                model, scheme, 1e9 * alone / steps, 1e9 * together / steps, alone / together,
                1e9 * hand / steps);
        }
}
