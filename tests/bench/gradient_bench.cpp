// SPDX-License-Identifier: GPL-3.0-or-later
/// What a gradient by 1000 controls at the nodes costs, in runs: processor time of study/gradient's sweep
/// (the recorded run and the way back) over that of a plain run of the same scheme and steps, the best of
/// several, in one process. The plain run has the control as the table that it is in the scene; the recorded
/// one has its coefficients on each step as coordinates of the system.
#include <algorithm>
#include <cstdio>
#include <string>

#include "engine/model/system.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/varied_motion.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/gradient/run_derivative.hpp"
#include "tests/bench/cpu_time.hpp"

using namespace extremal;

namespace {

/// A chain of pendulums, the torque on the first of which is a table of so many rows, a step from row to row:
/// a force, with friction, or a potential.
ReadScene sceneOf(const std::string& scheme, int pendulums, int rows, bool isForce) {
    std::string table, names, lagrangian, initial, zeros;
    for (int k = 0; k < rows; ++k)
        table += (k ? ",[" : "[") + std::to_string(0.05 * k) + "," +
                 std::to_string(0.3 * ((k * 7) % 11) / 11.0) + "]";
    for (int i = 0; i < pendulums; ++i) {
        const std::string x = "x" + std::to_string(i), comma = i ? "," : "", plus = i ? "+" : "";
        names.append(comma).append("\"").append(x).append("\"");
        lagrangian.append(plus).append(x).append("_t^2/2+cos(").append(x).append(")");
        if (i > 0)
            lagrangian.append("-(").append(x).append("-x").append(std::to_string(i - 1)).append(")^2/2");
        initial.append(comma).append("0.4");
        zeros.append(comma).append("0");
    }
    return readScene(R"json({"extremal":1,"model":{"type":"lagrangian","coordinates":[)json" + names +
                     R"json(],"lagrangian":")json" + lagrangian +
                     (isForce ? R"json(","forces":{"x0":"u-0.1*x0_t"})json" : R"json(+u*x0")json") +
                     R"json(,"controls":{"u":{"table":[)json" + table +
                     R"json(],"interpolation":"linear"}}},"initial":{"q":[)json" + initial +
                     R"json(],"p":[)json" + zeros + R"json(]},"time":{"end":)json" +
                     std::to_string(0.05 * (rows - 1)) + R"json(},"schemes":[{"scheme":")json" + scheme +
                     R"json(","step":0.05}],"reference":{"type":"none"}})json");
}

template <class Work>
double best(const Work& work) {
    double least = 1e300;
    for (int i = 0; i < 9; ++i) {
        const double from = cpuSeconds();
        work();
        least = std::min(least, cpuSeconds() - from);
    }
    return least;
}

/// The row of one scheme; its ratio, or 0 where something failed.
double ratioOf(const char* scheme, int pendulums, int rows, bool isForce) {
    const ReadScene read = sceneOf(scheme, pendulums, rows, isForce);
    if (!read.resolved) {
        std::printf("%s\n", read.errors.front().message.c_str());
        return 0;
    }
    const ResolvedScene& scene = *read.resolved;
    const ResolvedScheme& own = scene.schemes.front();
    const double plain = best([&] {
        const auto integrator = own.make(*scene.system, own.spec.step.value, scene.initial);
        State state = scene.initial;
        integrator->begin(state);
        for (int k = 0; k + 1 < rows; ++k)
            if (advance(*integrator, state).outcome != Outcome::converged) std::printf("failed\n");
    });
    RunDerivative run(scene, {.controls = {{"u", 2}}});
    const Eigen::MatrixXd c = Eigen::MatrixXd::Constant(2, run.steps(), 0.1);
    const double recorded = best([&] { (void)run.run(run.start(), c); });
    const Eigen::VectorXd l = run.columnOf(Eigen::VectorXd::Ones(2 * pendulums), 0);
    const double backward = best([&] {
        RunDerivative::Derivatives by;
        (void)run.differentiate(l, by);
    });
    const double ratio = (recorded + backward) / plain;
    std::printf("%-18s %-9s %9d %10.3f %10.3f %10.3f %8.2f %8.2f\n", scheme, isForce ? "force" : "potential",
                pendulums, 1e3 * plain, 1e3 * recorded, 1e3 * backward, ratio,
                (recorded + backward) / recorded);
    return ratio;
}

}  // namespace

int main() {
    constexpr int rows = 1000;
    std::printf("%-18s %-9s %9s %10s %10s %10s %8s %8s\n", "scheme", "torque", "pendulums", "run [ms]",
                "recorded", "backward", "ratio", "of own");
    double worst = 0;
    for (const bool isForce : {true, false})
        for (const int pendulums : {1, 4, 12})
            for (const char* scheme :
                 {"galerkin-gauss-1", "galerkin-gauss-2", "galerkin-gauss-3", "galerkin-gauss-4"})
                worst = std::max(worst, ratioOf(scheme, pendulums, rows, isForce));
    std::printf("at most %.2f runs for a gradient by %d controls\n", worst, rows);
    return 0;
}
